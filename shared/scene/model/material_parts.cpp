// SPDX-License-Identifier: MIT
#include "shared/scene/model/material_parts.h"

#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"

#include <algorithm>
#include <limits>

namespace diptych {

namespace {

void set(float& member, std::span<const double> v) {
    member = static_cast<float>(v[0]);
}
template <int N>
void set(glm::vec<N, float>& member, std::span<const double> v) {
    for (int c = 0; c < N; ++c) member[c] = static_cast<float>(v[static_cast<std::size_t>(c)]);
}

std::vector<double> valuesOf(float member) {
    return {double{member}};
}
template <int N>
std::vector<double> valuesOf(const glm::vec<N, float>& member) {
    return {&member.x, &member.x + N};
}

}  // namespace

void setPart(Material& m, MaterialParts& parts, AnimatedPart part, std::size_t slot,
             std::span<const double> v) {
    const auto emit = [&] {
        constexpr double max = std::numeric_limits<float>::max();
        for (int c = 0; c < 3; ++c)
            m.emissive[c] = static_cast<float>(std::min(parts.emissive[c] * parts.emissive_strength, max));
    };
    const auto setSlotTransform = [&] {
        setTransform(m.*materialSlots[slot].texture, parts.transforms[slot]);
    };
    switch (part) {
#define DIPTYCH_SET(type, name, ...) \
    case AnimatedPart::name:         \
        set(m.name, v);              \
        break;
        MATERIAL_FACTORS(DIPTYCH_SET)
#undef DIPTYCH_SET
        case AnimatedPart::specular_color:
        case AnimatedPart::specular_f0:
            set(m.specular_color, v);
            break;
        case AnimatedPart::anisotropy_rotation:
            set(m.anisotropy_rotation, v);
            break;
        case AnimatedPart::emissive:
            parts.emissive = {v[0], v[1], v[2]};
            emit();
            break;
        case AnimatedPart::emissive_strength:
            parts.emissive_strength = v[0];
            emit();
            break;
        case AnimatedPart::glossiness:
            m.roughness = static_cast<float>(1 - v[0]);
            break;
        case AnimatedPart::texture_offset:
            parts.transforms[slot].offset = {v[0], v[1]};
            setSlotTransform();
            break;
        case AnimatedPart::texture_rotation:
            parts.transforms[slot].rotation = v[0];
            setSlotTransform();
            break;
        case AnimatedPart::texture_scale:
            parts.transforms[slot].scale = {v[0], v[1]};
            setSlotTransform();
            break;
        default:  // parts of nodes, lights and cameras
            break;
    }
    if (part == AnimatedPart::ior && m.ior != 0) m.ior = std::max(m.ior, 1.0f);
}

std::vector<double> partOf(const Material& m, AnimatedPart part) {
    switch (part) {
#define DIPTYCH_GET(type, name, ...) \
    case AnimatedPart::name:         \
        return valuesOf(m.name);
        MATERIAL_FACTORS(DIPTYCH_GET)
#undef DIPTYCH_GET
        case AnimatedPart::emissive:
            return valuesOf(m.emissive);
        case AnimatedPart::specular_color:
        case AnimatedPart::specular_f0:
            return valuesOf(m.specular_color);
        case AnimatedPart::anisotropy_rotation:
            return valuesOf(m.anisotropy_rotation);
        case AnimatedPart::glossiness:
            return {1 - double{m.roughness}};
        default:
            return {1};
    }
}

}  // namespace diptych
