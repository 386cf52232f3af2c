// SPDX-License-Identifier: MIT
// Every use of an image or a buffer after every other: the tracker's barriers satisfy the memory model
// (hazards.h), and each is necessary.
#include "tests/support/hazards.h"

#include <gtest/gtest.h>

#include <random>

namespace diptych {
namespace {

const std::vector<Access> imageAccesses{access::colorAttachment,
                                        access::depthAttachment,
                                        access::depthTest,
                                        access::resolvedDepth,
                                        access::sampledColor(inFragment),
                                        access::sampledColor(inCompute),
                                        access::sampledColor(inVertex | inFragment),
                                        access::sampledDepth(inFragment),
                                        access::sampledDepth(inCompute),
                                        access::storageImageRead(inCompute),
                                        access::storageImageRead(inFragment),
                                        access::storageImageWrite(inCompute),
                                        access::copiedFromImage,
                                        access::copiedToImage};
const std::vector<Access> bufferAccesses{access::storageRead(inCompute),
                                         access::storageRead(inFragment),
                                         access::storageWrite(inCompute),
                                         access::storageWrite(inFragment),
                                         access::uniformRead(inVertex),
                                         access::texelRead(inFragment),
                                         access::texelRead(inCompute),
                                         access::indirectRead,
                                         access::vertexRead,
                                         access::indexRead,
                                         access::transferRead,
                                         access::transferWrite,
                                         access::hostRead};

// Uses of one resource, pass by pass, and the tracker's barriers.
struct Tracked {
    std::vector<DeclaredUse> uses;
    std::vector<RecordedBarrier> barriers;
};
Tracked trackedOf(const std::vector<Use>& uses, std::uint32_t levels = 1, std::uint32_t layers = 1) {
    BarrierTracker tracker;
    tracker.add("it", levels, layers);
    Tracked tracked;
    for (std::size_t pass = 0; pass < uses.size(); ++pass) {
        const std::string name = std::to_string(pass);
        for (const Barrier& b : tracker.before(name, {uses[pass]}))
            tracked.barriers.push_back({name, "it", b.part, b.from, b.to, pass});
        tracked.uses.push_back({name, "it", uses[pass].access, uses[pass].part, pass});
    }
    return tracked;
}

std::vector<std::string> hazardsIn(const Tracked& tracked) {
    Hazards hazards;
    hazards.run(tracked.uses, tracked.barriers);
    return hazards.found();
}

// The last barrier without its source stages must fail; if it has accesses, so must all barriers without
// theirs.
void expectSourcesNeeded(Tracked tracked, const std::string& what) {
    if (tracked.barriers.empty() || tracked.barriers.back().from.stages == 0) return;
    Tracked accesses = tracked;
    tracked.barriers.back().from.stages = VK_PIPELINE_STAGE_2_NONE;
    EXPECT_FALSE(hazardsIn(tracked).empty()) << what << ": no source stage";
    if (accesses.barriers.back().from.access == 0) return;
    for (RecordedBarrier& barrier : accesses.barriers) barrier.from.access = VK_ACCESS_2_NONE;
    EXPECT_FALSE(hazardsIn(accesses).empty()) << what << ": no source access";
}

TEST(BarrierHazards, NoneBetweenAnyThreeUses) {
    for (const std::vector<Access>* accesses : {&imageAccesses, &bufferAccesses})
        for (std::size_t a = 0; a < accesses->size(); ++a)
            for (std::size_t b = 0; b < accesses->size(); ++b)
                for (std::size_t c = 0; c < accesses->size(); ++c) {
                    std::vector<Use> uses;
                    for (const std::size_t i : {a, b, c}) uses.push_back({0, {}, (*accesses)[i], false});
                    const Tracked tracked = trackedOf(uses);
                    const std::string what = fmt::format("{} {} {}", a, b, c);
                    EXPECT_EQ(hazardsIn(tracked), std::vector<std::string>{}) << what;
                    expectSourcesNeeded(tracked, what);
                }
}

// Parts of an image, discarded contents, a dozen uses.
TEST(BarrierHazards, NoneInLongerLives) {
    std::mt19937 random(5);
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    constexpr std::uint32_t levels = 3, layers = 2;
    std::size_t barriers = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Use> uses;
        for (int i = 0; i < 12; ++i) {
            const auto level = static_cast<std::uint32_t>(below(levels)),
                       layer = static_cast<std::uint32_t>(below(layers));
            const Part one{level, 1, layer, 1}, all{0, levels, 0, layers}, column{level, 1, 0, layers};
            const Access& access = imageAccesses[below(imageAccesses.size())];
            uses.push_back(
                {0, std::array{one, all, column}[below(3)], access, writes(access) && below(2) == 0});
        }
        const Tracked tracked = trackedOf(uses, levels, layers);
        EXPECT_EQ(hazardsIn(tracked), std::vector<std::string>{}) << round;
        barriers += tracked.barriers.size();
    }
    EXPECT_GT(barriers, 3000u);
}

}  // namespace
}  // namespace diptych
