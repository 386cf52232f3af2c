// SPDX-License-Identifier: MIT
// FLIP's errors of two pictures, tile by tile. Beside the pictures each thread holds a few dozen rows of one
// tile.
#pragma once

#include "compare/metrics/flip_filters.h"
#include "compare/metrics/flip_rows.h"
#include "shared/image/image.h"

#include <cstdint>
#include <vector>

namespace diptych {

// Whether a pixel is left out of the filters because a component is NaN or infinite: not at all, in both
// pictures with the same value, or otherwise.
enum class Hole : std::uint8_t { none, same, different };

struct FlipPair {
    const Image *reference, *test;  // W x H x 3, alike
    std::vector<Hole> holes;        // W x H; empty: none
};

// One exposure of a pair of linear pictures: values are multiplied by `scale` and tone mapped.
struct FlipLook {
    float scale;
    ToneMapper mapper;
};

// Errors of a pair of sRGB pictures (no looks), or the largest over the looks at a linear pair; then `which`
// gets the first look that has it. At a hole the error is 0 (same) or 1 (different), at look 0.
void flipErrorMap(const FlipPair& pair, const FlipFilters& filters, const std::vector<FlipLook>& looks,
                  Image& errors, Image* which);

}  // namespace diptych
