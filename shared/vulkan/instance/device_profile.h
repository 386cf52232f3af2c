// SPDX-License-Identifier: MIT
// Choices that depend on the device rather than on the scene or the Settings. No other code checks the
// device type.
#pragma once

#include "shared/vulkan/instance/device_info.h"

#include <cstdint>

namespace diptych {

// Nanoseconds on the whole device. Choices between equivalent ways to draw use their ratios. Pass::takes
// uses them to estimate whether a draw must be divided.
struct DeviceCosts {
    double draw = 0;      // with the same state as the previous draw
    double triangle = 0;  // of a depth pass
    double depth = 0;     // per fragment of a depth pass
    double surface = 0;   // surface setup per shaded fragment
    double texture = 0;   // per texture of it
    double light = 0;     // per light at it
    // Light lists, to choose the size of their cells:
    double list = 0;       // to clear, count and allocate one list
    double listed = 0;     // to mark and write one light of a list
    double evaluated = 0;  // to evaluate one light of a list at a pixel
};

// The device whose choices a profile uses. Properties of the actual device are unaffected: software,
// bit_exact, time_stamps.
enum class ProfileChoices {
    of_device,
    gpu,  // a GPU's, so that tests without a GPU can use them
    // The device's own, except DeviceProfile::culls_by_compute: to measure and test it alone.
    culling_by_compute,
    flattening_branches,  // the same for DeviceProfile::flattens_branches
};

struct DeviceProfile {
    // A CPU renders: a frame's time is CPU time.
    bool software = false;
    // Two pipelines with the same computations and inputs agree bit for bit; on other devices within some
    // ULP.
    bool bit_exact = false;
    // Time stamps around passes are valid. On lavapipe work runs later than they say.
    bool time_stamps = false;
    // Loads of a uniform are repeated for every lane, so fragment shaders read the view from texels.
    bool gathers_uniforms = false;
    // Runs enough threads to build light lists by many threads per tile (gather). Otherwise a few threads
    // per light build them with fewer tests (scatter).
    bool wide_groups = false;
    // The driver's compile time doubles with every branch inside a loop: pipelines use modules with
    // branches converted to selections (flattened() of flatten.h).
    bool flattens_branches = false;
    // Iterations that the loops over a pixel's lights may take in one draw; longer lists are split over
    // several draws. Mesa lavapipe silently ends all loops of a shader invocation after 65,535 iterations in
    // total, some of which are reserved for other loops.
    std::uint32_t light_iterations = 1;
    // With a depth pre-pass, forward+ reads the stored depth, as deferred lighting does. On other devices
    // the fragment's own depth has the same bits, though Vulkan does not guarantee it.
    bool fetches_depth = true;
    // With MSAA, fragments whose samples all fail the depth test still cost a shader invocation. lavapipe
    // skips them only without MSAA.
    bool shades_failed_samples = false;
    // Number of triangles of a pass that are binned before rasterization starts (DrawDivision); 0: the
    // device decides. Measured on lavapipe with two cores: for 85,000 triangles, 10,000 to 20,000 save 10
    // % of a frame. Below 5,000, extra loads and stores cost as much.
    std::uint32_t bins_at_once = 0;
    // A compute shader culls into indirect draws; otherwise the CPU culls, which was faster on lavapipe.
    // Never used if indirect draws do not support firstInstance.
    bool culls_by_compute = false;
    // Time until the device's clocks have ramped up and timings are valid.
    double warm_up_ms = 0;
    // Longer submits risk a hang detection. Infinite: no limit.
    double longest_submit_ms = 0;
    DeviceCosts costs;
};

// `timestampBits`: timestampValidBits of the queue.
DeviceProfile profileOf(const DeviceInfo& info, std::uint32_t timestampBits,
                        ProfileChoices choices = ProfileChoices::of_device);

}  // namespace diptych
