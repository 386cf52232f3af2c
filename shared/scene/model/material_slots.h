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

// Words of MATERIAL_SLOTS for a texel: bit c of a sum is component c.
namespace texel {
inline constexpr bool linear = false, srgb = true;
inline constexpr unsigned r = 1, g = 2, b = 4, a = 8, rg = r | g, gb = g | b, rgb = rg | b, rgba = rgb | a;
}  // namespace texel

struct MaterialSlot {
    TextureSlot Material::*texture;
    bool srgb;                           // colour components are sRGB-encoded; alpha is always linear
    unsigned components;                 // that a shader reads
    std::uint32_t layer;                 // LAYER_* that reads the slot
    bool (*hasFactor)(const Material&);  // the slot's factor is not 0
    const char* words;                   // its name in messages
};

#define DIPTYCH_SLOT(number, name, colors, reads, layer, factor, words)                         \
    MaterialSlot{&Material::name##_texture,    texel::colors, texel::reads, gpu::LAYER_##layer, \
                 hasFactor<&Material::factor>, words},
inline constexpr std::array<MaterialSlot, gpu::SLOT_COUNT> materialSlots{MATERIAL_SLOTS(DIPTYCH_SLOT)};
#undef DIPTYCH_SLOT

inline const TextureSlot& slotOf(const Material& material, std::size_t slot) {
    return material.*materialSlots[slot].texture;
}
// The slot must have a texture.
inline const Texture& textureOf(const Scene& scene, const TextureSlot& slot) {
    return scene.textures[static_cast<std::size_t>(slot.texture)];
}
inline const TextureImage& imageOf(const Scene& scene, const TextureSlot& slot) {
    return scene.images[static_cast<std::size_t>(textureOf(scene, slot).image)];
}

// Whether what KHR_materials_volume absorbs colours diffuse transmission.
inline bool diffusesThroughVolume(const Material& m) {
    return !m.unlit && m.diffuse_transmission > 0 && m.thickness > 0 && m.attenuation_distance > 0 &&
           m.attenuation_color != glm::vec3(1);
}

// Whether the slot's texture can change a pixel: its factor is not zero, and the material is not unlit, or
// this is the base colour.
inline bool readsSlot(const Material& material, std::size_t slot) {
    if (slotOf(material, slot).texture < 0) return false;
    if (material.unlit) return slot == gpu::SLOT_base_color;
    const std::uint32_t layer = materialSlots[slot].layer;
    if (layer != gpu::LAYER_BASE && (layersOf(material) & layer) == 0) return false;
    switch (slot) {
        case gpu::SLOT_normal:
        case gpu::SLOT_occlusion:
        case gpu::SLOT_emissive:
        case gpu::SLOT_lightmap:
        case gpu::SLOT_clearcoat_normal:
            return materialSlots[slot].hasFactor(material);
        case gpu::SLOT_thickness:
            return (material.transmission != 0 && material.thickness != 0) || diffusesThroughVolume(material);
        default:
            return true;
    }
}

// The slot whose UV set and transform define generated tangents (makeTangents); SLOT_COUNT: none, TEXCOORD_0
// as it is. Animation never changes it.
inline std::size_t tangentSlot(const Material& material) {
    for (const std::size_t slot : {gpu::SLOT_normal, gpu::SLOT_clearcoat_normal, gpu::SLOT_anisotropy})
        if (slotOf(material, slot).texture >= 0) return slot;
    return gpu::SLOT_COUNT;
}
inline TextureSlot tangentMap(const Material& material) {
    const std::size_t slot = tangentSlot(material);
    return slot == gpu::SLOT_COUNT ? TextureSlot{} : slotOf(material, slot);
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
// frame; a third is omitted. Anisotropy without a texture takes the normal texture's UV set, untransformed.
struct RotatedMaps {
    std::uint32_t layers = 0;  // a sum of LAYER_CLEARCOAT and LAYER_ANISOTROPY
    TextureSlot map{};
    bool third = false;  // anisotropy, which takes the frame of tangentMap()

    bool ofCoat() const { return (layers & gpu::LAYER_CLEARCOAT) != 0; }
    bool ofAnisotropy() const { return (layers & gpu::LAYER_ANISOTROPY) != 0; }
};
inline RotatedMaps rotatedMaps(const Material& m, bool anisotropic) {
    const TextureSlot base = tangentMap(m), coat = m.clearcoat_normal_texture;
    const TextureSlot own =
        m.anisotropy_texture.texture >= 0
            ? m.anisotropy_texture
            : TextureSlot{.texcoord = m.normal_texture.texture >= 0 ? m.normal_texture.texcoord : 0};
    const bool coat_rotated = coat.texture >= 0 && !sameDirections(base, coat),
               rotated = anisotropic && !sameDirections(base, own);
    if (!coat_rotated) return {rotated ? gpu::LAYER_ANISOTROPY : 0, own};
    const bool shared = rotated && sameDirections(coat, own);
    return {gpu::LAYER_CLEARCOAT | (shared ? gpu::LAYER_ANISOTROPY : 0), coat, rotated && !shared};
}

inline bool isTransformed(const TextureSlot& slot) {
    return slot.u != glm::dvec3(1, 0, 0) || slot.v != glm::dvec3(0, 1, 0);
}

}  // namespace diptych
