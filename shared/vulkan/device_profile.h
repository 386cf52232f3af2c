// SPDX-License-Identifier: MIT
// What is chosen by the device instead of by the scene or the Settings. Nothing else asks what kind of device
// it is.
#pragma once

#include "shared/vulkan/device_info.h"

#include <cstdint>

namespace diptych {

// Nanoseconds of work on the whole device, for choices between ways to draw the same picture: only their
// ratios matter.
struct DeviceCosts {
    double triangle = 0;  // of a depth pass
    double depth = 0;     // a fragment of a depth pass
    double surface = 0;   // making the surface of a shaded fragment
    double texture = 0;   // each texture of it
    double light = 0;     // each light at it
    // Of light lists, for the size of their cells.
    double list = 0;       // to clear, count and place one
    double listed = 0;     // to mark and write one of its lights
    double evaluated = 0;  // to evaluate one of its lights at a pixel
};

struct DeviceProfile {
    // A CPU draws: what a frame takes is this machine's CPU time.
    bool software = false;
    // Two pipelines that compute the same from the same bits agree bit for bit; elsewhere within some ULP.
    bool bit_exact = false;
    // Time stamps around passes are true. On lavapipe they are not: work runs later than they say.
    bool time_stamps = false;
    // A shader's load of a uniform is gathered for every lane anew, so that fragment shaders read the view
    // from texels.
    bool gathers_uniforms = false;
    // So many threads run at once that light lists are made by many for each tile (gather); otherwise by few
    // for each light, which test less (scatter).
    bool wide_groups = false;
    DeviceCosts costs;
};

// `timestampBits`: how many bits of a time stamp the queue writes.
DeviceProfile profileOf(const DeviceInfo& info, std::uint32_t timestampBits);

}  // namespace diptych
