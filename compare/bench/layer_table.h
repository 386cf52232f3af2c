// SPDX-License-Identifier: MIT
// Time, memory and registers of three ways to draw layered materials, by the share of the picture that they
// cover and by lights: --table layers.
#pragma once

#include "compare/bench/bench.h"

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::bench {

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
};

// In row order; they point into the rows of `bench`. None of other tables.
std::vector<LayerRow> layerRows(const Bench& bench);

// Where each way is the fastest, a sentence per outcome; then the bytes of each way.
std::vector<std::string> layersInWords(const Bench& bench);

std::string layersText(const Bench& bench);
std::vector<output::Block> layerBlocks(const Bench& bench);  // of the page
nlohmann::ordered_json layersJson(const Bench& bench);
// Time over the covered share: a panel per light count and kind, a line per way.
std::string layersPlot(const Bench& bench, PlotPlace place);

}  // namespace diptych::bench
