// SPDX-License-Identifier: MIT
// A spot's cone, from the light's angles to the shader's factor: exact at its edges up to float32
// rounding. A change of 1e-5 rad is detected.
#include "compare/reference/light/punctual.h"
#include "shared/light/light_grid.h"
#include "shared/light/lights.h"
#include "shared/scene/view.h"
#include "tests/probe/probe.h"
#include "tests/support/light_formulas.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace diptych {
namespace {

constexpr std::pair<float, float> cones[] = {{0.0f, 0.6f}, {0.3f, 0.6f}, {0.59f, 0.6f}, {0.0f, 1.5707963f},
                                             {1.0f, 1.2f}, {0.9f, 0.9f}, {0.1f, 0.2f},  {0.7f, 1.5f}};

Light spotOf(const std::pair<float, float>& cone, const glm::dvec3& direction = {0, -1, 0}) {
    Light light;
    light.kind = LightKind::spot;
    light.direction = glm::normalize(direction);
    light.inner_cone = cone.first;
    light.outer_cone = cone.second;
    light.range = std::numeric_limits<float>::infinity();
    return light;
}

double scaleOf(const std::pair<float, float>& cone) {
    return coneScale(double{cone.first}, double{cone.second});
}
double factorOf(const std::pair<float, float>& cone, double cosine) {
    return coneFactor(double{cone.first}, double{cone.second}, cosine);
}

TEST(SpotCone, IsUploadedToTheLastBit) {
    for (const auto& cone : cones) {
        const Light light = spotOf(cone);
        const gpu::SpotCone uploaded = gpuLights(std::span(&light, 1), {0, 0, 0}).spot_cones.at(0);
        EXPECT_EQ(uploaded.scale, static_cast<float>(scaleOf(cone)));
        EXPECT_EQ(uploaded.offset, static_cast<float>(-std::cos(double{cone.second}) * scaleOf(cone)));
    }
}

// Angles around both edges, on both sides by 1e-6 to 1e-2 rad, then 0 to 1 rad.
std::vector<double> anglesAround(const std::pair<float, float>& cone) {
    std::vector<double> angles{0, (double{cone.first} + double{cone.second}) / 2};
    for (const double edge : {double{cone.first}, double{cone.second}})
        for (const double by : {0.0, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 1e-3, 1e-2})
            for (const double sign : {-1.0, 1.0}) angles.push_back(std::abs(edge + sign * by));
    for (int i = 0; i <= 100; ++i) angles.push_back(0.01 * i);
    return angles;
}

// The unit vector to the light has one or two roundings per component, and its dot product with the axis
// an error of 2e-7. The cone's scale multiplies it, and the sum has terms as large as the scale.
double roundingOf(double scale) {
    return 3e-7 * scale;
}

TEST(SpotCone, TheShadersEdgesAreTheSpecifications) {
    Probes probes;
    std::vector<float> input;
    std::vector<std::array<double, 2>> expected;  // factor, its rounding
    for (const auto& cone : cones) {
        const Light light = spotOf(cone);
        const gpu::SpotCone uploaded = gpuLights(std::span(&light, 1), {0, 0, 0}).spot_cones.at(0);
        for (const double angle : anglesAround(cone)) {
            const float x = static_cast<float>(std::sin(angle)), y = static_cast<float>(std::cos(angle));
            for (const float value : {x, y, 0.0f, 0.0f, uploaded.direction.x, uploaded.direction.y,
                                      uploaded.direction.z, uploaded.scale, uploaded.offset})
                input.push_back(value);
            expected.push_back(
                {factorOf(cone, double{y} / std::hypot(double{x}, double{y})), roundingOf(scaleOf(cone))});
        }
    }
    const std::vector<float> out = probes.run("lights", input, 9, 4);
    int between = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto [factor, rounding] = expected[i];
        // The distance is 1 up to float32 rounding: its square is off by 2e-7.
        EXPECT_NEAR(out[4 * i], factor * factor,
                    2 * std::max(factor, rounding) * rounding + 4e-7 * factor * factor)
            << "case " << i;
        between += factor > 0.01 && factor < 0.99;
    }
    EXPECT_GT(between, 20);
    const std::size_t count = anglesAround(cones[1]).size();  // the same for each cone
    EXPECT_EQ(out[4 * count], 1) << "on the axis of the second cone";
    EXPECT_EQ(out[4 * (2 * count - 1)], 0) << "outside it";
}

// Negative control: at the middle of the penumbra, 1e-5 rad at the outer edge changes the factor by more
// than three times the shader's rounding.
TEST(SpotCone, ATenThousandthOfADegreeIsMore) {
    for (const auto& cone : cones) {
        if (cone.second < 0.5f) continue;
        const double middle = std::cos((double{cone.first} + double{cone.second}) / 2);
        const std::pair<float, float> narrow{cone.first, cone.second - 1e-5f};
        if (const double factor = factorOf(cone, middle); factor > 0 && factor < 1) {
            EXPECT_GT(std::abs(factor - factorOf(narrow, middle)), 3 * roundingOf(scaleOf(cone)))
                << cone.second;
        }
    }
}

// The reference's factor, in double.
TEST(SpotCone, TheReferencesEdgesAreTheSpecifications) {
    for (const auto& cone : cones) {
        const Light light = spotOf(cone);
        for (const double angle : anglesAround(cone)) {
            const glm::dvec3 at(-2 * std::sin(angle), -2 * std::cos(angle), 0);
            const double factor = factorOf(cone, std::cos(angle));
            EXPECT_NEAR(reference::incident(light, {0, 0, 0}, at).irradiance.r, factor * factor / 4,
                        1e-12 * scaleOf(cone));
        }
    }
}

// The culling cone contains every direction in which the shader's float32 formula is above 0, whatever the
// rounding (fused or not; a float32 dot product is off by 3e-7). It exceeds the light's cone by at most
// its slack.
TEST(SpotCone, BoundsHoldWhatTheShaderLights) {
    View view;
    view.width = view.height = 64;
    for (const auto& cone : cones) {
        const Light light = spotOf(cone, {0.3, -0.8, -0.5});
        const GpuLights lights = gpuLights(std::span(&light, 1), {0, 0, 0});
        const gpu::SpotCone& shipped = lights.spot_cones.at(0);
        const gpu::LightBound bound = lightBounds(lights, view).at(0);
        // The smallest float32 cosine with light, by bisection.
        const auto lights_up = [&](float cosine) {
            return shipped.offset + cosine * shipped.scale > 0 ||
                   std::fma(cosine, shipped.scale, shipped.offset) > 0;
        };
        float dark = static_cast<float>(std::cos(double{cone.second})) - 1e-5f, min = dark + 2e-5f;
        ASSERT_FALSE(lights_up(dark));
        ASSERT_TRUE(lights_up(min));
        for (int step = 0; step < 60; ++step) {
            const float middle = dark + (min - dark) / 2;
            (lights_up(middle) ? min : dark) = middle;
        }
        EXPECT_LE(double{bound.cos_cone}, double{min} - 3e-7) << cone.second;
        EXPECT_GE(double{bound.cos_cone}, std::cos(double{cone.second}) - 5e-6) << cone.second;
        EXPECT_NEAR(std::hypot(double{bound.cos_cone}, double{bound.sin_cone}), 1, 1e-6);
        EXPECT_GE(double{bound.sin_cone}, 0);
    }
}

}  // namespace
}  // namespace diptych
