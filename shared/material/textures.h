// SPDX-License-Identifier: MIT
// One image and one sampler on the device.
#pragma once

#include "shared/frame/setting_values.h"
#include "shared/scene/image/mipmap.h"
#include "shared/vulkan/resources.h"

#include <functional>

namespace diptych {

struct TextureFormat {
    Texels texels = Texels::linear8;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    bool exact = true;  // every code of the image stays apart from its neighbours
};

// 8 bits as they are, 16 bits as 16. There is no sRGB format of 16 bits: such an image is decoded to linear
// float32, where the steps of dark codes, 1.2e-6, survive (16 linear bits end at 1.5e-5). What the device
// does not filter gives way to the next: float32, then half floats, which every Vulkan device filters.
//
// TexturePrecision::exact makes 16 bits of 8: of linear codes c exactly, as c / 255 is 257 c / 65535, and of
// sRGB half floats, decoded to within 2^-12 of the value at every code.
TextureFormat textureFormat(bool deep, bool srgb, TexturePrecision precision,
                            const std::function<bool(VkFormat)>& filters);
TextureFormat textureFormat(const Device& device, const TextureImage& image, bool srgb,
                            TexturePrecision precision);

GpuImage uploadTexture(Device& device, Uploader& uploader, const MipChain& chain, VkFormat format);

OwnedSampler makeSampler(Device& device, const Sampler& sampler);

}  // namespace diptych
