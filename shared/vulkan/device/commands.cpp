// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/commands.h"

#include "shared/vulkan/instance/check.h"

namespace diptych {

OwnedCommandPool makeCommandPool(VkDevice device, std::uint32_t family) {
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .pNext = nullptr,
                                       .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                       .queueFamilyIndex = family};
    VkCommandPool pool = VK_NULL_HANDLE;
    checkResult(vkCreateCommandPool(device, &info, nullptr, &pool), "vkCreateCommandPool");
    return {device, pool};
}

VkCommandBuffer allocateCommands(VkDevice device, VkCommandPool pool) {
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .pNext = nullptr,
                                           .commandPool = pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    checkResult(vkAllocateCommandBuffers(device, &info, &commands), "vkAllocateCommandBuffers");
    return commands;
}

OwnedFence makeFence(VkDevice device) {
    const VkFenceCreateInfo info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .pNext = nullptr, .flags = 0};
    VkFence fence = VK_NULL_HANDLE;
    checkResult(vkCreateFence(device, &info, nullptr, &fence), "vkCreateFence");
    return {device, fence};
}

OwnedQueryPool makeQueryPool(VkDevice device, VkQueryType type, std::uint32_t count,
                             VkQueryPipelineStatisticFlags statistics) {
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .pNext = nullptr,
                                     .flags = 0,
                                     .queryType = type,
                                     .queryCount = count,
                                     .pipelineStatistics = statistics};
    VkQueryPool pool = VK_NULL_HANDLE;
    checkResult(vkCreateQueryPool(device, &info, nullptr, &pool), "vkCreateQueryPool");
    return {device, pool};
}

void recordCommands(VkCommandBuffer commands, const std::function<void(VkCommandBuffer)>& record) {
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .pNext = nullptr,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                         .pInheritanceInfo = nullptr};
    checkResult(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    record(commands);
    checkResult(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
}

VkResult submitCommands(VkQueue queue, VkCommandBuffer commands, VkFence fence) {
    const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                           .pNext = nullptr,
                                           .commandBuffer = commands,
                                           .deviceMask = 0};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .pNext = nullptr,
                               .flags = 0,
                               .waitSemaphoreInfoCount = 0,
                               .pWaitSemaphoreInfos = nullptr,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &buffer,
                               .signalSemaphoreInfoCount = 0,
                               .pSignalSemaphoreInfos = nullptr};
    return vkQueueSubmit2(queue, 1, &submit, fence);
}

}  // namespace diptych
