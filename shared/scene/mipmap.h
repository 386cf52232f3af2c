// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/scene.h"

#include <vector>

namespace diptych {

// The whole mip chain of an image, level 0 first, down to 1x1, each level half the one before, rounded
// down (Vulkan's sizes). Averages are made in linear light: with `srgb` the colour components are decoded
// before and encoded after, alpha never. Odd sizes are weighted by area, so no texel is left out.
std::vector<TextureImage> makeMipmaps(const TextureImage& image, bool srgb);

}  // namespace diptych
