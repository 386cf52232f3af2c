// SPDX-License-Identifier: MIT
// The froxels at the ends of the grid: lights that reach only pixels of the first or last slice, or of the
// first or last column or row of tiles. In most images no missing light would show there.
#include "shared/contract/debug_mode.h"
#include "shared/light/light_grid.h"
#include "shared/scene/view.h"
#include "tests/image/square.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <set>

namespace diptych::tests {
namespace {

constexpr Size cutOff{213, 119};  // neither is a multiple of the tile size
constexpr double halfFieldTangent = 0.5;

// A white wall across the view at this distance; the camera is at the origin and looks along -Z.
Scene wallAt(double distance, double near) {
    Scene scene = square();
    scene.images.clear(), scene.textures.clear();
    scene.nodes[0].parent_from_node = glm::dmat4(20 * distance);
    scene.nodes[0].parent_from_node[3] = {0, 0, -distance, 1};
    scene.materials[0].metallic = 0;
    scene.cameras[0].yfov = 2 * std::atan(halfFieldTangent);
    scene.cameras[0].near = near;
    scene.cameras[0].world_from_camera[3] = {0, 0, 0, 1};
    return scene;
}

Light lampOf(const glm::dvec3& position, double range) {
    Light light;
    light.kind = LightKind::point;
    light.position = position;
    light.intensity = static_cast<float>(100 * range * range);
    light.range = static_cast<float>(range);
    return light;
}

// By shared/contract/light_list.h: the float's bits above the offset's, shifted.
gpu::uint sliceAt(const gpu::LightGrid& grid, double depth) {
    const float sum = static_cast<float>(depth) + grid.slice_offset;
    const gpu::uint steps = std::bit_cast<gpu::uint>(sum) - std::bit_cast<gpu::uint>(grid.slice_offset);
    return steps >> grid.slice_shift;
}
gpu::LightGrid froxelsOf(const Scene& scene) {
    const Pose pose = poseAt(scene, 0);
    const View view = makeView(scene, pose, "", cutOff.width, cutOff.height);
    const GpuLights lights = gpuLights(pose.lights, view.eye());
    return makeLightGrid({gpu::LISTS_CLUSTERED}, view, lights, lightBounds(lights, view),
                         device().profile().costs, std::uint64_t{128} << 20);
}

struct DrawnLights {
    Image lit, count;
};
DrawnLights drawnWith(Renderer& renderer, Path path, Assignment assign, LightKernel kernel) {
    Settings settings = unshadowed();
    settings.path = path;
    settings.size = cutOff;
    settings.assign = assign;
    settings.light_kernel = kernel;
    settings.gbuffer = GBufferEncoding::full;
    Frame frame = renderer.draw(settings, untimed({Channel::lit, Channel::light_count}));
    EXPECT_EQ(frame.counters.overflowed_lists, 0u);
    return {std::move(frame.channels.at(Channel::lit)), std::move(frame.channels.at(Channel::light_count))};
}

std::set<std::pair<int, int>> litPixels(const Image& image) {
    std::set<std::pair<int, int>> pixels;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.at(x, y, 0) > 0) pixels.insert({x, y});
    return pixels;
}

// Every assignment gives the image of `every`, and each lit pixel evaluated a light. Returns the lit
// pixels.
std::set<std::pair<int, int>> expectLitAlike(const Scene& scene) {
    Renderer renderer(device(), scene, pipelines());
    const DrawnLights every =
        drawnWith(renderer, Path::forward_plus, Assignment::every, LightKernel::automatic);
    const std::set<std::pair<int, int>> pixels = litPixels(every.lit);
    for (const Path path : {Path::forward_plus, Path::deferred})
        for (const Assignment assign : {Assignment::clustered, Assignment::tiled})
            for (const LightKernel kernel : {LightKernel::scatter, LightKernel::gather}) {
                const DrawnLights some = drawnWith(renderer, path, assign, kernel);
                const std::string what =
                    fmt::format("{}, {}, {}", nameOf(path), nameOf(assign), nameOf(kernel));
                EXPECT_EQ(differingPixels(every.lit, some.lit), 0u) << what;
                for (const auto& [x, y] : pixels)
                    EXPECT_GE(some.count.at(x, y), 1) << what << ": " << x << ", " << y;
            }
    return pixels;
}

// A light that ends just behind the wall, in the wall's slice. On the wall it lights a disc with a radius
// of sqrt(1 - 0.98^2) = 0.2 of its range.
TEST(LightCells, TheLastSliceOfFroxelsIsUsed) {
    for (const double range : {2.0, 0.5}) {
        // Slice boundaries depend on the device's costs.
        double wall = 10;
        Scene scene;
        gpu::LightGrid grid{};
        for (int i = 0; i < 40; ++i, wall *= 1.01) {
            scene = wallAt(wall, 0.1);
            scene.lights = {lampOf({0.5, 0.3, -(wall - 0.98 * range)}, range)};
            grid = froxelsOf(scene);
            if (sliceAt(grid, wall) == grid.slices - 1) break;
        }
        ASSERT_EQ(sliceAt(grid, wall), grid.slices - 1) << "the wall is in the last slice";
        ASSERT_GT(grid.slices, 2u);
        // The light ends in the last slice: no needless slice follows it.
        EXPECT_EQ(sliceAt(grid, wall + 0.02 * range), grid.slices - 1);
        const std::size_t lit = expectLitAlike(scene).size();
        const double side = 2 * halfFieldTangent * wall / cutOff.height,
                     radius = std::sqrt(1 - 0.98 * 0.98) * range / side;
        EXPECT_NEAR(static_cast<double>(lit), std::numbers::pi * radius * radius, 4 * radius + 2) << range;
        EXPECT_GT(lit, 2u);
    }
}

// The first slice ends at a fraction of the typical light's size. A wall in front of that, and a light
// between the wall and the camera.
TEST(LightCells, TheFirstSliceIsUsed) {
    constexpr double wall = 0.02;
    Scene scene = wallAt(wall, 0.005);
    scene.lights = {lampOf({0, 0, -0.015}, 0.008)};
    for (int i = 0; i < 4; ++i) scene.lights.push_back(lampOf({i - 2.0, 0, -50 - 3.0 * i}, 5));
    const gpu::LightGrid grid = froxelsOf(scene);
    ASSERT_GT(grid.slices, 2u);
    ASSERT_EQ(sliceAt(grid, wall), 0u);
    EXPECT_GT(expectLitAlike(scene).size(), 100u);
}

// Lights that reach one pixel each, at every corner and edge of the image: 0.3 pixels before the wall,
// with a range of 0.8; the next pixels are 1.04 away.
TEST(LightCells, TheOutermostTilesAreUsed) {
    constexpr double wall = 10, side = 2 * halfFieldTangent * wall / cutOff.height;
    Scene scene = wallAt(wall, 0.1);
    std::set<std::pair<int, int>> expected;
    for (const int x : {0, cutOff.width / 2, cutOff.width - 1})
        for (const int y : {0, cutOff.height / 2, cutOff.height - 1}) {
            const glm::dvec3 at((x + 0.5 - cutOff.width / 2.0) * side, (cutOff.height / 2.0 - y - 0.5) * side,
                                -wall + 0.3 * side);
            scene.lights.push_back(lampOf(at, 0.8 * side));
            expected.insert({x, y});
        }
    const gpu::LightGrid grid = froxelsOf(scene);
    EXPECT_NE(cutOff.width % (1 << grid.tile_shift), 0) << "the last column is cut off";
    EXPECT_NE(cutOff.height % (1 << grid.tile_shift), 0);
    EXPECT_EQ(expectLitAlike(scene), expected);
}

}  // namespace
}  // namespace diptych::tests
