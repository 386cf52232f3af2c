// SPDX-License-Identifier: MIT
// A complete benchmark and its outputs.
#pragma once

#include "compare/bench/cases.h"
#include "compare/plot/plot.h"
#include "compare/render/renderer.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::bench {

// Time of the passes whose names begin with `prefix`, in profiled frames, ms. Passes that build light lists
// begin with "assign", passes that light surfaces with "shade".
double passMs(const BenchRow& row, std::string_view prefix = {});
// Time of building light lists relative to all passes, 0 to 1.
double assignFraction(const BenchRow& row);

struct Bench {
    std::string scene;  // as on the command line
    BenchOptions options;
    ReportDevice device;
    int runs = 0;
    std::vector<BenchRow> rows, skips;
    std::string compiler = {};  // device of --compile-on; empty: none
};

// Measures the rows of one group. First renders one frame each to warm up, which also finds rows over
// options.max_ms. Then runs `runs` rounds of one frame each, and as many profiled rounds, at least three.
// Skipped rows go into bench.skips; times of earlier rows predict some skips. Groups share `pipelines`.
// isHopeless(): all rows of a growth group would be skipped. Its scene need not be read.
void measureGroup(Device& device, const std::shared_ptr<PipelineSet>& pipelines, const BenchGroup& group,
                  const Scene& scene, Bench& bench, const Stage& progress);
bool isHopeless(const Bench& bench, const BenchGroup& group);

// "1024", "36.4", "0.0123": four significant digits, all digits from 1000 on.
std::string msText(double ms);

std::string describeTime(const BenchRow& row);  // "12.3 (12.1 to 14)", ms

// Terminal text. benchTable(): rows from `first` on, with a header if it is 0. benchEnd(): notes, findings.
std::string benchTable(const Bench& bench, std::size_t first);
std::string benchEnd(const Bench& bench);
std::string benchHtml(const Bench& bench);
inline constexpr const char* starMeans =
    "* draws a different picture: only some lights are shaded per pixel, the others per object";

// SVG of time over light count, log-log: a panel per size, a line per mode with bars from least to
// greatest time. With one light count: a stacked bar of passes per mode. Of time and memory over the quantity
// of --table growth; of time over the fraction that layers cover.
std::string benchPlot(const Bench& bench, PlotTarget target);
// bench.json, schema 2, without the list of files.
nlohmann::ordered_json benchJson(const Bench& bench);

// Writes the folder; returns bench.json.
std::string writeBench(const Bench& bench, const std::filesystem::path& folder, bool force);
inline constexpr const char* benchManifest = "bench.json";

}  // namespace diptych::bench
