// SPDX-License-Identifier: MIT
#include "compare/viewer/latencies.h"

#include <gtest/gtest.h>

namespace diptych::viewer {
namespace {

// A request of 8x8 pixels, shown with `side` of them in a row.
DrawnView shownAs(std::uint64_t request, int side) {
    DrawnView shown;
    shown.request.id = request;
    shown.request.subject.settings.size = {8, 8};
    shown.size = {side, side};
    return shown;
}

TEST(Latencies, AnImageOfEachKindAndAKeyAreSaidOnce) {
    std::vector<std::string> said;
    Latencies latencies([&](const std::string& line) { said.push_back(line.substr(0, line.find(" after"))); },
                        Latencies::Clock::now());
    latencies.seen(shownAs(1, 4), 1);
    latencies.pressed("F", 1);
    latencies.seen(shownAs(1, 4), 2);  // the key has asked for an image: this is an earlier one
    latencies.asked(2);
    latencies.seen(shownAs(1, 4), 2);
    for (int frame = 0; frame < 2; ++frame) latencies.seen(shownAs(2, 8), 2);
    EXPECT_EQ(said, (std::vector<std::string>{"first picture", "first whole picture", "key F: seen"}));
}

TEST(Latencies, AKeyThatAsksForNoImageIsSeenAtOnce) {
    std::vector<std::string> said;
    Latencies latencies([&](const std::string& line) { said.push_back(line); }, Latencies::Clock::now());
    latencies.pressed("H", 5);
    latencies.seen(shownAs(3, 4), 5);
    ASSERT_EQ(said.size(), 2u);
    EXPECT_TRUE(said[1].starts_with("key H: seen after ")) << said[1];
}

TEST(Latencies, OfFramesHavePercentiles) {
    std::vector<std::string> said;
    Latencies latencies([&](const std::string& line) { said.push_back(line); }, Latencies::Clock::now());
    latencies.reportFrames();
    EXPECT_TRUE(said.empty());
    for (int ms = 1; ms < 30; ++ms) latencies.frame(ms);
    EXPECT_EQ(latencies.percentile(), 0);
    for (int ms = 30; ms <= 1200; ++ms) latencies.frame(ms);
    EXPECT_EQ(latencies.percentile(), 1188);
    latencies.reportFrames();
    EXPECT_EQ(said,
              (std::vector<std::string>{"interface: 1200 frames, median 600.0 ms, 99th percentile 1188.0 "
                                        "ms, longest 1200.0 ms"}));
}

}  // namespace
}  // namespace diptych::viewer
