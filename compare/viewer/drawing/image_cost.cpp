// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/image_cost.h"

#include <algorithm>
#include <cmath>

namespace diptych::viewer {

void ImageCost::add(double pixels, double ms) {
    // A briefly busy machine must not affect the estimate much, so it rises slowly.
    constexpr double slowly = 1.15;
    const auto take = [&](Point& point) {
        const bool same = point.pixels > 0 && pixels <= point.pixels * 1.5 && pixels * 1.5 >= point.pixels;
        point = {pixels, same ? std::min(ms, slowly * point.ms) : ms};
    };
    if (small_.pixels == 0 || pixels <= small_.pixels * 1.5) {
        if (small_.pixels >= 2 * pixels) large_ = small_;
        take(small_);
    } else {
        take(large_);
    }
}

double ImageCost::perPixel() const {
    if (!known()) return 0;
    const bool two = large_.pixels >= 1.5 * small_.pixels && large_.ms > small_.ms;
    return two ? (large_.ms - small_.ms) / (large_.pixels - small_.pixels) : small_.ms / small_.pixels;
}
double ImageCost::fixed() const {
    return known() ? std::max(0.0, small_.ms - perPixel() * small_.pixels) : 0;
}
double ImageCost::of(double pixels) const {
    return fixed() + perPixel() * pixels;
}

Size movingSize(const Size& full, double milliseconds, const ImageCost& cost) {
    const double room = std::max(0.5 * milliseconds, milliseconds - cost.fixed());
    const double expected = cost.perPixel() * full.width * full.height;
    // An image reduced by more than 8 is useless.
    const int divisor =
        cost.known() ? std::clamp(static_cast<int>(std::ceil(std::sqrt(expected / room) - 0.05)), 1, 8) : 3;
    Size size = full;
    size.width = std::max(1, full.width / divisor);
    size.height = std::max(1, full.height / divisor);
    return size;
}

}  // namespace diptych::viewer
