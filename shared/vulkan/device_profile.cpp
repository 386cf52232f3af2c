// SPDX-License-Identifier: MIT
#include "shared/vulkan/device_profile.h"

namespace diptych {

DeviceProfile profileOf(const DeviceInfo& info, std::uint32_t timestampBits) {
    const bool software = info.type == "cpu";
    // Measured on lavapipe with two cores. A GPU is assumed to take about a hundredth of each.
    constexpr DeviceCosts lavapipe{65, 1, 20, 10, 3}, gpu{0.6, 0.01, 0.2, 0.1, 0.03};
    return {.software = software,
            .bit_exact = software,
            .time_stamps = !software && timestampBits > 0,
            .gathers_uniforms = software,
            .wide_groups = !software,
            .costs = software ? lavapipe : gpu};
}

}  // namespace diptych
