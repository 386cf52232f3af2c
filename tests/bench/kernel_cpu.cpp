// SPDX-License-Identifier: MIT
#include "tests/bench/kernel_avx2.h"
#include "tests/bench/kernels.h"

#include <tbb/parallel_for.h>

namespace diptych::kernels {

static_assert(sizeof(gpu::Light) == 8 * sizeof(float));

bool hasCpuKernel() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return false;
#endif
}

void runCpuKernel(const KernelWorkload& workload, int listLength, Image& image) {
    const int across = workload.tilesAcross(), side = KernelWorkload::tile;
    const std::size_t stride = static_cast<std::size_t>(image.width) * 3;
    tbb::parallel_for(0, across * workload.tilesDown(), [&](int tile) {
        const int x = tile % across * side, y = tile / across * side;
        shadeTileAvx2(
            {&workload.lights.front().position.x,
             workload.indices.data() +
                 static_cast<std::size_t>(tile) * static_cast<std::size_t>(workload.list_capacity),
             listLength, x, y,
             image.data.data() + static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x) * 3,
             stride});
    });
}

}  // namespace diptych::kernels
