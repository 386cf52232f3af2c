// SPDX-License-Identifier: MIT
// The workload of bench_kernels.
#pragma once

#include "shared/contract/light.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <cstdint>
#include <vector>

namespace diptych::kernels {

// Tiles of 16 x 16 pixels, each with its own ascending light list. Surfaces come from kernelSurface() in
// shaders/lights.glsl.
struct KernelWorkload {
    Size size;                           // multiple of the tile size
    std::vector<gpu::Light> lights;      // at most maxKernelLights
    std::vector<std::uint32_t> indices;  // list_capacity per tile, row by row
    int list_capacity = 0;               // lights per list, a multiple of 4

    int tilesAcross() const { return size.width / tile; }
    int tilesDown() const { return size.height / tile; }
    static constexpr int tile = 16;
};

inline constexpr std::uint32_t maxKernelLights = 512;  // 16 KiB: Vulkan's minimum for
                                                       // maxUniformBufferRange

// Deterministic for a seed on every machine. `size`: multiple of the tile size. `listCapacity`: multiple
// of 4, at most `lights`. Throws std::logic_error otherwise.
KernelWorkload makeWorkload(const Size& size, std::uint32_t lights, int listCapacity, std::uint32_t seed);

}  // namespace diptych::kernels
