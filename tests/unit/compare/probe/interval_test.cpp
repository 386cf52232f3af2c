// SPDX-License-Identifier: MIT
// Interval arithmetic with Vulkan's error bounds, and the counts of results.
#include "compare/probe/inexact.h"
#include "compare/probe/probe.h"

#include <gtest/gtest.h>

namespace diptych::probe {
namespace {

TEST(Interval, AUlpIsTheDistanceOfFloats) {
    for (const float x : {1.0f, 1.5f, 0.999f, 3.3e38f, 1e-37f, 65504.0f})
        EXPECT_EQ(ulpOf(double{x}),
                  double{std::nextafter(x, std::numeric_limits<float>::infinity())} - double{x})
            << x;
    EXPECT_EQ(ulpOf(0), 0x1p-149);
    EXPECT_EQ(ulpOf(1e-40), 0x1p-149);
    EXPECT_EQ(ulpOf(-2), 0x1p-22);
}

TEST(Interval, WhatIsExactStays) {
    const Interval half(0.5f), three(3.0f);
    EXPECT_EQ((half + three).width(), 0);
    EXPECT_EQ((half * three).lo, 1.5);
    EXPECT_EQ((three - half).hi, 2.5);
    // 0.1f * 0.1f is not exact in float32.
    EXPECT_EQ((Interval(0.1f) * Interval(0.1f)).width(), ulpOf(0.01));
}

TEST(Interval, WidthsAreThoseOfVulkansTable) {
    const double third = ulpOf(1.0 / 3);
    EXPECT_GE((Interval(1.0f) / Interval(3.0f)).width(), 5 * third);
    EXPECT_LE((Interval(1.0f) / Interval(3.0f)).width(), 7 * third);
    EXPECT_GE(inverseRoot(Interval(3.0f)).width(), 4 * ulpOf(1 / std::sqrt(3.0)));
    EXPECT_GE(powerOfTwo(Interval(10.5f)).width(), 2 * 24 * ulpOf(std::exp2(10.5)));
    EXPECT_GE(binaryLogarithm(Interval(1.25f)).width(), 0x1p-20);
    EXPECT_LE(binaryLogarithm(Interval(1000.0f)).width(), 8 * ulpOf(std::log2(1000.0)));
    EXPECT_GE(sine(Interval(1.0f)).width(), 0x1p-10);
    EXPECT_EQ((Interval(1.0f) / Interval(-1.0f, 1.0f)).hi, endless);
    EXPECT_EQ((Interval(1.0f) / Interval(0x1.8p126f)).hi, endless);
    EXPECT_EQ((Interval(0x1p-100f) * Interval(0x1p-30f)).lo, 0) << "a denormal may be 0";
}

// This machine rounds to nearest; each of its results must lie within the interval.
TEST(Interval, HoldsWhatThisMachineComputes) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const auto a = static_cast<float>(random.logarithmic(1e-6, 1e6)),
                   b = static_cast<float>(random.uniform(-9, 9));
        const auto holds = [](Interval x, float y) { return x.lo <= y && y <= x.hi; };
        EXPECT_TRUE(holds(Interval(a) + Interval(b), a + b)) << a << " " << b;
        EXPECT_TRUE(holds(Interval(a) * Interval(b), a * b)) << a << " " << b;
        EXPECT_TRUE(holds(Interval(a) / Interval(b), a / b)) << a << " " << b;
        EXPECT_TRUE(holds(root(Interval(a)), std::sqrt(a))) << a;
        EXPECT_TRUE(holds(powerOfTwo(Interval(b)), std::exp2(b))) << b;
        EXPECT_TRUE(holds(naturalLogarithm(Interval(a)), std::log(a))) << a;
    }
}

TEST(Interval, ADoubtfulComparisonLeavesBoth) {
    const Interval a{1, 2}, b{1.5, 3};
    const Interval both = select(isLess(a, b), Interval(0.0f), Interval(9.0f));
    EXPECT_EQ(both.lo, 0);
    EXPECT_EQ(both.hi, 9);
    EXPECT_EQ(select(isLess(Interval(1.0f), b), Interval(0.0f), Interval(9.0f)).hi, 0);
}

TEST(Tally, CountsByPowersOfTwo) {
    Tally tally;
    for (const double error : {0.0, 0.25, 0.5, 0.75, 1.0, 3.0, 1e30}) {
        tally.value(0, 0, static_cast<float>(error), 0, 2, 1);
    }
    EXPECT_EQ(tally.histogram[0], 1u);
    EXPECT_EQ(tally.histogram[1], 2u) << "up to a half";
    EXPECT_EQ(tally.histogram[2], 2u) << "up to one";
    EXPECT_EQ(tally.histogram[4], 1u) << "up to four";
    EXPECT_EQ(tally.histogram[error_bins - 1], 1u);
    EXPECT_EQ(tally.failures, 2u) << "3 and 1e30 of 2 that are allowed";
    EXPECT_EQ(tally.worst.error, static_cast<double>(1e30f));
}

TEST(Tally, WhatIsNoNumberFailsAndWhatIsUnpromisedDoesNot) {
    Tally tally;
    tally.value(0, 0, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1);
    tally.value(1, 0, std::numeric_limits<float>::infinity(), 1, 1e38, 1);
    EXPECT_EQ(tally.nonfinite, 2u);
    EXPECT_EQ(tally.failures, 2u);
    tally.value(2, 0, 5, 1, endless, 1);
    EXPECT_EQ(tally.unpromised, 1u);
    EXPECT_EQ(tally.results, 2u);
}

}  // namespace
}  // namespace diptych::probe
