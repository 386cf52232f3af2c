// SPDX-License-Identifier: MIT
// Conclusions of a benchmark, and findings of its tables growth, layers and msaa. Pointers are into the rows
// of the Bench.
#pragma once

#include "compare/bench/bench.h"
#include "compare/experiment/intervals.h"
#include "compare/output/document.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace diptych::bench {

// Says which Settings are faster, by how much, how certainly, and because of which pass. Compares
// rows with equal size, light count and image: the fastest with the fastest of the other path. With only one
// path, compares it with the next row.
struct Conclusion {
    const BenchRow *faster = nullptr, *slower = nullptr;
    experiment::TimeRatio ratio;  // time of the slower over the faster
    // The pass that accounts for most of the difference; empty if none does.
    std::string pass;
    double faster_ms = 0, slower_ms = 0;  // of that pass, ms; 0 if the row lacks it

    std::string describe() const;  // a sentence
};

// By size and light count, in row order. Single rows have no conclusion.
std::vector<Conclusion> conclusionsOf(const Bench& bench);

// --table growth: one path on one axis.
struct GrowthLine {
    GrowthAxis axis;
    Path path;
    std::vector<const BenchRow*> rows;  // ascending
};

// The range with the largest growth: amount ~ quantity^exponent from `value` to `until`. Every step in the
// range grows at least as the square root. Not found if no step does.
struct Bend {
    double value = 0, until = 0;
    double exponent = 0;
    bool found = false;
};

// In row order.
std::vector<GrowthLine> growthLines(const Bench& bench);

// `values` ascend, `amounts` are positive. Throws std::logic_error if their counts differ.
Bend bendOf(const std::vector<double>& values, const std::vector<double>& amounts);

// Device memory of a row's frame and scene, MiB.
double memoryMib(const BenchRow& row);

// A sentence per line and metric: where growth starts, its exponent, and the pass that causes most of it.
std::vector<std::string> growthText(const Bench& bench);

// --table layers: time, memory and registers of three ways to draw layered materials, by the fraction of the
// image that they cover and by lights.
struct LayerWay {
    bool has_gbuffer;
    Layers layers;  // with a G-buffer

    Path path() const { return *std::ranges::find(drawn_paths, has_gbuffer, hasGBuffer); }
    std::string name() const;  // "deferred by forward"
};
inline constexpr std::array layerWays{LayerWay{false, Layers::gbuffer}, LayerWay{true, Layers::gbuffer},
                                      LayerWay{true, Layers::forward}};

struct LayerRow {
    Cover cover;
    std::uint64_t lights = 0;
    std::array<const BenchRow*, layerWays.size()> ways{};  // nullptr: not timed
    // Indices into `ways`, ascending: the least median, and all that do not differ from it significantly
    // (TimeRatio). Empty if fewer than two were timed.
    std::vector<std::size_t> fastest{};
    double lead = 0;  // how many times as long the next takes, median ratio; 0 if none takes longer

    std::vector<std::string> fastestNames() const;
};

// In row order. None of other tables.
std::vector<LayerRow> layerRows(const Bench& bench);

// Where each way is the fastest, a sentence per outcome; then the bytes of each way.
std::vector<std::string> layersText(const Bench& bench);

std::vector<output::Block> layerBlocks(const Bench& bench);

// Bytes per pixel of all full-size images.
std::uint64_t imageBytesPerPixel(const BenchRow& row);

// --table msaa: time and memory by samples per pixel, forward+ with and without transparency, and deferred.
// After the table of Billeter, Olsson and Assarsson 2013, "Tiled Forward Shading" (GPU Pro 4).
struct SampleTable {
    // A path with or without transparency.
    struct Line {
        Path path;
        Transparency transparency;
        std::map<int, const BenchRow*> cells{};  // by samples per pixel
        std::string name() const;                // "deferred, opaque only"
    };
    Size size;
    std::string scene;
    std::uint64_t lights = 0;
    std::set<int> columns{};  // samples per pixel
    std::vector<Line> lines{};
};

// With --table msaa one per size and light count, in row order; else none.
std::vector<SampleTable> sampleTables(const Bench& bench);

// Bytes per sample of depth and, for deferred, the G-buffer.
std::uint64_t bytesPerSample(const BenchRow& row);
// MiB of all full-size images.
double imageMib(const BenchRow& row);

// One sentence per path: bytes per sample, and the totals at 1920x1080.
std::vector<std::string> memoryText(const SampleTable& table);

std::vector<output::Block> sampleBlocks(const Bench& bench);

}  // namespace diptych::bench
