// SPDX-License-Identifier: MIT
// Text of a pixel breakdown for given steps and light terms, without drawing.
#include "compare/explain/pixel_breakdown.h"
#include "compare/output/writers.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace diptych {
namespace {

PixelStep stepOf(Channel mode, const PixelValue& a, const PixelValue& b, double tolerance) {
    PixelStep step;
    step.mode = &debugMode(mode);
    step.values = {a, b, {}};
    step.difference = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        step.difference = std::max(step.difference, std::abs(a[i] - b[i]));
    step.differs = step.difference > 0;
    step.tolerance = {tolerance, "half a step"};
    step.beyond = step.isCompared() && step.difference > tolerance;
    return step;
}

PixelBreakdown breakdownOf(std::vector<PixelStep> steps) {
    PixelBreakdown breakdown;
    breakdown.names = {"deferred", "forward_plus"};
    breakdown.shown = true;
    breakdown.steps = std::move(steps);
    for (const PixelTerm::Kind kind : {PixelTerm::Kind::sum, PixelTerm::Kind::lit, PixelTerm::Kind::residual})
        breakdown.terms.push_back({.kind = kind});
    return breakdown;
}

// A channel that is not a step would be omitted silently.
TEST(PixelBreakdown, EveryChannelIsAStepOnce) {
    std::vector<Channel> steps(pixelSteps().begin(), pixelSteps().end()), all;
    std::ranges::sort(steps);
    for (const DebugMode& mode : debugModes()) all.push_back(mode.channel);
    EXPECT_EQ(steps, all);
    EXPECT_EQ(pixelSteps().back(), Channel::lit) << "what all else makes";
    // The light terms come after the inputs of lighting and before its results.
    EXPECT_TRUE(std::ranges::is_partitioned(pixelSteps(), [](Channel mode) { return !isAfterTerms(mode); }));
}

TEST(PixelBreakdown, NamesTheFirstStepThatDiffers) {
    PixelBreakdown breakdown =
        breakdownOf({stepOf(Channel::depth, {1}, {1}, 0), stepOf(Channel::roughness, {0.3}, {0.30012}, 0.002),
                     stepOf(Channel::lit, {1, 1, 1}, {1, 1, 1.5}, 0.01)});
    EXPECT_EQ(
        firstDifference(breakdown),
        "the first step that differs by more than rounding: roughness (0.30012 against 0.3, 0.00012 in its "
        "metric, absolute, tolerance 0.002: half a step)");
    std::string text = inText(blocksOf(breakdown));
    EXPECT_NE(text.find("2 channels differ: roughness, lit\n"), std::string::npos) << text;
    EXPECT_NE(text.find("FAIL: at this pixel beyond tolerance: lit\n"), std::string::npos) << text;
    // Rounding does not count as a difference.
    breakdown.steps[1].differs = breakdown.steps[2].differs = false;
    breakdown.steps[2].beyond = false;
    EXPECT_EQ(firstDifference(breakdown), "no step differs by more than rounding");
    text = inText(blocksOf(breakdown));
    EXPECT_NE(text.find("pass: at this pixel all 3 shared channels"), std::string::npos) << text;
    EXPECT_EQ(toJson(breakdown)["first_difference"], nullptr);
}

// If only light differs, its term comes before the channels it affects.
TEST(PixelBreakdown, ATermComesBeforeTheLightItMakes) {
    PixelBreakdown breakdown = breakdownOf(
        {stepOf(Channel::depth, {1}, {1}, 0), stepOf(Channel::lit, {1, 1, 1}, {1, 1, 1.5}, 0.01)});
    breakdown.lights.push_back({.name = "lamp", .kind = "point"});
    PixelTerm lamp{.lights = {0}};
    lamp.values = {glm::dvec3(1), glm::dvec3(1, 1, 1.5), glm::dvec3(0)};
    lamp.has_reference = false;
    lamp.difference = 0.5;
    lamp.differs = true;
    breakdown.terms.insert(breakdown.terms.begin(), lamp);
    EXPECT_EQ(
        firstDifference(breakdown),
        "the first step that differs by more than rounding: light 0, point \"lamp\" (1 1 1.5 against 1 1 1 "
        "W/(sr m^2), relative difference 0.5; the surfaces are the same)");
    EXPECT_EQ(toJson(breakdown)["first_difference"], "light 0");
}

TEST(PixelBreakdown, ShowsAsManyDigitsAsADifferenceTakes) {
    const PixelBreakdown breakdown = breakdownOf({stepOf(Channel::metallic, {0.25}, {0.25000003}, 1)});
    EXPECT_NE(firstDifference(breakdown).find("0.25000003 against 0.25,"), std::string::npos)
        << firstDifference(breakdown);
}

}  // namespace
}  // namespace diptych
