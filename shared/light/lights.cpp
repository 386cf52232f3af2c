// SPDX-License-Identifier: MIT
#include "shared/light/lights.h"

#include "shared/contract/constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych {

namespace {

gpu::Light gpuLight(const Light& light, const glm::dvec3& eye) {
    gpu::Light g{};
    g.position = light.kind == LightKind::directional ? glm::vec3(0) : glm::vec3(light.position - eye);
    g.range = light.range;
    g.intensity = light.color * light.intensity;
    g.direction = glm::vec3(light.direction);
    g.cone_offset = 1;
    if (light.kind == LightKind::spot) {
        // KHR_lights_punctual's reference formula; the floor keeps a hard cone (inner = outer) finite.
        const double cosOuter = std::cos(static_cast<double>(light.outer_cone));
        const double scale = 1 / std::max(0.001, std::cos(static_cast<double>(light.inner_cone)) - cosOuter);
        g.cone_scale = static_cast<float>(scale);
        g.cone_offset = static_cast<float>(-cosOuter * scale);
    }
    return g;
}

// No path draws area lights yet.
bool shines(const Light& light) {
    return !isArea(light.kind) && light.color * light.intensity != glm::vec3(0) &&
           (light.kind == LightKind::directional || light.range > 0);
}

}  // namespace

GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye) {
    GpuLights result;
    for (const bool directional : {true, false})
        for (const Light& light : lights) {
            if ((light.kind == LightKind::directional) != directional || !shines(light)) continue;
            result.lights.push_back(gpuLight(light, eye));
            ++(directional ? result.directional : result.local);
        }
    if (result.lights.size() > gpu::MAX_LIGHTS_PER_DRAW)
        throw std::runtime_error(
            fmt::format("{} lights: --assign every walks up to {} in this version; use fewer --lights",
                        result.lights.size(), gpu::MAX_LIGHTS_PER_DRAW));
    return result;
}

}  // namespace diptych
