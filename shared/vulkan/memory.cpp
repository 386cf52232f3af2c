// SPDX-License-Identifier: MIT
#include "shared/vulkan/memory.h"

#include "shared/vulkan/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace diptych {

namespace {
constexpr VkDeviceSize blockSize = VkDeviceSize{64} << 20;  // larger requests get a block of their own

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}
}  // namespace

struct Memory::Block {
    OwnedMemory memory;
    VkDeviceSize size = 0;
    std::uint32_t type = 0;
    bool image = false;
    void* mapped = nullptr;
    std::map<VkDeviceSize, VkDeviceSize> free;  // offset -> size, never adjacent

    std::optional<VkDeviceSize> take(VkDeviceSize bytes, VkDeviceSize alignment) {
        for (auto range = free.begin(); range != free.end(); ++range) {
            const VkDeviceSize begin = range->first, end = begin + range->second;
            const VkDeviceSize offset = alignUp(begin, alignment);
            if (offset + bytes > end) continue;
            free.erase(range);
            if (offset > begin) free[begin] = offset - begin;
            if (offset + bytes < end) free[offset + bytes] = end - offset - bytes;
            return offset;
        }
        return std::nullopt;
    }

    void give(VkDeviceSize offset, VkDeviceSize bytes) {
        auto next = free.lower_bound(offset);
        if (next != free.end() && next->first == offset + bytes) {
            bytes += next->second;
            next = free.erase(next);
        }
        if (next != free.begin()) {
            const auto previous = std::prev(next);
            if (previous->first + previous->second == offset) {
                previous->second += bytes;
                return;
            }
        }
        free[offset] = bytes;
    }
};

Allocation::~Allocation() {
    if (owner_ != nullptr) owner_->release(block_, offset_, size_);
}

void Allocation::swap(Allocation& other) noexcept {
    std::swap(owner_, other.owner_);
    std::swap(block_, other.block_);
    std::swap(memory_, other.memory_);
    std::swap(offset_, other.offset_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
}

Memory::Memory(VkPhysicalDevice physical, VkDevice device) : device_(device) {
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

Memory::~Memory() = default;

std::uint32_t Memory::memoryType(std::uint32_t allowed, MemoryUse use) const {
    constexpr VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                    cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const VkMemoryPropertyFlags wanted = use == MemoryUse::device   ? local
                                         : use == MemoryUse::upload ? visible
                                                                    : visible | cached;
    for (const VkMemoryPropertyFlags flags : {wanted, wanted & ~cached})
        for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type)
            if ((allowed >> type & 1) != 0 && (properties_.memoryTypes[type].propertyFlags & flags) == flags)
                return type;
    throw std::runtime_error(
        "Vulkan: the device has no memory type for a resource; choose another with --device");
}

Allocation Memory::allocate(const VkMemoryRequirements& needs, MemoryUse use, bool image) {
    const std::uint32_t type = memoryType(needs.memoryTypeBits, use);
    Allocation result;
    for (std::size_t i = 0; i <= blocks_.size(); ++i) {
        if (i == blocks_.size()) {
            auto block = std::make_unique<Block>();
            block->size = std::max(blockSize, needs.size);
            block->type = type;
            block->image = image;
            const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                            .pNext = nullptr,
                                            .allocationSize = block->size,
                                            .memoryTypeIndex = type};
            VkDeviceMemory memory = VK_NULL_HANDLE;
            if (vkAllocateMemory(device_, &info, nullptr, &memory) != VK_SUCCESS)
                throw std::runtime_error(fmt::format(
                    "Vulkan: the device has no {:.1f} MiB more ({:.1f} MiB in use); try a smaller --size",
                    static_cast<double>(block->size) / 1048576.0,
                    static_cast<double>(allocated()) / 1048576.0));
            block->memory = OwnedMemory(device_, memory);
            block->free[0] = block->size;
            if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0)
                checkResult(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &block->mapped), "vkMapMemory");
            blocks_.push_back(std::move(block));
        }
        Block* block = blocks_[i].get();
        if (block == nullptr || block->type != type || block->image != image) continue;
        if (const auto offset = block->take(needs.size, needs.alignment)) {
            result.owner_ = this;
            result.block_ = i;
            result.memory_ = block->memory;
            result.offset_ = *offset;
            result.size_ = needs.size;
            if (block->mapped != nullptr) result.mapped_ = static_cast<char*>(block->mapped) + *offset;
            return result;
        }
    }
    throw std::logic_error("a new memory block cannot hold what it was made for");
}

void Memory::release(std::size_t index, VkDeviceSize offset, VkDeviceSize size) {
    Block& block = *blocks_[index];
    block.give(offset, size);
    // A large block is of little use to other allocations, so it is freed. The indices of the others must not
    // change.
    if (block.size > blockSize && block.free.size() == 1 && block.free.begin()->second == block.size)
        blocks_[index].reset();
}

VkDeviceSize Memory::allocated() const {
    VkDeviceSize bytes = 0;
    for (const auto& block : blocks_)
        if (block) bytes += block->size;
    return bytes;
}

std::size_t Memory::blocks() const {
    return static_cast<std::size_t>(
        std::count_if(blocks_.begin(), blocks_.end(), [](const auto& b) { return b != nullptr; }));
}

}  // namespace diptych
