// SPDX-License-Identifier: MIT
// How a pass uses an image or a buffer: stages, accesses and layout of synchronization2. Barriers are
// derived from these alone.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace diptych {

struct Access {
    VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  // for images; buffers have none

    bool operator==(const Access&) const = default;
};

// All accesses that write memory; the others read.
constexpr VkAccessFlags2 writeAccesses =
    VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;

constexpr bool writes(const Access& access) {
    return (access.access & writeAccesses) != 0;
}

// Shader stages for the accesses below.
constexpr VkPipelineStageFlags2 inVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                                inFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                inCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

namespace access {

// Images.
constexpr VkPipelineStageFlags2 depthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr Access colorAttachment{
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
constexpr Access depthAttachment{
    depthStages,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
// Tested without writes; the same pass may sample it.
constexpr Access depthTest{depthStages, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                           VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL};
// Target of a depth resolve: written in the colour output stage (Vulkan 1.3, 8.5.1) despite its depth
// format.
constexpr Access resolvedDepth{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                               VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                               VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
constexpr Access sampledColor(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
}
constexpr Access sampledDepth(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL};
}
constexpr Access storageImageRead(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL};
}
constexpr Access storageImageWrite(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL};
}
constexpr Access copiedFromImage{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                 VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
constexpr Access copiedToImage{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

// Buffers.
constexpr Access storageRead(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
}
constexpr Access storageWrite(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
}
constexpr Access uniformRead(VkPipelineStageFlags2 stages) {
    return {stages, VK_ACCESS_2_UNIFORM_READ_BIT};
}
constexpr Access texelRead(VkPipelineStageFlags2 stages) {  // of a uniform texel buffer
    return {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
}
constexpr Access indirectRead{VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
constexpr Access vertexRead{VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
                            VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT};
constexpr Access indexRead{VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT};
constexpr Access transferRead{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr Access transferWrite{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Access hostRead{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};

}  // namespace access

}  // namespace diptych
