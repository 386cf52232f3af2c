// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace diptych {

// If the environment restricts the Vulkan loader to certain driver files (VK_DRIVER_FILES, or formerly
// VK_ICD_FILENAMES) and there is no device: the missing file and advice. Empty if neither is set.
std::optional<std::string> driverFilesFault();

// Disables the shader cache of Mesa's drivers if its disk is full. They map its index, a sparse file of
// 1.3 MB, and the first page that cannot be written kills the process with SIGBUS (Mesa 22.3). Call before
// creating the instance.
void avoidCacheOnFullDisk();

}  // namespace diptych
