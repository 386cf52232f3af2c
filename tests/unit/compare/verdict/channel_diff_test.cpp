// SPDX-License-Identifier: MIT
// A channel's verdict: the last value that passes, the first that fails, and the tolerance for another
// device and for noise.
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace diptych {
namespace {

// Both paths of the small scene; only this channel is compared.
std::vector<Frame> framesOf(Channel mode) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) frame.requested = {mode};
    return frames;
}

const ChannelDiff& channelIn(const Comparison& comparison, Channel mode) {
    return *std::ranges::find_if(comparison.channels,
                                 [&](const ChannelDiff& channel) { return channel.mode->channel == mode; });
}

// Deferred against forward+, by default on a CPU.
Comparison comparedPair(const std::vector<Frame>& frames, const CompareOptions& options = {},
                        const ReportDevice& device = {"a CPU", "1.0", "cpu"}) {
    Report report;
    report.device = device;
    report.frames = frames;
    return compareFrames(report, 0, 1, {}, options);
}

TEST(ChannelDiff, PassesUpToItsToleranceAndNoFurther) {
    for (const Channel mode : {Channel::metallic, Channel::roughness, Channel::occlusion}) {
        std::vector<Frame> frames = framesOf(mode);
        const double max = channelIn(comparedPair(frames), mode).tolerance.max;
        ASSERT_GT(max, 0) << debugMode(mode).name;
        const auto verdictAt = [&](double fraction) {
            frames[1].channels.at(mode).at(1, 2) = static_cast<float>(0.5 + fraction * max);
            const Comparison comparison = comparedPair(frames);
            EXPECT_EQ(comparison.passed(), channelIn(comparison, mode).verdict == Verdict::pass);
            return channelIn(comparison, mode).verdict;
        };
        EXPECT_EQ(verdictAt(0.99), Verdict::pass) << debugMode(mode).name;
        EXPECT_EQ(verdictAt(1.01), Verdict::fail) << debugMode(mode).name;
        EXPECT_EQ(verdictAt(-0.99), Verdict::pass) << debugMode(mode).name;
        EXPECT_EQ(verdictAt(-1.01), Verdict::fail) << debugMode(mode).name;
        EXPECT_EQ(verdictAt(1.9), Verdict::fail) << debugMode(mode).name;
    }
}

// Bitwise identical if this very CPU drew both. Another device or driver, or a GPU, may differ by 16 ULP.
TEST(ChannelDiff, ImagesOfAnotherDeviceMayBeRoundedOtherwise) {
    std::vector<Frame> frames = framesOf(Channel::depth);
    float& depth = frames[0].channels.at(Channel::depth).at(1, 2);
    depth = std::nextafter(depth, 1.0f);
    const auto verdict = [&](const ReportDevice& device) {
        return channelIn(comparedPair(frames, {}, device), Channel::depth).verdict;
    };
    const ReportDevice here{"a CPU", "1.0", "cpu"};
    EXPECT_EQ(verdict(here), Verdict::fail);
    EXPECT_EQ(verdict({"a GPU", "1.0", "discrete"}), Verdict::pass);
    for (Frame& frame : frames) {
        frame.origin = {"kept.exr", "a CPU", "1.0", ""};
        EXPECT_EQ(verdict(here), Verdict::fail) << "a file of this device";
        frame.origin = {"kept.exr", "another CPU", "1.0", ""};
        EXPECT_EQ(verdict(here), Verdict::pass);
        frame.origin = {"kept.exr", "a CPU", "0.9", ""};
        EXPECT_EQ(verdict(here), Verdict::pass);
        frame.origin = {};
    }
    depth += 20 * 0x1p-24f;
    EXPECT_EQ(verdict({"a GPU", "1.0", "discrete"}), Verdict::fail) << "20 ULP of a half";
}

