// SPDX-License-Identifier: MIT
// Time and memory by samples per pixel: forward+ with and without transparency, and deferred. After the
// table of Billeter, Olsson and Assarsson 2013, "Tiled Forward Shading" (GPU Pro 4).
#pragma once

#include "compare/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::bench {

struct SampleTable {
    // A path with or without transparency.
    struct Line {
        Path path;
        Transparency transparency;
        std::vector<const BenchRow*> cells;  // by column; nullptr: not timed
        std::string name() const;            // "deferred, opaque only"
    };
    Size size;
    std::string scene;
    std::uint64_t lights = 0;
    std::vector<int> columns;  // samples per pixel, ascending
    std::vector<Line> lines;
};

// With --table msaa one per size and light count, in row order; else none. They point into the rows of
// `bench`.
std::vector<SampleTable> sampleTables(const Bench& bench);

// Time of passes that light surfaces, ms.
double lightingMs(const BenchRow& row);
// Bytes per sample of depth and, for deferred, the G-buffer.
std::uint64_t bytesPerSample(const BenchRow& row);

// One sentence per path: bytes per sample, compared with the 32 bytes of the paper's deferred renderer,
// and the totals at 1920x1080.
std::vector<std::string> memoryInWords(const SampleTable& table);

std::string sampleTablesText(const Bench& bench);
std::vector<output::Block> sampleBlocks(const Bench& bench);  // of the page
nlohmann::ordered_json sampleTablesJson(const Bench& bench);

}  // namespace diptych::bench
