// SPDX-License-Identifier: MIT
#include "compare/verdict/blended_pixels.h"

#include "compare/metrics/pixel.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>

namespace diptych {
namespace {

template <class Visit>
void within(const Image& image, std::size_t pixel, int radius, const Visit& visit) {
    const int x = static_cast<int>(pixel) % image.width, y = static_cast<int>(pixel) / image.width;
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width - 1); ++u)
            visit(static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                  static_cast<std::size_t>(u));
}

}  // namespace

BlendedPixels::BlendedPixels(const FramePair& pair) {
    const bool first = isReferenceFrame(pair.baseline);
    if (first == isReferenceFrame(pair.test)) return;
    const Frame& reference = first ? pair.baseline : pair.test;
    const auto lit = reference.channels.find(static_cast<int>(gpu::DEBUG_lit));
    if (reference.blended.empty() || lit == reference.channels.end()) return;
    share_ = &reference.blended;
    lit_ = &lit->second;
}

double BlendedPixels::allowed(const DebugMode& mode, std::size_t pixel) const {
    if (!share_ || mode.number != static_cast<int>(gpu::DEBUG_lit)) return 0;
    bool covered = false;
    within(*share_, pixel, 1, [&](std::size_t i) { covered = covered || *share_->pixel(i) > 0; });
    if (!covered) return 0;
    double range = 0;
    within(*lit_, pixel, 2, [&](std::size_t i) {
        range = std::max(range, metrics::distance(lit_->pixel(i), lit_->pixel(pixel), mode.width));
    });
    return range;
}

}  // namespace diptych
