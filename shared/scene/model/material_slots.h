// SPDX-License-Identifier: MIT
// A material's texture slots, in the order of SLOT_* (shared/contract/material.h).
#pragma once

#include "shared/contract/material.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <cstddef>

namespace diptych {

struct MaterialSlot {
    TextureSlot Material::*texture;
    bool srgb;  // colour components are sRGB-encoded; alpha is always linear
};

constexpr std::array<MaterialSlot, gpu::SLOT_COUNT> materialSlots{{
    {&Material::base_color_texture, true},
    {&Material::metallic_roughness_texture, false},
    {&Material::normal_texture, false},
    {&Material::occlusion_texture, false},
    {&Material::emissive_texture, true},
    {&Material::specular_texture, false},
    {&Material::specular_color_texture, true},
    {&Material::lightmap_texture, true},
    {&Material::clearcoat_texture, false},
    {&Material::clearcoat_roughness_texture, false},
    {&Material::clearcoat_normal_texture, false},
    {&Material::anisotropy_texture, false},
    {&Material::sheen_color_texture, true},
    {&Material::sheen_roughness_texture, true},  // alpha, often of the colour's image
    {&Material::iridescence_texture, false},
    {&Material::iridescence_thickness_texture, false},
    {&Material::transmission_texture, false},
    {&Material::thickness_texture, false},
    {&Material::diffuse_transmission_texture, true},  // alpha, often of the colour's image
    {&Material::diffuse_transmission_color_texture, true},
}};

// Whether the slot's texture can change a pixel: its factor is not zero, and the material is not unlit, or
// this is the base colour.
inline bool readsSlot(const Material& material, std::size_t slot) {
    if ((material.*materialSlots[slot].texture).texture < 0) return false;
    if (material.unlit) return slot == gpu::SLOT_base_color;
    switch (slot) {
        case gpu::SLOT_normal:
            return material.normal_scale != 0;
        case gpu::SLOT_occlusion:
            return material.occlusion_strength != 0;
        case gpu::SLOT_emissive:
            return material.emissive != glm::vec3(0);
        case gpu::SLOT_lightmap:
            return material.lightmap_intensity != 0;
        case gpu::SLOT_clearcoat:
        case gpu::SLOT_clearcoat_roughness:
            return material.clearcoat != 0;
        case gpu::SLOT_clearcoat_normal:
            return material.clearcoat != 0 && material.clearcoat_normal_scale != 0;
        case gpu::SLOT_anisotropy:
            return material.anisotropy != 0;
        case gpu::SLOT_sheen_color:
        case gpu::SLOT_sheen_roughness:
            return material.sheen_color != glm::vec3(0);
        case gpu::SLOT_iridescence:
        case gpu::SLOT_iridescence_thickness:
            return material.iridescence != 0;
        case gpu::SLOT_transmission:
            return material.transmission != 0;
        case gpu::SLOT_thickness:
            return material.transmission != 0 && material.thickness != 0;
        case gpu::SLOT_diffuse_transmission:
        case gpu::SLOT_diffuse_transmission_color:
            return material.diffuse_transmission != 0;
        default:
            return true;
    }
}

// The slot whose UV set and transform define generated tangents (makeTangents); SLOT_COUNT: none, TEXCOORD_0
// as it is. Animation never changes it.
inline std::size_t tangentSlot(const Material& material) {
    for (const std::size_t slot : {gpu::SLOT_normal, gpu::SLOT_clearcoat_normal, gpu::SLOT_anisotropy})
        if ((material.*materialSlots[slot].texture).texture >= 0) return slot;
    return gpu::SLOT_COUNT;
}
inline TextureSlot tangentMap(const Material& material) {
    const std::size_t slot = tangentSlot(material);
    return slot == gpu::SLOT_COUNT ? TextureSlot{} : material.*materialSlots[slot].texture;
}

inline bool isTransformed(const TextureSlot& slot) {
    return slot.u != glm::dvec3(1, 0, 0) || slot.v != glm::dvec3(0, 1, 0);
}

}  // namespace diptych
