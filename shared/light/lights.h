// SPDX-License-Identifier: MIT
#pragma once

#include "shared/contract/light.h"
#include "shared/scene/scene.h"

#include <span>
#include <vector>

namespace diptych {

// Lights as the shaders read them, directional ones first, each kind in the order given: every sum over
// lights in every path runs in this order.
struct GpuLights {
    std::vector<gpu::Light> lights;
    std::uint32_t directional = 0, local = 0;
};

// `eye`: the camera, world, m. World positions are made relative to it in double. A light that gives
// nothing (black, or zero range) is left out. Throws std::runtime_error where there are more than one
// draw may walk (MAX_LIGHTS_PER_DRAW).
GpuLights gpuLights(std::span<const Light> lights, const glm::dvec3& eye);

}  // namespace diptych
