// SPDX-License-Identifier: MIT
// The cells that a picture is cut into for light lists, and the bounds of lights. CPU only.
#pragma once

#include "shared/contract/light_list.h"
#include "shared/light/lights.h"
#include "shared/scene/view.h"
#include "shared/vulkan/device_profile.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// The bounds of the local lights, in their order.
std::vector<gpu::LightBound> lightBounds(const GpuLights& lights, const View& view);

// `lists`: LISTS_CLUSTERED or LISTS_TILED. No buffer of the lists is larger than `buffer_bytes`: tiles grow
// until the masks fit, and the capacity of the index buffer ends there, so that lists beyond it overflow.
// Clustered tiles and slices have the sizes that cost least for the given lights by the device's `costs`, in
// making lists and at pixels together; Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward
// Shading", with bounds from the projection alone as in Persson 2013, "Practical Clustered Shading".
// `in_front`: tiles have two lists each (LightGrid::lists).
gpu::LightGrid makeLightGrid(gpu::uint lists, bool in_front, const View& view, const GpuLights& lights,
                             std::span<const gpu::LightBound> bounds, const DeviceCosts& costs,
                             std::uint64_t buffer_bytes);

// An upper bound of the number of (light, list) pairs, from which the capacity of the index buffer is
// computed.
std::uint64_t listedAtMost(const gpu::LightGrid& grid, bool orthographic,
                           std::span<const gpu::LightBound> bounds);

// The cell that holds a pixel at a view depth, m, as cellOf() of shaders/lib/light_grid.glsl.
gpu::uint cellOf(const gpu::LightGrid& grid, int x, int y, float depth);

// View depths of slice `s`, m, a little more than float32 can round; the last reaches to MAX_BOUND_RADIUS.
struct SliceDepths {
    float near = 0, far = 0;
};
SliceDepths sliceDepths(const gpu::LightGrid& grid, gpu::uint s);

}  // namespace diptych