// Non-finite values are reported before the metric. A black baseline, whose relative error is infinite
// too, is reported after it.
TEST(ChannelDiff, SaysWhyAnErrorIsInfinite) {
    std::vector<Frame> frames = framesOf(Channel::metallic);
    float &here = frames[0].channels.at(Channel::metallic).at(1, 2),
          &there = frames[1].channels.at(Channel::metallic).at(1, 2);
    const auto reason = [&](Channel mode) { return channelIn(comparedPair(frames), mode).reason; };
    there = 0.75f;
    EXPECT_TRUE(reason(Channel::metallic).starts_with("max 0.25 exceeds")) << reason(Channel::metallic);
    here = std::nanf("");
    there = HUGE_VALF;
    EXPECT_TRUE(reason(Channel::metallic)
                    .starts_with("NaN or infinity at 1 pixel of deferred and 1 pixel of forward_plus; max "
                                 "inf exceeds"))
        << reason(Channel::metallic);

    frames = framesOf(Channel::lit);
    std::ranges::fill(frames[0].channels.at(Channel::lit).data, 0.0f);
    EXPECT_TRUE(
        reason(Channel::lit).ends_with("; the error is infinite at 1 pixel: the baseline is 0 everywhere"))
        << reason(Channel::lit);
}

// The tolerance includes the sum of both paths' differences between two runs, and no more.
TEST(ChannelDiff, TheNoiseOfBothPathsIsGranted) {
    std::vector<Frame> frames = framesOf(Channel::roughness);
    frames[0].noise[Channel::roughness] = {3, 0.125};
    frames[1].noise[Channel::roughness] = {1, 0.25};
    frames[1].channels.at(Channel::roughness).at(1, 2) += 0.375f;
    CompareOptions allowed;
    allowed.allow_noise = true;
    const ReportDevice card{"a GPU", "1.0", "discrete"};
    const Comparison strict = comparedPair(frames, {}, card), noisy = comparedPair(frames, allowed, card);
    EXPECT_FALSE(strict.passed());
    EXPECT_TRUE(noisy.passed());
    EXPECT_NEAR(channelIn(noisy, Channel::roughness).tolerance.max,
                channelIn(strict, Channel::roughness).tolerance.max + 0.375, 1e-12);
    frames[1].channels.at(Channel::roughness).at(1, 2) += 0.01f;
    EXPECT_FALSE(comparedPair(frames, allowed, card).passed());
}

