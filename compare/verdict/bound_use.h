// SPDX-License-Identifier: MIT
// Bound utilization of a channel whose bound differs from pixel to pixel.
#pragma once

#include "compare/metrics/channel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace diptych {

struct BoundUse {
    double used = 0;           // largest error divided by its pixel's bound; fails above 1
    int x = -1, y = -1;        // its pixel
    std::uint64_t beyond = 0;  // pixels with an error above their bound
    double max = 0, mean = 0;  // of the finite bounds, in the channel's error kind
};

// For one pixel: its error divided by its bound (0 without an error), and the bound.
struct PixelUse {
    double fraction = 0, bound = 0;
};
inline PixelUse pixelUse(double error, double bound) {
    return {error == 0 ? 0 : error / bound, bound};
}

// Over the covered pixels of an image `width` pixels wide. `of`: the PixelUse of a pixel, by row-major
// index.
template <class Of>
BoundUse boundUse(const Coverage& coverage, int width, const Of& of) {
    BoundUse use;
    for (std::size_t i = 0; i < coverage.covered.size(); ++i) {
        if (!coverage.covered[i]) continue;
        const auto [fraction, bound] = of(i);
        if (std::isfinite(bound)) {
            use.max = std::max(use.max, bound);
            use.mean += bound;
        }
        if (fraction == 0) continue;
        use.beyond += !(fraction <= 1);
        if (!(fraction > use.used) && use.x >= 0) continue;
        use.used = fraction;
        use.x = static_cast<int>(i % static_cast<std::size_t>(width));
        use.y = static_cast<int>(i / static_cast<std::size_t>(width));
    }
    if (coverage.count > 0) use.mean /= static_cast<double>(coverage.count);
    return use;
}

}  // namespace diptych
