// SPDX-License-Identifier: MIT
// Precision of the G-buffer's encodings, measured on the shipped GLSL.
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace diptych {
namespace {

struct Angles {
    double mean = 0, max = 0;  // degrees
};

// Uniform directions by the area-preserving cylinder map of a golden-ratio lattice: as uniform as random
// ones, and identical on every machine.
Angles octahedralError(Probes& probes, int bits) {
    constexpr int count = 400'000;
    std::vector<float> input;
    input.reserve(count * 4);
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1) / static_cast<double>(count), r = std::sqrt(1 - z * z);
        const double phi = 2 * std::numbers::pi * std::fmod(i * 0.6180339887498949, 1.0);
        for (const double c : {r * std::cos(phi), r * std::sin(phi), z})
            input.push_back(static_cast<float>(c));
        input.push_back(static_cast<float>(bits));
    }
    const std::vector<float> output = probes.run("octahedral", input, 4, 3);
    Angles angles;
    for (int i = 0; i < count; ++i) {
        const float *a = &input[static_cast<std::size_t>(i) * 4],
                    *b = &output[static_cast<std::size_t>(i) * 3];
        const double ax = a[0], ay = a[1], az = a[2], bx = b[0], by = b[1], bz = b[2];
        const double cross = std::hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
        const double angle = std::atan2(cross, ax * bx + ay * by + az * bz) * 180 / std::numbers::pi;
        angles.mean += angle / count;
        angles.max = std::max(angles.max, angle);
    }
    return angles;
}

// Published errors of normal encodings for uniform directions; 2 % for a different sampling of the sphere,
// and 1e-5 degrees for float32 directions.
TEST(Encoding, OctahedralMeetsTheTable) {
    Probes probes;
    struct Row {
        int bits;
        double mean, max;
    };
    for (const Row row : {Row{8, 0.3368, 0.9496}, Row{12, 0.0209, 0.0589}, Row{16, 0.00131, 0.00370}}) {
        const Angles got = octahedralError(probes, row.bits);
        EXPECT_NEAR(got.mean, row.mean, 0.02 * row.mean) << row.bits << " bits";
        EXPECT_LE(got.max, row.max * 1.01 + 1e-5) << row.bits << " bits";
        EXPECT_GE(got.max, row.max * 0.9) << row.bits << " bits: finer than its bits allow, so not measured";
    }
}

TEST(Encoding, OctahedralKeepsTheAxesExactly) {
    Probes probes;
    std::vector<float> input;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            for (int c = 0; c < 3; ++c) input.push_back(c == axis ? sign : 0.0f);
            input.push_back(8);
        }
    const std::vector<float> output = probes.run("octahedral", input, 4, 3);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(output[i * 3 + c], input[i * 4 + c]) << "direction " << i;
}

