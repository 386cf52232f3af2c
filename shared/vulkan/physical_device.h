// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/device_info.h"
#include "shared/vulkan/device_support.h"

#include <cstddef>
#include <string>
#include <vector>

namespace diptych {

// What a device is and what it can and cannot do for us: features and limits, asked, not versions.
DeviceInfo describe(const DeviceSupport& device, int index);

// An index into `infos`; "" takes the best usable one, discrete before integrated before virtual before
// cpu. Throws std::runtime_error naming --device and what there is, or the feature that is missing.
std::size_t chooseDevice(const std::vector<DeviceInfo>& infos, const std::string& choice);

// The one of this index, or the first with this in its name.
std::optional<std::size_t> findDevice(const std::vector<DeviceInfo>& infos, const std::string& choice);
std::string listOf(const std::vector<DeviceInfo>& infos);  // "0: NAME, 1: ..."; "none"

// The fact that a driver without hardware lacks, which compiles all the same (DeviceCompiler).
inline constexpr const char* memoryFact = "memory";

// With exactly the features of DEVICE_FEATURES that are there, and the extensions. `statistics`: with those
// of compiled pipelines, which the device must have.
VkDevice createDevice(const DeviceSupport& device, bool statistics = false);

}  // namespace diptych
