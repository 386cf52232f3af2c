// SPDX-License-Identifier: MIT
// A whole benchmark, and the files and texts made of it.
#pragma once

#include "compare/bench/cases.h"
#include "compare/bench/kernels.h"
#include "compare/plot/drawing.h"
#include "compare/render/renderer.h"
#include "shared/frame/frame.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diptych::bench {

// The measurements of one Settings.
struct BenchRow {
    Settings settings;
    std::string scene;  // with its number of lights
    std::optional<std::uint32_t> requested_lights;
    std::string camera;  // its title
    FrameTime time;
    std::vector<double> ms;        // every timed frame, in order
    std::vector<PassTime> passes;  // medians of the profiled frames
    FrameBytes bytes;
    FrameCounters counters;
    std::vector<std::string> notes;  // what a reader must know about this frame
    ModeParts parts = {};
    std::optional<GrowthPoint> growth = {};
};

// The names of passes that make light lists begin with this.
inline constexpr std::string_view assignPasses = "assign";
// The time of the profiled passes that make light lists, ms; and their share of all passes, 0 to 1.
double assignMs(const BenchRow& row);
double assignShare(const BenchRow& row);

struct Bench {
    std::string scene;  // as asked for
    Settings given;
    BenchOptions options;
    ReportDevice device;
    int runs = 0;
    std::vector<BenchRow> rows;
    std::vector<BenchSkip> skips;
    std::optional<KernelReport> kernels;
};

// Measures the rows of one group: first a frame each to warm up, which also finds rows that take over
// options.max_ms; then `runs` rounds of one frame each; then as many profiled rounds, at least three. Rows
// left out go into bench.skips; earlier rows of `bench` predict which need not be tried.
// A group of --table growth whose axis had too much for every path already is not even read.
void measureGroup(Device& device, const BenchGroup& group, const Scene& scene, Bench& bench,
                  const Stage& progress);
bool isHopeless(const Bench& bench, const BenchGroup& group);

// The notes that every row has; they are shown once instead of for each row.
std::vector<std::string> commonNotes(const Bench& bench);

// "1024", "36.4", "0.0123": four digits, or all before the point.
std::string msText(double ms);

// Sizes of the rows, in their order.
std::vector<Size> sizesOf(const Bench& bench);

// On a terminal: rows from `first` on, under a head where `first` is 0; then skips, kernels and notes.
std::string benchTable(const Bench& bench, std::size_t first);
std::string benchEnd(const Bench& bench);
std::string kernelTable(const KernelReport& kernels);

// Whether a row draws another picture than the others, see drawsAnotherPicture().
bool hasAnotherPicture(const Bench& bench);

// Time over light count, a line a mode with bars from the least to the most; a panel a size. Both axes are
// logarithmic. Of one light count: a bar a mode, stacked of its passes.
std::string benchPlot(const Bench& bench, PlotPlace place);
std::string benchHtml(const Bench& bench);
// bench.json, schema 1; `files`: all of the folder.
std::string benchJson(const Bench& bench, const std::vector<std::string>& files);

// Writes the folder. Returns bench.json.
std::string writeBench(const Bench& bench, const std::filesystem::path& folder, bool force);
inline constexpr const char* benchManifest = "bench.json";

}  // namespace diptych::bench
