// SPDX-License-Identifier: MIT
#include "shared/draw/depth_storage.h"

#include "shared/vulkan/device/device.h"

#include <fmt/format.h>

#include <stdexcept>

namespace diptych {

PipelineKey DepthStorage::stored(PipelineKey key) const {
    key.depth = format;
    if (kind != gpu::DEPTH_STANDARD) return key;
    switch (key.depth_compare) {
        case VK_COMPARE_OP_GREATER_OR_EQUAL:
            key.depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL;
            break;
        case VK_COMPARE_OP_GREATER:
            key.depth_compare = VK_COMPARE_OP_LESS;
            break;
        case VK_COMPARE_OP_LESS_OR_EQUAL:
            key.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
            break;
        case VK_COMPARE_OP_EQUAL:
        case VK_COMPARE_OP_ALWAYS:
            break;
        default:
            throw std::logic_error("DepthStorage: unknown depth test");
    }
    return key;
}

DepthStorage depthStorage(DepthFormat format) {
    switch (format) {
        case DepthFormat::d32f:
            break;
        case DepthFormat::d32f_standard:
            return {
                VK_FORMAT_D32_SFLOAT, gpu::DEPTH_STANDARD, {1.0f - gpu::STANDARD_DEPTH_FIRST, 0.0f, 1.0f}};
        case DepthFormat::d24:
            return {VK_FORMAT_X8_D24_UNORM_PACK32, gpu::DEPTH_STEPS_24, {1.0f / 16777215, 1.0f, 0.0f}};
        case DepthFormat::d16:
            return {VK_FORMAT_D16_UNORM, gpu::DEPTH_STEPS_16, {1.0f / 65535, 1.0f, 0.0f}};
    }
    return {};
}

VkFormat litFormatOf(LitFormat format) {
    switch (format) {
        case LitFormat::fp32:
            break;
        case LitFormat::fp16:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case LitFormat::b10g11r11:
            return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    }
    return VK_FORMAT_R32G32B32A32_SFLOAT;
}

std::optional<std::string> drawingProblem(const Device& device, const Settings& settings) {
    const auto lacks = [&](const char* option, const char* what, const char* instead) {
        return fmt::format("--{} {}: {} {}; use --{} {}", option, settings.valueOf(option),
                           device.info().name, what, option, instead);
    };
    const auto draws = [&](VkFormat format, VkImageUsageFlags usage) {
        return (device.support().sampleCounts(format, usage | VK_IMAGE_USAGE_SAMPLED_BIT) &
                VK_SAMPLE_COUNT_1_BIT) != 0;
    };
    if (!draws(depthStorage(settings.depth_format).format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT))
        return lacks("depth-format", "does not support this format as an attachment", "d32f");
    if (!draws(litFormatOf(settings.lit_format),
               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT))
        return lacks("lit-format", "does not support this format as an attachment", "fp32");
    if (hasGBuffer(settings.path) && settings.lighting == Lighting::compute) {
        const auto samples = static_cast<VkSampleCountFlags>(settings.msaa);
        const bool stores = settings.msaa == 1 || device.support().storesSamples();
        if (!stores ||
            (device.support().sampleCounts(litFormatOf(LitFormat::fp32),
                                           VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) &
             samples) == 0)
            return lacks(
                "lighting",
                fmt::format("does not support the storage images that it needs with --msaa {}", settings.msaa)
                    .c_str(),
                "fragment");
    }
    if (settings.shading_precision == ShadingPrecision::fp16 &&
        !device.support().has(DeviceFeature::shaderFloat16))
        return lacks("shading-precision", "lacks shaderFloat16", "fp32");
    return {};
}

}  // namespace diptych