// A value that no channel may have fails even if both images have it, at covered pixels alone.
TEST(ChannelDiff, AValueOutOfRangeFailsByName) {
    struct Row {
        Channel mode;
        std::vector<float> value;
        const char* fault;  // nullptr: none
    };
    const Row rows[] = {
        {Channel::normals, {0, 2, 0}, "vectors are not of unit length at 1 pixel, the worst 2 at 1,2"},
        {Channel::normals, {0, 0, 0}, "vectors are not of unit length at 1 pixel, the worst 0 at 1,2"},
        {Channel::normals, {0, 0.6f, 0.8f}, nullptr},
        {Channel::anisotropy_direction, {0, 0, 0}, nullptr},
        {Channel::anisotropy_direction,
         {0, 0, 0.5f},
         "vectors are neither 0 nor of unit length at 1 pixel, the worst 0.5 at 1,2"},
        {Channel::metallic, {1}, nullptr},
        {Channel::metallic, {1.25f}, "values are not between 0 and 1 at 1 pixel, the worst 1.25 at 1,2"},
        {Channel::metallic, {-0.25f}, "values are not between 0 and 1 at 1 pixel, the worst -0.25 at 1,2"},
        {Channel::albedo,
         {-0.25f, 0.5f, 1.5f},
         "values are not between 0 and 1 at 1 pixel, the worst 1.5 at 1,2"},
        {Channel::depth, {7}, nullptr},
        {Channel::depth, {-7}, "values are negative at 1 pixel, the worst -7 at 1,2"},
        {Channel::position, {-7, -8, -9}, nullptr}};
    for (const Row& row : rows) {
        std::vector<Frame> frames = framesOf(row.mode);
        for (Frame& frame : frames)
            std::ranges::copy(row.value, frame.channels.at(row.mode).pixel(
                                             frame.channels.at(row.mode).offset(1, 2) / row.value.size()));
        EXPECT_EQ(channelIn(comparedPair(frames), row.mode).reason,
                  row.fault ? std::string("deferred: ") + row.fault : "")
            << debugMode(row.mode).name << row.value[0];
    }
    // Two pixels, the worst second; one of the test alone; background and files have no range.
    std::vector<Frame> frames = framesOf(Channel::metallic);
    for (Frame& frame : frames) {
        frame.channels.at(Channel::material_id).at(3, 0) = 3;
        frame.channels.at(Channel::metallic).at(3, 0) = 1.25f;
        frame.channels.at(Channel::metallic).at(1, 2) = 2;
        frame.channels.at(Channel::metallic).at(0, 0) = 9;
    }
    EXPECT_EQ(channelIn(comparedPair(frames), Channel::metallic).reason,
              "deferred: values are not between 0 and 1 at 2 pixels, the worst 2 at 1,2");
    frames[0].origin = {"kept.exr", "a CPU", "1.0", ""};
    EXPECT_EQ(channelIn(comparedPair(frames), Channel::metallic).reason,
              "forward_plus: values are not between 0 and 1 at 2 pixels, the worst 2 at 1,2");
    frames[1].origin = frames[0].origin;
    EXPECT_EQ(channelIn(comparedPair(frames), Channel::metallic).reason, "");
}

TEST(ChannelDiff, HowMuchOfItsToleranceIsUsed) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    struct Row {
        Verdict verdict;
        double max;
        std::optional<std::uint64_t> unexplained;
        std::optional<double> measured;
        double used;
    };
    for (const Row& row : {Row{Verdict::pass, 1, {}, 1, 0.25},
                           {Verdict::fail, 1, {}, 8, 2},
                           {Verdict::informative, 1, {}, {}, 0},
                           {Verdict::pass, 0, {}, 1, 0},
                           {Verdict::forward_only, 1, {}, 1, 0},
                           {Verdict::deferred_only, 1, {}, 1, 0},
                           {Verdict::fail, 1, 2, 1, endless},
                           {Verdict::fail, 1, 0, 1, 0.25},
                           {Verdict::pass, 1, 2, 1, 0.25}}) {
        ChannelDiff channel;
        channel.verdict = row.verdict;
        channel.stats.max = row.max;
        channel.unexplained_pixels = row.unexplained;
        if (row.measured) {
            channel.criterion.emplace();
            channel.criterion->measured = *row.measured;
            channel.criterion->limit = 4;
        }
        EXPECT_EQ(usedFraction(channel), row.used) << nameOf(row.verdict);
    }
}

// Without a bound on the largest error, a rule leaves it open.
TEST(ChannelDiff, ARulesToleranceIsItsBoundOnTheLargestError) {
    std::vector<Frame> frames = framesOf(Channel::metallic);
    for (const auto& [member, max] :
         {std::pair{"max", 0.5}, {"mean", std::numeric_limits<double>::infinity()}}) {
        CompareOptions options;
        options.rules = rulesFromJson(std::string(R"({"rules": [{"channel": "metallic", ")") + member +
                                          R"(": 0.5, "because": "half"}]})",
                                      "t.json");
        const ChannelDiff channel = channelIn(comparedPair(frames, options), Channel::metallic);
        EXPECT_EQ(channel.tolerance.max, max);
        EXPECT_EQ(channel.tolerance.because, "half");
        EXPECT_EQ(channel.rule, std::string("t.json, rule 1: ") + member + " <= 0.5");
    }
}

}  // namespace
}  // namespace diptych
