// SPDX-License-Identifier: MIT
// Whether a depth pre-pass pays off, on devices with round costs.
#include "forward_plus/prepass.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace diptych {
namespace {

// Two million covered pixels, each drawn `times` times; shading a fragment takes 10 + 2 * 5 + 4 * 20 = 100
// ns.
PrepassChoice choiceFor(std::uint64_t times, double depthNs, double triangleNs = 0) {
    DeviceProfile device;
    device.software = true;
    device.costs.surface = 10;
    device.costs.texture = 5;
    device.costs.light = 20;
    device.costs.depth = depthNs;
    device.costs.triangle = triangleNs;
    const Overdraw overdraw{
        .triangles = 1'000'000, .fragments = 2'000'000 * times, .covered = 2'000'000, .textures = 2};
    return choosePrepass(overdraw, 4, device);
}

TEST(PrepassChoice, WhatIsHiddenIsSaved) {
    EXPECT_FALSE(choiceFor(1, 1).on) << "nothing is drawn twice";
    EXPECT_EQ(
        choiceFor(1, 1).because,
        "--prepass auto is off: 1.00 fragments per covered pixel; the pre-pass would take about 2 ms on "
        "this CPU device and save 0 ms of shading");
    EXPECT_EQ(choiceFor(3, 1).because,
              "--prepass auto is on: 3.00 fragments per covered pixel; the pre-pass would take about 6 ms on "
              "this CPU device and save 4e+02 ms of shading");
    EXPECT_TRUE(choiceFor(2, 49).on);
    EXPECT_FALSE(choiceFor(2, 51).on) << "200 ms saved of 4 million fragments that take 204 ms";
    EXPECT_TRUE(choiceFor(2, 1, 195).on);
    EXPECT_FALSE(choiceFor(2, 1, 197).on) << "a million triangles take 197 ms, fragments 4 ms";
}

TEST(PrepassChoice, AnEmptyImageHasNoFragmentsPerPixel) {
    const auto says = [](std::uint64_t covered, const char* fragments) {
        const PrepassChoice choice =
            choosePrepass({.triangles = 1, .fragments = 3, .covered = covered, .textures = 0}, 1, {});
        return choice.because.find(fragments) != std::string::npos;
    };
    EXPECT_TRUE(says(0, ": 0.00 fragments per covered pixel"));
    EXPECT_TRUE(says(1, ": 3.00 fragments per covered pixel"));
}

}  // namespace
}  // namespace diptych
