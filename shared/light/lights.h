// SPDX-License-Identifier: MIT
#pragma once

#include "shared/contract/area_light.h"
#include "shared/contract/light.h"
#include "shared/light/falloff.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

// Lights as shaders read them: by type, each type in the given order, but casting points and spots before
// others. Every sum over lights in every path runs in this order.
struct GpuLights {
    std::vector<gpu::Light> lights;           // directional, point, spot, area by kind, null light
    std::vector<gpu::SpotCone> spot_cones;    // then the null light's
    std::vector<gpu::AreaLight> area_lights;  // then the null light's
    std::vector<Importance> importance;       // of all but the null light
    std::vector<std::size_t> sources;         // likewise: index in the input
    // --assign per_object: directional light that is always shaded per pixel: the brightest that is not
    // marked not_important. If the sun casts shadows, it is this one.
    std::optional<std::size_t> base;
    LightFalloff falloff;      // of all local lights, in shaders and on the host
    bool environment = false;  // the scene has an environment as well
    glm::vec3 ambient{0};      // W/(sr m^2), uniform
    std::uint32_t directional = 0, point = 0, spot = 0;
    std::array<std::uint32_t, areaKinds.size()> areas{};  // by kind
    std::uint32_t casting_points = 0, casting_spots = 0;  // first of their type
    std::uint32_t area() const { return std::reduce(areas.begin(), areas.end()); }
    std::uint32_t local() const { return point + spot + area(); }
    std::uint32_t count() const { return directional + local(); }
    std::size_t firstSpot() const { return directional + point; }
    std::size_t firstArea() const { return firstSpot() + spot; }

    // The cone of light `i`; null unless it is a spot.
    const gpu::SpotCone* coneOf(std::size_t i) const {
        return i >= firstSpot() && i < firstArea() ? &spot_cones[i - firstSpot()] : nullptr;
    }
    // The shape of light `i`; null unless it is an area light.
    const gpu::AreaLight* shapeOf(std::size_t i) const {
        return i >= firstArea() ? &area_lights[i - firstArea()] : nullptr;
    }
};

// Projected area of the area light `i` from afar, m^2, which converts radiance to intensity: the largest
// over all directions, and in the unit direction `to_place` from its centre.
struct ShownArea {
    double max, there;
};
ShownArea shownArea(const GpuLights& lights, std::size_t i, const glm::dvec3& to_place);

// Light::inverse_range_squared for a range in metres, 1/m^2: the smallest float32 whose product with the
// squared range is at least 1, so that no light arrives from the range on. 0 if the squared range is
// infinite.
float inverseSquaredRange(float range);

// `eye`: the camera, world, m. Positions are made relative to it in double. Lights without effect (black,
// or zero range) are skipped. `casters`: indices of the shadow-casting points and spots, ascending. They
// count as important, so --assign per_object shades them per pixel.
GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye,
                    std::span<const std::size_t> casters = {});

}  // namespace diptych
