// SPDX-License-Identifier: MIT
#include "shared/vulkan/device/memory.h"

#include "shared/vulkan/instance/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace diptych {

namespace {
// The first block of a kind, and the largest that is shared. Each is as large as all before it, and holds
// four of what it is for. Larger ones would keep much for little.
constexpr VkDeviceSize firstBlock = VkDeviceSize{1} << 20, largestBlock = VkDeviceSize{16} << 20;

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}
}  // namespace

struct Memory::Block {
    OwnedMemory memory;
    VkDeviceSize size = 0;
    std::uint32_t type = 0;
    bool image = false, shared = false;  // else of one allocation
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

std::vector<std::uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                       std::uint32_t allowed, MemoryUse use) {
    constexpr VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                    cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const VkMemoryPropertyFlags must = use == MemoryUse::device ? 0 : visible,
                                wanted = use == MemoryUse::device     ? local
                                         : use == MemoryUse::readback ? visible | cached
                                                                      : visible;
    std::vector<std::uint32_t> types;
    // Other types have special rules: lazily allocated, protected, vendor-specific.
    constexpr VkMemoryPropertyFlags plain = local | visible | cached;
    for (const VkMemoryPropertyFlags flags : {wanted, must})
        for (std::uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
            const VkMemoryPropertyFlags has = properties.memoryTypes[type].propertyFlags;
            if ((allowed >> type & 1) != 0 && (has & ~plain) == 0 && (has & flags) == flags &&
                std::ranges::find(types, type) == types.end())
                types.push_back(type);
        }
    return types;
}

Memory::Memory(const DeviceSupport& support, VkDevice device)
    : device_(device), properties_(support.memory()) {
    calls_.allocate = [device](const VkMemoryAllocateInfo& info, VkDeviceMemory* memory) {
        return vkAllocateMemory(device, &info, nullptr, memory);
    };
    calls_.left = [&support] { return support.bytesLeft(); };
}

Memory::Memory(VkDevice device, const VkPhysicalDeviceMemoryProperties& properties, MemoryCalls calls)
    : device_(device), properties_(properties), calls_(std::move(calls)) {}

Memory::~Memory() = default;

Allocation Memory::allocate(const VkMemoryRequirements& needs, MemoryUse use, bool image,
                            const std::string& what) {
    const std::vector<std::uint32_t> types = memoryTypes(properties_, needs.memoryTypeBits, use);
    if (types.empty())
        throw std::runtime_error(
            fmt::format("Vulkan: the device has no memory type for {}; choose another with --device", what));
    const std::vector<VkDeviceSize> left = calls_.left();
    const auto leftOf = [&](std::uint32_t type) {
        return heapOf(type) < left.size() ? left[heapOf(type)] : ~VkDeviceSize{0};
    };
    // A heap's reported budget is an estimate: heaps that report too little are still tried last.
    for (const bool room : {true, false})
        for (const std::uint32_t type : types) {
            for (std::size_t i = 0; room && i < blocks_.size(); ++i)
                if (blocks_[i] && blocks_[i]->type == type && blocks_[i]->image == image)
                    if (Allocation found = take(i, needs); found.size() > 0) return found;
            if ((leftOf(type) >= needs.size) != room) continue;
            const VkDeviceSize grown = std::clamp(std::max(sharedBytes(type, image), 4 * needs.size),
                                                  firstBlock, largestBlock),
                               whole = leftOf(type) >= grown ? grown : needs.size;
            if (const auto block = addBlock(type, std::max(whole, needs.size), needs.size, image))
                return take(*block, needs);
        }
    std::string budget;
    if (!left.empty())
        budget = fmt::format(", {:.1f} MiB are left in its heap",
                             static_cast<double>(left.at(heapOf(types.front()))) / 1048576.0);
    throw std::runtime_error(fmt::format(
        "Vulkan: no memory for {} ({:.1f} MiB); {:.1f} MiB are in use{}; try a smaller --size", what,
        static_cast<double>(needs.size) / 1048576.0, static_cast<double>(allocated()) / 1048576.0, budget));
}

std::optional<std::size_t> Memory::addBlock(std::uint32_t type, VkDeviceSize max, VkDeviceSize min,
                                            bool image) {
    // Shaders may use the address of any buffer.
    const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                          .pNext = nullptr,
                                          .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT,
                                          .deviceMask = 0};
    for (VkDeviceSize bytes = max;; bytes = min) {
        const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                        .pNext = image ? nullptr : &flags,
                                        .allocationSize = bytes,
                                        .memoryTypeIndex = type};
        VkDeviceMemory memory = VK_NULL_HANDLE;
        const VkResult result = calls_.allocate(info, &memory);
        if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) {
            if (bytes == min) return std::nullopt;
            continue;
        }
        checkResult(result, "vkAllocateMemory");
        auto block = std::make_unique<Block>();
        block->memory = OwnedMemory(device_, memory);
        block->size = bytes;
        block->type = type;
        block->image = image;
        block->shared = bytes > min;
        block->free[0] = bytes;
        if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0)
            checkResult(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &block->mapped), "vkMapMemory");
        blocks_.push_back(std::move(block));
        return blocks_.size() - 1;
    }
}

// Empty if the block has no suitable free range.
Allocation Memory::take(std::size_t index, const VkMemoryRequirements& needs) {
    Block& block = *blocks_[index];
    Allocation result;
    const auto offset = block.take(needs.size, needs.alignment);
    if (!offset) return result;
    result.owner_ = this;
    result.block_ = index;
    result.memory_ = block.memory;
    result.offset_ = *offset;
    result.size_ = needs.size;
    if (block.mapped != nullptr) result.mapped_ = static_cast<char*>(block.mapped) + *offset;
    return result;
}

void Memory::release(std::size_t index, VkDeviceSize offset, VkDeviceSize size) {
    Block& block = *blocks_[index];
    block.give(offset, size);
    const bool empty = block.free.size() == 1 && block.free.begin()->second == block.size;
    // The last one waits for the next allocation. The indices of other blocks must not change.
    if (empty && (!block.shared || sharedBytes(block.type, block.image) > block.size)) blocks_[index].reset();
}

VkDeviceSize Memory::sharedBytes(std::uint32_t type, bool image) const {
    VkDeviceSize bytes = 0;
    for (const auto& block : blocks_)
        if (block && block->shared && block->type == type && block->image == image) bytes += block->size;
    return bytes;
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
