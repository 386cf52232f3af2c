// SPDX-License-Identifier: MIT
// Device memory, sub-allocated: a GPU allows a few thousand allocations, a scene has more resources.
#pragma once

#include "shared/vulkan/owned.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace diptych {

class Memory;

// A range of a block; returns to its block when it dies. Move-only.
class Allocation {
public:
    Allocation() = default;
    Allocation(Allocation&& other) noexcept { swap(other); }
    Allocation& operator=(Allocation&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Allocation();

    VkDeviceMemory memory() const { return memory_; }
    VkDeviceSize offset() const { return offset_; }
    VkDeviceSize size() const { return size_; }
    void* mapped() const { return mapped_; }  // nullptr where the host cannot see it

private:
    friend class Memory;
    void swap(Allocation& other) noexcept;

    Memory* owner_ = nullptr;
    std::size_t block_ = 0;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkDeviceSize offset_ = 0, size_ = 0;
    void* mapped_ = nullptr;
};

enum class MemoryUse { device, upload, readback };

class Memory {
public:
    Memory(VkPhysicalDevice physical, VkDevice device);
    ~Memory();

    // First fit in a block of the first memory type that suits; images and buffers live in blocks of
    // their own kind, so that bufferImageGranularity never matters. Throws std::runtime_error with the
    // size where the device has no more.
    Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool image);

    VkDeviceSize allocated() const;  // bytes of all blocks
    std::size_t blocks() const;

private:
    friend class Allocation;
    struct Block;
    void release(std::size_t block, VkDeviceSize offset, VkDeviceSize size);
    std::uint32_t memoryType(std::uint32_t allowed, MemoryUse use) const;

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace diptych