// 9.9.9.e5: half a step of the largest component. Its nine bits start with a one: 1 / 512.
TEST(Encoding, SharedExponentKeepsTheLargestComponentWithinHalfAStep) {
    Probes probes;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-15, 15.99f), fraction(0, 1);
    std::vector<float> input;
    for (int i = 0; i < 100'000; ++i) {
        const float largest = std::exp2(exponent(random));
        input.insert(input.end(), {largest, largest * fraction(random), largest * fraction(random)});
    }
    input.insert(input.end(), {65408, 65408, 0, 0, 0, 0, 511.6f, 1, 0, 1e9f, 2e9f, 3e9f});
    const std::vector<float> output = probes.run("packing", input, 3, 8);
    double worst = 0;
    for (std::size_t i = 0; i < 100'000; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(
                worst, std::abs(double{output[i * 8 + c]} - double{input[i * 3 + c]}) / double{input[i * 3]});
    EXPECT_LE(worst, 1.0 / 512);
    EXPECT_GT(worst, 0.9 / 512) << "better than nine bits: the encoding was not measured";
    const auto row = [&](std::size_t i) { return &output[(100'000 + i) * 8]; };
    EXPECT_EQ(row(0)[0], 65408.0f);
    EXPECT_EQ(row(1)[0], 0.0f);
    EXPECT_EQ(row(2)[0], 512.0f) << "the mantissa's overflow moves to the exponent";
    EXPECT_EQ(row(3)[2], 65408.0f) << "beyond the range: the largest; the layout then chooses float32";
}

// sqrt in 8 bits: |x - y| <= 2 sqrt(x) h + h^2 with half step h; the default F0 is exact.
TEST(Encoding, SquareRootInEightBits) {
    Probes probes;
    std::vector<float> input;
    for (int i = 0; i <= 30'000; ++i) input.push_back(static_cast<float>(i) / 30'000.0f);
    input.resize(input.size() / 3 * 3);
    input.insert(input.end(), {0.04f, 1.0f, 0.0f});
    const std::vector<float> output = probes.run("packing", input, 3, 8);
    const double h = 0.5 / 255;
    for (std::size_t i = 0; i < input.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = input[i * 3 + c], y = output[i * 8 + 3 + c];
            // 1e-6: float32 rounding in the root, the product and the square.
            ASSERT_LE(std::abs(x - y), 2 * std::sqrt(x) * h + h * h + 1e-6) << x;
        }
    const float* last = &output[output.size() - 8];
    EXPECT_NEAR(last[3], 0.04f, 1e-8) << "the default F0";
    EXPECT_EQ(last[4], 1.0f);
    EXPECT_EQ(last[5], 0.0f);
}

// Numbers from 0 to 1 in 12 bits, and in 8: no channel shows F90, so its error is bounded here.
TEST(Encoding, UnormsRoundToNearest) {
    Probes probes;
    std::vector<float> input;
    for (int i = 0; i <= 20'000; ++i) input.insert(input.end(), {static_cast<float>(i) / 20'000.0f, 0, 0});
    const std::vector<float> output = probes.run("packing", input, 3, 8);
    for (const auto& [column, largest] : {std::pair<std::size_t, double>{6, 4095}, {7, 255}}) {
        double worst = 0;
        for (std::size_t i = 0; i <= 20'000; ++i)
            worst = std::max(worst, std::abs(double{output[i * 8 + column]} - double{input[i * 3]}));
        EXPECT_LE(worst, 0.5 / largest + 1e-7);
        EXPECT_GT(worst, 0.45 / largest);
    }
}

// Decoding always yields a unit vector.
TEST(Encoding, EveryOctahedralCodeIsAUnitVector) {
    Probes probes;
    for (const int bits : {8, 12, 16}) {
        std::vector<float> input;
        std::mt19937 random(5);
        for (int i = 0; i < 50'000; ++i) {
            std::normal_distribution<float> normal;
            const float x = normal(random), y = normal(random), z = normal(random),
                        length = std::sqrt(x * x + y * y + z * z);
            input.insert(input.end(), {x / length, y / length, z / length, static_cast<float>(bits)});
        }
        const std::vector<float> output = probes.run("octahedral", input, 4, 3);
        double worst = 0;
        for (std::size_t i = 0; i < output.size(); i += 3)
            worst = std::max(
                worst,
                std::abs(std::hypot(double{output[i]}, double{output[i + 1]}, double{output[i + 2]}) - 1));
        // A sum of three products, a root and a division, each rounded.
        EXPECT_LE(worst, 10 * 0x1p-24) << bits << " bits";
    }
}

// Decoded values are within [0, 1], even for inputs that are not.
TEST(Encoding, PackedNumbersStayWithinTheirDomain) {
    Probes probes;
    std::vector<float> input;
    for (const float x : {0.0f, 1.0f, 0.5f, 1e-30f, std::nextafter(1.0f, 0.0f), 1.5f, -0.5f, 1e30f, -1e30f})
        input.insert(input.end(), {x, x, x});
    const std::vector<float> output = probes.run("packing", input, 3, 8);
    for (std::size_t row = 0; row < input.size() / 3; ++row)
        for (std::size_t i = 3; i < 8; ++i) {
            EXPECT_GE(output[row * 8 + i], 0.0f) << input[row * 3];
            EXPECT_LE(output[row * 8 + i], 1.0f) << input[row * 3];
        }
}

}  // namespace
}  // namespace diptych
