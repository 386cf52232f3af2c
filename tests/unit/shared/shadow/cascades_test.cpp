// SPDX-License-Identifier: MIT
// Positions of the sun's shadow cascades.
#include "shared/shadow/cascades.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <random>

namespace diptych {
namespace {

View viewFrom(const glm::dvec3& eye, const glm::dvec3& target, double metre = 1) {
    View view;
    view.width = 320;
    view.height = 180;
    view.camera.near = 0.1 * metre;
    view.camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, {0.01, 1, 0.02}));
    return view;
}

Bounds boxOf(const glm::dvec3& min, const glm::dvec3& max) {
    Bounds bounds;
    bounds.min = min;
    bounds.max = max;
    return bounds;
}

const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.3, 1, 0.2));

// A point of the view; x and y are -1 to 1 over the image.
glm::dvec3 pointAt(const View& view, double x, double y, double depth) {
    const double aspect = static_cast<double>(view.width) / view.height;
    const double side = view.camera.orthographic ? view.camera.ymag : depth * std::tan(view.camera.yfov / 2);
    return view.eye() - view.backward() * depth + view.right() * (x * side * aspect) + view.up() * (y * side);
}

glm::dvec2 texelOf(const Cascades& cascades, const CascadeArea& area, const glm::dvec3& world) {
    return (glm::dvec2(cascades.space.from(world)) - area.corner) / area.texel;
}

TEST(Cascades, SplitsAreInOrderAndEndAtTheDistance) {
    for (const int count : {1, 2, 3, 4}) {
        const std::vector<double> ends = splitDepths(0.2, 100, count);
        ASSERT_EQ(ends.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(ends.back(), 100);
        for (std::size_t i = 1; i < ends.size(); ++i) EXPECT_LT(ends[i - 1], ends[i]);
    }
    // Three quarters of equal ratios (0.2 (500)^(1/2) = 4.472) and one quarter of equal differences
    // (50.1).
    EXPECT_NEAR(splitDepths(0.2, 100, 2).front(), 0.75 * 4.47214 + 0.25 * 50.1, 1e-4);
}

TEST(Cascades, LightSpaceIsRightHandedWhereverTheSunStands) {
    for (const glm::dvec3& to : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), toLight}) {
        const LightSpace space = lightSpace(to);
        EXPECT_EQ(space.z, to);
        EXPECT_NEAR(glm::length(glm::cross(space.x, space.y) - space.z), 0, 1e-12);
        EXPECT_NEAR(glm::dot(space.x, space.y), 0, 1e-12);
    }
}

// Each covers all its receivers and the filter around them: perspective or orthographic, in scenes of a
// millimetre and of a hundred kilometres.
TEST(Cascades, CoverWhatTheyServeAndTheFilterAroundIt) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double metre : {1e-3, 1.0, 1e4})
        for (const bool orthographic : {false, true})
            for (int i = 0; i < 20; ++i) {
                View view = viewFrom(glm::dvec3(any(random), any(random), any(random)) * (20 * metre),
                                     glm::dvec3(any(random), any(random), any(random)) * (20 * metre), metre);
                view.camera.orthographic = orthographic;
                view.camera.ymag = 3 * metre;
                const Bounds bounds = boxOf(glm::dvec3(-40, -2, -30) * metre, glm::dvec3(40, 10, 30) * metre);
                const CascadeRequest request{.size = 512, .count = 3, .kernel = 7};
                const Cascades cascades = fitCascades(view, bounds, toLight, request);
                ASSERT_EQ(cascades.areas.size(), 3u);
                for (const CascadeArea& area : cascades.areas)
                    for (int k = 0; k < 50; ++k) {
                        const double depth = area.begin + (area.end - area.begin) * (any(random) + 1) / 2;
                        const glm::dvec3 p = pointAt(view, any(random), any(random), depth);
                        // If a cascade covers the whole scene, only points of the scene.
                        if (glm::any(glm::lessThan(p, bounds.min)) ||
                            glm::any(glm::greaterThan(p, bounds.max)))
                            continue;
                        const glm::dvec2 texel = texelOf(cascades, area, p);
                        EXPECT_GE(std::min(texel.x, texel.y), 4.0);
                        EXPECT_LE(std::max(texel.x, texel.y), 508.0);
                        const glm::dvec4 clip =
                            cascades.clipFromWorld(area, 512, view.eye()) * glm::dvec4(p - view.eye(), 1);
                        EXPECT_NEAR((clip.x + 1) * 256, texel.x, 1e-6);
                        EXPECT_NEAR((clip.y + 1) * 256, texel.y, 1e-6);
                        EXPECT_GT(clip.z, 0);
                        EXPECT_LT(clip.z, 1);
                    }
            }
}

