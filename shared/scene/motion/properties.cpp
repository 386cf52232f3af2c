// SPDX-License-Identifier: MIT
#include "shared/scene/motion/properties.h"

#include "shared/scene/model/animated.h"
#include "shared/scene/model/material_parts.h"
#include "shared/scene/motion/animation.h"

#include <algorithm>
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
        const PartProperties properties = propertiesOf(property.part);
        std::vector<double>& result = values[property];
        for (const double x : sampled(*keyframes, property.part, seconds))
            result.push_back(std::clamp(x, properties.min, properties.max));
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

std::vector<Material> movedMaterials(const Scene& scene, const Values& values) {
    std::vector<Material> materials;
    std::map<int, MaterialParts> parts;
    for (const auto& [property, value] : values) {
        if (!isMaterialPart(property.part)) continue;
        if (materials.empty()) materials = scene.materials;
        Material& material = materials[static_cast<std::size_t>(property.object)];
        const auto [own, isNew] = parts.try_emplace(property.object);
        if (isNew) {
            const auto found = scene.material_parts.find(property.object);
            if (found != scene.material_parts.end())
                own->second = found->second;
            else
                own->second.emissive = glm::dvec3(material.emissive);
        }
        setPart(material, own->second, property.part, static_cast<std::size_t>(property.element), value);
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
