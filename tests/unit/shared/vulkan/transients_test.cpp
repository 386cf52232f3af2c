// SPDX-License-Identifier: MIT
// Exactly the images whose lifetimes do not overlap share memory.
#include "shared/vulkan/passes/transients.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace diptych {
namespace {

Transient living(std::size_t first, std::size_t last, VkDeviceSize size, std::uint32_t types = 1,
                 VkDeviceSize alignment = 16) {
    return {{size, alignment, types}, first, last};
}

using Members = std::vector<std::size_t>;

TEST(Transients, LivesThatDoNotOverlapShareABlock) {
    const std::vector<SharedBlock> blocks =
        shareMemory(std::vector{living(4, 5, 100), living(0, 1, 300), living(2, 3, 200, 1, 64)});
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(blocks[0].members, (Members{1, 2, 0}));
    EXPECT_EQ(blocks[0].needs.size, 300u);
    EXPECT_EQ(blocks[0].needs.alignment, 64u);
}

// If one ends in the pass in which another begins, it is read there while the other is written.
TEST(Transients, LivesThatMeetInAPassDoNot) {
    EXPECT_EQ(shareMemory(std::vector{living(0, 2, 100), living(2, 3, 100)}).size(), 2u);
}

TEST(Transients, MemoryTypesThatNoneShareAreApart) {
    EXPECT_EQ(shareMemory(std::vector{living(0, 1, 100, 1), living(2, 3, 100, 2)}).size(), 2u);
    const std::vector<SharedBlock> both =
        shareMemory(std::vector{living(0, 1, 100, 6), living(2, 3, 100, 3), living(4, 5, 100, 5)});
    ASSERT_EQ(both.size(), 2u);  // the first two only share type 1, which the third does not support
    EXPECT_EQ(both[0].needs.memoryTypeBits, 2u);
}

TEST(Transients, EveryBlockServesAllItsMembersAndNoTwoMeet) {
    std::mt19937 random(7);
    const auto upTo = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n)(random); };
    for (int round = 0; round < 200; ++round) {
        std::vector<Transient> all;
        for (std::size_t i = 0, n = upTo(20); i < n; ++i) {
            const std::size_t first = upTo(10);
            all.push_back(living(first, first + upTo(3), 16 * (1 + upTo(50)),
                                 static_cast<std::uint32_t>(1 + upTo(6)), VkDeviceSize{16} << upTo(4)));
        }
        std::vector<int> members(all.size(), 0);
        for (const SharedBlock& block : shareMemory(all)) {
            EXPECT_NE(block.needs.memoryTypeBits, 0u);
            for (std::size_t k = 0; k < block.members.size(); ++k) {
                const Transient& image = all[block.members[k]];
                ++members[block.members[k]];
                EXPECT_GE(block.needs.size, image.needs.size);
                EXPECT_EQ(block.needs.alignment % image.needs.alignment, 0u);
                EXPECT_EQ(block.needs.memoryTypeBits & ~image.needs.memoryTypeBits, 0u);
                if (k > 0) {
                    EXPECT_LT(all[block.members[k - 1]].last, image.first);
                }
            }
        }
        EXPECT_TRUE(std::ranges::all_of(members, [](int count) { return count == 1; }));
    }
}

}  // namespace
}  // namespace diptych
