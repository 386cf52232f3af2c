// SPDX-License-Identifier: MIT
// The library interface: the same metrics as diff, and a reason if images cannot be compared.
#include "compare/library/diptych.h"
#include "compare/verdict/measurement.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::library {
namespace {

std::vector<float> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(random() % 1000) / 1000;
    return values;
}

TEST(Library, FiguresAreThoseOfDiff) {
    constexpr int width = 20, height = 12;
    const std::vector<float> a = noise(3 * width * height, 1), b = noise(3 * width * height, 2);
    Image reference(width, height, 3), test(width, height, 3);
    std::ranges::copy(a, reference.data.begin());
    std::ranges::copy(b, test.data.begin());
    std::vector<std::uint8_t> half(width * height, 0);
    for (std::size_t i = 0; i < half.size() / 2; ++i) half[i] = 1;
    for (const bool display : {false, true})
        for (const bool covered : {false, true}) {
            Options options;
            options.display = display;
            options.pixels_per_degree = 30;
            if (covered) options.covered = half;
            const Result result = compare({width, height, a}, {width, height, b}, options);
            Coverage coverage = everyPixel(width * height);
            if (covered) {
                coverage.covered = half;
                coverage.count = half.size() / 2;
            }
            HdrFlipOptions flip;
            flip.pixels_per_degree = 30;
            const Measurement expected({.display = display,
                                        .reference = reference,
                                        .test = test,
                                        .coverage = &coverage,
                                        .flip = flip});
            EXPECT_EQ(result.compared, coverage.count);
            const auto all = expected.all();
            EXPECT_EQ(result.figures.size(), all.size());
            for (const auto& [name, value] : all) {
                EXPECT_EQ(result.figures.at(name), value) << name;
                EXPECT_EQ(std::ranges::count(figureNames(), name), 1) << name;
            }
            ASSERT_EQ(result.flip.size(), half.size());
            float max = 0;
            for (std::size_t i = 0; i < half.size(); ++i)
                if (coverage.covered[i]) max = std::max(max, result.flip[i]);
            ASSERT_GE(result.worst_x, 0);
            EXPECT_EQ(result.flip[static_cast<std::size_t>(result.worst_y * width + result.worst_x)], max);
        }
}

TEST(Library, TheUsualViewerIsFlips) {
    EXPECT_EQ(Options().pixels_per_degree, FlipOptions().pixels_per_degree);
    EXPECT_FALSE(Options().display);
}

