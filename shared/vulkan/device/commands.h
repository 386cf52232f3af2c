// SPDX-License-Identifier: MIT
// Command buffers, query pools and queue submits.
#pragma once

#include "shared/vulkan/instance/owned.h"

#include <cstdint>
#include <functional>

namespace diptych {

OwnedCommandPool makeCommandPool(VkDevice device, std::uint32_t family);
VkCommandBuffer allocateCommands(VkDevice device, VkCommandPool pool);  // freed with its pool
OwnedFence makeFence(VkDevice device);                                  // unsignaled

// `statistics`: VkQueryPipelineStatisticFlagBits of pipeline statistics. Queries must be reset before use.
OwnedQueryPool makeQueryPool(VkDevice device, VkQueryType type, std::uint32_t count,
                             VkQueryPipelineStatisticFlags statistics = 0);

// Records between begin and end, for one submit.
void recordCommands(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record);
VkResult submitCommands(VkQueue queue, VkCommandBuffer commands, VkFence fence);

}  // namespace diptych
