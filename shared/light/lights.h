// SPDX-License-Identifier: MIT
#pragma once

#include "shared/contract/light.h"
#include "shared/scene/scene.h"

#include <span>
#include <vector>

namespace diptych {

// Lights as the shaders read them, by kind and each kind in the order given: every sum over lights in every
// path runs in this order.
struct GpuLights {
    std::vector<gpu::Light> lights;  // directional, point, spot
    std::vector<gpu::SpotCone> spot_cones;
    std::uint32_t directional = 0, point = 0, spot = 0;
};

// Light::inverse_range_squared of a range in metres, 1/m^2: the least float32 whose product with the squared
// range is at least 1, so that no light arrives from the range on. 0 for a range whose square is infinite.
float inverseSquaredRange(float range);

// `eye`: the camera, world, m. World positions are made relative to it in double. A light that gives
// nothing (black, or zero range) is left out. Throws std::runtime_error where there are more than one
// draw may walk (MAX_LIGHTS_PER_DRAW).
GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye);

}  // namespace diptych
