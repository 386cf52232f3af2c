// SPDX-License-Identifier: MIT
// Groups of options that several commands share, or that one command alone has many of.
#pragma once

#include "compare/cli/parsed_options.h"

#include <CLI/CLI.hpp>

#include <string>

namespace diptych::cli {

inline constexpr const char* pixel_group = "Settings (may change a pixel)";
inline constexpr const char* picture_group = "Channels and pictures";
inline constexpr const char* output_group = "Output";
inline constexpr const char* selection_group = "Comparison";
inline constexpr const char* device_group = "Device and timing";

void addSettings(CLI::App& app, ParsedOptions& parsed, const std::string& except = "");
void addPicture(CLI::App& app, Options& options, ParsedOptions& parsed);
void addOutput(CLI::App& app, Options& options);
// `usual`: help of --out.
void addFiles(CLI::App& app, Options& options, const std::string& usual);
void addSelection(CLI::App& app, SelectionOptions& selection, ParsedOptions& parsed);
void addTolerances(CLI::App& app, Options& options);
void addDiff(CLI::App& app, PictureDiffOptions& diff, ParsedOptions& parsed);
void addShard(CLI::App& app, Options& options);
void addSince(CLI::App& app, Options& options);
// `usual`: what a sweep tries without --grid.
void addGrid(CLI::App& app, Options& options, const char* usual);
void addChoose(CLI::App& app, ChooseOptions& choose, ParsedOptions& parsed);
void addAudit(CLI::App& app, AuditOptions& audit, ParsedOptions& parsed);
void addReport(CLI::App& app, Options& options, ParsedOptions& parsed);
void addView(CLI::App& app, ViewOptions& view);
void addBench(CLI::App& app, ParsedOptions& parsed);
// `what`: what the command does with an external renderer.
void addRenderers(CLI::App& app, ParsedOptions& parsed, const char* what);
void addSides(CLI::App& app, ParsedOptions& parsed);
void addDevice(CLI::App& app, Options& options);

}  // namespace diptych::cli
