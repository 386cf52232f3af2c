// SPDX-License-Identifier: MIT
#include "shared/scene/motion/properties.h"

#include "shared/scene/model/animated.h"
#include "shared/scene/motion/animation.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <optional>

namespace diptych {

namespace {

struct Property {
    int object;
    AnimatedPart part;
    int element;
    auto operator<=>(const Property&) const = default;
};

// Values of every animated property, clamped to its range. The last channel of a property wins.
using Values = std::map<Property, std::vector<double>>;

Values valuesAt(const Scene& scene, double seconds, const std::string& choice) {
    std::map<Property, const Keyframes*> last;
    for (const Animation& animation : animationsOf(scene, choice))
        for (const AnimationChannel& channel : animation.channels)
            if (!isNodePart(channel.part) && !isMeshPart(channel.part))
                last[{channel.object, channel.part, channel.element}] =
                    &animation.keyframes[static_cast<std::size_t>(channel.keyframes)];
    Values values;
    for (const auto& [property, keyframes] : last) {
        const PartFacts facts = factsOf(property.part);
        std::vector<double>& result = values[property];
        for (const double x : sampled(*keyframes, property.part, seconds))
            result.push_back(std::clamp(x, facts.least, facts.most));
    }
    return values;
}

// The value of a scalar property.
std::optional<double> numberOf(const Values& values, int object, AnimatedPart part) {
    const auto at = values.find({object, part, 0});
    return at == values.end() ? std::nullopt : std::optional(at->second[0]);
}

glm::vec3 rgb(const std::vector<double>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

void move(Light& light, const Values& values) {
    if (light.source < 0) return;
    if (const auto color = values.find({light.source, AnimatedPart::light_color, 0}); color != values.end())
        light.color = rgb(color->second);
    const auto set = [&](float& member, AnimatedPart part) {
        if (const auto number = numberOf(values, light.source, part)) member = static_cast<float>(*number);
    };
    set(light.intensity, AnimatedPart::light_intensity);
    set(light.range, AnimatedPart::light_range);
    set(light.outer_cone, AnimatedPart::light_outer_cone);
    set(light.inner_cone, AnimatedPart::light_inner_cone);
    light.inner_cone = std::min(light.inner_cone, light.outer_cone);
}

void move(Camera& camera, const Values& values) {
    if (camera.source < 0) return;
    const auto set = [&](double& member, AnimatedPart part) {
        const auto number = numberOf(values, camera.source, part);
        if (number) member = *number;
        return number.has_value();
    };
    set(camera.yfov, AnimatedPart::camera_yfov);
    set(camera.aspect, AnimatedPart::camera_aspect);
    set(camera.ymag, AnimatedPart::camera_ymag);
    set(camera.xmag, AnimatedPart::camera_xmag);
    const bool near = set(camera.near, AnimatedPart::camera_near);
    const bool far = set(camera.far, AnimatedPart::camera_far);
    if (!near && !far) return;
    constexpr double thin = 1e-6;  // m, and relative: what float32 resolves
    if (!camera.orthographic) camera.near = std::max(camera.near, thin);
    if (camera.far > camera.near) return;
    camera.far = camera.orthographic ? camera.near + std::max(thin, thin * camera.near)
                                     : std::numeric_limits<double>::infinity();
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

// A material, and the parts of its combined values.
class MovedMaterial {
public:
    MovedMaterial(Material& material, const MaterialParts* parts) : m_(material) {
        if (parts)
            parts_ = *parts;
        else
            parts_.emissive = glm::dvec3(material.emissive);
    }

    void set(AnimatedPart part, int element, const std::vector<double>& v) {
        const auto number = static_cast<float>(v[0]);
        for (const auto& row : materialNumbers)
            if (row.part == part) m_.*row.member = number;
        for (const auto& row : materialColors)
            if (row.part == part) m_.*row.member = rgb(v);
        switch (part) {
            case AnimatedPart::base_color:
                m_.base_color = glm::vec4(rgb(v), static_cast<float>(v[3]));
                break;
            case AnimatedPart::emissive:
                parts_.emissive = {v[0], v[1], v[2]};
                emit();
                break;
            case AnimatedPart::emissive_strength:
                parts_.emissive_strength = v[0];
                emit();
                break;
            case AnimatedPart::ior:
                m_.ior = number == 0 ? 0 : std::max(number, 1.0f);
                break;
            case AnimatedPart::glossiness:
                m_.roughness = static_cast<float>(1 - v[0]);
                break;
            case AnimatedPart::texture_offset:
                transform(element).offset = {v[0], v[1]};
                place(element);
                break;
            case AnimatedPart::texture_rotation:
                transform(element).rotation = v[0];
                place(element);
                break;
            case AnimatedPart::texture_scale:
                transform(element).scale = {v[0], v[1]};
                place(element);
                break;
            default:  // above, or parts of nodes, lights and cameras
                break;
        }
    }

private:
    Material& m_;
    MaterialParts parts_;

    TextureTransform& transform(int slot) { return parts_.transforms[static_cast<std::size_t>(slot)]; }
    void place(int slot) {
        setTransform(m_.*materialSlots[static_cast<std::size_t>(slot)].texture, transform(slot));
    }
    void emit() {
        constexpr double most = std::numeric_limits<float>::max();
        for (int c = 0; c < 3; ++c)
            m_.emissive[c] =
                static_cast<float>(std::min(parts_.emissive[c] * parts_.emissive_strength, most));
    }
};

std::vector<Material> movedMaterials(const Scene& scene, const Values& values) {
    std::vector<Material> materials;
    // Properties of one material are consecutive.
    for (auto at = values.begin(); at != values.end();) {
        const int object = at->first.object;
        std::optional<MovedMaterial> moved;
        for (; at != values.end() && at->first.object == object; ++at) {
            if (!isMaterialPart(at->first.part)) continue;
            if (materials.empty()) materials = scene.materials;
            if (!moved) {
                const auto parts = scene.material_parts.find(object);
                moved.emplace(materials[static_cast<std::size_t>(object)],
                              parts == scene.material_parts.end() ? nullptr : &parts->second);
            }
            moved->set(at->first.part, at->first.element, at->second);
        }
    }
    return materials;
}

}  // namespace

PropertyMotion propertiesAt(const Scene& scene, double seconds, const std::string& choice) {
    const Values values = valuesAt(scene, seconds, choice);
    PropertyMotion motion{scene.lights, scene.cameras, movedMaterials(scene, values)};
    for (Light& light : motion.lights) move(light, values);
    for (Camera& camera : motion.cameras) move(camera, values);
    return motion;
}

}  // namespace diptych
