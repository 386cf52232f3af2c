// SPDX-License-Identifier: MIT
// Images and samplers on the device.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/image/mipmap.h"
#include "shared/vulkan/device/resources.h"

#include <functional>

namespace diptych {

struct TextureFormat {
    Texels texels = Texels::linear8;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    bool exact = true;  // adjacent codes of the image stay distinct
};

// 8 and 16 bits keep their size. There is no 16-bit sRGB format: such an image becomes linear float32,
// which resolves the steps of dark codes, 1.2e-6 (16 linear bits end at 1.5e-5). If the device cannot
// filter a format, the next one is used: float32, then half floats, which every Vulkan device filters.
//
// TexturePrecision::exact widens 8 bits to 16. Linear codes c stay exact, because c / 255 is 257 c /
// 65535. sRGB becomes half floats, within 2^-12 of the value at every code.
TextureFormat textureFormat(bool deep, bool srgb, TexturePrecision precision,
                            const std::function<bool(VkFormat)>& filters);
TextureFormat textureFormat(const Device& device, const TextureImage& image, bool srgb,
                            TexturePrecision precision);

GpuImage uploadTexture(Device& device, Uploader& uploader, const MipChain& chain, VkFormat format);

OwnedSampler makeSampler(Device& device, const Sampler& sampler);

}  // namespace diptych
