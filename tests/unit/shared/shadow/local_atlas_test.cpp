// SPDX-License-Identifier: MIT
// Shadow map tiles of point and spot lights in their atlas.
#include "shared/shadow/local_atlas.h"
#include "shared/shadow/scene_bounds.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace diptych {
namespace {

View lookingFrom(const glm::dvec3& eye, const glm::dvec3& target) {
    View view;
    view.width = 320;
    view.height = 180;
    view.camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, {0.01, 1, 0.02}));
    return view;
}

Light pointAt(const glm::dvec3& position, float range = std::numeric_limits<float>::infinity()) {
    Light light;
    light.position = position;
    light.range = range;
    return light;
}
Light spotAt(const glm::dvec3& position, const glm::dvec3& direction, double degrees) {
    Light light = pointAt(position);
    light.kind = LightKind::spot;
    light.direction = glm::normalize(direction);
    light.outer_cone = static_cast<float>(glm::radians(degrees));
    return light;
}

Bounds roomBounds() {
    Bounds bounds;
    bounds.min = {-5, 0, -5};
    bounds.max = {5, 3, 5};
    return bounds;
}

// The visible geometry is the room itself.
LocalAtlas atlasOf(const std::vector<Light>& lights, const View& view, const AtlasRequest& request = {},
                   const Bounds& bounds = roomBounds()) {
    std::array<glm::dvec3, 8> box = cornersOf(bounds);
    for (glm::dvec3& corner : box) corner -= view.eye();
    return layOutAtlas(lights, bounds, std::span(&box, 1), std::span(&box, 1), view, request);
}

// Number of texels that belong to no tile, or to several.
std::size_t texelsNotOwnedOnce(const LocalAtlas& atlas) {
    std::vector<int> owners(static_cast<std::size_t>(atlas.side) * static_cast<std::size_t>(atlas.side));
    std::size_t wrong = 0;
    for (const AtlasTile& tile : atlas.tiles)
        for (int y = tile.corner.y; y < tile.corner.y + tile.size; ++y)
            for (int x = tile.corner.x; x < tile.corner.x + tile.size; ++x)
                if (x < 0 || y < 0 || x >= atlas.side || y >= atlas.side ||
                    owners[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.side) +
                           static_cast<std::size_t>(x)]++ > 0)
                    ++wrong;
    return wrong;
}

// Tiles of any number of lights, sizes and positions share no texel and are all inside the atlas.
TEST(LocalAtlas, TilesShareNoTexel) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const int count : {1, 2, 7, 42})
        for (const int size : {16, 512, 700, 2048}) {
            std::vector<Light> lights;
            for (int i = 0; i < count; ++i) {
                const glm::dvec3 at(4 * any(random), 1.5 + any(random), 4 * any(random));
                if (i % 3 == 0)
                    lights.push_back(spotAt(at, {any(random), -1, any(random)}, 20 + 65 * (i % 2)));
                else
                    lights.push_back(pointAt(at, 1 + static_cast<float>(i % 4)));
            }
            LocalAtlas atlas = atlasOf(lights, lookingFrom({4, 2, 12}, {0, 1, 0}), {.size = size});
            ASSERT_FALSE(atlas.tiles.empty());
            EXPECT_EQ(texelsNotOwnedOnce(atlas), 0u) << count << " " << size;
            for (const AtlasTile& tile : atlas.tiles) EXPECT_GE(tile.size, minTile);
            // Negative control.
            atlas.tiles.back().corner.x += atlas.tiles.size() > 1 ? -1 : 1;
            EXPECT_GT(texelsNotOwnedOnce(atlas), 0u) << count << " " << size;
        }
}

