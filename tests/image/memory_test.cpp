// SPDX-License-Identifier: MIT
// Fallbacks if device memory is short: the next memory type, an exact size, and finally a message that
// names the request that was too large. A full heap is simulated: lavapipe's heap never is full.
#include "shared/vulkan/device/memory.h"
#include "tests/image/scenes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr VkMemoryPropertyFlags localMemory = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                visibleMemory = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                cachedMemory = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
constexpr VkDeviceSize mebibyte = VkDeviceSize{1} << 20;

// As on many discrete GPUs: 0 device-local, 1 host-visible, 2 host-visible and cached, 3 device-local and
// host-visible.
VkPhysicalDeviceMemoryProperties discreteMemory() {
    VkPhysicalDeviceMemoryProperties properties{};
    properties.memoryTypeCount = 4;
    properties.memoryTypes[0] = {localMemory, 0};
    properties.memoryTypes[1] = {visibleMemory, 1};
    properties.memoryTypes[2] = {visibleMemory | cachedMemory, 1};
    properties.memoryTypes[3] = {localMemory | visibleMemory, 2};
    properties.memoryHeapCount = 3;
    return properties;
}

using Types = std::vector<std::uint32_t>;

TEST(MemoryTypes, TheBestComeFirstAndAllThatServeFollow) {
    const VkPhysicalDeviceMemoryProperties discrete = discreteMemory();
    EXPECT_EQ(memoryTypes(discrete, 0xf, MemoryUse::device), (Types{0, 3, 1, 2}));
    EXPECT_EQ(memoryTypes(discrete, 0xf, MemoryUse::upload), (Types{1, 2, 3}));
    EXPECT_EQ(memoryTypes(discrete, 0xf, MemoryUse::readback), (Types{2, 1, 3}));
    EXPECT_EQ(memoryTypes(discrete, 0x6, MemoryUse::device), (Types{1, 2}));
    EXPECT_EQ(memoryTypes(discrete, 0x1, MemoryUse::readback), Types{});
    VkPhysicalDeviceMemoryProperties lazy = discrete;
    lazy.memoryTypes[0].propertyFlags |= VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
    EXPECT_EQ(memoryTypes(lazy, 0xf, MemoryUse::device), (Types{3, 1, 2}));
}

// Simulated memory of those types; each heap provides up to the given number of bytes. All allocations
// really come from device()'s first host-visible type.
class PlayedMemory {
public:
    explicit PlayedMemory(std::vector<VkDeviceSize> room, std::vector<VkDeviceSize> says = {})
        : room_(std::move(room)),
          memory_(device().handle(), discreteMemory(),
                  {.allocate = [this](const VkMemoryAllocateInfo& info,
                                      VkDeviceMemory* memory) { return allocate(info, memory); },
                   .left = [says = std::move(says)] { return says; }}) {}

    Allocation take(VkDeviceSize size, MemoryUse use = MemoryUse::device) {
        return memory_.allocate({size, 16, 0xf}, use, true, "the image lit");
    }
    const Types& asked() const { return asked_; }
    Memory& memory() { return memory_; }

private:
    VkResult allocate(VkMemoryAllocateInfo info, VkDeviceMemory* memory) {
        const VkPhysicalDeviceMemoryProperties discrete = discreteMemory();
        asked_.push_back(info.memoryTypeIndex);
        VkDeviceSize& room = room_.at(discrete.memoryTypes[info.memoryTypeIndex].heapIndex);
        if (info.allocationSize > room) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        room -= info.allocationSize;
        VkPhysicalDeviceMemoryProperties real;
        vkGetPhysicalDeviceMemoryProperties(device().support().handle(), &real);
        info.memoryTypeIndex = memoryTypes(real, ~0u, MemoryUse::upload).at(0);
        return vkAllocateMemory(device().handle(), &info, nullptr, memory);
    }

    std::vector<VkDeviceSize> room_;
    Types asked_;
    Memory memory_;
};

