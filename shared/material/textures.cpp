// SPDX-License-Identifier: MIT
#include "shared/material/textures.h"

#include "shared/vulkan/instance/check.h"

#include <fmt/format.h>

#include <stdexcept>

namespace diptych {

TextureFormat textureFormat(bool deep, bool srgb, TexturePrecision precision,
                            const std::function<bool(VkFormat)>& filters) {
    if (!deep && precision == TexturePrecision::exact && srgb)
        return {Texels::float16, VK_FORMAT_R16G16B16A16_SFLOAT, true};
    if (!deep && precision != TexturePrecision::exact)
        return srgb ? TextureFormat{Texels::srgb8, VK_FORMAT_R8G8B8A8_SRGB, true}
                    : TextureFormat{Texels::linear8, VK_FORMAT_R8G8B8A8_UNORM, true};
    if (!srgb && filters(VK_FORMAT_R16G16B16A16_UNORM))
        return {Texels::linear16, VK_FORMAT_R16G16B16A16_UNORM, true};
    if (filters(VK_FORMAT_R32G32B32A32_SFLOAT)) return {Texels::float32, VK_FORMAT_R32G32B32A32_SFLOAT, true};
    return {Texels::float16, VK_FORMAT_R16G16B16A16_SFLOAT, false};
}

TextureFormat textureFormat(const Device& device, const TextureImage& image, bool srgb,
                            TexturePrecision precision) {
    // Floats are treated like 16-bit sRGB, which becomes float.
    return textureFormat(image.deep(), srgb || !image.rgba32.empty(), precision, [&](VkFormat format) {
        return device.support().can(format, format_use::sampled | format_use::filtered);
    });
}

GpuImage uploadTexture(Device& device, Uploader& uploader, const MipChain& chain, VkFormat format) {
    const auto max = static_cast<int>(device.limits().maxImageDimension2D);
    if (chain.width() > max || chain.height() > max)
        throw std::runtime_error(fmt::format("image {}: has {} x {} pixels; {} supports up to {} per side",
                                             chain.name(), chain.width(), chain.height(), device.info().name,
                                             max));
    GpuImage image(device, {.name = chain.name(),
                            .format = format,
                            .width = static_cast<std::uint32_t>(chain.width()),
                            .height = static_cast<std::uint32_t>(chain.height()),
                            .levels = static_cast<std::uint32_t>(chain.count()),
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                            .filtered = true});
    for (std::uint32_t level = 0; level < chain.count(); ++level)
        uploader.level(image, level, chain.level(level));
    return image;
}

OwnedSampler makeSampler(Device& device, const Sampler& s) {
    const auto address = [](Wrap wrap) {
        return wrap == Wrap::repeat            ? VK_SAMPLER_ADDRESS_MODE_REPEAT
               : wrap == Wrap::mirrored_repeat ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                               : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    };
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = s.magnify_linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.minFilter = s.minify_linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.mipmapMode = s.mipmaps_linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = address(s.wrap_s);
    info.addressModeV = address(s.wrap_t);
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    // Vulkan's equivalent of OpenGL filters without mip levels: clamping just above level 0 keeps the
    // choice between magnification and minification.
    info.maxLod = s.mipmaps ? VK_LOD_CLAMP_NONE : 0.25f;
    VkSampler sampler = VK_NULL_HANDLE;
    checkResult(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    return {device.handle(), sampler};
}

}  // namespace diptych
