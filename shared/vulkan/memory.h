// SPDX-License-Identifier: MIT
// Device memory, sub-allocated: a GPU allows a few thousand allocations, a scene has more resources.
#pragma once

#include "shared/vulkan/device_support.h"
#include "shared/vulkan/owned.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
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

// The memory types out of `allowed` (a bit each) that a use may have, best first: of the device, its own and
// then any; to be read back, cached and then any that the host sees.
std::vector<std::uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                       std::uint32_t allowed, MemoryUse use);

// How memory is asked for; tests have their own.
struct MemoryCalls {
    std::function<VkResult(const VkMemoryAllocateInfo&, VkDeviceMemory*)> allocate;
    // Bytes that are left in each heap, from VK_EXT_memory_budget; empty: the device does not say.
    std::function<std::vector<VkDeviceSize>()> left;
};

class Memory {
public:
    Memory(const DeviceSupport& support, VkDevice device);  // `support` outlives it
    Memory(VkDevice device, const VkPhysicalDeviceMemoryProperties& properties, MemoryCalls calls);
    ~Memory();

    // First fit in a block of a memory type that suits, the best that has room: heaps that say that they have
    // none are asked last. Images and buffers live in blocks of their own kind, so that
    // bufferImageGranularity never matters. Throws std::runtime_error that says what was too large, by the
    // name `what`, where all are full.
    Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool image,
                        const std::string& what);

    VkDeviceSize allocated() const;  // bytes of all blocks
    std::size_t blocks() const;

private:
    friend class Allocation;
    struct Block;
    Allocation take(std::size_t block, const VkMemoryRequirements& needs);
    void release(std::size_t block, VkDeviceSize offset, VkDeviceSize size);
    // The index of a new block of `most` bytes, or where they are not there of `least`; nothing where the
    // type's heap is full.
    std::optional<std::size_t> addBlock(std::uint32_t type, VkDeviceSize most, VkDeviceSize least,
                                        bool image);
    std::uint32_t heapOf(std::uint32_t type) const { return properties_.memoryTypes[type].heapIndex; }

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    MemoryCalls calls_;
    std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace diptych
