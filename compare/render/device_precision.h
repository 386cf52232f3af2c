// SPDX-License-Identifier: MIT
// The precision that a device promises and that was measured of it, which bounds how far its pictures may be
// from another device's.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/material/texture_probe.h"

#include <array>
#include <optional>
#include <string>

namespace diptych {

class Device;

struct DevicePrecision {
    std::string name;
    // VkPhysicalDeviceLimits: a vertex is placed, and a texture's weights and levels are chosen, to 2^-bits
    // of a pixel, a texel and a level. These are the least that Vulkan allows.
    unsigned sub_pixel_bits = 4, sub_texel_bits = 4, mipmap_bits = 4;
    std::optional<TextureSampling> texels{};  // measured, of a scene that has textures
};

// `textured`: measures what it makes of texels, too.
DevicePrecision precisionOf(Device& device, bool textured = false,
                            TexturePrecision textures = TexturePrecision::device);
std::array<DevicePrecision, 2> precisionsOf(Device& device, Device& against, bool textured = false,
                                            TexturePrecision textures = TexturePrecision::device);

}  // namespace diptych
