// SPDX-License-Identifier: MIT
#include "shared/vulkan/pipelines/descriptors.h"

#include "shared/vulkan/device/pipeline_compiler.h"
#include "shared/vulkan/instance/check.h"

#include <map>

namespace diptych {

OwnedDescriptorSetLayout makeSetLayout(VkDevice device, std::span<const VkDescriptorType> types) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < types.size(); ++i)
        bindings.push_back({i, types[i], 1, VK_SHADER_STAGE_ALL, nullptr});
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .pNext = nullptr,
                                               .flags = 0,
                                               .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                               .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    checkResult(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
    return {device, layout};
}

OwnedDescriptorSetLayout makeSetLayout(Device& device, std::span<const VkDescriptorType> types) {
    OwnedDescriptorSetLayout layout = makeSetLayout(device.handle(), types);
    if (PipelineCompiler* const compiler = device.compiler()) compiler->addLayout(layout.get(), types);
    return layout;
}

OwnedPipelineLayout makePipelineLayout(VkDevice device, std::span<const VkDescriptorSetLayout> sets,
                                       const std::optional<VkPushConstantRange>& constants) {
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .pNext = nullptr,
                                          .flags = 0,
                                          .setLayoutCount = static_cast<std::uint32_t>(sets.size()),
                                          .pSetLayouts = sets.data(),
                                          .pushConstantRangeCount = constants ? 1u : 0u,
                                          .pPushConstantRanges = constants ? &*constants : nullptr};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    checkResult(vkCreatePipelineLayout(device, &info, nullptr, &layout), "vkCreatePipelineLayout");
    return {device, layout};
}

OwnedPipelineLayout makePipelineLayout(Device& device, std::span<const VkDescriptorSetLayout> sets,
                                       const std::optional<VkPushConstantRange>& constants) {
    OwnedPipelineLayout layout = makePipelineLayout(device.handle(), sets, constants);
    if (PipelineCompiler* const compiler = device.compiler())
        compiler->addLayout(layout.get(), sets, constants);
    return layout;
}

DescriptorSets::DescriptorSets(Device& device, VkDescriptorSetLayout layout,
                               std::span<const VkDescriptorType> types, std::uint32_t count)
    : device_(device.handle()), types_(types.begin(), types.end()) {
    if (count == 0) return;
    std::map<VkDescriptorType, std::uint32_t> needed;
    for (const VkDescriptorType type : types) needed[type] += count;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, number] : needed) sizes.push_back({type, number});
    const VkDescriptorPoolCreateInfo poolInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                              .pNext = nullptr,
                                              .flags = 0,
                                              .maxSets = count,
                                              .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                              .pPoolSizes = sizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    checkResult(vkCreateDescriptorPool(device_, &poolInfo, nullptr, &pool), "vkCreateDescriptorPool");
    pool_ = OwnedDescriptorPool(device_, pool);
    const std::vector<VkDescriptorSetLayout> layouts(count, layout);
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .pNext = nullptr,
                                           .descriptorPool = pool,
                                           .descriptorSetCount = count,
                                           .pSetLayouts = layouts.data()};
    sets_.resize(count);
    checkResult(vkAllocateDescriptorSets(device_, &info, sets_.data()), "vkAllocateDescriptorSets");
}

void DescriptorSets::write(std::size_t set, std::uint32_t binding, const VkDescriptorBufferInfo* buffer,
                           const VkDescriptorImageInfo* image, const VkBufferView* texels) {
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .pNext = nullptr,
                                     .dstSet = sets_.at(set),
                                     .dstBinding = binding,
                                     .dstArrayElement = 0,
                                     .descriptorCount = 1,
                                     .descriptorType = types_.at(binding),
                                     .pImageInfo = image,
                                     .pBufferInfo = buffer,
                                     .pTexelBufferView = texels};
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void DescriptorSets::buffer(std::size_t set, std::uint32_t binding, VkBuffer buffer, VkDeviceSize offset,
                            VkDeviceSize range) {
    const VkDescriptorBufferInfo info{buffer, offset, range};
    write(set, binding, &info, nullptr, nullptr);
}

void DescriptorSets::image(std::size_t set, std::uint32_t binding, VkImageView view, VkSampler sampler,
                           VkImageLayout layout) {
    const VkDescriptorImageInfo info{sampler, view, layout};
    write(set, binding, nullptr, &info, nullptr);
}

void DescriptorSets::texels(std::size_t set, std::uint32_t binding, VkBufferView view) {
    write(set, binding, nullptr, nullptr, &view);
}

}  // namespace diptych
