// SPDX-License-Identifier: MIT
// A complete benchmark and its outputs.
#pragma once

#include "compare/bench/cases.h"
#include "compare/output/document.h"
#include "compare/plot/drawing.h"
#include "compare/render/renderer.h"
#include "shared/frame/frame.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::bench {

// Prefix of passes that build light lists.
inline constexpr std::string_view assignPasses = "assign";
// Time of these passes in profiled frames, ms, and their fraction of all passes, 0 to 1.
double assignMs(const BenchRow& row);
double assignShare(const BenchRow& row);

struct Bench {
    std::string scene;  // as on the command line
    Settings given;
    BenchOptions options;
    ReportDevice device;
    int runs = 0;
    std::vector<BenchRow> rows, skips;
    std::string compiler = {};  // device of --compile-on; empty: none
};

// Rows, then skips.
std::vector<const experiment::Row*> allRows(const Bench& bench);

// Measures the rows of one group. First renders one frame each to warm up, which also finds rows over
// options.max_ms. Then runs `runs` rounds of one frame each, and as many profiled rounds, at least three.
// Skipped rows go into bench.skips; times of earlier rows predict some skips. Groups share `pipelines`.
// isHopeless(): all rows of a growth group would be skipped. Its scene need not be read.
void measureGroup(Device& device, const std::shared_ptr<PipelineSet>& pipelines, const BenchGroup& group,
                  const Scene& scene, Bench& bench, const Stage& progress);
bool isHopeless(const Bench& bench, const BenchGroup& group);

// Notes that all rows share; shown once.
std::vector<std::string> commonNotes(const Bench& bench);

// "1024", "36.4", "0.0123": four significant digits, all digits from 1000 on.
std::string msText(double ms);

std::string timeInWords(const BenchRow& row);  // "12.3 (12.1 to 14)", ms

// Distinct sizes, in order of the rows.
std::vector<Size> sizesOf(const Bench& bench);

std::string passesInWords(const BenchRow& row);  // "shade 1.2, resolve 0.1"; ms

output::Table modeTable(const Bench& bench);  // a row for each of the benchmark's

// Terminal text. benchTable(): rows from `first` on, with a header if it is 0. benchEnd(): skips, notes.
std::string benchTable(const Bench& bench, std::size_t first);
std::string benchEnd(const Bench& bench);

// Whether any row uses drawsAnotherPicture().
bool hasAnotherPicture(const Bench& bench);

// SVG of time over light count, log-log: a panel per size, a line per mode with bars from least to
// greatest time. With one light count: a stacked bar of passes per mode.
std::string benchPlot(const Bench& bench, PlotPlace place);
std::string benchHtml(const Bench& bench);
// bench.json, schema 2. `files`: all files of the folder.
std::string benchJson(const Bench& bench, const std::vector<std::string>& files);

// Writes the folder; returns bench.json.
std::string writeBench(const Bench& bench, const std::filesystem::path& folder, bool force);
inline constexpr const char* benchManifest = "bench.json";

}  // namespace diptych::bench
