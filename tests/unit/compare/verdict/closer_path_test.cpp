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
    CloserPathChannel far = closer.channels[0];
    for (const auto& [by, words] : {std::pair{21462.0, "(21500 times less)"}, {1.5, "(1.5 times less)"}}) {
        far.by = by;
        EXPECT_NE(closerPathLine(closer, far, frames).find(words), std::string::npos);
    }
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
    const CloserPath closer = closerPathOf(frames, 0, {1, 2}, coverage(frames[0], frames[1]), {});
    EXPECT_NE(closerPathLine(closer, closer.channels[0], frames).find("no error"), std::string::npos);
    const auto broken = threeFrames({1, 1}, {std::numeric_limits<float>::quiet_NaN(), 1}, {1.5f, 1});
    EXPECT_EQ(litOf(broken).closer, 1);
}

TEST(CloserPath, TheImageHasEachPathsColour) {
    Image error_difference(3, 1, 1);
    error_difference.data = {-1, 0, 0.25f};
    const Image8 image = closerPathImage(error_difference, 1);
    EXPECT_EQ(std::vector<std::uint8_t>(image.data.begin(), image.data.begin() + 3),
              (std::vector<std::uint8_t>{111, 155, 232}));
    EXPECT_EQ(image.data[4], 0);
    EXPECT_EQ(image.data[6], 112) << "the root of a quarter: half of 224";
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
