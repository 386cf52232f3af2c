// SPDX-License-Identifier: MIT
// Further inputs for comparing one path on two devices, beside the channels.
#pragma once

#include "compare/frames/device_precision.h"
#include "shared/frame/channel.h"
#include "shared/image/image.h"

#include <array>
#include <functional>
#include <map>

namespace diptych {

struct AcrossDevices {
    std::array<DevicePrecision, 2> devices;  // of the baseline and of the test
    // By surface channel, the range of texels that may be visible at a pixel (texel_ranges.h).
    std::map<Channel, Image> texels;
    // Texture coordinates of forward+ on both devices; they reveal seams, which a deferred Frame does not
    // show. nullptr: unknown.
    std::array<const Image*, 2> texcoords{};
    // Whether the scene has a surface (or `several`) of a material (-1: any blended one) within `near`
    // metres of a position (world axes, camera as origin, m). Empty: unknown; then no two surfaces count
    // as having equal depth.
    std::function<bool(int material, const float* position, double near, bool several)> surface_at{};
    // Lit channels and visibilities of the test's surfaces, shaded on the baseline's device from their
    // channels.
    std::map<Channel, Image> relit;
};

}  // namespace diptych
