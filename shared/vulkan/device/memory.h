// SPDX-License-Identifier: MIT
// Sub-allocation of device memory: GPUs allow a few thousand allocations, and a scene has more resources.
#pragma once

#include "shared/vulkan/instance/device_support.h"
#include "shared/vulkan/instance/owned.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

class Memory;

// A range of a memory block, returned to it on destruction. Move-only.
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
    void* mapped() const { return mapped_; }  // nullptr if the CPU cannot access it

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

// Memory types among `allowed` (one bit each) for a use, best first. device: device-local, then any;
// readback: host-cached, then any host-visible.
std::vector<std::uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                       std::uint32_t allowed, MemoryUse use);

// Allocation functions; tests provide their own.
struct MemoryCalls {
    std::function<VkResult(const VkMemoryAllocateInfo&, VkDeviceMemory*)> allocate;
    // Free bytes of each heap, from VK_EXT_memory_budget; empty if not reported.
    std::function<std::vector<VkDeviceSize>()> left;
};

class Memory {
public:
    Memory(const DeviceSupport& support, VkDevice device);  // `support` must outlive it
    Memory(VkDevice device, const VkPhysicalDeviceMemoryProperties& properties, MemoryCalls calls);
    ~Memory();

    // First fit in a block of the best suitable memory type with free space; heaps that report too little
    // come last. Images and buffers use separate blocks, so bufferImageGranularity does not apply. Throws
    // std::runtime_error naming `what` and its size if all heaps are full.
    Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool image,
                        const std::string& what);

    VkDeviceSize allocated() const;  // total size of all blocks
    std::size_t blocks() const;

private:
    friend class Allocation;
    struct Block;
    Allocation take(std::size_t block, const VkMemoryRequirements& needs);
    void release(std::size_t block, VkDeviceSize offset, VkDeviceSize size);
    VkDeviceSize sharedBytes(std::uint32_t type, bool image) const;
    // Index of a new block of `max` bytes, or else of `min`; nothing if the type's heap is full.
    std::optional<std::size_t> addBlock(std::uint32_t type, VkDeviceSize max, VkDeviceSize min, bool image);
    std::uint32_t heapOf(std::uint32_t type) const { return properties_.memoryTypes[type].heapIndex; }

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    MemoryCalls calls_;
    std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace diptych
