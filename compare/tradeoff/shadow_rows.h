// SPDX-License-Identifier: MIT
// The rows of a sweep whose shadows of the sun were judged, and which of them another one beats.
#pragma once

#include "compare/tradeoff/tradeoff.h"

namespace diptych::tradeoff {

struct ShadowRow {
    std::size_t row = 0;  // index
    ShadowErrors errors{};
    double ms = 0;            // of a frame
    std::uint64_t bytes = 0;  // of a frame: images and buffers
    // Some other row has no more error, and takes no more time, or memory, and less of one of the two.
    bool beaten_in_time = false, beaten_in_memory = false;
};

// By ascending error. Empty where the reference traced no sun that casts, or no two rows differ in their
// shadows.
std::vector<ShadowRow> shadowRowsOf(const Tradeoff& tradeoff);

// On a terminal; empty without such rows.
std::string shadowTable(const Tradeoff& tradeoff);
// On the page; empty without such rows.
std::string shadowTableHtml(const Tradeoff& tradeoff);

}  // namespace diptych::tradeoff
