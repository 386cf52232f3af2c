// SPDX-License-Identifier: MIT
// Which images of a frame may have the same memory, by when they live. Calls no Vulkan.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// What one image needs, and the first and the last pass that use it.
struct Transient {
    VkMemoryRequirements needs{};
    std::size_t first = 0, last = 0;
};

struct SharedBlock {
    VkMemoryRequirements needs{};      // of all members
    std::vector<std::size_t> members;  // numbers of transients, in the order of their lives
};

// In the order of their sizes each goes into the first block of a fitting memory type where no other lives
// while it does (first fit, decreasing), or into a new one. Every transient is a member of one block.
std::vector<SharedBlock> shareMemory(std::span<const Transient> transients);

}  // namespace diptych