// Neighbours overlap where they blend, and the last ends at the requested distance.
TEST(Cascades, FollowEachOther) {
    const CascadeRequest request{.distance = 50};
    const Cascades cascades =
        fitCascades(viewFrom({0, 2, 9}, {0, 0, 0}), boxOf({-90, 0, -90}, {90, 9, 90}), toLight, request);
    EXPECT_EQ(cascades.areas.front().begin, 0);
    EXPECT_EQ(cascades.areas.back().end, 50);
    for (std::size_t i = 1; i < cascades.areas.size(); ++i) {
        const CascadeArea &before = cascades.areas[i - 1], &area = cascades.areas[i];
        EXPECT_NEAR(area.begin, before.end - 0.1 * (before.end - before.begin), 1e-12);
        EXPECT_GT(area.texel, before.texel);
    }
}

// A texel covers the same part of the world for any camera position and direction.
TEST(Cascades, StayOnTheirTexelsWhileTheCameraMoves) {
    const Bounds bounds = boxOf({-300, 0, -300}, {300, 9, 300});
    const CascadeRequest request{.distance = 60};
    const Cascades first = fitCascades(viewFrom({0, 2, 9}, {0, 0, 0}), bounds, toLight, request);
    for (int i = 1; i < 30; ++i) {
        const View view = viewFrom({0.37 * i, 2, 9 - 0.11 * i}, {std::sin(i), 0.1 * i, 0});
        const Cascades now = fitCascades(view, bounds, toLight, request);
        EXPECT_EQ(now.near, first.near);
        EXPECT_EQ(now.far, first.far);
        for (std::size_t k = 0; k < now.areas.size(); ++k) {
            EXPECT_NEAR(now.areas[k].texel, first.areas[k].texel, 1e-12);
            const glm::dvec2 moved = (now.areas[k].corner - first.areas[k].corner) / first.areas[k].texel;
            EXPECT_NEAR(glm::length(moved - glm::round(moved)), 0, 1e-6);
        }
    }
}

// If the scene is smaller than the view, no texel is wasted around it, and the map does not move.
TEST(Cascades, OfASmallSceneCoverIt) {
    const Bounds bounds = boxOf({-1, -1, -1}, {1, 1, 1});
    const Cascades one = fitCascades(viewFrom({0, 2, 9}, {0, 0, 0}), bounds, toLight, {.count = 1});
    const Cascades other = fitCascades(viewFrom({5, 2, 9}, {0, 0, 0}), bounds, toLight, {.count = 1});
    EXPECT_EQ(one.areas[0].corner, other.areas[0].corner);
    EXPECT_LT(one.areas[0].texel * 2048, 2 * std::sqrt(3.0) * 1.02);
}

// The shaders' constants agree with the matrices that draw the maps.
TEST(Cascades, ShadersAndMapsAgree) {
    const View view = viewFrom({3, 2, 9}, {0, 0, 0});
    const CascadeRequest request{.size = 1024};
    const Cascades cascades = fitCascades(view, boxOf({-30, 0, -30}, {30, 9, 30}), toLight, request);
    const gpu::ShadowLight light = gpuShadowLight(cascades, view, 2);
    const std::vector<gpu::Cascade> areas = gpuCascades(cascades, view.eye(), 0.5);
    EXPECT_EQ(light.light, 2u);
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const glm::dvec3 p = pointAt(view, 0.3, -0.2, cascades.areas[i].end);
        const glm::vec3 position(p - view.eye());
        const glm::dvec4 clip =
            cascades.clipFromWorld(cascades.areas[i], 1024, view.eye()) * glm::dvec4(p - view.eye(), 1);
        const glm::vec2 texel =
            glm::vec2(glm::dot(position, light.x), glm::dot(position, light.y)) * areas[i].texels_per_metre +
            areas[i].offset;
        EXPECT_NEAR(double{texel.x}, (clip.x + 1) * 512, 1e-3);
        EXPECT_NEAR(double{texel.y}, (clip.y + 1) * 512, 1e-3);
        EXPECT_NEAR(double{glm::dot(position, light.to_light) * light.depth_scale + light.depth_offset},
                    clip.z, 1e-6);
        EXPECT_NEAR(double{glm::dot(position, light.forward)}, cascades.areas[i].end, 1e-5);
        EXPECT_EQ(light.ends[static_cast<int>(i)], static_cast<float>(cascades.areas[i].end));
    }
}

}  // namespace
}  // namespace diptych