TEST(Library, LimitsDecide) {
    constexpr int width = 8, height = 8;
    const std::vector<float> a = noise(3 * width * height, 1);
    std::vector<float> b = a;
    b[17] += 0.25f;
    Options options;
    options.limits = {{"max", 0.3}, {"max", 0.2}, {"psnr", 10}, {"psnr", 90}};
    Result result = compare({width, height, a}, {width, height, b}, options);
    ASSERT_EQ(result.outcomes.size(), 4u);
    EXPECT_TRUE(result.outcomes[0].holds && result.outcomes[2].holds);
    EXPECT_FALSE(result.outcomes[1].holds || result.outcomes[3].holds);
    EXPECT_NEAR(result.outcomes[0].measured, 0.25, 1e-6);
    EXPECT_FALSE(result.passed);
    options.limits.resize(1);
    EXPECT_TRUE(compare({width, height, a}, {width, height, b}, options).passed);
    // Equal images without limits.
    result = compare({width, height, a}, {width, height, a});
    EXPECT_TRUE(result.passed);
    EXPECT_EQ(result.worst_x, -1);
    EXPECT_EQ(result.worst_y, -1);
    // A NaN, which a mean would miss.
    b[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(compare({width, height, a}, {width, height, b}).passed);
    options.limits = {{"mean", 1e9}};
    EXPECT_FALSE(compare({width, height, a}, {width, height, b}, options).outcomes[0].holds);
}

TEST(Library, WhatCannotBeComparedSaysWhy) {
    const std::vector<float> four(12, 0.5f), six(18, 0.5f);
    const auto fault = [](const Picture& reference, const Picture& test, const Options& options = {}) {
        return faultOf([&] { compare(reference, test, options); });
    };
    const Picture square{2, 2, four};
    EXPECT_EQ(fault(square, {3, 2, six}),
              "the reference is 2x2 and the test is 3x2: images must have the same size");
    EXPECT_EQ(fault({2, 3, four}, square), "the reference is 2x3 and has 12 values; give 3 per pixel");
    EXPECT_EQ(fault({0, 0, {}}, square), "the reference is 0x0 and has 0 values; give 3 per pixel");
    Options options;
    options.limits = {{"flop", 1}};
    EXPECT_EQ(fault(square, square, options), "flop: unknown metric; figureNames() lists them");
    options.limits = {{"angle_max", 1}};
    EXPECT_EQ(fault(square, square, options), "angle_max: is not defined for colours");
    const std::vector<std::uint8_t> none(4, 0), three(3, 1);
    options.limits.clear();
    options.covered = none;
    EXPECT_EQ(fault(square, square, options), "no pixel counts: Options::covered is 0 everywhere");
    options.covered = three;
    EXPECT_EQ(fault(square, square, options),
              "Options::covered has 3 values for 4 pixels; give one per pixel");
    options.covered = {};
    options.pixels_per_degree = 0;
    EXPECT_NE(fault(square, square, options), "");
}

TEST(Library, EveryFigureHasAMeaning) {
    for (const std::string& name : figureNames()) EXPECT_NE(meaningOf(name), "") << name;
    EXPECT_EQ(meaningOf("flop"), "");
}

// Every size that does not fit its values, and what it said.
TEST(Library, APictureHasThreeValuesPerPixel) {
    const std::vector<float> values(12, 0.5f);
    const Picture square{2, 2, values};
    const auto fault = [&](const Picture& reference, const Picture& test) {
        return faultOf([&] { compare(reference, test); });
    };
    for (const auto& [width, height] : {std::pair{0, 2}, {2, 0}, {-2, -2}, {1, 2}, {2, 3}}) {
        const std::string rest = " is " + std::to_string(width) + "x" + std::to_string(height) +
                                 " and has 12 values; give 3 per pixel";
        EXPECT_EQ(fault({width, height, values}, square), "the reference" + rest);
        EXPECT_EQ(fault(square, {width, height, values}), "the test" + rest);
    }
    EXPECT_EQ(fault({4, 1, values}, square),
              "the reference is 4x1 and the test is 2x2: images must have the same size");
    EXPECT_EQ(fault({2, 1, std::span(values).first(6)}, square),
              "the reference is 2x1 and the test is 2x2: images must have the same size");
    EXPECT_EQ(fault({1, 4, values}, {1, 4, values}), "");
}

// The first of the largest; only covered pixels count, of which any value but 0 is one.
TEST(Library, TheWorstPixelIsCovered) {
    constexpr int width = 9, height = 7;
    std::vector<float> a(3 * width * height, 0.5f), b = a;
    const auto at = [](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    for (const auto& [x, y] : {std::pair{8, 1}, {2, 5}})
        for (std::size_t c = 0; c < 3; ++c) b[3 * at(x, y) + c] = std::numeric_limits<float>::quiet_NaN();
    Result result = compare({width, height, a}, {width, height, b});
    EXPECT_EQ(result.worst_x, 8);
    EXPECT_EQ(result.worst_y, 1);
    EXPECT_EQ(result.flip[at(2, 5)], 1);
    EXPECT_EQ(result.compared, static_cast<std::size_t>(width * height));
    EXPECT_TRUE(result.outcomes.empty());
    EXPECT_FALSE(result.passed) << "a NaN in one image alone";
    std::vector<std::uint8_t> covered(width * height, 255);
    covered[at(8, 1)] = 0;
    Options options;
    options.covered = covered;
    result = compare({width, height, a}, {width, height, b}, options);
    EXPECT_EQ(result.worst_x, 2);
    EXPECT_EQ(result.worst_y, 5);
    EXPECT_EQ(result.compared, static_cast<std::size_t>(width * height - 1));
    covered[at(2, 5)] = 0;
    result = compare({width, height, a}, {width, height, b}, options);
    EXPECT_EQ(result.worst_x, -1);
    EXPECT_TRUE(result.passed);
}

// A limit is kept by what equals it; one that fails makes all fail, wherever it stands.
TEST(Library, ALimitIncludesItsValue) {
    const std::vector<float> a(12, 0.5f);
    std::vector<float> b = a;
    b[4] = 0.75f;
    Options options;
    options.limits = {{"max", 0.25}};
    EXPECT_TRUE(compare({2, 2, a}, {2, 2, b}, options).passed);
    options.limits = {{"max", 0.2499}, {"max", 1}};
    const Result result = compare({2, 2, a}, {2, 2, b}, options);
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.outcomes[0].limit.figure, "max");
    EXPECT_EQ(result.outcomes[0].limit.value, 0.2499);
    EXPECT_EQ(result.outcomes[0].measured, 0.25);
    EXPECT_FALSE(result.outcomes[0].holds);
    EXPECT_TRUE(result.outcomes[1].holds);
    EXPECT_EQ(Limit().figure, "flip");
    EXPECT_EQ(Limit().value, 0);
    EXPECT_EQ(std::ranges::count(version(), '.'), 2) << version();
    EXPECT_EQ(figureNames().size(), allMetrics().size());
}

}  // namespace
}  // namespace diptych::library
