// SPDX-License-Identifier: MIT
// FLIP's errors of two images, tile by tile. Besides the images, each thread needs a few dozen rows of one
// tile.
#pragma once

#include "compare/metrics/flip_filters.h"
#include "compare/metrics/flip_rows.h"
#include "shared/image/image.h"
#include "shared/image/image_rows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diptych {

// Whether a pixel is excluded from the filters because a component is NaN or infinite: no; with the same
// value in both images; otherwise.
enum class Hole : std::uint8_t { none, same, different };

struct FlipPair {
    ImageRows reference, test;  // W x H x 3, same size
    std::vector<Hole> holes;    // W x H; empty: none
};

// One exposure of a linear pair: values are multiplied by `scale` and tone mapped.
struct FlipExposure {
    float scale;
    ToneMapper mapper;
};

// A reference that is already filtered at some exposures, so that only the tests need filtering. Takes 20
// bytes per pixel and exposure; caches the first exposures that fit into `max_bytes`.
class FilteredReference {
public:
    // `holes`: W x H or empty; must be those of the pairs that use it.
    FilteredReference(const ImageRows& reference, const std::vector<Hole>& holes, const FlipFilters& filters,
                      const std::vector<FlipExposure>& exposures, std::size_t max_bytes);
    bool has(std::size_t exposure) const { return exposure < exposures_.size(); }
    // Row y from column x on, for a cached exposure.
    ComparableRow row(std::size_t exposure, int x, int y) const;

private:
    std::size_t at(std::size_t plane, int x, int y) const;

    std::size_t width_, height_;
    std::vector<std::vector<float>> exposures_;  // planes of a ComparableRow, in its order
};

// Errors of a pair of sRGB images (no exposures), or the largest over those of a linear pair. Holes have
// error 0 (same) or 1 (different). `cache`: for the pair's reference, holes and exposures; it does not
// change the result.
void flipErrorMap(const FlipPair& pair, const FlipFilters& filters,
                  const std::vector<FlipExposure>& exposures, Image& errors,
                  const FilteredReference* cache = nullptr);

}  // namespace diptych
