// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/scene.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// Device formats of RGBA texels: 8-bit sRGB (alpha linear), 8 or 16 bits of linear 0 to 1, and linear
// floats of 16 or 32 bits.
enum class Texels { srgb8, linear8, linear16, float16, float32 };

std::size_t bytesPerTexel(Texels texels);

// The mip chain of an image: level 0 first, down to 1x1, each level half the size, rounded down as in
// Vulkan. Averages are linear; with `srgb`, colour is decoded from sRGB first. Odd sizes are weighted by
// area, so every texel counts equally. Each level averages the unrounded level before it, so rounding
// errors do not add up. If level 0 needs no conversion, it refers to the image's memory, and the image
// must outlive the chain.
class MipChain {
public:
    // An 8-bit image converts to any format, a 16-bit one to linear16, float16 or float32. Floats convert
    // to float32, or to float16 with values clamped to 65504. srgb8 requires `srgb`; linear8 and linear16
    // require linear codes.
    MipChain(const TextureImage& image, bool srgb, Texels texels);

    // Copies component `component` of another chain into the alpha of this one. Both have 8 bits, and that
    // component is linear. Their sizes must agree from some level on. Larger levels are magnified
    // bilinearly from the other chain's first level, with repeating or clamped edges, and rounded to
    // codes.
    void replaceAlpha(const MipChain& from, std::size_t component, bool repeat_x, bool repeat_y);

    // Copies level 0 if it refers to the image's memory, so that the image need not outlive the chain.
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
    std::vector<std::vector<std::byte>> levels_;  // the first is empty if image_ is level 0
};

}  // namespace diptych
