// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/instance/device_info.h"
#include "shared/vulkan/instance/device_support.h"

#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// Properties and capabilities of a device: features and limits are queried, not derived from versions.
DeviceInfo describe(const DeviceSupport& device, int index);

// Index into `infos`. `choice` "": the best usable device, in the order discrete, integrated, virtual,
// cpu. Throws std::runtime_error naming --device and the available devices, or the missing feature.
std::size_t chooseDevice(const std::vector<DeviceInfo>& infos, const std::string& choice);

// Device with this index, or the first whose name contains it.
std::optional<std::size_t> findDevice(const std::vector<DeviceInfo>& infos, const std::string& choice);
std::string listOf(const std::vector<DeviceInfo>& infos);  // "0: NAME, 1: ..."; "none"

// Property that drivers without hardware lack; DeviceCompiler does not need it.
inline constexpr const char* memoryProperty = "memory";

// Enables exactly the supported features of DEVICE_FEATURES, and the extensions. `statistics`: also those
// of compiled pipelines, which the device must support.
VkDevice createDevice(const DeviceSupport& device, bool statistics = false);

}  // namespace diptych
