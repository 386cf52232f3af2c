// SPDX-License-Identifier: MIT
#include "shared/scene/model/material_parts.h"

#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_slots.h"

#include <algorithm>
#include <limits>

namespace diptych {

namespace {

glm::vec3 rgb(std::span<const double> v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// Properties that are members of Material.
template <class Value>
struct MaterialMember {
    AnimatedPart part;
    Value Material::*member;
};
constexpr MaterialMember<float> materialNumbers[] = {
    {AnimatedPart::metallic, &Material::metallic},
    {AnimatedPart::roughness, &Material::roughness},
    {AnimatedPart::normal_scale, &Material::normal_scale},
    {AnimatedPart::occlusion_strength, &Material::occlusion_strength},
    {AnimatedPart::alpha_cutoff, &Material::alpha_cutoff},
    {AnimatedPart::specular, &Material::specular},
    {AnimatedPart::transmission, &Material::transmission},
    {AnimatedPart::clearcoat, &Material::clearcoat},
    {AnimatedPart::clearcoat_roughness, &Material::clearcoat_roughness},
    {AnimatedPart::clearcoat_normal_scale, &Material::clearcoat_normal_scale},
    {AnimatedPart::anisotropy, &Material::anisotropy},
    {AnimatedPart::anisotropy_rotation, &Material::anisotropy_rotation},
    {AnimatedPart::sheen_roughness, &Material::sheen_roughness},
    {AnimatedPart::iridescence, &Material::iridescence},
    {AnimatedPart::iridescence_ior, &Material::iridescence_ior},
    {AnimatedPart::iridescence_thickness_least, &Material::iridescence_thickness_least},
    {AnimatedPart::iridescence_thickness_most, &Material::iridescence_thickness_most},
    {AnimatedPart::thickness, &Material::thickness},
    {AnimatedPart::attenuation_distance, &Material::attenuation_distance},
    {AnimatedPart::dispersion, &Material::dispersion},
    {AnimatedPart::diffuse_transmission, &Material::diffuse_transmission},
};
constexpr MaterialMember<glm::vec3> materialColors[] = {
    {AnimatedPart::specular_color, &Material::specular_color},
    {AnimatedPart::specular_f0, &Material::specular_color},
    {AnimatedPart::sheen_color, &Material::sheen_color},
    {AnimatedPart::attenuation_color, &Material::attenuation_color},
    {AnimatedPart::diffuse_transmission_color, &Material::diffuse_transmission_color},
};

}  // namespace

void setPart(Material& m, MaterialParts& parts, AnimatedPart part, std::size_t slot,
             std::span<const double> v) {
    const auto number = static_cast<float>(v[0]);
    const auto emit = [&] {
        constexpr double most = std::numeric_limits<float>::max();
        for (int c = 0; c < 3; ++c)
            m.emissive[c] = static_cast<float>(std::min(parts.emissive[c] * parts.emissive_strength, most));
    };
    const auto place = [&] { setTransform(m.*materialSlots[slot].texture, parts.transforms[slot]); };
    for (const auto& row : materialNumbers)
        if (row.part == part) m.*row.member = number;
    for (const auto& row : materialColors)
        if (row.part == part) m.*row.member = rgb(v);
    switch (part) {
        case AnimatedPart::base_color:
            m.base_color = glm::vec4(rgb(v), static_cast<float>(v[3]));
            break;
        case AnimatedPart::emissive:
            parts.emissive = {v[0], v[1], v[2]};
            emit();
            break;
        case AnimatedPart::emissive_strength:
            parts.emissive_strength = v[0];
            emit();
            break;
        case AnimatedPart::ior:
            m.ior = number == 0 ? 0 : std::max(number, 1.0f);
            break;
        case AnimatedPart::glossiness:
            m.roughness = static_cast<float>(1 - v[0]);
            break;
        case AnimatedPart::texture_offset:
            parts.transforms[slot].offset = {v[0], v[1]};
            place();
            break;
        case AnimatedPart::texture_rotation:
            parts.transforms[slot].rotation = v[0];
            place();
            break;
        case AnimatedPart::texture_scale:
            parts.transforms[slot].scale = {v[0], v[1]};
            place();
            break;
        default:  // above, or parts of nodes, lights and cameras
            break;
    }
}

}  // namespace diptych
