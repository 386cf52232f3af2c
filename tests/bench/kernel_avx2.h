// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::kernels {

// One tile of 16 x 16 pixels. kernel_avx2.cpp is compiled for AVX2 and FMA. It includes only plain types,
// so that no shared template or inline function is compiled for these extensions.
struct KernelTile {
    const float* lights;           // 8 floats each: gpu::Light
    const std::uint32_t* indices;  // the tile's light list
    int count;                     // evaluated lights
    int x, y;                      // first pixel
    float* row;                    // R, G, B of the first pixel
    std::size_t stride;            // floats per row of the image
};
void shadeTileAvx2(const KernelTile& tile);

}  // namespace diptych::kernels
