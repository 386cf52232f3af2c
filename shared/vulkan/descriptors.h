// SPDX-License-Identifier: MIT
#pragma once

#include "shared/vulkan/device.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace diptych {

// The descriptor types by their names in the binding tables of shared/contract.
namespace binding_kind {
inline constexpr VkDescriptorType uniform_buffer = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                  storage_buffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                  texel_buffer = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                  image = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}  // namespace binding_kind

// One row of a binding table.
struct BindingRow {
    std::uint32_t number;
    const char* name;
    VkDescriptorType type;
};
#define DIPTYCH_BINDING_ROW(number, name, kind, what) \
    ::diptych::BindingRow{number, #name, ::diptych::binding_kind::kind},

// The types of a table, indexed by binding. Does not compile where a number is not the row's place.
template <std::size_t n>
consteval std::array<VkDescriptorType, n> bindingTypes(const BindingRow (&rows)[n]) {
    std::array<VkDescriptorType, n> types{};
    for (std::size_t i = 0; i < n; ++i) {
        if (rows[i].number != i) throw std::logic_error("a binding table skips or repeats a number");
        types[i] = rows[i].type;
    }
    return types;
}

OwnedDescriptorSetLayout makeSetLayout(
    Device& device, std::span<const VkDescriptorType> types);  // bindings 0..n-1, all stages

// Sets of one layout from one pool; they live as long as it.
class DescriptorSets {
public:
    DescriptorSets() = default;
    DescriptorSets(Device& device, VkDescriptorSetLayout layout, std::span<const VkDescriptorType> types,
                   std::uint32_t count);

    VkDescriptorSet operator[](std::size_t i) const { return sets_[i]; }

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
