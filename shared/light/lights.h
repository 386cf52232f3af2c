// SPDX-License-Identifier: MIT
#pragma once

#include "shared/contract/area_light.h"
#include "shared/contract/light.h"
#include "shared/scene/model/scene.h"

#include <optional>
#include <span>
#include <vector>

namespace diptych {

// Lights as the shaders read them, by kind and each kind in the order given, but points and spots that cast
// before those that do not: every sum over lights in every path runs in this order.
struct GpuLights {
    std::vector<gpu::Light> lights;         // directional, point, spot, rect, disc, tube, and the null light
    std::vector<gpu::SpotCone> spot_cones;  // and the null light's
    std::vector<gpu::AreaLight> area_lights;  // and the null light's
    std::vector<Importance> importance;       // of all but the null light
    std::vector<std::size_t> sources;         // of the same: its place among the lights it was made of
    // --assign per_object: the directional light that is always shaded per pixel, the brightest one that is
    // not marked not_important; the sun that casts, where one does.
    std::optional<std::size_t> base;
    bool environment = false;  // an environment lights the scene beside them
    glm::vec3 ambient{0};      // W/(sr m^2), from everywhere
    std::uint32_t directional = 0, point = 0, spot = 0, rect = 0, disc = 0, tube = 0;
    std::uint32_t casting_points = 0, casting_spots = 0;  // the first of their kind
    std::uint32_t area() const { return rect + disc + tube; }
    std::uint32_t local() const { return point + spot + area(); }
    std::uint32_t count() const { return directional + local(); }
};

// Light::inverse_range_squared of a range in metres, 1/m^2: the least float32 whose product with the squared
// range is at least 1, so that no light arrives from the range on. 0 for a range whose square is infinite.
float inverseSquaredRange(float range);

// `eye`: the camera, world, m. World positions are made relative to it in double. A light that gives
// nothing (black, or zero range) is left out. `casters`: places of the points and spots that cast shadows, in
// ascending order; they are important, so that --assign per_object shades them per pixel.
GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye,
                    std::span<const std::size_t> casters = {});

}  // namespace diptych
