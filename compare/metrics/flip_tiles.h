// SPDX-License-Identifier: MIT
// FLIP's errors of two pictures, tile by tile. Beside the pictures each thread holds a few dozen rows of one
// tile.
#pragma once

#include "compare/metrics/flip_filters.h"
#include "compare/metrics/flip_rows.h"
#include "shared/image/image.h"
#include "shared/image/picture_rows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

// Whether a pixel is left out of the filters because a component is NaN or infinite: not at all, in both
// pictures with the same value, or otherwise.
enum class Hole : std::uint8_t { none, same, different };

struct FlipPair {
    PictureRows reference, test;  // W x H x 3, alike
    std::vector<Hole> holes;      // W x H; empty: none
};

// One exposure of a pair of linear pictures: values are multiplied by `scale` and tone mapped.
struct FlipLook {
    float scale;
    ToneMapper mapper;
};

// A reference as it is compared under some looks, so that of each test only its own half is filtered. 20
// bytes a pixel and look; the looks that `most_bytes` has room for, from the first on.
class FilteredReference {
public:
    // `holes`: as the pairs have them that it serves; W x H or empty.
    FilteredReference(const PictureRows& reference, const std::vector<Hole>& holes,
                      const FlipFilters& filters, const std::vector<FlipLook>& looks, std::size_t most_bytes);
    bool keeps(std::size_t look) const { return look < looks_.size(); }
    // From column x of row y on; of a look that is kept.
    ComparableRow row(std::size_t look, int x, int y) const;

private:
    std::size_t at(std::size_t plane, int x, int y) const;

    std::size_t width_, height_;
    std::vector<std::vector<float>> looks_;  // the planes of a ComparableRow, in its order
};

// Errors of a pair of sRGB pictures (no looks), or the largest over the looks at a linear pair. At a hole the
// error is 0 (same) or 1 (different). `kept`: of the pair's reference and holes, under these looks; the
// result is the same with and without it.
void flipErrorMap(const FlipPair& pair, const FlipFilters& filters, const std::vector<FlipLook>& looks,
                  Image& errors, const FilteredReference* kept = nullptr);

}  // namespace diptych
