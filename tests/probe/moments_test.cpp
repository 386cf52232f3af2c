// SPDX-License-Identifier: MIT
// Moments of warped depth compared with closed forms.
#include "shared/shadow/moments.h"
#include "tests/probe/moment_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace diptych {
namespace {

std::vector<MomentResult> seen(const std::vector<MomentFilter>& filters) {
    return seenThrough(gpu::SHADOWS_EVSM, filters);
}
using Filter = MomentFilter;
using Result = MomentResult;

// Two distant occluders cover half of the filter each, and the receiver lies D behind the second. With x =
// c D / range, Chebyshev's bound transmits 1 / (1 + (2 e^x - 1)^2) of the light.
TEST(Moments, LeakBehindTwoHalvesIsTheClosedForm) {
    for (const float nearest : {0.0f, -1.0f})
        for (const float exponent : {5.0f, 20.0f, 40.0f}) {
            std::vector<Filter> filters;
            const std::vector<double> behind{0.001, 0.005, 0.01, 0.025, 0.05, 0.1, 0.3};
            for (const double d : behind)
                filters.push_back({.near = 0.999f,
                                   .far = 0.4f,
                                   .receiver = static_cast<float>(0.4 - d),
                                   .exponent = exponent,
                                   .nearest = nearest});
            const std::vector<Result> results = seen(filters);
            for (std::size_t i = 0; i < behind.size(); ++i) {
                // The formula ignores the first occluder's contribution to the moments.
                const double scale = double{exponent} * (nearest < 0 ? 2 : 1);
                if (scale * 0.599 < 8) continue;
                const double leak = 1 / (1 + std::pow(2 * std::exp(scale * behind[i]) - 1, 2));
                EXPECT_NEAR(double{results[i].visibility}, leak, 0.02) << exponent << " " << behind[i];
            }
        }
}

// In front of everything: lit. Far behind: dark. Half and half: half at the farther depth.
TEST(Moments, ASingleDepthIsAllOrNothing) {
    const std::vector<Result> results = seen({{.near = 0.5f, .far = 0.5f, .receiver = 0.6f},
                                              {.near = 0.5f, .far = 0.5f, .receiver = 0.5f},
                                              {.near = 0.5f, .far = 0.5f, .receiver = 0.2f},
                                              {.near = 0.9f, .far = 0.2f, .receiver = 0.2f}});
    EXPECT_EQ(results[0].visibility, 1);
    EXPECT_EQ(results[1].visibility, 1);
    EXPECT_NEAR(results[2].visibility, 0, 1e-4);
    EXPECT_NEAR(results[3].visibility, 0.5, 1e-4);
}

// Planar receiver: depths in the filter are symmetric about its own. The minimum variance hides rounding
// of the moments; without it, a plane that is flat to 1e-6 of the range would shadow itself.
TEST(Moments, APlaneNeverShadowsItself) {
    std::vector<Filter> filters;
    for (const float slope : {1e-6f, 1e-4f, 1e-3f, 1e-2f, 0.1f, 0.3f})
        filters.push_back({.near = 0.5f + slope,
                           .far = 0.5f - slope,
                           .receiver = 0.5f,
                           .min_variance = Settings().evsm_min_variance});
    for (const Result& result : seen(filters)) EXPECT_NEAR(result.visibility, 1, 1e-6);
}

// Light below the bleeding threshold is cut off, and the rest rescaled to [0, 1].
TEST(Moments, BleedReductionAndLeastVariance) {
    const Filter half{.near = 0.9f, .far = 0.2f, .receiver = 0.2f};
    Filter reduced = half, gone = half, soft{.near = 0.5f, .far = 0.5f, .receiver = 0.49f, .exponent = 5};
    reduced.bleed = 0.2f;
    gone.bleed = 0.6f;
    Filter softer = soft;
    softer.min_variance = 1e-4f;
    const std::vector<Result> results = seen({half, reduced, gone, soft, softer});
    EXPECT_NEAR(results[1].visibility, (0.5 - 0.2) / 0.8, 1e-4);
    EXPECT_EQ(results[2].visibility, 0);
    EXPECT_LT(results[3].visibility, 0.01f);
    // A standard deviation of 0.01 and a distance of 0.01; a little less because of the warp.
    EXPECT_NEAR(results[4].visibility, 0.5, 0.03);
}

// With the formats' largest exponents, all moments stay finite and all visibilities in [0, 1].
TEST(Moments, StayFiniteUpToTheLargestExponent) {
    EXPECT_NEAR(largestExponent(false), 44.36, 0.01);
    EXPECT_NEAR(largestExponent(true), 5.54, 0.01);
    std::vector<Filter> filters;
    for (const float nearest : {0.0f, -1.0f})
        for (const float near : {0.0f, 0.3f, 1.0f, 7.0f})
            for (const float receiver : {-3.0f, 0.0f, 0.5f, 1.0f, 7.0f})
                filters.push_back(
                    {.near = near, .far = 0, .receiver = receiver, .exponent = 44.36f, .nearest = nearest});
    for (const Result& r : seen(filters)) {
        EXPECT_TRUE(std::isfinite(r.moments[0]) && std::isfinite(r.moments[1]));
        EXPECT_GE(r.visibility, 0);
        EXPECT_LE(r.visibility, 1);
    }
}

// 32 bits if the device filters them; otherwise 16, whatever was requested.
TEST(MomentFormat, FollowsWhatTheDeviceFilters) {
    const MomentSupport all{true, true}, no32{false, true};
    for (const Shadows shadows : {Shadows::evsm, Shadows::evsm4}) {
        const auto of = [&](EvsmPrecision asked, const MomentSupport& device) {
            return momentFormat(shadows, asked, device);
        };
        EXPECT_FALSE(of(EvsmPrecision::automatic, all).half);
        EXPECT_FALSE(of(EvsmPrecision::fp32, all).half);
        EXPECT_TRUE(of(EvsmPrecision::fp32, all).because.empty());
        EXPECT_TRUE(of(EvsmPrecision::fp16, all).half);
        for (const EvsmPrecision asked : {EvsmPrecision::automatic, EvsmPrecision::fp32}) {
            EXPECT_TRUE(of(asked, no32).half);
            EXPECT_NE(of(asked, no32).because.find("does not filter"), std::string::npos);
        }
    }
    EXPECT_EQ(momentFormat(Shadows::evsm4, EvsmPrecision::fp32, all).format, VK_FORMAT_R32G32B32A32_SFLOAT);
    EXPECT_EQ(momentFormat(Shadows::evsm4, EvsmPrecision::fp16, all).format, VK_FORMAT_R16G16B16A16_SFLOAT);
}

// Four moments of depth take 64 bits a texel, as integers if the device stores and filters them. Otherwise
// they take more memory or more bias, and the reason is reported.
TEST(MomentFormat, OfFourMomentsIsInIntegersWhereTheDeviceHasThem) {
    const auto of = [](const MomentSupport& device) {
        return momentFormat(Shadows::msm4, EvsmPrecision::automatic, device);
    };
    EXPECT_EQ(of({true, true}).format, VK_FORMAT_R16G16B16A16_UNORM);
    EXPECT_EQ(of({false, true}).format, VK_FORMAT_R16G16B16A16_UNORM);
    EXPECT_EQ(of({true, true}).bias, 6e-5);
    EXPECT_TRUE(of({true, true}).because.empty());
    EXPECT_EQ(of({true, false}).format, VK_FORMAT_R32G32B32A32_SFLOAT);
    EXPECT_EQ(of({true, false}).bias, 3e-5);
    EXPECT_NE(of({true, false}).because.find("16-bit UNORM"), std::string::npos);
    EXPECT_EQ(of({false, false}).format, VK_FORMAT_R16G16B16A16_SFLOAT);
    EXPECT_GT(of({false, false}).bias, 1e-3);
    EXPECT_NE(of({false, false}).because.find("or filter 32-bit floats"), std::string::npos);
}

}  // namespace
}  // namespace diptych
