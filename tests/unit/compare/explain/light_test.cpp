// SPDX-License-Identifier: MIT
// Attribution of a change of direct light to single lights, and of a factor in lit, compared with known
// changes.
#include "compare/explain/frame_images.h"
#include "compare/explain/light_contributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace diptych::tests {
namespace {

constexpr int width = 20, height = 12;

// Coloured light that falls off around (x, y).
Image lightAround(double x, double y, double r, double g, double b) {
    Image image(width, height, 3);
    for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u) {
            const double light = 1 / (1 + (u - x) * (u - x) + (v - y) * (v - y));
            image.at(u, v, 0) = static_cast<float>(r * light);
            image.at(u, v, 1) = static_cast<float>(g * light);
            image.at(u, v, 2) = static_cast<float>(b * light);
        }
    return image;
}

std::vector<Image> threeLights() {
    return {lightAround(3, 3, 1, 0.7, 0.4), lightAround(15, 6, 1, 0.7, 0.4), lightAround(9, 9, 0.3, 0.5, 1)};
}

Image times(const Image& image, const auto& factor) {
    Image made = image;
    for (std::size_t i = 0; i < made.data.size(); ++i)
        made.data[i] *= static_cast<float>(factor(static_cast<int>(i / 3)));
    return made;
}

// The fraction of the whole change attributed to a light, weighted by the change's magnitude.
double fractionOf(const std::vector<std::vector<float>>& parts, std::size_t light, const Image& change) {
    double part = 0, all = 0;
    for (std::size_t p = 0; p < change.pixels(); ++p) {
        const double size = std::abs(double{change.pixel(p)[1]});
        part += size * double{parts[light][p]};
        all += size;
    }
    return part / all;
}

TEST(LightsOfChange, AFactorIsFoundByWhereTheLightIs) {
    const std::vector<Image> lights = threeLights();
    for (std::size_t light = 0; light < lights.size(); ++light) {
        const Image change = times(lights[light], [](int) { return -0.3; });
        const auto parts = lightsOfChange(change, lights, LightChange::factor);
        EXPECT_GT(fractionOf(parts, light, change), 0.999) << light;
    }
}

// One factor for all colours is tried first; a factor of each colour explains what it leaves.
TEST(LightsOfChange, AFactorMayBeOfEachColour) {
    const std::vector<Image> lights{lightAround(3, 3, 1, 0.5, 0.25), lightAround(3, 3, 0.25, 0.5, 1)};
    const Image dimmed = times(lights[0], [](int) { return -0.3; });
    EXPECT_GT(fractionOf(lightsOfChange(dimmed, lights, LightChange::factor), 0, dimmed), 0.999)
        << "colours of the other would explain it, too";
    const std::vector<Image> apart = threeLights();
    Image tinted = apart[1];
    for (std::size_t i = 0; i < tinted.data.size(); ++i) tinted.data[i] *= i % 3 == 2 ? 0.5f : -0.25f;
    EXPECT_GT(fractionOf(lightsOfChange(tinted, apart, LightChange::factor), 1, tinted), 0.999);
}

TEST(LightsOfChange, ALightThatIsDroppedIsTheOneThatIsMissing) {
    const std::vector<Image> lights = threeLights();
    for (std::size_t light = 0; light < lights.size(); ++light) {
        // Change in an area that is not a multiple of the blocks.
        const Image change = times(lights[light], [](int p) { return p % width < 11 ? 1.0 : 0.0; });
        const auto parts = lightsOfChange(change, lights, LightChange::whole);
        EXPECT_GT(fractionOf(parts, light, change), 0.99) << light;
    }
}

TEST(LightsOfChange, AShadowIsOfTheLightWhoseColourItHas) {
    const std::vector<Image> lights = threeLights();
    const Image change = times(lights[2], [](int p) { return 0.5 + 0.5 * std::sin(p); });
    EXPECT_GT(fractionOf(lightsOfChange(change, lights, LightChange::visibility), 2, change), 0.999);
}

// Lights of one colour with partial visibility everywhere: either could have caused the change.
TEST(LightsOfChange, LightsThatCannotBeToldApartShare) {
    const std::vector<Image> lights{times(threeLights()[0], [](int) { return 1; }),
                                    times(threeLights()[0], [](int) { return 2; })};
    const Image change = times(lights[0], [](int p) { return 0.5 + 0.5 * std::sin(p); });
    const auto parts = lightsOfChange(change, lights, LightChange::visibility);
    EXPECT_NEAR(fractionOf(parts, 0, change), 1.0 / 3, 1e-5);
    EXPECT_NEAR(fractionOf(parts, 1, change), 2.0 / 3, 1e-5);
}

