// SPDX-License-Identifier: MIT
// Command buffers, the queries that they write, and their way to the queue.
#pragma once

#include "shared/vulkan/owned.h"

#include <cstdint>
#include <functional>

namespace diptych {

OwnedCommandPool makeCommandPool(VkDevice device, std::uint32_t family);
VkCommandBuffer allocateCommands(VkDevice device, VkCommandPool pool);  // dies with its pool
OwnedFence makeFence(VkDevice device);                                  // unsignaled

// `statistics`: of pipeline statistics, VkQueryPipelineStatisticFlagBits. Its queries must be reset before
// they are used.
OwnedQueryPool makeQueryPool(VkDevice device, VkQueryType type, std::uint32_t count,
                             VkQueryPipelineStatisticFlags statistics = 0);

// Between begin and end, to be submitted once.
void recordCommands(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record);
VkResult submitCommands(VkQueue queue, VkCommandBuffer commands, VkFence fence);

}  // namespace diptych
