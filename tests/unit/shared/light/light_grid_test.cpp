// SPDX-License-Identifier: MIT
// Cells of the light lists, and light ranges for a cutoff.
#include "shared/light/light_grid.h"
#include "shared/light/cutoff.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/load.h"
#include "tests/support/light_formulas.h"
#include "tests/support/light_kinds.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>

namespace diptych {
namespace {

constexpr std::uint64_t lavapipes = std::uint64_t{128} << 20;

DeviceCosts costsOf(const char* deviceType) {
    DeviceInfo info;
    info.type = deviceType;
    return profileOf(info, 0).costs;
}

View viewOf(int width, int height) {
    View view;
    view.width = width;
    view.height = height;
    return view;
}

std::vector<Light> pointsAhead(std::size_t count, float range) {
    std::vector<Light> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        lights[i].position = {0.01 * static_cast<double>(i % 100) - 0.5, 0,
                              -2 - 0.3 * static_cast<double>(i % 50)};
        lights[i].range = range;
    }
    return lights;
}

gpu::LightGrid gridOf(gpu::uint lists, const View& view, const std::vector<Light>& lights,
                      const DeviceCosts& costs = costsOf("cpu")) {
    const GpuLights gpu = gpuLights(lights, glm::dvec3(0));
    return makeLightGrid({lists}, view, gpu, lightBounds(gpu, view), costs, lavapipes);
}

std::tuple<gpu::uint, gpu::uint, gpu::uint> cellSizeOf(const gpu::LightGrid& grid) {
    return {grid.tile_shift, grid.slice_shift, grid.slices};
}

// Only ratios of costs matter; expensive lists mean fewer of them.
TEST(LightGrid, HasTheSizeThatCostsLeastOnTheDevice) {
    const std::vector<Light> lights = pointsAhead(300, 3);
    const auto with = [&](const DeviceCosts& costs) {
        return gridOf(gpu::LISTS_CLUSTERED, viewOf(640, 360), lights, costs);
    };
    const DeviceCosts cpu = costsOf("cpu"), gpu = costsOf("discrete");
    EXPECT_LT(gpu.list, cpu.list);
    EXPECT_EQ(cellSizeOf(with(gpu)), cellSizeOf(with(cpu)));
    DeviceCosts lists = cpu, pixels = cpu;
    lists.list *= 100;
    pixels.evaluated *= 100;
    EXPECT_LT(with(lists).lists, with(cpu).lists);
    EXPECT_GT(with(pixels).lists, with(cpu).lists);
}

TEST(LightGrid, CoversAnyImageWithWholeTiles) {
    for (const auto& [width, height] : {std::pair{1, 1}, {15, 17}, {16, 16}, {1279, 719}, {16384, 3}})
        for (const gpu::uint lists : {gpu::LISTS_CLUSTERED, gpu::LISTS_TILED}) {
            const gpu::LightGrid grid = gridOf(lists, viewOf(width, height), pointsAhead(300, 3));
            const auto side = 1u << grid.tile_shift;
            EXPECT_GE(grid.tiles.x * side, static_cast<unsigned>(width));
            EXPECT_LT((grid.tiles.x - 1) * side, static_cast<unsigned>(width));
            EXPECT_GE(grid.tiles.y * side, static_cast<unsigned>(height));
            EXPECT_EQ(grid.lists, grid.tiles.x * grid.tiles.y * grid.slices);
            if (lists == gpu::LISTS_TILED) {
                EXPECT_EQ(side, gpu::LIGHT_TILE);
            }
        }
}

TEST(LightGrid, NoBufferExceedsTheDevices) {
    for (const gpu::uint lists : {gpu::LISTS_CLUSTERED, gpu::LISTS_TILED})
        for (const std::size_t count : {std::size_t{1}, std::size_t{4096}, std::size_t{65600}}) {
            const gpu::LightGrid grid = gridOf(lists, viewOf(3840, 2160), pointsAhead(count, 5));
            EXPECT_LE(std::uint64_t{grid.words} * grid.lists * 4, lavapipes) << count;
            EXPECT_LE(std::uint64_t{grid.capacity} * grid.width * 4, lavapipes) << count;
            EXPECT_GE(grid.capacity, grid.all_end) << "the list of all lights always fits";
        }
}

TEST(LightGrid, SlicesMeetAndTheLastHasNoEnd) {
    const gpu::LightGrid grid = gridOf(gpu::LISTS_CLUSTERED, viewOf(640, 360), pointsAhead(300, 3));
    ASSERT_GT(grid.slices, 4u);
    EXPECT_EQ(sliceDepths(grid, 0).near, 0.0f);
    EXPECT_EQ(sliceDepths(grid, grid.slices - 1).far, gpu::MAX_BOUND_RADIUS);
    for (gpu::uint s = 0; s + 1 < grid.slices; ++s) {
        const SliceDepths a = sliceDepths(grid, s), b = sliceDepths(grid, s + 1);
        EXPECT_GE(a.far, b.near) << "no gap that rounding could fall into";
        EXPECT_LT(a.far - b.near, 1e-4f * b.near);
        EXPECT_LT(a.near, a.far);
    }
}

TEST(LightGrid, LightsThatEndNowhereAreListedInAllCells) {
    const gpu::LightGrid grid = gridOf(gpu::LISTS_CLUSTERED, viewOf(640, 360),
                                       pointsAhead(10, std::numeric_limits<float>::infinity()));
    EXPECT_GE(std::uint64_t{grid.capacity} * grid.width, std::uint64_t{10} * grid.lists);
}

class LightBoundOf : public testing::TestWithParam<LightKind> {};

// Directional lights are in no list. View axes are the world's with y and z inverted.
TEST_P(LightBoundOf, HoldsEveryPlaceThatItLights) {
    Light light;
    light.kind = GetParam();
    light.position = {1, 2, -9};
    light.direction = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
    light.axis = anyAcross(light.direction);
    light.range = 3;
    const auto bounds = lightBounds(gpuLights(std::span(&light, 1), glm::dvec3(0)), viewOf(64, 64));
    ASSERT_EQ(bounds.size(), GetParam() == LightKind::directional ? 0u : 1u);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> within(-3, 3);
    int lit = 0;
    for (int i = 0; i < 300 && !bounds.empty(); ++i) {
        const glm::dvec3 from(within(random), within(random), within(random));
        Light seen = light;
        seen.position = -from;
        // An area light's back counts too.
        if (!(isArea(GetParam()) ? glm::length(from) < 3
                                 : irradianceFrom(seen, glm::normalize(seen.position)) > 0))
            continue;
        ++lit;
        const glm::dvec3 at = light.position + from, there(at.x, -at.y, -at.z);
        EXPECT_LE(glm::distance(there, glm::dvec3(bounds[0].centre)), double{bounds[0].radius});
        EXPECT_GE(glm::dot(there - glm::dvec3(bounds[0].apex), glm::dvec3(bounds[0].axis)),
                  double{bounds[0].cos_cone} * glm::length(from));
    }
    for (const gpu::LightBound& bound : bounds) {
        EXPECT_GT(lit, 10);
        EXPECT_LE(bound.radius, 3.001f) << "and little else";
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LightBoundOf, testing::ValuesIn(everyLightKind()), lightKindName);

TEST(LightCutoffRange, IsWhereAWhiteSurfaceIsAsDim) {
    Light light;
    light.intensity = 5;
    const double range = cutoffRange(light, 0.01);
    EXPECT_NEAR(5 / (range * range) / std::numbers::pi, 0.01, 1e-9);
    Light ends = light;
    ends.range = 2;
    const std::vector<Light> lights = withCutoff({light, ends}, 0.01);
    EXPECT_NEAR(lights[0].range, range, 1e-5 * range);
    EXPECT_EQ(lights[1].range, 2) << "its own stays";
    EXPECT_TRUE(std::isinf(withCutoff({light}, 0)[0].range));
}

TEST(LightCutoffRange, TheEnergyCutIsAShare) {
    const Scene scene = loadScene("builtin:spheres?lights=4");
    const Pose pose = poseAt(scene, 0);
    Light lamp;
    lamp.position = {0, 2, 0};
    EXPECT_EQ(energyCut(scene, pose, std::vector{lamp}, 0, {}), 0);
    double before = 0;
    for (const double cutoff : {1e-6, 1e-3, 0.1}) {
        const double cut = energyCut(scene, pose, std::vector{lamp}, cutoff, {});
        EXPECT_GT(cut, before);
        before = cut;
    }
    EXPECT_GT(before, 0.9);
    lamp.range = 3;
    EXPECT_EQ(energyCut(scene, pose, std::vector{lamp}, 1, {}), 0) << "it has a range";
}

// A lamp and a spot light a square of 1 mm from 1 m above. The spot's axis misses it by 0.4 rad, so that it
// is between its cones. The spot is four times as strong, so its squared range is four times as large.
TEST(LightCutoffRange, TheEnergyCutHasTheFalloff) {
    Scene scene;
    scene.meshes.push_back({"square", {rectangle({-5e-4f, -5e-4f, 0}, {1e-3f, 0, 0}, {0, 1e-3f, 0})}});
    scene.nodes.push_back({"square", -1, glm::dmat4(1.0), 0});
    scene.materials.push_back({});
    Light lamp;
    lamp.position = {0, 0, 1};
    lamp.intensity = 1;
    Light spot = lamp;
    spot.kind = LightKind::spot;
    spot.intensity = 4;
    spot.direction = {std::sin(0.4), 0, -std::cos(0.4)};
    spot.inner_cone = 0.2f;
    spot.outer_cone = 0.6f;
    // x: squared distance by the lamp's squared range.
    const double cutoff = 0.25, x = std::numbers::pi * cutoff;
    const double t = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    for (const bool squared : {false, true})
        for (const bool smooth : {false, true}) {
            const double cone = 4 * (smooth ? t * t * (3 - 2 * t) : t * t), power = squared ? 2 : 1;
            const double kept = std::pow(1 - x * x, power) + cone * std::pow(1 - x * x / 16, power);
            // The square's half diagonal changes the cosine by 3e-4, and its cone by 0.2 %.
            EXPECT_NEAR(energyCut(scene, poseAt(scene, 0), std::vector{lamp, spot}, cutoff,
                                  {.squared_window = squared, .smooth_cones = smooth}),
                        1 - kept / (1 + cone), 1e-4)
                << squared << smooth;
        }
}

}  // namespace
}  // namespace diptych