// A light that covers less of the image gets smaller tiles.
TEST(LocalAtlas, TilesFollowTheLightsPartOfTheImage) {
    const View view = lookingFrom({0, 1.5, 30}, {0, 1.5, 0});
    const LocalAtlas atlas = atlasOf({spotAt({0, 2, 0}, {0, -1, 0}, 40), pointAt({2, 1, 0}, 1.0f)}, view);
    ASSERT_FALSE(atlas.tiles.empty());
    const AtlasTile &large = atlas.tiles[static_cast<std::size_t>(atlas.lights[0].tiles[4])],
                    &small = atlas.tiles[static_cast<std::size_t>(atlas.lights[1].tiles[2])];
    // Its range of 5.5 m at 30 m is a third of the image's height of 34.6 m; 1 m is a seventeenth.
    EXPECT_EQ(large.size, 256);
    EXPECT_EQ(small.size, 32);
    const LocalAtlas near = atlasOf({pointAt({0, 1.5, 29}, 4.0f)}, view);
    for (const AtlasTile& tile : near.tiles) EXPECT_EQ(tile.size, 512) << "the eye is within its reach";
    EXPECT_EQ(atlasOf({spotAt({0, 2, 0}, {0, -1, 0}, 40)}, view).side, 256) << "no more than is needed";
}

// Faces without visible geometry, or beside the view, have no tile; they are counted as unseen.
TEST(LocalAtlas, WhatReachesNothingThatIsSeenHasNoTile) {
    const View view = lookingFrom({0, 1.5, 12}, {0, 1.5, 0});
    const LocalAtlas above = atlasOf({pointAt({0, 3.5, 0})}, view);
    EXPECT_EQ(above.lights[0].tiles[2], -1) << "nothing is above the lamp";
    EXPECT_GE(above.lights[0].tiles[3], 0);
    EXPECT_EQ(above.tiles.size() + above.unseen, 6u);
    const LocalAtlas beside = atlasOf({pointAt({60, 1.5, 0}, 20.0f)}, view);
    EXPECT_TRUE(beside.tiles.empty());
    EXPECT_EQ(beside.side, 0);
    EXPECT_EQ(beside.unseen, 6u);
    EXPECT_TRUE(atlasOf({pointAt({0, 1.5, -30}, 20.0f)}, view).tiles.empty()) << "no box is within its range";
    EXPECT_TRUE(atlasOf({pointAt({0, 1.5, 40}, 20.0f)}, view).tiles.empty()) << "behind the eye";
    const LocalAtlas wide = atlasOf({spotAt({0, 1.5, 0}, {0, 0, -1}, 80)}, view);
    EXPECT_EQ(wide.lights[0].tiles[5], -1) << "behind a spot";
    EXPECT_EQ(wide.tiles.size(), 5u);
}

// A small object on the floor only casts downwards; without casters there is no tile.
TEST(LocalAtlas, WhatNothingCastsIntoHasNoTile) {
    const View view = lookingFrom({0, 1.5, 12}, {0, 1.5, 0});
    const std::vector<Light> lights{pointAt({0, 1.5, 0})};
    Bounds small;
    small.min = {-0.1, 0, -0.1};
    small.max = {0.1, 0.3, 0.1};
    std::array<glm::dvec3, 8> room = cornersOf(roomBounds()), thing = cornersOf(small);
    for (auto* box : {&room, &thing})
        for (glm::dvec3& corner : *box) corner -= view.eye();
    const std::span seen(&room, 1);
    const LocalAtlas atlas = layOutAtlas(lights, roomBounds(), seen, std::span(&thing, 1), view, {});
    ASSERT_EQ(atlas.tiles.size(), 1u);
    EXPECT_EQ(atlas.tiles[0].face, 3u);
    EXPECT_EQ(atlas.empty, 5u);
    const LocalAtlas none = layOutAtlas(lights, roomBounds(), seen, {}, view, {});
    EXPECT_EQ(none.side, 0);
    EXPECT_EQ(none.empty, 6u);
    EXPECT_EQ(none.lights.size(), 1u) << "what is turned from it sees nothing of it all the same";
}