TEST(MemoryTypes, TheNextTypeIsTakenWhereOneIsFull) {
    PlayedMemory played({100 * mebibyte, 300 * mebibyte, 0});
    const Allocation first = played.take(80 * mebibyte), second = played.take(80 * mebibyte);
    // The second allocation fits in neither device-local memory nor the host-visible part of it.
    EXPECT_EQ(played.asked(), (Types{0, 0, 3, 1}));
    EXPECT_EQ(first.mapped(), nullptr);
    EXPECT_NE(second.mapped(), nullptr);
    EXPECT_EQ(played.memory().allocated(), 160 * mebibyte);
}

// A block of a less suitable type is not used while the best type has capacity.
TEST(MemoryTypes, EachUseHasItsBestTypeThoughAnotherHasABlock) {
    PlayedMemory played({1000 * mebibyte, 1000 * mebibyte, 1000 * mebibyte});
    const Allocation upload = played.take(mebibyte, MemoryUse::upload),
                     readback = played.take(mebibyte, MemoryUse::readback), own = played.take(mebibyte),
                     more = played.take(mebibyte);
    EXPECT_EQ(played.asked(), (Types{1, 2, 0}));
}

// Only a full heap is skipped.
TEST(MemoryTypes, OtherErrorsAreNotTakenForAFullHeap) {
    Memory lost(
        device().handle(), discreteMemory(),
        {.allocate = [](const VkMemoryAllocateInfo&, VkDeviceMemory*) { return VK_ERROR_DEVICE_LOST; },
         .left = [] { return std::vector<VkDeviceSize>{}; }});
    try {
        lost.allocate({mebibyte, 16, 0xf}, MemoryUse::device, true, "the image lit");
        FAIL() << "the device is lost";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("the device was lost"), std::string::npos) << error.what();
    }
}

TEST(MemoryTypes, ABlockIsAsSmallAsItMustBe) {
    PlayedMemory played({40 * mebibyte, 0, 0});
    const Allocation small = played.take(30 * mebibyte);
    EXPECT_EQ(played.memory().allocated(), 30 * mebibyte);
}

// Small for little, and what is freed goes back but for one block.
TEST(MemoryTypes, BlocksGrowAndAreFreed) {
    PlayedMemory played({1000 * mebibyte, 0, 0});
    {
        const Allocation small = played.take(1000);
        EXPECT_EQ(played.memory().allocated(), mebibyte);
        const Allocation large = played.take(300 * mebibyte);
        std::vector<Allocation> many;
        for (int i = 0; i < 64; ++i) many.push_back(played.take(mebibyte));
        EXPECT_LE(played.memory().allocated(), (300 + 64 + 16) * mebibyte);
        EXPECT_LE(played.memory().blocks(), 10u);
        many.clear();
        EXPECT_EQ(played.memory().blocks(), 2u) << "those of what is left";
    }
    EXPECT_LE(played.memory().allocated(), 16 * mebibyte);
    EXPECT_EQ(played.memory().blocks(), 1u);
}

// A heap that reports little memory left is tried last, although it might provide more than it reports.
TEST(MemoryTypes, HeapsSayWhatTheyHaveLeft) {
    PlayedMemory played({1000 * mebibyte, 1000 * mebibyte, 1000 * mebibyte},
                        {mebibyte, 1000 * mebibyte, mebibyte});
    const Allocation other = played.take(80 * mebibyte);
    EXPECT_EQ(played.asked(), Types{1});
    PlayedMemory wrong({1000 * mebibyte, 0, 0}, {mebibyte, mebibyte, mebibyte});
    const Allocation same = wrong.take(80 * mebibyte);
    EXPECT_EQ(wrong.asked(), Types{0});
}

TEST(MemoryTypes, WhatWasTooLargeIsNamed) {
    PlayedMemory played({100 * mebibyte, 0, 0}, {20 * mebibyte, 0, 0});
    const Allocation first = played.take(80 * mebibyte);
    try {
        played.take(300 * mebibyte);
        FAIL() << "there is no such memory";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "Vulkan: no memory for the image lit (300.0 MiB); 80.0 MiB are in use, 20.0 MiB are left "
                  "in its heap; try a smaller --size");
    }
}

}  // namespace
}  // namespace diptych::tests
