// SPDX-License-Identifier: MIT
// Guaranteed and measured precision of a device. It bounds the difference between images of two devices.
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
    // VkPhysicalDeviceLimits: vertex positions, texture weights and mip levels are exact to 2^-bits of a
    // pixel, a texel and a level. The defaults are the minima that Vulkan allows.
    unsigned sub_pixel_bits = 4, sub_texel_bits = 4, mipmap_bits = 4;
    std::optional<TextureSampling> texels{};  // measured, if the scene has textures
};

// `textured`: also measures texture sampling.
DevicePrecision precisionOf(Device& device, bool textured = false,
                            TexturePrecision textures = TexturePrecision::device);
std::array<DevicePrecision, 2> precisionsOf(Device& device, Device& against, bool textured = false,
                                            TexturePrecision textures = TexturePrecision::device);

}  // namespace diptych
