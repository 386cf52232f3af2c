// SPDX-License-Identifier: MIT
// Range of texels among which two devices' filters may choose at each pixel: by the steps of their
// weights, and by the level of detail, for which Vulkan permits a range.
#pragma once

#include "compare/frames/device_precision.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <map>

namespace diptych {

// Largest difference of two samples by surface channel, W x H x 1, in its unit (unit vectors: degrees); 0
// without a texture. Both samples are means of texels that may be visible at the pixel, so the texels'
// range is the bound. If both devices magnify a texture, the steps of its weights are the bound. Uses the
// scene's own texels, in double. `frame`: of forward+, with texcoords and material_id. Without texcoords,
// or with second texture coordinates, the whole texture may be visible at a pixel.
std::map<Channel, Image> texelRanges(const Scene& scene, const Frame& frame,
                                     const std::array<DevicePrecision, 2>& devices);

}  // namespace diptych
