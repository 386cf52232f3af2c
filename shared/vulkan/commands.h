// SPDX-License-Identifier: MIT
// Command buffers and their way to the queue.
#pragma once

#include "shared/vulkan/owned.h"

#include <cstdint>
#include <functional>

namespace diptych {

OwnedCommandPool makeCommandPool(VkDevice device, std::uint32_t family);
VkCommandBuffer allocateCommands(VkDevice device, VkCommandPool pool);  // dies with its pool
OwnedFence makeFence(VkDevice device);                                  // unsignaled

// Between begin and end, to be submitted once.
void recordCommands(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record);
VkResult submitCommands(VkQueue queue, VkCommandBuffer commands, VkFence fence);

}  // namespace diptych
