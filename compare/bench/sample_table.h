// SPDX-License-Identifier: MIT
// Time and memory by samples a pixel: the table of Billeter, Olsson and Assarsson 2013, "Tiled Forward
// Shading" (GPU Pro 4), of any scene: forward+ without blended surfaces and with them, and deferred.
#pragma once

#include "compare/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace diptych::bench {

struct SampleTable {
    // A path without blended surfaces or with them.
    struct Line {
        Path path;
        Transparency transparency;
        std::vector<const BenchRow*> cells;  // by column; nullptr: not timed
        std::string name() const;            // "deferred, opaque only"
    };
    Size size;
    std::string scene;
    std::uint64_t lights = 0;
    std::vector<int> columns;  // samples a pixel, ascending
    std::vector<Line> lines;
};

// Of --table msaa one for each size and light count, in the order of the rows; else none. They refer to the
// rows.
std::vector<SampleTable> sampleTables(const Bench& bench);

// The passes that light surfaces, ms.
double lightingMs(const BenchRow& row);
// A sample's share of depth and, of deferred, the G-buffer; bytes.
std::uint64_t bytesPerSample(const BenchRow& row);

// What a path keeps for a sample, beside the 32 bytes that the paper's deferred renderer does and what these
// take at 1920x1080: a sentence a path.
std::vector<std::string> memoryInWords(const SampleTable& table);

std::string sampleTablesText(const Bench& bench);
std::string sampleTablesHtml(const Bench& bench);
nlohmann::ordered_json sampleTablesJson(const Bench& bench);

}  // namespace diptych::bench