// The shaders' constants agree with the matrices that draw the tiles, and the filter of every receiver
// stays in its face's tile.
TEST(LocalAtlas, ShadersAndTilesAgree) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1, 1);
    const View view = lookingFrom({1, 2, 4}, {0, 1, 0});
    const AtlasRequest request{.size = 1024, .kernel = 7, .bias = 0.25};
    const std::vector<Light> lights{pointAt({0.4, 1.2, -0.3}), spotAt({1, 2.5, 1}, {-0.3, -1, 0.2}, 30),
                                    spotAt({-2, 2, 0}, {1, -1, 0.4}, 85)};
    const LocalAtlas atlas = atlasOf(lights, view, request);
    const std::vector<glm::vec4> texels = gpuTexels(atlas, request);
    ASSERT_EQ(texels.size(), lights.size() * gpu::LOCAL_SHADOW_TEXELS);
    EXPECT_EQ(atlas.tiles.size() + atlas.unseen, 12u);
    for (const AtlasTile& tile : atlas.tiles) {
        const AtlasLight& light = atlas.lights[tile.light];
        const glm::vec4* const own = &texels[tile.light * gpu::LOCAL_SHADOW_TEXELS];
        const glm::vec4 face = own[3 + tile.face];
        const auto axes = faceAxes(light, tile.face);
        EXPECT_EQ(own[2].w, 0.25f);
        for (int i = 0; i < 200; ++i) {
            // In the light's axes for a face, as defined in the contract.
            const double a = light.tangent * any(random), b = light.tangent * any(random),
                         depth = light.far * (0.01 + 0.98 * std::abs(any(random)));
            const glm::dvec3 point = light.position + depth * (a * axes[0] + b * axes[1] + axes[2]);
            const glm::dvec4 clip = atlas.clipFromWorld(tile, view.eye()) * glm::dvec4(point - view.eye(), 1);
            const glm::dvec2 drawn =
                (glm::dvec2(clip) / clip.w + 1.0) * (tile.size / 2.0) + glm::dvec2(tile.corner);
            EXPECT_NEAR(drawn.x, double{face.x} + double{face.z} * a, 1e-3);
            EXPECT_NEAR(drawn.y, double{face.y} + double{face.z} * b, 1e-3);
            EXPECT_NEAR(clip.z / clip.w, double{own[0].w} / depth + double{own[1].w}, 1e-7);
            const glm::dvec2 from = glm::abs(drawn - glm::dvec2(tile.corner) - tile.size / 2.0);
            EXPECT_LE(std::max(from.x, from.y) + 4, tile.size / 2.0) << "half of seven texels, and a half";
        }
        EXPECT_LE(double{face.w} + 4, tile.size / 2.0);
    }
}

// Depth is 1 at the nearest caster, 0 at the end of the light: at its range, or at the scene's farthest
// corner.
TEST(LocalAtlas, DepthEndsWhereTheLightDoes) {
    const View view = lookingFrom({1, 2, 4}, {0, 1, 0});
    const LocalAtlas atlas = atlasOf({pointAt({0, 1, 0}, 2.0f), pointAt({0, 1, 0})}, view);
    EXPECT_NEAR(atlas.lights[0].far, 2, 0.01);
    EXPECT_NEAR(atlas.lights[1].far, std::sqrt(25 + 25 + 4.0), 0.01);
    for (const AtlasLight& light : atlas.lights) {
        const AtlasTile& tile = atlas.tiles[static_cast<std::size_t>(light.tiles[5])];
        const auto depthAt = [&](double z) {
            const glm::dvec4 clip = atlas.clipFromWorld(tile, view.eye()) *
                                    glm::dvec4(light.position - glm::dvec3(0, 0, z) - view.eye(), 1);
            return clip.z / clip.w;
        };
        EXPECT_NEAR(depthAt(light.near), 1, 1e-9);
        EXPECT_NEAR(depthAt(light.far), 0, 1e-9);
    }
}

}  // namespace
}  // namespace diptych
