// SPDX-License-Identifier: MIT
#include "tests/bench/kernel_workload.h"

#include "shared/light/lights.h"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace diptych::kernels {

KernelWorkload makeWorkload(const Size& size, std::uint32_t lights, int listCapacity, std::uint32_t seed) {
    if (size.width % KernelWorkload::tile != 0 || size.height % KernelWorkload::tile != 0 ||
        listCapacity % 4 != 0 || lights > maxKernelLights ||
        static_cast<std::uint32_t>(listCapacity) > lights)
        throw std::logic_error(
            "makeWorkload: whole tiles, whole groups of four, lists no longer than lights");
    KernelWorkload workload{size, {}, {}, listCapacity};
    std::mt19937 random(seed);
    // In [0, 1), from raw generator bits: distributions differ between standard libraries.
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    const float range = 4;
    for (std::uint32_t i = 0; i < lights; ++i) {
        gpu::Light light{};
        for (int axis = 0; axis < 3; ++axis) light.intensity[axis] = 0.2f + 0.8f * unit();
        light.position = {-3 + 7 * unit(), -2 + 5 * unit(), -5.5f + 2 * unit()};
        light.range = range;
        light.inverse_range_squared = inverseSquaredRange(range);
        workload.lights.push_back(light);
    }
    std::vector<std::uint32_t> all(lights);
    for (std::uint32_t i = 0; i < lights; ++i) all[i] = i;
    for (int tile = 0; tile < workload.tilesAcross() * workload.tilesDown(); ++tile) {
        // Start of a Fisher-Yates shuffle, then sorted.
        for (int i = 0; i < listCapacity; ++i)
            std::swap(all[static_cast<std::size_t>(i)],
                      all[static_cast<std::size_t>(i) + random() % (lights - static_cast<std::uint32_t>(i))]);
        std::vector<std::uint32_t> list(all.begin(), all.begin() + listCapacity);
        std::ranges::sort(list);
        workload.indices.insert(workload.indices.end(), list.begin(), list.end());
    }
    return workload;
}

}  // namespace diptych::kernels
