// SPDX-License-Identifier: MIT
// Filters of four moments compared with closed forms.
#include "tests/probe/moment_filter.h"

#include <gtest/gtest.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace diptych {
namespace {

// Light that four moments transmit, computed differently from the shader: the biased distribution is
// known, and with it its orthogonal polynomials. Among all distributions with these four moments and a
// point at `at`, consider the one with the least shadow. Its other points are roots of the polynomials'
// kernel, with weights 1 / kernel (Akhiezer 1965, "The Classical Moment Problem").
double minShadowOfBiased(double first, double second, double fraction, double bias, double at) {
    const std::array<double, 4> places{first, second, 0, 1},
        weights{(1 - bias) * fraction, (1 - bias) * (1 - fraction), bias / 2, bias / 2};
    std::array<std::array<double, 3>, 3> polynomials{};  // coefficients of 1, z, z^2
    const auto value = [](const std::array<double, 3>& p, double z) { return p[0] + z * (p[1] + z * p[2]); };
    const auto product = [&](const auto& a, const auto& b) {
        double sum = 0;
        for (std::size_t i = 0; i < 4; ++i) sum += weights[i] * value(a, places[i]) * value(b, places[i]);
        return sum;
    };
    for (std::size_t n = 0; n < 3; ++n) {
        std::array<double, 3> p{};
        p[n] = 1;
        for (int twice = 0; twice < 2; ++twice)
            for (std::size_t k = 0; k < n; ++k) {
                const double along = product(p, polynomials[k]);
                for (std::size_t i = 0; i < 3; ++i) p[i] -= along * polynomials[k][i];
            }
        const double length = std::sqrt(product(p, p));
        for (double& c : p) c /= length;
        polynomials[n] = p;
    }
    std::array<double, 3> kernel{};  // polynomial in its second argument
    for (const auto& p : polynomials)
        for (std::size_t i = 0; i < 3; ++i) kernel[i] += value(p, at) * p[i];
    const double half = -kernel[1] / (2 * kernel[2]),
                 root = std::sqrt(std::max(half * half - kernel[0] / kernel[2], 0.0));
    double before = 0;
    for (const double z : {half - root, half + root}) {
        double sum = 0;
        for (const auto& p : polynomials) sum += value(p, z) * value(p, z);
        if (z < at) before += 1 / sum;
    }
    return before;
}

// Two distant occluders cover half of the filter each; the receiver lies behind both. The first warp leaks
// just behind the second occluder, as with two moments. For the second warp, with s = exp(-k d),
// Chebyshev's bound is v / (v + (m - s)^2), m = (s1 + s2) / 2, v = (s1 - s2)^2 / 4. It leaks if the receiver
// is not much farther behind than the occluders are apart. The smaller leak applies.
TEST(FourMoments, Evsm4LeaksTheLesserOfBothClosedForms) {
    for (const float nearest : {0.0f, -1.0f})
        for (const float exponent : {5.0f, 20.0f, 40.0f})
            for (const float negative : {1.0f, 5.0f, 40.0f}) {
                std::vector<MomentFilter> filters;
                const std::vector<double> behind{0.001, 0.01, 0.025, 0.05, 0.1, 0.2, 0.4, 0.55};
                for (const double d : behind)
                    filters.push_back({.near = 0.8f,
                                       .far = 0.6f,
                                       .receiver = static_cast<float>(0.6 - d),
                                       .exponent = exponent,
                                       .negative = negative,
                                       .nearest = nearest});
                const std::vector<MomentResult> results = seenThrough(gpu::SHADOWS_EVSM4, filters);
                const auto bound = [&](const auto& warp, double receiver) {
                    const double near = warp(0.2), far = warp(0.4), mean = (near + far) / 2,
                                 half = (near - far) / 2, away = warp(receiver) - mean;
                    return half * half / (half * half + away * away);
                };
                const double range = 1 - double{nearest};
                const auto first = [&](double d) {
                    return std::exp(double{exponent} * (double{nearest} + range * d));
                };
                const auto other = [&](double d) {
                    return -std::exp(-double{negative} * (double{nearest} + range * d));
                };
                for (std::size_t i = 0; i < behind.size(); ++i) {
                    const double receiver = 0.4 + behind[i];
                    EXPECT_NEAR(double{results[i].visibility},
                                std::min(bound(first, receiver), bound(other, receiver)), 1e-3)
                        << nearest << " " << exponent << " " << negative << " " << behind[i];
                }
            }
}

// Four moments of two depths determine the distribution, so only the bias leaks.
TEST(FourMoments, Msm4LeaksWhatItsBiasLetsThrough) {
    for (const float bias : {3e-5f, 6e-5f, 1e-3f})
        for (const float near : {0.95f, 0.8f, 0.55f}) {
            std::vector<MomentFilter> filters;
            const std::vector<double> behind{0.02, 0.05, 0.1, 0.2, 0.4, 0.49};
            for (const double d : behind)
                filters.push_back(
                    {.near = near, .far = 0.5f, .receiver = static_cast<float>(0.5 - d), .bias = bias});
            const std::vector<MomentResult> results = seenThrough(gpu::SHADOWS_MSM4, filters);
            for (std::size_t i = 0; i < behind.size(); ++i) {
                const double leak =
                    1 - minShadowOfBiased(1 - double{near}, 0.5, 0.5, double{bias}, 0.5 + behind[i]);
                EXPECT_NEAR(double{results[i].visibility}, leak, 0.02)
                    << bias << " " << near << " " << behind[i];
            }
        }
}

// An occluder covers a fraction of a plane's filter: both filters shadow the plane by that fraction.
TEST(FourMoments, APlaneReceivesWhatCoversIt) {
    for (const gpu::uint shadows : {gpu::SHADOWS_EVSM, gpu::SHADOWS_EVSM4, gpu::SHADOWS_MSM4}) {
        std::vector<MomentFilter> filters;
        for (int i = 0; i <= 20; ++i)
            filters.push_back({.near = 0.9f, .far = 0.3f, .receiver = 0.3f, .fraction = float(i) / 20});
        const std::vector<MomentResult> results = seenThrough(shadows, filters);
        for (int i = 0; i <= 20; ++i)
            EXPECT_NEAR(double{results[static_cast<std::size_t>(i)].visibility}, i == 0 ? 1 : 1 - i / 20.0,
                        shadows == gpu::SHADOWS_MSM4 ? 0.02 : 1e-4)
                << shadows << " " << i;
    }
}

// A single depth behind the receiver casts no shadow; one in front casts full shadow.
TEST(FourMoments, ASingleDepthIsAllOrNothing) {
    for (const gpu::uint shadows : {gpu::SHADOWS_EVSM4, gpu::SHADOWS_MSM4}) {
        const std::vector<MomentResult> results =
            seenThrough(shadows, std::vector<MomentFilter>{{.near = 0.5f, .far = 0.5f, .receiver = 0.7f},
                                                           {.near = 0.5f, .far = 0.5f, .receiver = 0.2f},
                                                           {.near = 0, .far = 0, .receiver = 0.5f},
                                                           {.near = 1, .far = 1, .receiver = 0.5f}});
        EXPECT_NEAR(results[0].visibility, 1, 1e-3) << shadows;
        EXPECT_NEAR(results[1].visibility, 0, 2e-3) << shadows;
        EXPECT_NEAR(results[2].visibility, 1, 1e-3) << shadows;
        EXPECT_NEAR(results[3].visibility, 0, 2e-3) << shadows;
    }
}

// Stored moments fill [0, 1], the range of unsigned normalized integers.
TEST(FourMoments, OfEveryDepthFillTheRangeOfIntegers) {
    std::vector<MomentFilter> filters;
    for (int i = -5; i <= 105; ++i)
        filters.push_back({.near = float(i) / 100, .far = float(i) / 100, .receiver = 0.5f});
    std::array<float, 4> min{9, 9, 9, 9}, max{-9, -9, -9, -9};
    for (const MomentResult& result : seenThrough(gpu::SHADOWS_MSM4, filters))
        for (std::size_t k = 0; k < 4; ++k) {
            min[k] = std::min(min[k], result.moments[k]);
            max[k] = std::max(max[k], result.moments[k]);
        }
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(min[k], 0, 0.01) << k;
        EXPECT_NEAR(max[k], 1, 0.01) << k;
        EXPECT_GE(min[k], -2e-5f) << k;
        EXPECT_LE(max[k], 1 + 2e-5f) << k;
    }
}

