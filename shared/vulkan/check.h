// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>

namespace diptych {

// Throws std::runtime_error "Vulkan: WHAT: the reason; what helps" on an error code.
void checkResult(VkResult result, const char* what);
std::string nameOf(VkResult result);

}  // namespace diptych
