// SPDX-License-Identifier: MIT
// Channels as images.
#include "compare/image/channel_image.h"
#include "tests/support/report_builder.h"
#include "tests/support/srgb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
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

// Black surfaces count with a thousandth of the mean; negative light and uncovered pixels do not count.
TEST(ChannelImage, TheLogAverageIsThatOfCoveredLight) {
    Image lit(4, 1, 3, 0.0f);
    for (int c = 0; c < 3; ++c) lit.at(1, 0, c) = 0.5f, lit.at(2, 0, c) = -1, lit.at(3, 0, c) = 7;
    Coverage three;
    three.covered = {true, true, true, false};
    EXPECT_NEAR(exposureFor({}, &lit, three).factor, 0.18 / std::sqrt(0.5 * 0.001 * 0.25), 1e-6);
    three.covered = {true, false, true, false};
    EXPECT_EQ(exposureFor({}, &lit, three).factor, 1) << "nothing is lit";
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

// What has no range of its own is shown as it is.
TEST(ChannelImage, OnlyLengthsCountsAndIndicesAreNormalised) {
    const std::set<std::string_view> normalised{"depth",
                                                "position",
                                                "shaded_samples",
                                                "light_count",
                                                "iridescence_ior",
                                                "dispersion",
                                                "iridescence_thickness",
                                                "transmission_thickness",
                                                "attenuation_distance"};
    Frame frame = bothFrames()[0];
    for (auto& [channel, image] : frame.channels) std::ranges::fill(image.data, 10.0f);
    const Frame* frames[] = {&frame};
    for (const auto& [channel, image] : frame.channels) {
        const DebugMode& mode = debugMode(channel);
        const std::string text = scaleFor(mode, {}, frames).text;
        EXPECT_EQ(text.find("10") != text.npos, normalised.contains(mode.name)) << mode.name << ": " << text;
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
    const Image8 mapped = channelImage(lit, frame, scaleFor(lit, {0.36, true, ""}, frames));
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(mapped.data.at(static_cast<std::size_t>(c)),
                  std::lround(255 * srgbFromLinear(pbrNeutral({0, 0, 0.36f})[static_cast<std::size_t>(c)])))
            << "the tone curve";
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

// The Khronos PBR Neutral tone mapper as it is specified, in double precision. It is monotonic and stays
// within [0, 1].
TEST(ChannelImage, PbrNeutral) {
    for (const std::array<float, 3> rgb : {std::array{0.5f, 0.4f, 0.3f},
                                           {0.05f, 0.02f, 0.3f},
                                           {3.0f, 0.5f, 0.07f},
                                           {0.85f, 0.9f, 0.2f},
                                           {9.0f, 8.0f, 7.0f},
                                           {0.0f, 0.0f, 0.8f}}) {
        const double x = std::min({rgb[0], rgb[1], rgb[2]}), offset = x < 0.08 ? x - 6.25 * x * x : 0.04,
                     peak = std::max({rgb[0], rgb[1], rgb[2]}) - offset;
        for (std::size_t c = 0; c < 3; ++c) {
            double expected = rgb[c] - offset;
            if (peak >= 0.76) {
                const double compressed = 1 - 0.24 * 0.24 / (peak + 0.24 - 0.76),
                             g = 1 - 1 / (0.15 * (peak - compressed) + 1);
                expected = (1 - g) * expected * compressed / peak + g * compressed;
            }
            EXPECT_NEAR(pbrNeutral(rgb)[c], expected, 2e-6) << rgb[0] << " " << c;
        }
    }
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
    EXPECT_EQ(halfSize({4, 2, 1, {0, 0, 0, 0, 1, 1, 1, 0}}).data, (std::vector<std::uint8_t>{1, 0}))
        << "a half is rounded up";
}

}  // namespace
}  // namespace diptych
