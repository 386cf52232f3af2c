// SPDX-License-Identifier: MIT
#include "compare/run/still_working.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace diptych {
namespace {

TEST(StillWorking, RepeatsTheLastStepUntilItEnds) {
    using namespace std::chrono_literals;
    std::atomic<int> reads = 0, decodes = 0;
    Progress progress([&](const std::string&, double, const std::string& step) {
        ++(step == "read" ? reads : decodes);
        if (decodes > 2) throw std::runtime_error("cancelled");  // harmless on another thread
    });
    {
        StillWorking working(Stage(progress, "a.exr"), "read", 1ms);
        while (reads < 3) std::this_thread::sleep_for(1ms);  // hangs without repetition
        working.at(0.5, "decode");
        while (decodes < 5) std::this_thread::sleep_for(1ms);
    }
    const int last = reads + decodes;
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(reads + decodes, last);
}

}  // namespace
}  // namespace diptych