// Values that no blur produces, but stray depths may: visibility still stays in [0, 1].
TEST(FourMoments, AnythingStoredGivesAShare) {
    constexpr float inf = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN(), big = std::numeric_limits<float>::max(),
                    tiny = std::numeric_limits<float>::denorm_min();
    const std::vector<float> strange{0, -0.0f, 1, -1, tiny, -tiny, 1e-20f, 1e20f, big, -big, inf, -inf, nan};
    std::mt19937 random(7);
    const auto any = [&] { return strange[random() % strange.size()]; };
    const auto fraction = [&] { return float(random() % 65536) / 65535; };
    std::vector<StoredMoments> stored;
    for (int i = 0; i < 40000; ++i) {
        StoredMoments s{{any(), any(), any(), any()}, {.near = 0, .far = 0, .receiver = fraction()}};
        if (i % 2 == 0) s.moments = {fraction(), fraction(), fraction(), fraction()};
        if (i % 5 == 0) s.filter.receiver = any();
        s.filter.nearest = i % 3 == 0 ? 0.0f : -1.0f;
        s.filter.exponent = i % 7 == 0 ? 0.0f : 44.36f;
        s.filter.negative = i % 7 < 4 ? 44.36f : 1e-3f;
        s.filter.min_variance = i % 11 == 0 ? big : i % 11 == 1 ? 1e-8f : 0;
        s.filter.bleed = i % 4 == 0 ? 0.999f : 0;
        stored.push_back(s);
    }
    for (const gpu::uint shadows : {gpu::SHADOWS_EVSM, gpu::SHADOWS_EVSM4, gpu::SHADOWS_MSM4}) {
        int outside = 0;
        for (const float visibility : seenThrough(shadows, stored))
            outside += !(visibility >= 0 && visibility <= 1);
        EXPECT_EQ(outside, 0) << shadows;
    }
}

