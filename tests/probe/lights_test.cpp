// SPDX-License-Identifier: MIT
// KHR_lights_punctual as the shaders evaluate it, compared with the specification's formulas in double.
#include "shared/light/lights.h"
#include "tests/probe/probe.h"
#include "tests/support/light_formulas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace diptych {
namespace {

struct PointCase {
    double x, y, z, range, axis_x, axis_y, axis_z, scale, offset;
};

std::vector<float> evaluate(Probes& probes, const std::vector<PointCase>& cases) {
    std::vector<float> input;
    for (const PointCase& c : cases)
        for (const double value :
             {c.x, c.y, c.z, static_cast<double>(inverseSquaredRange(static_cast<float>(c.range))), c.axis_x,
              c.axis_y, c.axis_z, c.scale, c.offset})
            input.push_back(static_cast<float>(value));
    return probes.run("lights", input, 9, 4);
}

TEST(Lights, FalloffIsTheSpecificationsFormula) {
    Probes probes;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> distance(0.01, 9.9);
    std::vector<PointCase> cases;
    for (int i = 0; i < 2000; ++i) cases.push_back({0, distance(random), 0, 10, 0, -1, 0, 0, 1});
    const std::vector<float> out = evaluate(probes, cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double d = static_cast<double>(static_cast<float>(cases[i].y));
        const double window = punctualWindow(d, 10);
        // Near the range 1 - x^4 cancels: a float32 error of 6e-8 relative to 1, divided by d^2.
        EXPECT_NEAR(out[i * 4], window / (d * d), 1e-6 * window / (d * d) + 3e-7 / (d * d));
        EXPECT_NEAR(out[i * 4 + 2], 1.0f, 2e-7f) << "the direction points to the light";
    }
}

TEST(Lights, IsExactlyZeroAtTheRangeAndBeyond) {
    Probes probes;
    std::vector<PointCase> cases;
    for (const double range : {0.37, 1.0, 3.0, 10.0, 1e6}) {
        const auto r = static_cast<double>(static_cast<float>(range));
        cases.push_back({r, 0, 0, r, 0, -1, 0, 0, 1});
        cases.push_back({0, -1.0001 * r, 0, r, 0, -1, 0, 0, 1});
        cases.push_back({0, 0, 1e18 * r, r, 0, -1, 0, 0, 1});
    }
    const std::vector<float> out = evaluate(probes, cases);
    for (std::size_t i = 0; i < cases.size(); ++i) EXPECT_EQ(out[i * 4], 0.0f) << "case " << i;
    // Negative control: just inside the range, it is not zero.
    const std::vector<float> inside = evaluate(probes, {{0.99, 0, 0, 1, 0, -1, 0, 0, 1}});
    EXPECT_GT(inside[0], 0.0f);
}

TEST(Lights, WithoutRangeIsInverseSquareEverywhere) {
    Probes probes;
    const double infinite = std::numeric_limits<double>::infinity();
    const std::vector<float> out =
        evaluate(probes, {{100, 0, 0, infinite, 0, -1, 0, 0, 1}, {0, 1e6, 0, infinite, 0, -1, 0, 0, 1}});
    EXPECT_NEAR(out[0], 1e-4f, 1e-10f);
    EXPECT_NEAR(out[4], 1e-12f, 1e-18f);
}

TEST(Lights, InTheLightsOwnCentreIsFinite) {
    Probes probes;
    const std::vector<float> out =
        evaluate(probes, {{0, 0, 0, 5, 0, -1, 0, 0, 1}, {1e-20, 0, 0, 5, 0, -1, 0, 2, -1}});
    for (const float value : out) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace diptych
