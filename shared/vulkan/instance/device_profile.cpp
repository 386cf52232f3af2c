// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/device_profile.h"

#include <limits>

namespace diptych {

DeviceProfile profileOf(const DeviceInfo& info, std::uint32_t timestampBits, ProfileChoices choices) {
    const bool software = info.type == "cpu";
    const bool asSoftware = software && choices != ProfileChoices::gpu;
    // Measured on lavapipe with two cores. A GPU is assumed to be about 100 times as fast.
    constexpr DeviceCosts lavapipe{.draw = 7'000,
                                   .triangle = 65,
                                   .depth = 1,
                                   .surface = 20,
                                   .texture = 10,
                                   .light = 3,
                                   .list = 40,
                                   .listed = 15,
                                   .evaluated = 5};
    constexpr DeviceCosts gpu{.draw = 70,
                              .triangle = 0.6,
                              .depth = 0.01,
                              .surface = 0.2,
                              .texture = 0.1,
                              .light = 0.03,
                              .list = 0.4,
                              .listed = 0.15,
                              .evaluated = 0.05};
    return {.software = software,
            .bit_exact = software,
            .time_stamps = !software && timestampBits > 0,
            .gathers_uniforms = asSoftware,
            .wide_groups = !asSoftware,
            // Measured: a loop with 16 two-sided branches takes 0.02 s; one with 32 does not finish in 10
            // s.
            .flattens_branches =
                info.driver.starts_with("SwiftShader") || choices == ProfileChoices::flattening_branches,
            .light_iterations = asSoftware ? 65'000u : 1u << 20,
            .fetches_depth = !asSoftware,
            .shades_failed_samples = asSoftware,
            .bins_at_once = asSoftware && timestampBits > 0 ? 15'000u : 0u,
            .culls_by_compute = !asSoftware || choices == ProfileChoices::culling_by_compute,
            .warm_up_ms = asSoftware ? 0.0 : 300.0,
            .longest_submit_ms = asSoftware ? std::numeric_limits<double>::infinity() : 100,
            .costs = asSoftware ? lavapipe : gpu};
}

}  // namespace diptych
