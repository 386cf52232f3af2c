// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

namespace diptych {

// On an error code, throws std::runtime_error "Vulkan: WHAT: reason; advice".
void checkResult(VkResult result, std::string_view what);
std::string nameOf(VkResult result);

}  // namespace diptych
