// SPDX-License-Identifier: MIT
// A material's texture slots, in the order of SLOT_* (shared/contract/material.h).
#pragma once

#include "shared/contract/material.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

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

// Whether what KHR_materials_volume absorbs colours diffuse transmission.
inline bool diffusesThroughVolume(const Material& m) {
    return !m.unlit && m.diffuse_transmission > 0 && m.thickness > 0 && m.attenuation_distance > 0 &&
           m.attenuation_color != glm::vec3(1);
}

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
            return (material.transmission != 0 && material.thickness != 0) || diffusesThroughVolume(material);
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

// Whether tangents of both maps agree on every surface: the transforms differ by an offset or by positive
// scales along s and t.
inline bool sameDirections(const TextureSlot& a, const TextureSlot& b) {
    const auto area = [](const TextureSlot& m) { return m.u.x * m.v.y - m.u.y * m.v.x; };
    const auto along = [&](const TextureSlot& m) {  // dP/ds, in the plane of the untransformed coordinates
        return glm::dvec2(m.v.y, -m.v.x) * (area(m) < 0 ? -1.0 : 1.0);
    };
    if (a.texcoord != b.texcoord) return false;
    if (area(a) == 0 || area(b) == 0)
        return glm::dvec2(a.u) == glm::dvec2(b.u) && glm::dvec2(a.v) == glm::dvec2(b.v);
    const glm::dvec2 p = along(a), q = along(b);
    const double cosine = p.x * q.x + p.y * q.y, sine = p.x * q.y - p.y * q.x;
    constexpr double rounded = 1e-6;  // of transforms given in float32
    return (area(a) < 0) == (area(b) < 0) && std::abs(sine) <= rounded * cosine;
}

// Maps of layers whose generated tangents differ from those of tangentMap(). Vertices store one further
// frame; a third is left out. Anisotropy without a texture takes the normal texture's UV set, untransformed.
struct TurnedMaps {
    std::uint32_t layers = 0;  // a sum of LAYER_CLEARCOAT and LAYER_ANISOTROPY
    TextureSlot map{};
    bool third = false;  // anisotropy, which takes the frame of tangentMap()

    bool ofCoat() const { return (layers & gpu::LAYER_CLEARCOAT) != 0; }
    bool ofAnisotropy() const { return (layers & gpu::LAYER_ANISOTROPY) != 0; }
};
inline TurnedMaps turnedMaps(const Material& m, bool anisotropic) {
    const TextureSlot base = tangentMap(m), coat = m.clearcoat_normal_texture;
    const TextureSlot own =
        m.anisotropy_texture.texture >= 0
            ? m.anisotropy_texture
            : TextureSlot{.texcoord = m.normal_texture.texture >= 0 ? m.normal_texture.texcoord : 0};
    const bool coat_turned = coat.texture >= 0 && !sameDirections(base, coat),
               turned = anisotropic && !sameDirections(base, own);
    if (!coat_turned) return {turned ? gpu::LAYER_ANISOTROPY : 0, own};
    const bool shared = turned && sameDirections(coat, own);
    return {gpu::LAYER_CLEARCOAT | (shared ? gpu::LAYER_ANISOTROPY : 0), coat, turned && !shared};
}

inline bool isTransformed(const TextureSlot& slot) {
    return slot.u != glm::dvec3(1, 0, 0) || slot.v != glm::dvec3(0, 1, 0);
}

}  // namespace diptych
