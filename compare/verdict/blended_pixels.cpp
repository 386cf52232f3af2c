// SPDX-License-Identifier: MIT
#include "compare/verdict/blended_pixels.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/neighbours.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <cmath>

namespace diptych {

BlendedPixels::BlendedPixels(const FramePair& pair) : pair_(pair) {
    if (!pair.hasReference() || pair.reference().blended.empty()) return;
    reference_ = &pair.reference();
    for (const float v : reference_->unblended.data)
        if (std::isfinite(v)) brightest_ = std::max(brightest_, double{v});
}

const Image* BlendedPixels::imageOf(const DebugMode& mode) const {
    const bool moved =
        mode.channel == Channel::lit || mode.channel == Channel::lit_transmission || isOfGlass(mode);
    return reference_ && moved ? &reference_->channels.at(mode.channel) : nullptr;
}

double BlendedPixels::throughGlass(const DebugMode& mode, std::size_t pixel) const {
    if (!isLit(mode.channel) || !imageOf(mode)) return 0;
    const Image& glass = reference_->blended;
    double fraction = 0;
    within(glass, pixel, 1,
           [&](std::size_t i, int, int) { fraction = std::max(fraction, double{glass.pixel(i)[1]}); });
    return fraction > 0 ? std::max(fraction * brightest_, metrics::largestFinite(glass.pixel(pixel) + 2, 1))
                        : 0;
}

double BlendedPixels::allowed(const DebugMode& mode, std::size_t pixel) const {
    const Image* const image = imageOf(mode);
    if (!image) return 0;
    bool covered = false;
    within(*image, pixel, 1,
           [&](std::size_t i, int, int) { covered = covered || *reference_->blended.pixel(i) > 0; });
    if (!covered) return 0;
    double range = 0;
    within(*image, pixel, 2, [&](std::size_t i, int, int) {
        range = std::max(range, metrics::distance(image->pixel(i), image->pixel(pixel), mode.width));
    });
    return range + throughGlass(mode, pixel) + texel(mode);
}

double BlendedPixels::texel(const DebugMode& mode) const {
    if (!isOfGlass(mode) || pair_.needs.textures == 0) return 0;
    return mode.texels == TexelUse::length   ? double{pair_.needs.volume_thickness_range} / 255
           : mode.texels == TexelUse::number ? 1.0 / 255
                                             : 0;
}

bool BlendedPixels::anyGlass() const {
    if (!reference_) return false;
    const Image& fractions = reference_->blended;
    for (std::size_t i = 0; i < fractions.pixels(); ++i)
        if (fractions.pixel(i)[1] > 0) return true;
    return false;
}

}  // namespace diptych
