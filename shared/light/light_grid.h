// SPDX-License-Identifier: MIT
// Tiles and froxels of an image for light lists, and bounds of lights. CPU only.
#pragma once

#include "shared/contract/light_list.h"
#include "shared/light/lights.h"
#include "shared/scene/view.h"
#include "shared/vulkan/instance/device_profile.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

// Bounds of the local lights, in order.
std::vector<gpu::LightBound> lightBounds(const GpuLights& lights, const View& view);

// `lists`: LISTS_CLUSTERED or LISTS_TILED. No buffer of the lists exceeds `buffer_bytes`: tiles grow until
// the masks fit, and the index buffer's capacity is limited, so that further lists overflow. `in_front`:
// tiles have two lists each (LightGrid::lists).
// Sizes of froxels minimize the total cost of list building and shading for these lights by the device's
// `costs` (Olsson, Billeter and Assarsson 2012, "Clustered Deferred and Forward Shading"). Their bounds
// depend on the projection alone, as in Persson 2013, "Practical Clustered Shading".
struct GridLists {
    gpu::uint lists;
    bool in_front = false;
};
gpu::LightGrid makeLightGrid(const GridLists& of, const View& view, const GpuLights& lights,
                             std::span<const gpu::LightBound> bounds, const DeviceCosts& costs,
                             std::uint64_t buffer_bytes);

// Upper bound of the number of (light, list) pairs, which determines the capacity of the index buffer.
std::uint64_t listedAtMost(const gpu::LightGrid& grid, bool orthographic,
                           std::span<const gpu::LightBound> bounds);

// Cell of a pixel at a view depth, m; as cellOf() of shaders/lib/lights/light_grid.glsl.
gpu::uint cellOf(const gpu::LightGrid& grid, int x, int y, float depth);

// View depths of slice `s`, m, extended by more than float32 rounding; the last ends at MAX_BOUND_RADIUS.
struct SliceDepths {
    float near = 0, far = 0;
};
SliceDepths sliceDepths(const gpu::LightGrid& grid, gpu::uint s);

}  // namespace diptych
