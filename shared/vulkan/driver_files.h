// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace diptych {

// Where the environment narrows the Vulkan loader down to certain driver files (VK_DRIVER_FILES, or
// VK_ICD_FILENAMES as it was called before), and there is no device: which of them is missing, and what to
// do. Empty where neither is set.
std::optional<std::string> driverFilesFault();

// Has Mesa's drivers do without their shader cache where its disk is full: they map its index, a hole of
// 1.3 MB, and the first page that finds no room ends the process by SIGBUS (22.3). Before the instance is
// made.
void avoidCacheOnFullDisk();

}  // namespace diptych
