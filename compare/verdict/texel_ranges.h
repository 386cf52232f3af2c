// SPDX-License-Identifier: MIT
// How far apart the texels are among which two devices' filters may choose at each pixel: by their weights'
// steps and by the level of detail, which Vulkan lets a device take from a range.
#pragma once

#include "compare/render/device_precision.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <array>
#include <map>

namespace diptych {

// By channel of the surface how far apart two samples may be, W x H x 1, in its unit (unit vectors: degrees);
// 0 where no texture is read. Either is a mean of texels that may be seen at the pixel, so that their range
// is the bound; where a texture is magnified on both devices, the steps of its weights are. From the scene's
// own texels, in double. `frame`: of forward+, with texcoords and material_id; without texcoords the whole
// texture may be seen at a pixel, and so it may by second texture coordinates.
std::map<int, Image> texelRanges(const Scene& scene, const Frame& frame,
                                 const std::array<DevicePrecision, 2>& devices);

}  // namespace diptych
