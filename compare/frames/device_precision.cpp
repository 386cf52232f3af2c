// SPDX-License-Identifier: MIT
#include "compare/frames/device_precision.h"

#include "shared/vulkan/device/device.h"

namespace diptych {

DevicePrecision precisionOf(Device& device, bool textured, TexturePrecision textures) {
    const VkPhysicalDeviceLimits& limits = device.limits();
    DevicePrecision precision{device.info().name, limits.subPixelPrecisionBits, limits.subTexelPrecisionBits,
                              limits.mipmapPrecisionBits};
    if (textured) precision.texels = probeTextures(device, textures);
    return precision;
}

std::array<DevicePrecision, 2> precisionsOf(Device& device, Device& against, bool textured,
                                            TexturePrecision textures) {
    return {precisionOf(device, textured, textures), precisionOf(against, textured, textures)};
}

}  // namespace diptych
