// SPDX-License-Identifier: MIT
// Channels as images.
#include "compare/image/channel_image.h"
#include "tests/support/report_builder.h"
#include "tests/support/srgb.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace diptych {
namespace {

// A tenth of the pixels is bright; exposure by the log-average alone would overexpose it.
TEST(ChannelImage, HighlightsHoldTheAutomaticExposure) {
    Image lit(20, 1, 3, 0.01f);
    for (int x = 0; x < 2; ++x)
        for (int c = 0; c < 3; ++c) lit.at(x, 0, c) = 2;
    Coverage all;
    all.covered.assign(20, true);
    EXPECT_NEAR(exposureFor({}, &lit, all).factor, 0.7 / 2, 1e-9);
    EXPECT_TRUE(exposureFor({}, &lit, all).tonemap);
}

// Three pixels of a hundred do not set the exposure: they are above the 95th percentile.
TEST(ChannelImage, ExposureIsForTheNinetyFifthPercentile) {
    Image lit(100, 1, 3, 0.01f);
    for (int x = 0; x < 20; ++x)
        for (int c = 0; c < 3; ++c) lit.at(x, 0, c) = x < 3 ? 100 : 4;
    Coverage all;
    all.covered.assign(100, true);
    EXPECT_NEAR(exposureFor({}, &lit, all).factor, 0.7 / 4, 1e-6);
}

// Neither a film's index nor its thickness is between 0 and 1, and only the thickness has a unit.
TEST(ChannelImage, FilmsAreShownOverTheirRange) {
    Frame frame = bothFrames()[0];
    for (const auto& [shown, value, words] : {std::tuple{Channel::iridescence_ior, 1.5f, "grey, 0 to 1.5"},
                                              {Channel::iridescence_thickness, 400.0f, "grey, 0 to 400 nm"},
                                              {Channel::transmission_thickness, 0.5f, "grey, 0 to 0.5 m"},
                                              {Channel::attenuation_distance, 3.0f, "grey, 0 to 3 m"},
                                              {Channel::dispersion, 1.5f, "grey, 0 to 1.5"}}) {
        const DebugMode& mode = debugMode(shown);
        Image& image = frame.channels.at(mode.channel);
        image.at(1, 2) = value;
        Image& ids = frame.channels.at(Channel::material_id);
        ids.at(2, 2) = 1;  // a surface without a film
        const Frame* frames[] = {&frame};
        const ImageScale scale = scaleFor(mode, {}, frames);
        EXPECT_EQ(scale.text, words);
        EXPECT_EQ(channelImage(mode, frame, scale).data.at(3 * (2 * 4 + 1)), 255);
    }
}

// One object has one colour; neighbouring ids have different colours.
TEST(ChannelImage, AnIdHasItsColour) {
    Frame frame = bothFrames()[0];
    const DebugMode& ids = debugMode(Channel::material_id);
    Image& image = frame.channels.at(Channel::material_id);
    for (int x = 0; x < 4; ++x) image.at(x, 2) = static_cast<float>(std::array{0, 1, 2, 0}[x]);
    const Frame* frames[] = {&frame};
    const Image8 drawn = channelImage(ids, frame, scaleFor(ids, {}, frames));
    const auto colour = [&](int x) {
        const std::uint8_t* const p = drawn.data.data() + 3 * (2 * 4 + x);
        return std::array{p[0], p[1], p[2]};
    };
    EXPECT_NE(colour(0), colour(1));
    EXPECT_NE(colour(1), colour(2));
    EXPECT_NE(colour(0), colour(2));
    EXPECT_EQ(colour(0), colour(3));
    // Hues in sixths of a turn: 0.42, 4.128 and 7.836 - 6. Saturation 0.62; values 0.95, 0.75, 0.58.
    const auto expectColour = [&](int x, double r, double g, double b) {
        for (const auto& [got, expected] : {std::pair{colour(x)[0], r}, {colour(x)[1], g}, {colour(x)[2], b}})
            EXPECT_NEAR(got, 255 * expected, 0.6) << x;
    };
    expectColour(0, 0.95, 0.95 * (1 - 0.62 * (1 - 0.42)), 0.95 * 0.38);    // red to yellow
    expectColour(1, 0.75 * (1 - 0.62 * (1 - 0.1282)), 0.75 * 0.38, 0.75);  // blue to magenta
    expectColour(2, 0.58 * (1 - 0.62 * 0.8364), 0.58, 0.58 * 0.38);        // yellow to green
}

TEST(ChannelImage, BackgroundAndExposure) {
    const Frame frame = bothFrames()[0];
    const DebugMode& lit = debugMode(Channel::lit);
    ImageChoice choice;
    choice.tonemap = false;
    const Exposure automatic = exposureFor(choice, &frame.channels.at(Channel::lit), coverage(frame, frame));
    EXPECT_DOUBLE_EQ(automatic.factor, 0.18 / 0.5) << "one covered pixel of luminance 0.5";
    const Frame* frames[] = {&frame};
    const Image8 image = channelImage(lit, frame, scaleFor(lit, automatic, frames));
    EXPECT_EQ(image.data[3 * (2 * 4 + 1)], 118) << "sRGB of 0.18 is 117.6";
    EXPECT_EQ(image.data[0], 0);
    EXPECT_EQ(image.data[2], std::lround(255 * srgbFromLinear(0.36)))
        << "background (0, 0, 1) at exposure 0.36";
    choice.ev100 = 0;
    EXPECT_DOUBLE_EQ(exposureFor(choice, nullptr, {}).factor, 1 / 1.2);
    choice.exposure = 3;
    EXPECT_EQ(exposureFor(choice, nullptr, {}).factor, 3);
}

TEST(ChannelImage, SrgbByTheStandard) {
    EXPECT_EQ(srgbFromLinear(0), 0);
    EXPECT_DOUBLE_EQ(srgbFromLinear(1), 1);
    EXPECT_NEAR(srgbFromLinear(0.0031308), 0.04045, 1e-5) << "both pieces meet";
    EXPECT_NEAR(srgbFromLinear(0.2158605), 0.5019608, 1e-6) << "code 128";
}

// Below its shoulder the tone curve only subtracts the Fresnel offset of 0.04. It is monotonic and stays
// within [0, 1].
TEST(ChannelImage, PbrNeutral) {
    const auto mid = pbrNeutral({0.5f, 0.4f, 0.3f});
    EXPECT_FLOAT_EQ(mid[0], 0.46f);
    EXPECT_FLOAT_EQ(mid[2], 0.26f);
    float last = -1;
    for (float x = 0; x < 1000; x = x * 1.1f + 0.01f) {
        const float y = pbrNeutral({x, x, x})[0];
        EXPECT_GT(y, last - 1e-6f);
        EXPECT_LE(y, 1);
        last = y;
    }
}

TEST(ChannelImage, ErrorsBrightenMonotonicallyAndWhatIsBeyondStandsOut) {
    double last = -1;
    for (int i = 0; i <= 64; ++i) {
        const auto c = errorColor(i / 64.0);
        const double y = 0.2126 * decodedSrgb(c[0] / 255.0) + 0.7152 * decodedSrgb(c[1] / 255.0) +
                         0.0722 * decodedSrgb(c[2] / 255.0);
        EXPECT_GT(y, last) << i;
        last = y;
    }
    Image errors(4, 1, 1);
    errors.data = {0, 0.5f, 2, std::numeric_limits<float>::infinity()};
    const Image8 image = errorMap(errors, 1);
    const auto at = [&](std::size_t i) {
        return std::array<std::uint8_t, 3>{image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]};
    };
    EXPECT_EQ(at(0), (std::array<std::uint8_t, 3>{}));
    EXPECT_NE(at(1), at(0));
    EXPECT_EQ(at(2), beyondColor);
    EXPECT_EQ(at(3), nonfiniteColor);
}

