// SPDX-License-Identifier: MIT
// Subnormals become 0; every other number keeps its bits.
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace diptych {
namespace {

TEST(Flushed, OnlySubnormalsBecomeZero) {
    using Float = std::numeric_limits<float>;
    const float subnormal = std::nextafter(Float::min(), 0.0f), next = std::nextafter(Float::min(), 1.0f);
    std::vector<float> input;
    for (const float size : {0.0f, Float::denorm_min(), 0x1p-140f, subnormal, Float::min(), next, 0x1p-125f,
                             1.0f, Float::max(), Float::infinity()})
        for (const float x : {size, -size, 0.5f}) input.push_back(x);
    Probes probes;
    const std::vector<float> output = probes.run("flushed", input, 3, 3);
    for (std::size_t i = 0; i < input.size(); ++i)
        if (std::abs(input[i]) < Float::min()) {
            EXPECT_EQ(std::abs(output[i]), 0.0f) << input[i];
        } else {
            EXPECT_EQ(std::bit_cast<std::uint32_t>(output[i]), std::bit_cast<std::uint32_t>(input[i]))
                << input[i];
        }
}

}  // namespace
}  // namespace diptych
