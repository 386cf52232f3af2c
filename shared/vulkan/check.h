// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

namespace diptych {

// Throws std::runtime_error "Vulkan: WHAT: the reason; what helps" on an error code.
void checkResult(VkResult result, std::string_view what);
std::string nameOf(VkResult result);

}  // namespace diptych
