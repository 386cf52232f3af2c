// SPDX-License-Identifier: MIT
// The workload that the kernels of a benchmark shade.
#pragma once

#include "shared/contract/light.h"
#include "shared/frame/settings.h"
#include "shared/image/image.h"

#include <cstdint>
#include <vector>

namespace diptych::bench {

// Tiles of 16 x 16 pixels, each with a list of its own, of lights in ascending order; the surface of a pixel
// is benchSurface() of shaders/lib/bench_lights.glsl.
struct KernelWorkload {
    Size size;                           // whole tiles
    std::vector<gpu::Light> lights;      // as many as a uniform block of bench_lights.glsl holds, or fewer
    std::vector<std::uint32_t> indices;  // list_capacity of each tile, row by row
    int list_capacity = 0;               // lights of a list, a multiple of 4

    int tilesAcross() const { return size.width / tile; }
    int tilesDown() const { return size.height / tile; }
    static constexpr int tile = 16;
};

inline constexpr std::uint32_t mostKernelLights = 512;  // 16 KiB: the least that a uniform buffer may have

// The same for the same seed, on every machine. `size` in whole tiles; `listCapacity` a multiple of 4, at
// most `lights`.
KernelWorkload makeWorkload(const Size& size, std::uint32_t lights, int listCapacity, std::uint32_t seed);

}  // namespace diptych::bench