// Both precisions with their own exponents; 16-bit moments are rounded down, as lavapipe stores them.
// Measures how far behind the second of two half-covering occluders more than 5 % of the light leaks. 16
// bits leak about eight times as far, the ratio of the exponents.
TEST(FourMoments, SixteenBitsLeakFartherThanThirtyTwo) {
    const auto down = [](float value) {
        const float half = glm::unpackHalf1x16(glm::packHalf1x16(value));
        if (std::abs(half) <= std::abs(value)) return half;
        return glm::unpackHalf1x16(static_cast<glm::uint16>(glm::packHalf1x16(value) - 1));
    };
    for (const gpu::uint shadows : {gpu::SHADOWS_EVSM, gpu::SHADOWS_EVSM4}) {
        std::array<double, 2> reach{};
        for (const bool half : {false, true}) {
            std::vector<MomentFilter> filters;
            for (int i = 1; i <= 400; ++i)
                filters.push_back({.near = 0.95f,
                                   .far = 0.5f,
                                   .receiver = 0.5f - float(i) / 1000,
                                   .exponent = half ? 5.5f : 40.0f,
                                   .nearest = -1});
            std::vector<StoredMoments> stored;
            const std::vector<MomentResult> exact = seenThrough(shadows, filters);
            for (std::size_t i = 0; i < exact.size(); ++i) {
                stored.push_back({exact[i].moments, filters[i]});
                if (half)
                    for (float& m : stored.back().moments) m = down(m);
            }
            const std::vector<float> visibility = seenThrough(shadows, stored);
            for (std::size_t i = 0; i < visibility.size(); ++i)
                if (visibility[i] > 0.05f) reach[half] = double(i + 1) / 1000;
        }
        // 1 / (1 + (2 e^x - 1)^2) = 0.05 at x = 0.986, x = 2 c D.
        EXPECT_NEAR(reach[0], 0.986 / 80, 0.002) << shadows;
        EXPECT_NEAR(reach[1], 0.986 / 11, 0.01) << shadows;
        RecordProperty(shadows == gpu::SHADOWS_EVSM ? "reach16" : "reach16_of_four",
                       std::to_string(reach[1]));
    }
}

}  // namespace
}  // namespace diptych
