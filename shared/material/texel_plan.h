// SPDX-License-Identifier: MIT
// Minimizes texture samples per material. A single-colour image becomes a factor; slots that read one
// image in the same way share a sample. With --textures packed, roughness and metallic are in alphas that
// nothing else reads. Does not use Vulkan.
#pragma once

#include "shared/contract/material.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <cstddef>
#include <functional>

namespace diptych {

// Indexed by SLOT_*: TEXEL_*, or 0 if the slot reads nothing.
using SlotTexels = std::array<gpu::uint, gpu::SLOT_COUNT>;

// Whether all texels of an 8-bit image are equal in the components that the slot reads; false for more
// bits.
bool hasOneColor(const TextureImage& image, std::size_t slot);

// The slot whose components a slot of a material reads: glossiness is the alpha of its specular colour, so
// that is read like a base colour.
constexpr std::size_t readLike(const Material& material, std::size_t slot) {
    return material.specular_glossiness && slot == gpu::SLOT_specular_color ? gpu::SLOT_base_color : slot;
}

// Queries about the textures of a material, by index in Scene::textures.
struct TextureQueries {
    std::function<bool(int texture, std::size_t slot)> one_color;
    std::function<bool(int a, int b)> same_image;  // same image, same sampler
    // Whether the base colour and normal images have roughness and metallic in their alphas.
    std::function<bool(const Material&)> packed;
};
SlotTexels slotTexels(const Material& material, const TextureQueries& ask);

// Whether --textures packed applies to a material without animation. It must be opaque. Its three textures
// have 8 bits and the same sampler, UV set and transform. The base colour and normal images are 2^n times
// as large as the roughness image on both sides (n >= 0), so that mip levels correspond.
bool isPacked(const Material& material, const Scene& scene);

}  // namespace diptych
