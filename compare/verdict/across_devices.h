// SPDX-License-Identifier: MIT
// Two pictures of one path on two devices: their judgement's input beside the channels.
#pragma once

#include "compare/render/device_precision.h"
#include "shared/image/image.h"

#include <array>
#include <functional>
#include <map>

namespace diptych {

struct AcrossDevices {
    std::array<DevicePrecision, 2> devices;  // the baseline's and the test's
    // By channel of the surface, the range of the texels that may be seen at a pixel (texel_ranges.h).
    std::map<int, Image> texels;
    // Texture coordinates of forward+ on both devices: they tell seams, which a deferred Frame does not show.
    // nullptr: unknown.
    std::array<const Image*, 2> texcoords{};
    // The scene has a surface (or `several`) of a material (-1: any blended one) within `near` metres of a
    // place from the camera in world axes, m. Empty: unknown, and no two surfaces count as being of one
    // depth.
    std::function<bool(int material, const float* place, double near, bool several)> surface_at{};
    // Lit channels of the test's surfaces as the baseline's device lights them, from their channels.
    std::map<int, Image> relit;
};

}  // namespace diptych
