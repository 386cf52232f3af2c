// SPDX-License-Identifier: MIT
// Properties of what animations may move: component count, valid range, and which materials change over
// time.
#pragma once

#include "shared/scene/model/material_slots.h"
#include "shared/scene/model/motion.h"
#include "shared/scene/model/scene.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace diptych {

// Bound for material factors that glTF leaves unbounded: keeps their squares and products finite in
// float32.
inline constexpr double maxFactor = 1e12;

// nm: the largest half; packed G-buffers store the thickness as one.
inline constexpr double maxFilmThickness = 65504;

// m: the least attenuation distance; 0 stands for infinity (Material).
inline constexpr double minAttenuationDistance = 1e-12;

struct PartProperties {
    // Components per key; for weights, per morph target.
    std::size_t width;
    double min = -std::numeric_limits<float>::max();  // valid range; values outside are clamped
    double max = std::numeric_limits<float>::max();
};

constexpr PartProperties propertiesOf(AnimatedPart part) {
    using glm::vec3, glm::vec4;
    constexpr double any = std::numeric_limits<float>::max();
    // rad or m: the least extent of a camera or light that float32 can divide by
    constexpr double thin = 1e-6;
    switch (part) {
        case AnimatedPart::translation:
        case AnimatedPart::scale:
            return {3};
        case AnimatedPart::rotation:
            return {4};
        case AnimatedPart::weights:
        case AnimatedPart::weight:
        case AnimatedPart::mesh_weights:
        case AnimatedPart::mesh_weight:
        case AnimatedPart::anisotropy_rotation:
        case AnimatedPart::texture_rotation:
            return {1};
        case AnimatedPart::light_color:
            return {3, 0, any};
        case AnimatedPart::light_intensity:
        case AnimatedPart::emissive_strength:
            return {1, 0, any};
        case AnimatedPart::light_range:
        case AnimatedPart::camera_aspect:
        case AnimatedPart::camera_ymag:
        case AnimatedPart::camera_xmag:
        case AnimatedPart::camera_far:
            return {1, thin, any};
        case AnimatedPart::light_inner_cone:
        case AnimatedPart::light_outer_cone:
            return {1, 0, glm::half_pi<double>()};
        case AnimatedPart::camera_yfov:
            return {1, thin, glm::pi<double>() - thin};
        case AnimatedPart::camera_near:  // an orthographic camera may have 0
            return {1, 0, any};
#define DIPTYCH_PROPERTIES(type, name, initially, min, max) \
    case AnimatedPart::name:                                \
        return {sizeof(type) / sizeof(float), min, max};
            MATERIAL_FACTORS(DIPTYCH_PROPERTIES)
#undef DIPTYCH_PROPERTIES
        case AnimatedPart::emissive:
            return {3, 0, any};
        case AnimatedPart::specular_color:
            return {3, 0, maxFactor};
        case AnimatedPart::specular_f0:
            return {3, 0, 1};
        case AnimatedPart::glossiness:
            return {1, 0, 1};
        case AnimatedPart::texture_offset:
        case AnimatedPart::texture_scale:
            return {2, -maxFactor, maxFactor};
    }
    return {0};
}

constexpr bool isNodePart(AnimatedPart part) {
    return part <= AnimatedPart::weight;
}
constexpr bool isMeshPart(AnimatedPart part) {
    return part == AnimatedPart::mesh_weights || part == AnimatedPart::mesh_weight;
}
constexpr bool isLightPart(AnimatedPart part) {
    return part >= AnimatedPart::light_color && part <= AnimatedPart::light_outer_cone;
}
constexpr bool isCameraPart(AnimatedPart part) {
    return part >= AnimatedPart::camera_yfov && part <= AnimatedPart::camera_far;
}
constexpr bool isMaterialPart(AnimatedPart part) {
    return part >= AnimatedPart::base_color;
}

// KHR_texture_transform: scale, then rotation (counter-clockwise with v growing downwards), then offset.
inline void setTransform(TextureSlot& slot, const TextureTransform& t) {
    const double c = std::cos(t.rotation), s = std::sin(t.rotation);
    slot.u = {c * t.scale.x, s * t.scale.y, t.offset.x};
    slot.v = {-s * t.scale.x, c * t.scale.y, t.offset.y};
}

// Calls `use` with each channel that changes a material, of all animations, whether they play or not.
template <class Use>
void forMaterialChannels(const Scene& scene, const Use& use) {
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            if (isMaterialPart(channel.part)) use(channel);
}

// Materials that any animation changes.
inline std::set<int> materialsThatMove(const Scene& scene) {
    std::set<int> moving;
    forMaterialChannels(scene, [&](const AnimationChannel& channel) { moving.insert(channel.object); });
    return moving;
}

// For each material, whether `is` is true of it at rest, or an animation changes `part`.
template <class Is>
std::vector<bool> materialsThatEver(const Scene& scene, AnimatedPart part, const Is& is) {
    std::vector<bool> ever;
    for (const Material& material : scene.materials) ever.push_back(is(material));
    forMaterialChannels(scene, [&](const AnimationChannel& channel) {
        if (channel.part == part) ever[static_cast<std::size_t>(channel.object)] = true;
    });
    return ever;
}
// Whether it is ever anisotropic, and so needs tangents without any map.
inline std::vector<bool> materialsWithAnisotropy(const Scene& scene) {
    return materialsThatEver(scene, AnimatedPart::anisotropy, hasFactor<&Material::anisotropy>);
}
// Whether it ever blends; an animation may make it transmit light.
inline std::vector<bool> materialsThatBlend(const Scene& scene) {
    return materialsThatEver(scene, AnimatedPart::transmission, blends);
}

// For each material, whether an animation rotates, scales or mirrors a map for which `counts(material,
// slot)`.
template <class Counts>
std::vector<bool> mapsThatTurn(const Scene& scene, const Counts& counts) {
    std::vector<bool> turns(scene.materials.size(), false);
    forMaterialChannels(scene, [&](const AnimationChannel& channel) {
        const auto object = static_cast<std::size_t>(channel.object);
        if ((channel.part == AnimatedPart::texture_rotation || channel.part == AnimatedPart::texture_scale) &&
            counts(scene.materials[object], static_cast<std::size_t>(channel.element)))
            turns[object] = true;
    });
    return turns;
}
// Its tangentMap().
inline std::vector<bool> tangentMapsThatTurn(const Scene& scene) {
    return mapsThatTurn(scene, [](const Material& m, std::size_t slot) { return slot == tangentSlot(m); });
}
// A map that RotatedMaps may describe.
inline std::vector<bool> layerMapsThatTurn(const Scene& scene) {
    return mapsThatTurn(scene, [](const Material& m, std::size_t slot) {
        return slot != tangentSlot(m) && (slot == gpu::SLOT_clearcoat_normal || slot == gpu::SLOT_anisotropy);
    });
}

// readsSlot() at any time of an animation, if the material `moves`.
inline bool mayReadSlot(const Material& material, std::size_t slot, bool moves) {
    if (!moves) return readsSlot(material, slot);
    return slotOf(material, slot).texture >= 0 && (!material.unlit || slot == gpu::SLOT_base_color);
}

}  // namespace diptych
