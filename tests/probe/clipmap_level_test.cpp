// SPDX-License-Identifier: MIT
// The level of the sun's clipmap that shaders choose, compared with the definition of levels.
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace diptych {
namespace {

// The finest level whose extent is at least the distance: exact at a level's end, the next one as soon as
// float32 exceeds it. Beyond all levels, the whole scene's.
TEST(ClipmapLevel, IsTheFinestThatReaches) {
    constexpr float levels = 9;
    std::vector<float> in;
    std::vector<int> expected;
    const auto add = [&](float x, float reach) {
        in.insert(in.end(), {x, 0, 0, reach, levels});
        int level = 0;
        while (level < static_cast<int>(levels) && double{x} > double{reach} * std::exp2(level)) ++level;
        expected.push_back(level);
    };
    for (const float reach : {0x1p-10f, 0.25f, 4.0f, 0x1p20f})
        for (int power = -4; power < 12; ++power) {
            const float end = reach * std::exp2(static_cast<float>(power));
            for (const float x : {end, std::nextafter(end, 0.0f), std::nextafter(end, 2 * end), 0.7f * end})
                add(x, reach);
        }
    add(0, 1);
    add(std::numeric_limits<float>::infinity(), 1);
    const std::vector<float> out = Probes().run("clipmap_level", in, 5, 1);
    for (std::size_t i = 0; i < out.size(); ++i)
        EXPECT_EQ(static_cast<int>(out[i]), expected[i]) << in[5 * i] << " of " << in[5 * i + 3];
}

}  // namespace
}  // namespace diptych
