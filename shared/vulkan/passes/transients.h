// SPDX-License-Identifier: MIT
// Memory sharing of a frame's images by lifetime. Makes no Vulkan calls.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <vector>

namespace diptych {

// Requirements of one image, and the first and last pass that use it.
struct Transient {
    VkMemoryRequirements needs{};
    std::size_t first = 0, last = 0;
};

struct SharedBlock {
    VkMemoryRequirements needs{};      // of all members together
    std::vector<std::size_t> members;  // indices of transients, in order of lifetime
};

// First fit, decreasing: in order of size, each transient goes into the first block with a suitable memory
// type and no overlapping lifetime, or into a new block. Every transient is in exactly one block.
std::vector<SharedBlock> shareMemory(std::span<const Transient> transients);

}  // namespace diptych
