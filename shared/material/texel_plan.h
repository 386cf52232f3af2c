// SPDX-License-Identifier: MIT
// Where each slot of a material finds its texel, so that no more is sampled than must be: an image of one
// colour is a factor, slots that read one image in the same way share a sample, and of --textures packed
// roughness and metallic are in alphas that nothing else reads. No Vulkan.
#pragma once

#include "shared/contract/material.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <cstddef>
#include <functional>

namespace diptych {

// Indexed by SLOT_*: TEXEL_*, or 0 of a slot that reads nothing.
using SlotTexels = std::array<gpu::uint, gpu::SLOT_COUNT>;

// Whether all texels of an image of 8 bits are the same in the components that the slot reads. Images of more
// bits never are.
bool hasOneColor(const TextureImage& image, std::size_t slot);

// What a plan asks of the textures that a material names, by their numbers in Scene::textures.
struct TextureQuestions {
    std::function<bool(int texture, std::size_t slot)> one_color;
    std::function<bool(int a, int b)> same_image;  // and sampled alike
    // Whether there are images of base colour and normal map with roughness and metallic in their alphas.
    std::function<bool(const Material&)> packed;
};
SlotTexels slotTexels(const Material& material, const TextureQuestions& ask);

// Whether --textures packed has such images of a material that no animation changes: opaque, with all three
// textures of 8 bits, sampled alike by one UV set and transform, in which no occlusion is read beside
// roughness and metallic, and where the others are as large as theirs or twice, four times, ... as large on
// both sides, so that their mip levels are those of one image.
bool isPacked(const Material& material, const Scene& scene);

}  // namespace diptych
