// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace diptych::bench {

// One tile of 16 x 16 pixels. kernel_avx2.cpp is compiled for AVX2 and FMA. It includes only plain types, so
// that no template or inline function shared with other files is compiled that way.
struct KernelTile {
    const float* lights;           // 8 floats each: gpu::Light
    const std::uint32_t* indices;  // the tile's list
    int count;                     // lights that are walked
    int x, y;                      // its first pixel
    float* row;                    // R, G, B of that pixel
    std::size_t stride;            // floats from one row of pixels to the next
};
void shadeTileAvx2(const KernelTile& tile);

}  // namespace diptych::bench
