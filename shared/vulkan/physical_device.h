// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/device_info.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// What a device is and what it can and cannot do for us: features and limits, asked, not versions.
DeviceInfo describe(VkPhysicalDevice device, int index);

// The first queue family that draws and computes.
std::optional<std::uint32_t> graphicsFamily(VkPhysicalDevice device);

// An index into `infos`; "" takes the best usable one, discrete before integrated before virtual before
// cpu. Throws std::runtime_error naming --device and what there is, or the feature that is missing.
std::size_t chooseDevice(const std::vector<DeviceInfo>& infos, const std::string& choice);

// The one of this index, or the first with this in its name.
std::optional<std::size_t> findDevice(const std::vector<DeviceInfo>& infos, const std::string& choice);
std::string listOf(const std::vector<DeviceInfo>& infos);  // "0: llvmpipe, 1: ..."; "none"

// The fact that a driver without hardware lacks, which compiles all the same (PipelineCompiler).
inline constexpr const char* memoryFact = "memory";

bool saysStatistics(VkPhysicalDevice device);     // VK_KHR_pipeline_executable_properties
bool knowsMemoryBudget(VkPhysicalDevice device);  // VK_EXT_memory_budget

// Fragment shaders may use 64-bit atomics on buffers and the number of their triangle.
bool sortsFragments(VkPhysicalDevice device);
// Fragment shaders may store to a sample of an image.
bool storesSamples(VkPhysicalDevice device);
// Whether shaders may have integers of 64 bits.
bool hasInt64(VkPhysicalDevice device);
// Whether shaders may compute with floats of 16 bits.
bool hasFloat16(VkPhysicalDevice device);
// Whether indirect draws may begin at any instance.
bool beginsAtAnyInstance(VkPhysicalDevice device);

// With exactly the features that we use, and what the device has of those that are of help. `statistics`:
// with those of compiled pipelines, which the device must have.
VkDevice createDevice(VkPhysicalDevice physical, std::uint32_t family, bool statistics = false);

}  // namespace diptych
