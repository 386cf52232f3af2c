// SPDX-License-Identifier: MIT
// Binding tables of shared/contract as Vulkan descriptor types.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace diptych {

// Descriptor types by their names in those tables.
namespace binding_kind {
inline constexpr VkDescriptorType uniform_buffer = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                  storage_buffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                  texel_buffer = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                  image = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                  fetched_image = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                  storage_image = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
}  // namespace binding_kind

struct BindingRow {
    std::uint32_t number;
    const char* name;
    VkDescriptorType type;
};
#define DIPTYCH_BINDING_ROW(number, name, kind, what) \
    ::diptych::BindingRow{number, #name, ::diptych::binding_kind::kind},

// Descriptor types indexed by binding. Fails to compile if a number is not its row's index.
template <std::size_t n>
consteval std::array<VkDescriptorType, n> bindingTypes(const BindingRow (&rows)[n]) {
    std::array<VkDescriptorType, n> types{};
    for (std::size_t i = 0; i < n; ++i) {
        if (rows[i].number != i) throw std::logic_error("a binding table skips or repeats a number");
        types[i] = rows[i].type;
    }
    return types;
}

}  // namespace diptych
