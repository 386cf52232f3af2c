// SPDX-License-Identifier: MIT
#include "shared/light/ltc_image.h"

#include "shared/light/ltc.h"
#include "shared/vulkan/instance/check.h"

#include <cstdint>
#include <span>
#include <vector>

namespace diptych {

LtcImage::LtcImage(Device& device, Uploader& uploader, bool needed) {
    const std::vector<std::uint64_t> texels = needed ? ltcTexels(ltcTable()) : std::vector<std::uint64_t>(1);
    image_ = GpuImage(device, {.name = "linearly transformed cosines",
                               .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                               .width = needed ? gpu::LTC_CELLS : 1,
                               .height = needed ? gpu::LTC_BLOCKS * gpu::LTC_CELLS : 1,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                               .filtered = true});
    uploader.level(image_, 0, std::as_bytes(std::span(texels)));
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler = VK_NULL_HANDLE;
    checkResult(vkCreateSampler(device.handle(), &info, nullptr, &sampler), "vkCreateSampler");
    sampler_ = OwnedSampler(device.handle(), sampler);
}

}  // namespace diptych
