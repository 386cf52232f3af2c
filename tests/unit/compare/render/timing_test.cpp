// SPDX-License-Identifier: MIT
// The order of timed frames, and the medians of their passes' times; no clock is read.
#include "compare/render/timing.h"

#include <gtest/gtest.h>

#include <utility>

namespace diptych {
namespace {

// Each frame is drawn once before any is repeated, so a temporary slowdown of the machine affects all of
// them.
TEST(Timing, FramesAreDrawnInTurns) {
    std::vector<std::pair<int, std::size_t>> order;
    interleave(2, 3, [&](int round, std::size_t i) { order.emplace_back(round, i); });
    EXPECT_EQ(order,
              (std::vector<std::pair<int, std::size_t>>{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}}));
    interleave(0, 3, [](int, std::size_t) { ADD_FAILURE() << "no round"; });
}

TEST(Timing, RecordingHasATimeOfItsOwn) {
    const FrameTime time = timeWithRecording({5, 3, 4}, {2, 0.5, 1});
    EXPECT_EQ(time.median, 4);
    EXPECT_EQ(time.record, 1);
    EXPECT_EQ(time.runs, 3);
}

// One pass has its median in the middle frame, the other in the last; neither is first or largest.
TEST(Timing, APassHasTheMedianOfItsTimes) {
    const std::vector<PassTime> medians =
        mediansOf({{{"shade", 9}, {"lists", 1}}, {{"shade", 4}, {"lists", 8}}, {{"shade", 2}, {"lists", 5}}});
    ASSERT_EQ(medians.size(), 2u);
    EXPECT_EQ(medians[0].name, "shade");
    EXPECT_EQ(medians[0].ms, 4);
    EXPECT_EQ(medians[1].name, "lists");
    EXPECT_EQ(medians[1].ms, 5);
    EXPECT_TRUE(mediansOf({}).empty());
}

}  // namespace
}  // namespace diptych
