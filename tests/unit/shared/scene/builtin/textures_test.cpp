// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/textures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace diptych {
namespace {

TEST(Textures, ACheckerAlternates) {
    const TextureImage squares = checker("checker", 4, 2, {1, 2, 3, 4}, {5, 6, 7, 8});
    EXPECT_EQ(squares.rgba[0], 1);
    EXPECT_EQ(squares.rgba[8], 5);          // the third texel of the first row
    EXPECT_EQ(squares.rgba[4 * 4 * 2], 5);  // the first texel of the third row
}

TEST(Textures, NormalMapsRiseTowardsTheTop) {
    // A ramp that rises to the right and, more steeply, to the top. Normals tilt to the left and, more
    // strongly, downwards.
    HeightField ramp{16, {}};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) ramp.height.push_back(1000 * x + 2000 * (15 - y));
    const TextureImage map = normalMap("ramp", ramp, 16);
    const std::uint8_t* n = &map.rgba[4 * (16 * 8 + 8)];
    // Slopes 1000 * 16 / 65535 = 0.24414 and 0.48828: n = (-0.24414, -0.48828, 1) / 1.13941, in steps of 1
    // / 127.5.
    EXPECT_EQ(n[0], std::lround((1 - 0.24414 / 1.13941) * 127.5));
    EXPECT_EQ(n[1], std::lround((1 - 0.48828 / 1.13941) * 127.5));
    EXPECT_EQ(n[2], std::lround((1 + 1 / 1.13941) * 127.5));
}

TEST(Textures, CutOutsHaveBothInsideAndOutside) {
    for (const TextureImage& image : {leaf("leaf", 128), lattice("lattice", 128)}) {
        std::size_t inside = 0;
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
            EXPECT_TRUE(image.rgba[i] == 0 || image.rgba[i] == 255);
            inside += image.rgba[i] == 255;
        }
        EXPECT_GT(inside, image.rgba.size() / 4 / 8) << image.name;
        EXPECT_LT(inside, image.rgba.size() / 4 * 3 / 4) << image.name;
    }
}

}  // namespace
}  // namespace diptych
