// SPDX-License-Identifier: MIT
// How much a channel uses of a bound that each pixel has.
#pragma once

#include "compare/metrics/channel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace diptych {

struct BoundUse {
    double used = 0;            // the largest error divided by its pixel's bound; above 1 is too much
    int x = -1, y = -1;         // its pixel
    std::uint64_t beyond = 0;   // pixels with an error above their bound
    double most = 0, mean = 0;  // of the finite bounds, in the channel's metric
};

// Of one pixel: its error divided by its bound, 0 where there is no error; and that bound.
struct PixelUse {
    double share = 0, bound = 0;
};
inline PixelUse pixelUse(double error, double bound) {
    return {error == 0 ? 0 : error / bound, bound};
}

// Over the covered pixels of an image `width` pixels wide. `of`: the PixelUse of a pixel, row by row.
template <class Of>
BoundUse boundUse(const Coverage& coverage, int width, const Of& of) {
    BoundUse use;
    for (std::size_t i = 0; i < coverage.covered.size(); ++i) {
        if (!coverage.covered[i]) continue;
        const auto [share, bound] = of(i);
        if (std::isfinite(bound)) {
            use.most = std::max(use.most, bound);
            use.mean += bound;
        }
        if (share == 0) continue;
        use.beyond += !(share <= 1);
        if (!(share > use.used) && use.x >= 0) continue;
        use.used = share;
        use.x = static_cast<int>(i % static_cast<std::size_t>(width));
        use.y = static_cast<int>(i / static_cast<std::size_t>(width));
    }
    if (coverage.count > 0) use.mean /= static_cast<double>(coverage.count);
    return use;
}

}  // namespace diptych