// Between two lights that both change, each gets a part.
TEST(LightsOfChange, WhatOneLightLeavesIsTheNextOnes) {
    const std::vector<Image> lights = threeLights();
    Image change = lights[0];
    for (std::size_t i = 0; i < change.data.size(); ++i) change.data[i] += 4 * lights[2].data[i];
    const auto parts = lightsOfChange(change, lights, LightChange::factor);
    const std::size_t between = 6 * width + 6;
    EXPECT_GT(parts[0][between], 0.2f);
    EXPECT_GT(parts[2][between], 0.2f);
}

TEST(LightsOfChange, PartsAddUpToOneOrNothing) {
    const std::vector<Image> lights = threeLights();
    Image change = times(lights[0], [](int) { return 0.4; });
    for (std::size_t i = 0; i < change.data.size(); ++i) change.data[i] -= 0.2f * lights[1].data[i];
    for (const LightChange how : {LightChange::factor, LightChange::whole, LightChange::visibility}) {
        const auto parts = lightsOfChange(change, lights, how);
        for (std::size_t p = 0; p < change.pixels(); ++p) {
            const double sum = double{parts[0][p]} + parts[1][p] + parts[2][p];
            EXPECT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-6) << sum;
        }
    }
    const auto none = lightsOfChange(Image(width, height, 3), lights, LightChange::factor);
    for (const float part : none[0]) EXPECT_EQ(part, 0);
}

TEST(ExposureBetween, IsTheFactorThatHalfOfTheImageHas) {
    const Image right = threeLights()[0];
    Image twice = times(right, [](int) { return 2.0; });
    EXPECT_NEAR(commonFactor(twice, right).value(), 2, 1e-6);
    // Another error in less than half of the image does not hide the factor.
    for (std::size_t i = 0; i < twice.data.size() * 2 / 5; ++i) twice.data[i] *= 1.3f;
    EXPECT_NEAR(commonFactor(twice, right).value(), 2, 1e-6);
    for (std::size_t i = 0; i < twice.data.size(); ++i) twice.data[i] = std::sqrt(right.data[i]);
    EXPECT_FALSE(commonFactor(twice, right).has_value());
    EXPECT_FALSE(commonFactor(twice, Image(width, height, 3)).has_value()) << "black says nothing";
}

// Components by their ratio to those expected, in any order. Of those expected, components under a thousandth
// of their finite mean do not count.
TEST(ExposureBetween, HalfOfTheBrightComponentsHaveTheFactor) {
    const auto factorOf = [](const std::vector<std::pair<float, float>>& expected_and_ratio) {
        Image lit(static_cast<int>(expected_and_ratio.size()) / 3, 1, 3), expected = lit;
        for (std::size_t i = 0; i < expected_and_ratio.size(); ++i) {
            expected.data[i] = expected_and_ratio[i].first;
            lit.data[i] = expected_and_ratio[i].first * expected_and_ratio[i].second;
        }
        return commonFactor(lit, expected);
    };
    EXPECT_EQ(factorOf({{1, 2}, {1, 0.1f}, {1, 2}, {1, 0.2f}, {1, 2}, {1, 0.3f}}), 2);
    EXPECT_EQ(factorOf({{1, 2}, {1, 0.1f}, {1, 2}, {1, 0.2f}, {1, 9}, {1, 1.5f}}), std::nullopt);
    // A tenth of a percent is the same.
    EXPECT_TRUE(factorOf({{1, 2}, {1, 1.9981f}, {1, 2.0019f}}).has_value());
    EXPECT_FALSE(factorOf({{1, 2}, {1, 1.9979f}, {1, 2.0021f}}).has_value());
    for (const auto& [dark, factor] : {std::pair{0.0004f, 2.0}, {0.0005f, 9.0}}) {
        std::vector<std::pair<float, float>> rows(12, {dark, 9.0f});
        std::fill_n(rows.begin(), 3, std::pair{NAN, 1.0f});
        std::fill_n(rows.begin() + 5, 4, std::pair{1.0f, 2.0f});  // the mean is 0.444
        EXPECT_NEAR(factorOf(rows).value_or(0), factor, 1e-5) << dark;
    }
}

TEST(ExposureBetween, IsOfBothSides) {
    EXPECT_NEAR(exposureBetween(0.5, 1).value(), 2, 1e-12);
    EXPECT_FALSE(exposureBetween(3.0, 3.0).has_value());
    EXPECT_FALSE(exposureBetween({}, 2.0).has_value());
    for (const double factor : {0.9979, 1.0021}) EXPECT_EQ(exposureBetween(1.0, factor), factor);
    for (const double factor : {0.9981, 1.001, 1.0019})
        EXPECT_FALSE(exposureBetween(1.0, factor).has_value()) << "halves round by as much";
}

}  // namespace
}  // namespace diptych::tests
