// SPDX-License-Identifier: MIT
#include "shared/light/lights.h"

#include "shared/contract/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych {

namespace {

gpu::Light gpuLight(const Light& light, const glm::dvec3& eye) {
    const bool directional = light.kind == LightKind::directional;
    return {.position = directional ? -glm::vec3(light.direction) : glm::vec3(light.position - eye),
            .inverse_range_squared = directional ? 0 : inverseSquaredRange(light.range),
            .intensity = light.color * light.intensity,
            .range = light.range};
}

gpu::SpotCone spotCone(const Light& light) {
    // KHR_lights_punctual's reference formula; the floor keeps a hard cone (inner = outer) finite.
    const double cosOuter = std::cos(static_cast<double>(light.outer_cone));
    const double scale = 1 / std::max(0.001, std::cos(static_cast<double>(light.inner_cone)) - cosOuter);
    return {glm::vec3(light.direction), static_cast<float>(scale), static_cast<float>(-cosOuter * scale), {}};
}

// No path draws area lights yet.
bool shines(const Light& light) {
    return !isArea(light.kind) && light.color * light.intensity != glm::vec3(0) &&
           (light.kind == LightKind::directional || light.range > 0);
}

}  // namespace

float inverseSquaredRange(float range) {
    const float squared = range * range;
    if (!(squared > 0)) return std::numeric_limits<float>::infinity();
    float inverse = 1 / squared;
    while (inverse * squared < 1) inverse = std::nextafter(inverse, std::numeric_limits<float>::infinity());
    return std::isinf(squared) ? 0 : inverse;
}

GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye) {
    GpuLights result;
    const auto take = [&](LightKind kind, std::uint32_t& count) {
        for (const Light& light : lights) {
            if (light.kind != kind || !shines(light)) continue;
            result.lights.push_back(gpuLight(light, eye));
            if (kind == LightKind::spot) result.spot_cones.push_back(spotCone(light));
            ++count;
        }
    };
    take(LightKind::directional, result.directional);
    take(LightKind::point, result.point);
    take(LightKind::spot, result.spot);
    result.lights.push_back({.position = {}, .inverse_range_squared = 1, .intensity = {}, .range = 0});
    result.spot_cones.push_back({{0, 0, 1}, 0, 0, {}});
    return result;
}

}  // namespace diptych
