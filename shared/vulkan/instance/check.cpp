// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/check.h"

#include <fmt/format.h>

#include <stdexcept>

namespace diptych {

std::string nameOf(VkResult result) {
    switch (result) {
        case VK_SUCCESS:
            return "success";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of host memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of device memory";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "initialization failed";
        case VK_ERROR_DEVICE_LOST:
            return "the device was lost";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "memory map failed";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "layer not present";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "extension not present";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "feature not present";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "incompatible driver";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "too many objects";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "format not supported";
        case VK_ERROR_FRAGMENTED_POOL:
            return "fragmented pool";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "out of pool memory";
        default:
            return fmt::format("VkResult {}", static_cast<int>(result));
    }
}

namespace {

const char* helpFor(VkResult result) {
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
            return "; try a smaller --size or fewer --lights, or choose another device with --device";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "; try a smaller --size, or another device with --device";
        default:
            return "; choose another device with --device";
    }
}

}  // namespace

void checkResult(VkResult result, std::string_view what) {
    if (result < 0)
        throw std::runtime_error(fmt::format("Vulkan: {}: {}{}", what, nameOf(result), helpFor(result)));
}

}  // namespace diptych
