// SPDX-License-Identifier: MIT
// A path's tolerance against a reference that integrates the environment, for each of the path's
// environment methods.
#include "compare/verdict/environment_cost.h"

#include "compare/verdict/approximation_errors.h"
#include "compare/verdict/channel_diff.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace diptych {
namespace {

struct EvaluatedPair {
    Frame reference, path;
    Requirements needs;
    Coverage coverage = everyPixel(1);

    EvaluatedPair() {
        reference.settings.path = Path::reference;
        reference.environment_costs = Image(1, 1, 9);
        std::ranges::copy(std::vector<float>{1, 2, 3, 10, 20, 30, 100, 1000, 10000},
                          reference.environment_costs.data.begin());
        path.settings.path = Path::forward_plus;
        path.settings.ibl_samples = 64;
    }
    FramePair pair() const { return {reference, path, needs, coverage}; }
    double allowed(Channel mode) const { return EnvironmentCost(pair()).allowed(debugMode(mode), 0); }
    std::string because(Channel mode) const { return EnvironmentCost(pair()).because(debugMode(mode)); }
};

TEST(EnvironmentCost, IsThatOfThePathsSettings) {
    EvaluatedPair p;
    const double spread = 4 * std::numbers::pi / 64;
    EXPECT_EQ(p.allowed(Channel::lit_diffuse), 1);
    EXPECT_NEAR(p.allowed(Channel::lit_specular), 10 + spread * 1000 + filteredFraction * 10000, 1e-9);
    EXPECT_NEAR(p.allowed(Channel::lit), 1 + 10 + spread * 1000 + filteredFraction * 10000, 1e-9);
    EXPECT_EQ(p.allowed(Channel::lit_ambient), 0);
    EXPECT_EQ(p.allowed(Channel::albedo), 0);
    p.path.settings.ibl_diffuse = IblDiffuse::map;
    p.path.settings.ibl_bias = 1;
    EXPECT_EQ(p.allowed(Channel::lit_diffuse), 3);
    EXPECT_NEAR(p.allowed(Channel::lit_specular), 30 + 4 * spread * 1000 + filteredFraction * 10000, 1e-9);
    p.path.settings.ibl = Ibl::sampled;
    EXPECT_NEAR(p.allowed(Channel::lit_specular), 100 + 4 * spread * 1000 + sampledFraction / 8 * 10000,
                1e-9);
}

TEST(EnvironmentCost, PartsOfSpecularLightAreGrantedAllOfIt) {
    const EvaluatedPair p;
    EXPECT_GT(p.allowed(Channel::lit_specular), 0);
    for (const Channel mode : {Channel::lit_clearcoat, Channel::lit_sheen})
        EXPECT_EQ(p.allowed(mode), p.allowed(Channel::lit_specular)) << debugMode(mode).name;
    EXPECT_EQ(p.allowed(Channel::lit_transmission), p.allowed(Channel::lit_diffuse));
}

TEST(EnvironmentCost, IsGrantedAgainstTheReferenceAlone) {
    EvaluatedPair p;
    EXPECT_TRUE(EnvironmentCost(p.pair()).any());
    p.reference.environment_costs = {};
    EXPECT_FALSE(EnvironmentCost(p.pair()).any());
    EXPECT_EQ(EnvironmentCost(p.pair()).allowed(debugMode(Channel::lit), 0), 0);
    EvaluatedPair q;
    q.reference.settings.path = Path::deferred;
    EXPECT_FALSE(EnvironmentCost(q.pair()).any());
}

TEST(EnvironmentCost, IsTakenFromThePixelsError) {
    EvaluatedPair p;
    p.reference.channels[Channel::lit_diffuse] = Image(1, 1, 3, 10.0f);
    for (const auto& [value, excess] : {std::pair{10.9f, 0.0}, {11.5f, 0.05}, {8.0f, 0.1}}) {
        p.path.channels[Channel::lit_diffuse] = Image(1, 1, 3, value);
        const auto errors = certainErrors(debugMode(Channel::lit_diffuse), p.pair());
        ASSERT_TRUE(errors);
        EXPECT_NEAR(errors->at(0), excess, 1e-6) << value;
    }
}

TEST(EnvironmentCost, WhatItTakesOfLitIsSaidWithItsSetting) {
    EvaluatedPair p;
    p.reference.environment_costs.data = {1, 0, 0, 3, 0, 0, 0, 0, 0};
    const DebugMode& lit = debugMode(Channel::lit);
    p.reference.channels[lit.channel] = Image(1, 1, 3, 10.0f);
    p.path.channels[lit.channel] = Image(1, 1, 3, 12.0f);
    const std::vector<ApproximationError> errors = approximationErrors(lit, p.pair());
    EXPECT_EQ(approximationErrorText(lit, errors),
              "lit is off by 20 % in the mean, granted to split IBL (p99.9 15 %): --ibl sampled; diffuse IBL "
              "(p99.9 5 %): --ibl-diffuse map");
    const auto evaluated = [&](float value, const char* max) {
        p.path.channels[lit.channel] = Image(1, 1, 3, value);
        const std::string text =
            fmt::format(R"({{"rules": [{{"channel": "lit", "granted": {}, "because": "x"}}]}})", max);
        const std::vector<Rule> rules = rulesFromJson(text, "t.json");
        return diffChannel(lit, p.pair(), rules, false);
    };
    EXPECT_EQ(evaluated(12, "0.25").verdict, Verdict::pass);
    EXPECT_EQ(evaluated(12, "0.15").reason, "granted 0.2 exceeds 0.15; 100 % of the pixels differ");
    EXPECT_NEAR(meanApproximationError(evaluated(20, "1").approximation_errors), 0.4, 1e-6)
        << "what tolerances take of an error of 1";
    EXPECT_EQ(evaluated(20, "1").verdict, Verdict::fail) << "the rest of it";
    p.reference.environment_costs = {};
    EXPECT_TRUE(approximationErrors(lit, p.pair()).empty());
}

// A part of each kind's tolerance is taken, here a tenth: the allowed errors are 1, 2, 3, 5 and 6 of 10.
TEST(ApproximationErrors, EachHasItsNameAndTheSettingThatRemovesIt) {
    EvaluatedPair p;
    const DebugMode& lit = debugMode(Channel::lit);
    p.reference.channels[lit.channel] = p.reference.unblended = Image(1, 1, 3, 10.0f);
    p.reference.channels[Channel::lit_haze] = Image(1, 1, 3, 600.0f);
    p.reference.shadow_edge = Image(1, 1, 2);
    p.reference.shadow_edge.data = {0, 1};
    p.reference.environment_costs.data = {2, 0, 20, 3, 0, 0, 4, 0, 0};
    p.reference.blended = Image(1, 1, 3);
    p.reference.blended.data = {1, 0.5f, 0};
    p.path.channels[lit.channel] = Image(1, 1, 3, 100.0f);
    p.path.channels[Channel::depth] = Image(1, 1, 1, 1.0f);
    p.path.shadow_filter_radii = {{10, 0.1}};
    p.path.settings.haze = true;
    p.path.settings.haze_march_steps = 10;
    const auto said = [&] { return approximationErrorText(lit, approximationErrors(lit, p.pair())); };
    EXPECT_EQ(
        said(),
        "lit is off by 170 % in the mean, granted to steps through haze (p99.9 60 %): --haze-march-steps "
        "0; blending and glass (p99.9 50 %); split IBL (p99.9 30 %): --ibl sampled; diffuse IBL (p99.9 "
        "20 %): --ibl-diffuse map; shadow filtering (p99.9 10 %)");
    p.path.settings.ibl = Ibl::sampled;
    p.path.settings.ibl_diffuse = IblDiffuse::map;
    EXPECT_EQ(
        said(),
        "lit is off by 360 % in the mean, granted to diffuse IBL (p99.9 200 %); steps through haze (p99.9 "
        "60 %): --haze-march-steps 0; blending and glass (p99.9 50 %); 64 samples of IBL (p99.9 40 %): "
        "--ibl-samples 128")
        << "a twentieth of the largest is not said";
    p.coverage = {};
    EXPECT_EQ(said(), "");
}

TEST(EnvironmentCost, SaysHowLightIsIntegrated) {
    EvaluatedPair p;
    const std::string end = " at each pixel, as the reference integrates it",
                      split = fmt::format("the split sum, the spread of its maps' samples and {:.3g} %",
                                          100 * filteredFraction),
                      harmonics = "irradiance by harmonics of order 2 and the base's mean share of it";
    EXPECT_EQ(p.because(Channel::lit_diffuse), "; plus the error of " + harmonics + end);
    EXPECT_EQ(p.because(Channel::lit_specular), "; plus the error of " + split + end);
    EXPECT_EQ(p.because(Channel::lit), "; plus the error of " + harmonics + ", " + split + end);
    p.path.settings.ibl = Ibl::sampled;
    p.path.settings.ibl_diffuse = IblDiffuse::map;
    EXPECT_EQ(
        p.because(Channel::lit_environment),
        fmt::format("; plus the error of irradiance by a map and the base's mean share of it, 64 samples "
                    "of the lobe, their spread and {:.3g} %,{}",
                    100 * sampledFraction / 8, end));
    EXPECT_EQ(p.because(Channel::lit_ambient), "");
}

}  // namespace
}  // namespace diptych
