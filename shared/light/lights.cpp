// SPDX-License-Identifier: MIT
#include "shared/light/lights.h"

#include "shared/contract/constants.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/scene/model/axes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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
    // Reference formula of KHR_lights_punctual; the lower bound keeps a hard cone (inner = outer) finite.
    const double cosOuter = std::cos(double{light.outer_cone});
    const double scale = 1 / std::max(0.001, std::cos(double{light.inner_cone}) - cosOuter);
    return {glm::vec3(light.direction), static_cast<float>(scale), static_cast<float>(-cosOuter * scale), {}};
}

gpu::AreaLight areaLight(const Light& light) {
    const glm::dvec3 up = glm::cross(light.direction, light.axis);
    gpu::AreaLight g{.x = {},
                     .radius = light.radius,
                     .y = {},
                     .extent = light.radius,
                     .direction = glm::vec3(light.direction),
                     .two_sided = light.two_sided ? 1.0f : 0.0f};
    if (light.kind == LightKind::rect) {
        g.x = glm::vec3(light.axis * (double{light.width} / 2));
        g.y = glm::vec3(up * (double{light.height} / 2));
        g.extent = std::hypot(light.width, light.height) / 2;
    } else if (light.kind == LightKind::disc) {
        const glm::dvec3 x = perpendicularTo(light.direction) * double{light.radius};
        g.x = glm::vec3(x);
        g.y = glm::vec3(glm::cross(light.direction, x));
    } else {
        g.x = glm::vec3(light.axis * (double{light.length} / 2));
        g.direction = glm::vec3(light.axis);
        g.extent = std::hypot(light.length / 2, light.radius);
    }
    return g;
}

bool shines(const Light& light) {
    return light.color * light.intensity != glm::vec3(0) &&
           (light.kind == LightKind::directional || light.range > 0);
}

}  // namespace

ShownArea shownArea(const GpuLights& lights, std::size_t i, const glm::dvec3& to_place) {
    const gpu::AreaLight& light = *lights.shapeOf(i);
    std::size_t kind = 0, past_kind = lights.firstArea() + lights.areas[0];
    while (kind + 1 < lights.areas.size() && i >= past_kind) past_kind += lights.areas[++kind];
    const double r = double{light.radius}, half = glm::length(glm::dvec3(light.x));
    const double cosine = glm::dot(glm::dvec3(light.direction), to_place);
    if (areaKinds[kind] == LightKind::tube) {
        const double side = 4 * half * r, end = std::numbers::pi * r * r;
        return {side + end, side * std::sqrt(std::max(0.0, 1 - cosine * cosine)) + end * std::abs(cosine)};
    }
    const double halves = glm::length(glm::cross(glm::dvec3(light.x), glm::dvec3(light.y)));
    const double flat = halves * (areaKinds[kind] == LightKind::disc ? std::numbers::pi : 4);
    return {flat, flat * (light.two_sided > 0 ? std::abs(cosine) : std::max(cosine, 0.0))};
}

float inverseSquaredRange(float range) {
    const float squared = range * range;
    if (!(squared > 0)) return std::numeric_limits<float>::infinity();
    float inverse = 1 / squared;
    while (inverse * squared < 1) inverse = std::nextafter(inverse, std::numeric_limits<float>::infinity());
    return std::isinf(squared) ? 0 : inverse;
}

GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye,
                    std::span<const std::size_t> casters) {
    GpuLights result;
    const auto take = [&](LightKind kind, bool casting = false) {
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const Light& light = lights[i];
            if (light.kind != kind || !shines(light) || std::ranges::binary_search(casters, i) != casting)
                continue;
            result.lights.push_back(gpuLight(light, eye));
            result.sources.push_back(i);
            result.importance.push_back(casting ? Importance::important : light.importance);
            if (kind == LightKind::spot) result.spot_cones.push_back(spotCone(light));
            if (isArea(kind)) result.area_lights.push_back(areaLight(light));
            ++count;
        }
        return count;
    };
    result.directional = take(LightKind::directional);
    for (std::size_t i = 0; i < result.directional; ++i) {
        const auto strength = [&](std::size_t light) { return strengthOf(lights[result.sources[light]]); };
        if (result.importance[i] != Importance::not_important &&
            (!result.base || strength(i) > strength(*result.base)))
            result.base = i;
    }
    result.casting_points = take(LightKind::point, true);
    result.point = result.casting_points + take(LightKind::point);
    result.casting_spots = take(LightKind::spot, true);
    result.spot = result.casting_spots + take(LightKind::spot);
    for (std::size_t i = 0; i < areaKinds.size(); ++i) result.areas[i] = take(areaKinds[i]);
    result.lights.push_back({.position = {}, .inverse_range_squared = 1, .intensity = {}, .range = 0});
    result.spot_cones.push_back({{0, 0, 1}, 0, 0, {}});
    result.area_lights.push_back(
        {.x = {}, .radius = 0, .y = {}, .extent = 1, .direction = {0, 0, 1}, .two_sided = 0});
    return result;
}

}  // namespace diptych
