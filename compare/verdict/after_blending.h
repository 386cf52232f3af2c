// SPDX-License-Identifier: MIT
// Differences of lit that appear where something is blended over the opaque picture, and were not there
// before.
#pragma once

#include "compare/verdict/frame_pair.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace diptych {

struct AfterBlending {
    std::uint64_t covered = 0;  // pixels that are judged and over which something is blended
    std::uint64_t before = 0;   // pixels of which lit differs before that
    std::uint64_t pixels = 0;   // that differ after it and did not, or not as much, before
    std::uint64_t allowed = 0;  // so many of these may
    double largest = 0;         // of their differences after it, lit's metric
    int x = -1, y = -1;         // its pixel

    bool passed() const { return pixels <= allowed; }
};

// Of two paths: blending "over" weights what lies behind by 0 to 1, and what is blended is the same in both,
// so that no pixel may differ by more than before: on a CPU by not a bit where it did not differ, else by 16
// ULP of the pixel's largest component more, as both sums are rounded. Of a packed G-buffer forward+ shows
// what its surfaces are after the encoding, so that what the encoding explains is no difference. Of a path
// and the reference in mode surface: pixels within lit's tolerance before and beyond it after, of which there
// may be a thousandth of those that something blended covers, rounded up. Empty where nothing is blended, and
// for pictures of which it is not known what they were before.
std::optional<AfterBlending> afterBlending(const FramePair& pair);

// "after the transparent draw: 132 pixels of lit differ that did not before it ..."; empty where it passed.
std::string faultOf(const AfterBlending& found);

}  // namespace diptych
