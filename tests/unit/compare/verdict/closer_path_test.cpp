// SPDX-License-Identifier: MIT
#include "compare/verdict/closer_path.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"
#include "tests/support/frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace diptych {
namespace {

// One row of grey pixels with material 0; the last pixel has material 2.
Frame frameOf(Path path, const std::vector<float>& values) {
    const int width = static_cast<int>(values.size());
    Frame frame = flatFrame(path, width, 1);
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
            frame.channels[Channel::lit].at(x, 0, c) = values[static_cast<std::size_t>(x)];
    frame.channels[Channel::material_id].at(width - 1, 0) = 2;
    return frame;
}

std::vector<Frame> threeFrames(const std::vector<float>& reference, const std::vector<float>& deferred,
                               const std::vector<float>& forward) {
    return {frameOf(Path::reference, reference), frameOf(Path::deferred, deferred),
            frameOf(Path::forward_plus, forward)};
}

CloserPathChannel litOf(const std::vector<Frame>& frames) {
    const CloserPath closer =
        closerPathOf(frames, 0, {1, 2}, coverage(frames[0], frames[1]), {"stone", "", "gold"});
    EXPECT_EQ(closer.channels.size(), 1u);
    return closer.channels.at(0);
}

// With MSAA, a path's light components come from one sample, the reference's from all.
TEST(CloserPath, OfSeveralSamplesIsOfLitAlone) {
    auto frames = threeFrames({1, 1}, {1.1f, 1}, {1, 1});
    for (Frame& frame : frames) frame.channels[Channel::lit_diffuse] = frame.channels.at(Channel::lit);
    const auto channels = [&] {
        return closerPathOf(frames, 0, {1, 2}, coverage(frames[0], frames[1]), {}).channels.size();
    };
    EXPECT_EQ(channels(), 2u);
    frames[1].settings.msaa = frames[2].settings.msaa = 4;
    EXPECT_EQ(channels(), 1u);
    EXPECT_EQ(litOf(frames).mode->channel, Channel::lit);
}

TEST(CloserPath, SaysWhichWhereAndByHowMuch) {
    const auto frames = threeFrames({1, 1, 2, 4}, {1.1f, 1, 2.4f, 4}, {1, 1, 2.1f, 4.4f});
    const CloserPathChannel channel = litOf(frames);
    EXPECT_EQ(channel.closer, 1);
    EXPECT_NEAR(channel.paths[0].stats.mean, (0.1 + 0 + 0.2 + 0) / 4, 1e-6);
    EXPECT_NEAR(channel.paths[1].stats.mean, (0 + 0 + 0.05 + 0.1) / 4, 1e-6);
    EXPECT_NEAR(channel.by, 2, 1e-5);
    EXPECT_NEAR(channel.between.stats.max, 0.4 / 4 > 0.3 / 2.4 ? 0.1 : 0.3 / 2.4, 1e-6)
        << "relative to the first";
    EXPECT_EQ(channel.closer_pixels[0], 1u);
    EXPECT_EQ(channel.closer_pixels[1], 2u);
    EXPECT_EQ(channel.even_pixels, 1u);
    EXPECT_GT(channel.error_difference.at(0, 0), 0);
    EXPECT_EQ(channel.error_difference.at(1, 0), 0);
    EXPECT_LT(channel.error_difference.at(3, 0), 0);
    ASSERT_EQ(channel.materials.size(), 2u);
    EXPECT_EQ(channel.materials[0].name, "stone") << "the two are 0.25 apart there, 0.1 in gold";
    EXPECT_EQ(channel.materials[0].pixels, 3u);
    EXPECT_NEAR(channel.materials[1].mean[1], 0.1, 1e-6);
    const CloserPath closer = closerPathOf(frames, 0, {1, 2}, coverage(frames[0], frames[1]), {});
    EXPECT_EQ(closerPathLine(closer, closer.channels[0], frames),
              "lit: forward_plus is closer to the reference: mean error 0.0375 against 0.075 for deferred (2 "
              "times less); it is closer at 50.0 % of the pixels (deferred at 25.0 %, equal at 25.0 %)");
}

TEST(CloserPath, WhatCannotBeToldApartIsEven) {
    EXPECT_EQ(litOf(threeFrames({1, 1}, {1.1f, 1}, {1.1f, 1})).closer, -1);
    EXPECT_EQ(litOf(threeFrames({1, 1}, {1.50001f, 1}, {1.5f, 1})).closer, -1) << "a thousandth of the error";
    EXPECT_EQ(litOf(threeFrames({1, 1}, {1.52f, 1}, {1.5f, 1})).closer, 1);
    auto unsure = threeFrames({1, 1}, {1.52f, 1}, {1.5f, 1});
    unsure[0].uncertainty = Image(2, 1, 1, 0.1f);
    EXPECT_EQ(litOf(unsure).closer, -1) << "the reference is known to less than they are apart";
}

TEST(CloserPath, WhatIsExactIsInfinitelyCloser) {
    const auto frames = threeFrames({1, 1}, {1, 1}, {1.5f, 1});
    const CloserPathChannel channel = litOf(frames);
    EXPECT_EQ(channel.closer, 0);
    EXPECT_TRUE(std::isinf(channel.by));
    const auto broken = threeFrames({1, 1}, {std::numeric_limits<float>::quiet_NaN(), 1}, {1.5f, 1});
    EXPECT_EQ(litOf(broken).closer, 1);
}

TEST(CloserPath, TheImageHasEachPathsColour) {
    Image error_difference(3, 1, 1);
    error_difference.data = {-1, 0, 0.25f};
    // The root of a quarter is half of each component; the first path's colour where it is closer.
    EXPECT_EQ(closerPathImage(error_difference, 1).data,
              (std::vector<std::uint8_t>{111, 155, 232, 0, 0, 0, 112, 83, 41}));
    error_difference.data = {-8, NAN, 1};
    EXPECT_EQ(closerPathImage(error_difference, 4).data,
              (std::vector<std::uint8_t>{111, 155, 232, 0, 0, 0, 112, 83, 41}));
}

TEST(CloserPath, EachOutcomeHasItsLine) {
    const auto lineOf = [](const std::vector<float>& deferred, const std::vector<float>& forward,
                           const std::vector<float>& reference = {1, 1}) {
        const auto frames = threeFrames(reference, deferred, forward);
        const CloserPath closer = closerPathOf(frames, 0, {1, 2}, coverage(frames[0], frames[1]), {});
        return closerPathLine(closer, closer.channels[0], frames);
    };
    EXPECT_EQ(lineOf({1.5f, 1}, {1.5f, 1}),
              "lit: both paths are equally close to the reference, mean errors 0.25 and 0.25");
    EXPECT_EQ(
        lineOf({1, 1}, {1.5f, 1}),
        "lit: deferred is closer to the reference: mean error 0 against 0.25 for forward_plus (no error); "
        "it is closer at 50.0 % of the pixels (forward_plus at 0.0 %, equal at 50.0 %)");
    EXPECT_EQ(lineOf({1.5f, HUGE_VALF}, {1.5f, 1.25f}),
              "lit: forward_plus is closer to the reference: mean error 0.375 against inf for deferred "
              "(infinite); it is closer at 50.0 % of the pixels (deferred at 0.0 %, equal at 50.0 %)");
    CloserPathChannel far = litOf(threeFrames({1, 1}, {1, 1}, {1.5f, 1}));
    const auto frames = threeFrames({1, 1}, {1, 1}, {1.5f, 1});
    const CloserPath closer = closerPathOf(frames, 0, {1, 2}, coverage(frames[0], frames[1]), {});
    for (const auto& [by, words] : {std::pair{999.4, "(999 times less)"},
                                    {1000, "(1000 times less)"},
                                    {1004, "(1000 times less)"},
                                    {1006, "(1010 times less)"},
                                    {21462, "(21500 times less)"},
                                    {1.5, "(1.5 times less)"}}) {
        far.by = by;
        EXPECT_NE(closerPathLine(closer, far, frames).find(words), std::string::npos) << by;
    }
}

// Eight materials, by how much they add to the difference of the two means: apart by 0.1 n at each pixel.
TEST(CloserPath, MaterialsThatDecideComeFirst) {
    std::vector<float> reference(12, 1), deferred(12, 1), forward(12, 1);
    for (std::size_t i = 0; i < 12; ++i) (i % 2 ? deferred : forward)[i] += 0.125f * static_cast<float>(i);
    auto frames = threeFrames(reference, deferred, forward);
    std::vector<int> expected;
    for (int i = 0; i < 10; ++i) frames[0].channels[Channel::material_id].at(i, 0) = static_cast<float>(i);
    // Material 9 has the last three pixels: 1.125 + 1.375 - 1.25.
    for (const int i : {10, 11}) frames[0].channels[Channel::material_id].at(i, 0) = 9;
    const CloserPathChannel lit = litOf(frames);
    for (const MaterialError& material : lit.materials) expected.push_back(material.id);
    EXPECT_EQ(expected, (std::vector<int>{9, 8, 7, 6, 5, 4, 3, 2}));
    EXPECT_EQ(lit.materials[0].name, "");
    EXPECT_EQ(lit.materials[7].name, "gold");
    EXPECT_EQ(lit.materials[0].pixels, 3u);
    EXPECT_NEAR(lit.materials[0].mean[0], 2.5 / 3, 1e-6);
    EXPECT_NEAR(lit.materials[0].mean[1], 1.25 / 3, 1e-6);
}

// The 99th percentile of the pixels that differ.
TEST(CloserPath, AnImagesTopLeavesOutOneInAHundred) {
    Image difference(20, 20, 1);
    for (std::size_t i = 0; i < 201; ++i)
        difference.data[i] = (i % 2 ? -1.0f : 1.0f) * static_cast<float>(i + 1);
    difference.data[300] = HUGE_VALF;
    EXPECT_EQ(closerPathTop(difference), 199);
    EXPECT_EQ(closerPathTop(Image(2, 2, 1)), 1);
}

// An error within the reference's own uncertainty is not counted against a path; a larger one is.
TEST(CloserPath, TheReferencesOwnUncertaintyIsGrantedByThePixel) {
    auto frames = threeFrames({1, 1}, {1.01f, 1}, {1.03f, 1});
    const Requirements needs;
    const Coverage covered = coverage(frames[0], frames[1]);
    const auto certain = [&](std::size_t path) {
        const FramePair pair{frames[0], frames[path], needs, covered, true, nullptr};
        return certainErrors(debugMode(Channel::lit), pair);
    };
    EXPECT_FALSE(certain(1).has_value()) << "nothing was sampled";
    frames[0].uncertainty = Image(2, 1, 1);
    frames[0].uncertainty.data = {0.005f, 0.5f};
    EXPECT_EQ(std::ranges::max(certain(1).value()), 0);
    EXPECT_NEAR(std::ranges::max(certain(2).value()), 0.03 - 2.29 * 0.005, 1e-6)
        << "what is open elsewhere grants nothing here";
    frames[2].channels[Channel::lit].at(0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isinf(std::ranges::max(certain(2).value())));
}

}  // namespace
}  // namespace diptych
