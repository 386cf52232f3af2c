// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/device/device.h"
#include "shared/vulkan/spirv/binding_table.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace diptych {

OwnedDescriptorSetLayout makeSetLayout(
    Device& device, std::span<const VkDescriptorType> types);  // bindings 0..n-1, all stages
OwnedDescriptorSetLayout makeSetLayout(VkDevice device, std::span<const VkDescriptorType> types);
OwnedPipelineLayout makePipelineLayout(Device& device, std::span<const VkDescriptorSetLayout> sets,
                                       const std::optional<VkPushConstantRange>& constants = {});
OwnedPipelineLayout makePipelineLayout(VkDevice device, std::span<const VkDescriptorSetLayout> sets,
                                       const std::optional<VkPushConstantRange>& constants = {});

// Descriptor sets of one layout from one pool, which they share ownership with.
class DescriptorSets {
public:
    DescriptorSets() = default;
    DescriptorSets(Device& device, VkDescriptorSetLayout layout, std::span<const VkDescriptorType> types,
                   std::uint32_t count);

    VkDescriptorSet operator[](std::size_t i) const { return sets_[i]; }
    std::uint32_t bindings() const { return static_cast<std::uint32_t>(types_.size()); }

    void buffer(std::size_t set, std::uint32_t binding, VkBuffer buffer, VkDeviceSize offset = 0,
                VkDeviceSize range = VK_WHOLE_SIZE);
    void texels(std::size_t set, std::uint32_t binding, VkBufferView view);
    void image(std::size_t set, std::uint32_t binding, VkImageView view, VkSampler sampler,
               VkImageLayout layout);

private:
    void write(std::size_t set, std::uint32_t binding, const VkDescriptorBufferInfo* buffer,
               const VkDescriptorImageInfo* image, const VkBufferView* texels);

    VkDevice device_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorType> types_;
    OwnedDescriptorPool pool_;
    std::vector<VkDescriptorSet> sets_;
};

}  // namespace diptych
