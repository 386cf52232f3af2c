// SPDX-License-Identifier: MIT
// From declared uses to barriers: the rules of synchronization2, one by one. The validation layer finds
// neither a missing source stage nor a barrier that waits for too much; these tests do.
#include "shared/vulkan/passes/barriers.h"
#include "shared/vulkan/device/device.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

const Access computeWrite = access::storageWrite(inCompute), computeRead = access::storageRead(inCompute),
             fragmentRead = access::storageRead(inFragment), colorSampled = access::sampledColor(inFragment);

class Barriers : public testing::Test {
protected:
    std::vector<Barrier> buffer(const Access& access) { return tracker.before("pass", {{list, {}, access}}); }
    std::vector<Barrier> image(const Access& access, bool discards = false) {
        return tracker.before("pass", {{target, {}, access, discards}});
    }
    BarrierTracker tracker;
    const std::size_t list = tracker.add("list"), target = tracker.add("picture"),
                      pyramid = tracker.add("pyramid", 3, 2);
};

TEST_F(Barriers, TheFirstWriteOfABufferWaitsForNothing) {
    EXPECT_TRUE(buffer(computeWrite).empty());
}

TEST_F(Barriers, AReadSeesTheWriteOnceForEachStageAndAccess) {
    buffer(computeWrite);
    const Access written{inCompute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    EXPECT_EQ(buffer(fragmentRead), (std::vector<Barrier>{{list, {}, written, fragmentRead}}));
    EXPECT_TRUE(buffer(fragmentRead).empty()) << "it is visible there already";
    EXPECT_EQ(buffer(computeRead), (std::vector<Barrier>{{list, {}, written, computeRead}}))
        << "visible to fragment shaders is not visible to compute shaders";
    EXPECT_EQ(buffer(access::texelRead(inFragment)).size(), 1u) << "another access of the same stage";
    EXPECT_EQ(buffer(access::indirectRead).size(), 1u);
}

// The pass's own reads see the previous contents, not its writes.
TEST_F(Barriers, WhatAPassReadsAndWritesIsReadByTheNext) {
    tracker.before("scan", {{list, {}, computeRead}, {list, {}, computeWrite}});
    EXPECT_EQ(buffer(computeRead).size(), 1u);
    EXPECT_TRUE(buffer(computeRead).empty());
}

TEST_F(Barriers, AWriteWaitsForEveryReadSinceTheLastWrite) {
    buffer(computeWrite);
    buffer(fragmentRead);
    buffer(access::vertexRead);
    const std::vector<Barrier> again = buffer(computeWrite);
    ASSERT_EQ(again.size(), 1u);
    EXPECT_EQ(again[0].from.stages, inCompute | inFragment | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT);
    EXPECT_EQ(again[0].from.access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(again[0].to, computeWrite);
}

TEST_F(Barriers, AWriteAfterAWriteWaits) {
    buffer(access::transferWrite);
    EXPECT_EQ(buffer(computeWrite), (std::vector<Barrier>{{list, {}, access::transferWrite, computeWrite}}));
}

// Data from earlier submits is read without a barrier; only a write makes later readers wait.
TEST_F(Barriers, WhatWasThereBeforeIsReadAtOnce) {
    tracker.setWritten(list);
    EXPECT_TRUE(buffer(fragmentRead).empty());
    const std::vector<Barrier> write = buffer(computeWrite);
    ASSERT_EQ(write.size(), 1u);
    EXPECT_EQ(write[0].from, (Access{inFragment, 0}));
    EXPECT_EQ(buffer(fragmentRead).size(), 1u);
}

TEST_F(Barriers, AnImageChangesItsLayout) {
    EXPECT_EQ(image(access::colorAttachment, true),
              (std::vector<Barrier>{{target, {}, {}, access::colorAttachment}}));
    const std::vector<Barrier> sampled = image(colorSampled);
    ASSERT_EQ(sampled.size(), 1u);
    EXPECT_EQ(sampled[0].from, (Access{access::colorAttachment.stages, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                                       access::colorAttachment.layout}));
    EXPECT_EQ(sampled[0].to, colorSampled);
    EXPECT_TRUE(image(colorSampled).empty());
    // Another stage waits for the layout transition, which ended before the fragment shader.
    const std::vector<Barrier> elsewhere = image(access::sampledColor(inCompute));
    ASSERT_EQ(elsewhere.size(), 1u);
    EXPECT_EQ(elsewhere[0].from.stages, inFragment);
    EXPECT_EQ(elsewhere[0].from.layout, elsewhere[0].to.layout);
    // Cleared: the contents are discarded, but the barrier waits for their readers.
    const std::vector<Barrier> next = image(access::colorAttachment, true);
    ASSERT_EQ(next.size(), 1u);
    EXPECT_EQ(next[0].from.layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(next[0].from.stages, inFragment | inCompute);
}

TEST_F(Barriers, OnePassMayTestAndSampleDepth) {
    tracker.before("draw", {{target, {}, access::depthAttachment, true}});
    const std::vector<Barrier> both = tracker.before(
        "shade", {{target, {}, access::depthTest}, {target, {}, access::sampledDepth(inFragment)}});
    ASSERT_EQ(both.size(), 1u);
    EXPECT_EQ(both[0].to,
              (Access{access::depthStages | inFragment,
                      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                      VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL}));
}

// Level by level, as for a mip chain: each reads the one above.
TEST_F(Barriers, LevelsAndLayersAreApart) {
    const Part all{0, 3, 0, 2}, top{0, 1, 0, 2}, middle{1, 1, 0, 2};
    EXPECT_EQ(tracker.before("draw", {{pyramid, top, access::colorAttachment, true}}).size(), 1u);
    const std::vector<Barrier> first = tracker.before(
        "reduce", {{pyramid, top, colorSampled}, {pyramid, middle, access::colorAttachment, true}});
    ASSERT_EQ(first.size(), 2u);
    EXPECT_EQ(first[0].part, top);
    EXPECT_EQ(first[1].part, middle);
    EXPECT_EQ(first[1].from, Access{});
    tracker.before("reduce",
                   {{pyramid, middle, colorSampled}, {pyramid, {2, 1, 0, 2}, access::colorAttachment, true}});
    const std::vector<Barrier> whole = tracker.before("shade", {{pyramid, all, colorSampled}});
    ASSERT_EQ(whole.size(), 1u) << "only the last level is still an attachment, of both layers at once";
    EXPECT_EQ(whole[0].part, (Part{2, 1, 0, 2}));
    // If one layer is redrawn, the other is unaffected.
    EXPECT_EQ(tracker.before("draw", {{pyramid, {0, 1, 1, 1}, access::colorAttachment, true}})[0].part,
              (Part{0, 1, 1, 1}));
    EXPECT_EQ(tracker.before("shade", {{pyramid, all, colorSampled}})[0].part, (Part{0, 1, 1, 1}));
}

TEST_F(Barriers, SharedMemoryWaitsForItsEarlierOwner) {
    image(access::colorAttachment, true);
    image(colorSampled);
    const std::size_t second = tracker.add("second");
    tracker.alias(second, target);
    const std::vector<Barrier> taken = tracker.before("next", {{second, {}, access::colorAttachment, true}});
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].from.stages, inFragment);
    EXPECT_EQ(taken[0].from.layout, VK_IMAGE_LAYOUT_UNDEFINED);
}

TEST_F(Barriers, ContradictionsAreNamed) {
    const auto fault = [&](const std::vector<Use>& uses) -> std::string {
        try {
            tracker.before("shade", uses);
        } catch (const std::logic_error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(fault({{target, {}, colorSampled}, {target, {}, access::colorAttachment}}),
              "pass shade: uses picture in two layouts at once");
    EXPECT_EQ(fault({{list, {}, computeWrite}, {list, {}, fragmentRead}}),
              "pass shade: writes and reads list in different stages");
    EXPECT_EQ(fault({{pyramid, {0, 2, 0, 1}, colorSampled}, {pyramid, {1, 1, 0, 1}, colorSampled}}),
              "pass shade: uses of pyramid overlap partially; declare the same levels and layers");
    EXPECT_EQ(fault({{pyramid, {3, 1, 0, 1}, colorSampled}}),
              "pass shade: pyramid has no such level or layer");
    EXPECT_EQ(fault({{pyramid, {0, 1, 1, 2}, colorSampled}}),
              "pass shade: pyramid has no such level or layer");
    for (const auto& [read, written] : {std::pair<Part, Part>{{0, 1, 0, 1}, {1, 1, 0, 1}},
                                        {{1, 1, 0, 1}, {0, 1, 0, 1}},
                                        {{2, 1, 0, 1}, {2, 1, 1, 1}},
                                        {{2, 1, 1, 1}, {2, 1, 0, 1}}})
        EXPECT_EQ(fault({{pyramid, read, colorSampled}, {pyramid, written, access::colorAttachment}}), "")
            << "a level or a layer may be made of its neighbour";
}

// Contents that one use of a pass needs are kept, even if its other uses of the same part discard them.
TEST_F(Barriers, ContentsAreDiscardedOnlyWhereEveryUseDoes) {
    image(access::colorAttachment, true);
    image(colorSampled);
    const std::vector<Barrier> kept = tracker.before(
        "pass", {{target, {}, access::colorAttachment, true}, {target, {}, access::colorAttachment}});
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept[0].from.layout, colorSampled.layout);
}

// SHADER_READ covers every way in which a shader reads.
TEST_F(Barriers, AGeneralReadOfShadersCoversEachKind) {
    buffer(computeWrite);
    EXPECT_EQ(buffer({inFragment, VK_ACCESS_2_SHADER_READ_BIT}).size(), 1u);
    EXPECT_TRUE(buffer(fragmentRead).empty());
    EXPECT_TRUE(buffer({inFragment, VK_ACCESS_2_UNIFORM_READ_BIT}).empty());
    EXPECT_EQ(buffer(computeRead).size(), 1u) << "of these stages alone";
}

TEST_F(Barriers, WhatWasUploadedIsInTheLayoutThatItWasLeftIn) {
    tracker.setWritten(target, colorSampled.layout);
    EXPECT_TRUE(image(colorSampled).empty());
    EXPECT_EQ(image(access::colorAttachment).at(0).from.layout, colorSampled.layout);
}

// An image in another's memory waits for that image's writers and readers.
TEST_F(Barriers, MemoryIsTakenOverFromItsWritersAndReaders) {
    const std::size_t second = tracker.add("second");
    buffer(computeWrite);
    buffer(fragmentRead);
    tracker.alias(second, list);
    const std::vector<Barrier> taken = tracker.before("pass", {{second, {}, computeWrite}});
    ASSERT_EQ(taken.size(), 1u);
    EXPECT_EQ(taken[0].from, (Access{inCompute | inFragment, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}));
}

TEST(TimeStamps, OnlyValidBitsCountAndTheCounterWraps) {
    EXPECT_EQ(elapsedTicks(10, 25, 64), 15u);
    EXPECT_EQ(elapsedTicks(0xabc0000000000010, 0x1230000000000025, 36), 0x15u) << "undefined bits above";
    EXPECT_EQ(elapsedTicks((std::uint64_t{1} << 36) - 5, 7, 36), 12u);
    EXPECT_EQ(elapsedTicks(~std::uint64_t{0}, 4, 64), 5u);
}

}  // namespace
}  // namespace diptych
