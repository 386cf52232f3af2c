// SPDX-License-Identifier: MIT
// Tolerance of lit, and of the channels of glass, at blended surfaces and glass against the reference. In
// mode surface the reference traces those with its own rays and filters their textures itself; opaque
// surfaces are a path's capture. Behind rough or refracting glass a path knows only its own image.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>
#include <string_view>

namespace diptych {

inline constexpr std::string_view throughGlassBecause =
    "any error of light through rough or refracting glass, which a path takes from its own picture";

class BlendedPixels {
public:
    // `pair` must outlive it.
    explicit BlendedPixels(const FramePair& pair);

    bool any() const { return reference_ != nullptr; }
    // Tolerance in the channel's unit; 0 for channels other than lit and those of glass. Next to a pixel
    // with a blended surface, it is the reference's change within two pixels. That covers the rasteriser's
    // edge, and a mip level one step coarser. Texels of glass have 8 bits.
    double allowed(const DebugMode& mode, std::size_t pixel) const;
    // Tolerance of light through rough or refracting glass; 0 for other pixels and channels. A path takes
    // this light from any pixel of its image of opaque surfaces; the reference traces it. Neither is below
    // 0, so they differ by at most the larger: the transmitted fraction of the image's brightest pixel, or
    // the reference's transmitted light. Light that the glass reflects has no part in it.
    double throughGlass(const DebugMode& mode, std::size_t pixel) const;
    bool anyGlass() const;

    // Whether the channel describes glass, which no path captures for the reference.
    static bool isOfGlass(const DebugMode& mode) {
        return sourceOf(mode.channel).part == MaterialPart::transmission;
    }

private:
    // The reference's image of a channel that glass and blending change; nullptr for others.
    const Image* imageOf(const DebugMode& mode) const;
    double texel(const DebugMode& mode) const;

    const FramePair& pair_;
    const Frame* reference_ = nullptr;  // with Frame::blended
    double brightest_ = 0;              // largest component of the image of opaque surfaces, W/(sr m^2)
};

}  // namespace diptych
