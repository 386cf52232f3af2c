// SPDX-License-Identifier: MIT
#include "shared/material/texel_plan.h"

#include "shared/scene/model/material_slots.h"

#include <algorithm>

namespace diptych {

namespace {

bool sameCoordinates(const TextureSlot& a, const TextureSlot& b) {
    return a.texcoord == b.texcoord && a.u == b.u && a.v == b.v;
}

// log2 of the size ratio of `large` to `small`; -1 if it is not a power of two.
int halvings(const TextureImage& large, const TextureImage& small) {
    for (int n = 0; small.width <= large.width >> n; ++n)
        if (small.width << n == large.width && small.height << n == large.height) return n;
    return -1;
}

}  // namespace

bool hasOneColor(const TextureImage& image, std::size_t slot) {
    if (image.rgba.empty()) return false;
    for (std::size_t c = 0; c < 4; ++c) {
        if ((materialSlots[slot].components >> c & 1u) == 0) continue;
        for (std::size_t i = c; i < image.rgba.size(); i += 4)
            if (image.rgba[i] != image.rgba[c]) return false;
    }
    return true;
}

SlotTexels slotTexels(const Material& material, const TextureQueries& ask) {
    SlotTexels texels{};
    for (gpu::uint slot = 0; slot < gpu::SLOT_COUNT; ++slot)
        if (readsSlot(material, slot))
            texels[slot] = ask.one_color(slotOf(material, slot).texture, readLike(material, slot))
                               ? gpu::TEXEL_CONSTANT
                               : gpu::TEXEL_OWN;
    const auto fraction = [&](gpu::uint slot, gpu::uint sampled) {
        const TextureSlot &a = slotOf(material, slot), &b = slotOf(material, sampled);
        if (texels[slot] == gpu::TEXEL_OWN && texels[sampled] == gpu::TEXEL_OWN && sameCoordinates(a, b) &&
            ask.same_image(a.texture, b.texture))
            texels[slot] = gpu::TEXEL_SHARED;
    };
    fraction(gpu::SLOT_occlusion, gpu::SLOT_metallic_roughness);
    fraction(gpu::SLOT_emissive, gpu::SLOT_base_color);
    fraction(gpu::SLOT_sheen_roughness, gpu::SLOT_sheen_color);
    fraction(gpu::SLOT_diffuse_transmission, gpu::SLOT_diffuse_transmission_color);
    const auto sampled = [&](gpu::uint slot) { return texels[slot] == gpu::TEXEL_OWN; };
    if (sampled(gpu::SLOT_metallic_roughness) && sampled(gpu::SLOT_normal) && sampled(gpu::SLOT_base_color) &&
        texels[gpu::SLOT_occlusion] != gpu::TEXEL_SHARED && ask.packed(material))
        texels[gpu::SLOT_metallic_roughness] = gpu::TEXEL_ALPHAS;
    return texels;
}

bool isPacked(const Material& material, const Scene& scene) {
    const TextureSlot &base = material.base_color_texture, &normal = material.normal_texture,
                      &read = material.metallic_roughness_texture;
    if (material.alpha_mode != AlphaMode::opaque || blends(material) ||
        std::min({base.texture, normal.texture, read.texture}) < 0 || !sameCoordinates(base, read) ||
        !sameCoordinates(normal, read))
        return false;
    const TextureImage& small = imageOf(scene, read);
    return std::ranges::all_of(std::array{&base, &normal}, [&](const TextureSlot* slot) {
        const TextureImage& image = imageOf(scene, *slot);
        return textureOf(scene, *slot).sampler == textureOf(scene, read).sampler && !image.deep() &&
               !small.deep() && halvings(image, small) >= 0;
    });
}

}  // namespace diptych
