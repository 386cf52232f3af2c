// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Formats of RGBA texels as a device samples them: 8 bits of sRGB (alpha linear), 8 or 16 bits of linear 0
// to 1, linear floats of 16 or 32 bits.
enum class Texels { srgb8, linear8, linear16, float16, float32 };

std::size_t bytesPerTexel(Texels texels);

// The mip chain of an image: level 0 first, down to 1x1, each level half the size of the one before, rounded
// down (Vulkan's sizes). Averages are made in linear light; with `srgb` the image's colour components are
// decoded from sRGB first, alpha is always linear. Odd sizes are weighted by area, so that every texel
// counts. Each level is averaged from the unrounded level before it: rounding happens only on output. Level
// 0 in the image's own texels (8, 16 bits or floats as they are) is the image's own memory, which must
// outlive the chain.
class MipChain {
public:
    // An image of 8 bits becomes any; one of 16 bits linear16, float16 or float32; one of floats float32, or
    // float16 with values limited to 65504. srgb8 is of sRGB, linear8 and linear16 are of linear codes.
    MipChain(const TextureImage& image, bool srgb, Texels texels);

    // Puts component `component` of another chain into the alpha of this one; both of 8 bits, linear but for
    // colours of sRGB. From some level on both must have the same sizes; the levels above are that one's
    // first as a linear filter magnifies it, in axes that repeat or else are clamped at the edge, rounded to
    // codes.
    void replaceAlpha(const MipChain& from, std::size_t component, bool repeat_x, bool repeat_y);

    // Copies level 0 where it is the image's own memory, which then need not outlive the chain.
    void own();

    const std::string& name() const { return name_; }
    Texels texels() const { return texels_; }
    std::size_t count() const { return levels_.size(); }
    int width(std::size_t level = 0) const;
    int height(std::size_t level = 0) const;
    std::span<const std::byte> level(std::size_t i) const {
        return i == 0 && levels_[0].empty() ? image_ : levels_[i];
    }

private:
    std::string name_;
    Texels texels_;
    int width_, height_;
    std::span<const std::byte> image_;
    std::vector<std::vector<std::byte>> levels_;  // the first is empty where image_ is level 0
};

}  // namespace diptych
