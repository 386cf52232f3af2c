// SPDX-License-Identifier: MIT
// Pixels beside edges: how many of them may differ between devices, and the first that must not.
#include "compare/verdict/surface_pixels.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace diptych {
namespace {

TEST(SurfacePixels, AreSaidWithTheirLimits) {
    SurfacePixels pixels;
    const std::string start = "not compared: ";
    EXPECT_EQ(pixels.describe(),
              start +
                  "0 pixels where the other device shows another triangle, all beside an edge (tolerance: "
                  "0 of 0)");
    EXPECT_EQ(pixels.fault(), "");
    pixels.triangles = {2, 100, 8, 0, -1, -1};
    pixels.shadows = {3, 50, 9, 0, -1, -1};
    pixels.tied = 4;
    EXPECT_EQ(pixels.count(), 9u);
    EXPECT_EQ(pixels.describe(),
              start +
                  "2 pixels where the other device shows another triangle, all beside an edge (tolerance: "
                  "8 of 100); 3 in another shadow, all beside a shadow boundary (tolerance: 9 of 50); 4 "
                  "where two surfaces have the same depth");
    pixels.triangles.count = 8;
    pixels.shadows.count = 9;
    EXPECT_EQ(pixels.fault(), "");
    pixels.shadows.count = 10;
    EXPECT_EQ(pixels.fault(),
              "the other device shows another shadow at 10 pixels; tolerance: 9 of the 50 pixels beside a "
              "shadow boundary");
    pixels.shadows.strays = 1;
    pixels.shadows.x = 5, pixels.shadows.y = 6;
    EXPECT_EQ(pixels.fault(),
              "the other device shows another shadow at 1 pixel not beside a shadow boundary, the first at "
              "5,6");
    pixels.triangles.count = 9;
    EXPECT_EQ(pixels.fault(),
              "the other device shows another triangle at 9 pixels; tolerance: 8 of the 100 pixels beside an "
              "edge");
    EXPECT_EQ(surfacePixelChannels(), (std::vector<Channel>{Channel::material_id, Channel::depth,
                                                            Channel::position, Channel::geometric_normal}));
}

}  // namespace
}  // namespace diptych