TEST(ChannelImage, WhatWasRepairedIsMarked) {
    Frame frame;
    frame.settings.size = {3, 1};
    frame.channels[Channel::lit] = Image(3, 1, 3, 0.5f);
    frame.channels[Channel::material_id] = Image(3, 1, 1, 0.0f);
    frame.repaired[Channel::lit] = {1};
    const Image8 drawn = channelImage(debugMode(Channel::lit), frame, {});
    const auto at = [&](std::size_t i) {
        return std::array<std::uint8_t, 3>{drawn.data[3 * i], drawn.data[3 * i + 1], drawn.data[3 * i + 2]};
    };
    EXPECT_EQ(at(1), nonfiniteColor);
    EXPECT_NE(at(0), nonfiniteColor);
    EXPECT_EQ(at(2), at(0));
}

TEST(ChannelImage, HalfSizeAverages) {
    const Image8 image{2, 2, 3, {0, 0, 0, 4, 4, 4, 8, 8, 8, 12, 12, 12}};
    EXPECT_EQ(halfSize(image).data, (std::vector<std::uint8_t>{6, 6, 6}));
    EXPECT_EQ(halfSize({4, 2, 1, {0, 4, 100, 200, 8, 12, 60, 40}}).data, (std::vector<std::uint8_t>{6, 100}));
    EXPECT_EQ(halfSize({1, 1, 3, {9, 8, 7}}).data, (std::vector<std::uint8_t>{9, 8, 7}));
}

}  // namespace
}  // namespace diptych
