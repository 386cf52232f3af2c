// SPDX-License-Identifier: MIT
// The lights that cast shadows.
#include "shared/scene/lights/shadow_casters.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace diptych {
namespace {

using Places = std::vector<std::size_t>;

Light shining(LightKind kind, float intensity, bool asks = false) {
    Light light;
    light.kind = kind;
    light.intensity = intensity;
    light.shadow = asks;
    return light;
}

TEST(Casters, AreTheBrightestAndThoseThatAsk) {
    std::vector<Light> lights{shining(LightKind::point, 1), shining(LightKind::rect, 100, true),
                              shining(LightKind::spot, 3),  shining(LightKind::point, 2, true),
                              shining(LightKind::point, 3), shining(LightKind::directional, 5)};
    EXPECT_EQ(localCasting(lights, 0).lights, (Places{3})) << "an area light throws no shadow";
    EXPECT_EQ(localCasting(lights, 1).lights, (Places{2, 3})) << "of equals the first";
    EXPECT_EQ(localCasting(lights, 2).lights, (Places{2, 3, 4}));
    EXPECT_EQ(localCasting(lights, 2).unshadowed, 1u);
    EXPECT_EQ(localCasting(lights, 9).lights, (Places{0, 2, 3, 4}));
    EXPECT_EQ(castingLights(lights, 1), (Places{2, 3, 5})) << "and the sun, in ascending order";
    // A colour's luminance counts.
    lights[2].color = {0, 0, 1};
    EXPECT_EQ(localCasting(lights, 1).lights, (Places{3, 4}));
}

TEST(Casters, GiveLight) {
    std::vector<Light> lights{shining(LightKind::point, 0, true), shining(LightKind::point, 1, true),
                              shining(LightKind::point, 1)};
    lights[1].range = 0;
    EXPECT_EQ(localCasting(lights, 5).lights, (Places{2}));
    EXPECT_EQ(localCasting(lights, 0).unshadowed, 1u) << "what gives nothing is not missed";
    EXPECT_TRUE(castingLights({}, 4).empty());
}

// A cone of 90 degrees fits a face; a wider one meets four more, and a point light all six.
TEST(Casters, TakeAsManyTilesAsTheirLightMayReach) {
    Light spot = shining(LightKind::spot, 1);
    EXPECT_EQ(shadowTiles(spot), 1) << "glTF's default cone";
    spot.outer_cone = 0.79f;
    EXPECT_EQ(shadowTiles(spot), 5);
    EXPECT_EQ(shadowTiles(shining(LightKind::point, 1)), 6);
}

// The most intense lights get tiles first; a light that does not fit leaves its tiles to others.
TEST(Casters, AreNoMoreThanTheAtlasHolds) {
    std::vector<Light> lights(60, shining(LightKind::point, 1));
    lights[59].intensity = 2;
    lights.push_back(shining(LightKind::spot, 0.5f, true));
    const LocalCasting casting = localCasting(lights, 50);
    EXPECT_EQ(casting.lights.size(), 43u) << "42 points take 252 of 256 tiles, and a spot one";
    EXPECT_EQ(casting.lights[41], 59u);
    EXPECT_EQ(casting.lights.back(), 60u);
    EXPECT_EQ(casting.over_capacity, 8u);
    EXPECT_EQ(casting.unshadowed, 18u);
    EXPECT_EQ(castingLights(lights, 50), casting.lights) << "the reference is told the same";
}

}  // namespace
}  // namespace diptych
