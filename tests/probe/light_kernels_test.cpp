// SPDX-License-Identifier: MIT
// Both compute shaders of light lists make the same masks, bit for bit; gather tests few lights in few
// cells.
#include "shared/scene/load.h"
#include "shared/scene/motion/pose.h"
#include "tests/probe/kernel_frame.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace diptych {
namespace {

// Light masks of a view, as written by one of the compute shaders.
struct Masks {
    gpu::LightGrid grid{};
    std::vector<gpu::uint> words, candidates;
    gpu::uint word(std::size_t w, std::size_t list) const { return words[w * grid.list_stride + list]; }
};

Masks masksOf(const View& view, const std::vector<Light>& lights, gpu::uint kind, LightCullingKernel kernel) {
    const GpuLights gpu = gpuLights(lights, view.eye());
    KernelFrame frame(probeDevice(), view);
    LightLists made(probeDevice(), frame.uploader(), frame.lists(), {kind, kernel}, view, gpu);
    made.bind(frame.sets());
    Pipelines pipelines(probeDevice(), VK_NULL_HANDLE);
    const auto width = static_cast<std::uint32_t>(view.width),
               height = static_cast<std::uint32_t>(view.height);
    PassList passes(probeDevice(), width, height);
    const ImageRef depth = passes.image("depth", VK_FORMAT_D32_SFLOAT);
    // Stripes of several depths, background between them.
    passes.draw("depth").depth(depth, Load::clear).record([&](VkCommandBuffer commands) {
        for (std::uint32_t x = 0; x < width; x += 23) {
            const double z = reversedOf(view, 2 + x % 40);
            const VkClearAttachment value{
                VK_IMAGE_ASPECT_DEPTH_BIT, 0, {.depthStencil = {static_cast<float>(z), 0}}};
            const VkClearRect rect{{{static_cast<int>(x), 0}, {std::min(17u, width - x), height}}, 0, 1};
            vkCmdClearAttachments(commands, 1, &value, 1, &rect);
        }
    });
    Variant variant;
    variant.set(gpu::FEATURE_orthographic, view.camera.orthographic)
        .set(gpu::FEATURE_spot_lights, gpu.spot > 0);
    made.addPasses(passes, pipelines, variant, frame.set(), depth);
    passes.run();
    Masks masks{made.grid(), contents<gpu::uint>(probeDevice(), made.masks()), {}};
    if (kernel == LightCullingKernel::gather)
        masks.candidates = contents<gpu::uint>(probeDevice(), made.candidates());
    return masks;
}

// Counts of (cell, light) pairs.
struct Pairs {
    std::uint64_t all = 0, candidates = 0, marked = 0, different = 0;
};

Pairs compared(const Masks& scatter, const Masks& gather) {
    const gpu::LightGrid& grid = gather.grid;
    const std::size_t tiles = std::size_t{grid.tiles.x} * grid.tiles.y, row = tiles + grid.slices;
    Pairs pairs;
    pairs.all = std::uint64_t{grid.lists} * grid.local_lights;
    for (std::size_t w = 0; w < grid.words; ++w)
        for (std::size_t list = 0; list < grid.lists; ++list) {
            const gpu::uint candidates =
                gather.candidates[w * row + list % tiles] & gather.candidates[w * row + tiles + list / tiles];
            const auto count = [](gpu::uint bits) { return static_cast<std::uint64_t>(std::popcount(bits)); };
            pairs.candidates += count(candidates);
            pairs.marked += count(scatter.word(w, list));
            pairs.different += count(scatter.word(w, list) ^ gather.word(w, list));
        }
    return pairs;
}

Pairs pairsOf(const View& view, const std::vector<Light>& lights, gpu::uint kind) {
    return compared(masksOf(view, lights, kind, LightCullingKernel::scatter),
                    masksOf(view, lights, kind, LightCullingKernel::gather));
}

void print(const std::string& what, const Pairs& pairs) {
    std::printf("%s: of %.3g pairs of cell and light %.3g are candidates, %.3g are marked\n", what.c_str(),
                static_cast<double>(pairs.all), static_cast<double>(pairs.candidates),
                static_cast<double>(pairs.marked));
}

constexpr gpu::uint kinds[] = {gpu::LISTS_CLUSTERED, gpu::LISTS_TILED};

View viewOf(int width, int height, bool orthographic) {
    View view = plainView(width, height);
    view.camera.orthographic = orthographic;
    view.camera.ymag = 8;
    if (orthographic) view.camera.far = 60;
    return view;
}

// Lights inside and around the image, some behind the camera; every third is a spot. `radius`: median, m.
std::vector<Light> lightsAround(std::size_t count, double radius, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<Light> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        Light& light = lights[i];
        const double depth = 40 * unit(random) * unit(random) - 2, scale = 0.5 + std::abs(depth);
        light.position = {1.2 * scale * both(random), 0.8 * scale * both(random), -depth};
        light.range = static_cast<float>(radius * std::pow(10.0, both(random)));
        if (i % 3 != 2) continue;
        light.kind = LightKind::spot;
        light.direction = glm::normalize(glm::dvec3(both(random), both(random), both(random)));
        light.outer_cone = static_cast<float>(glm::radians(0.01 + 89 * unit(random)));
    }
    return lights;
}

TEST(LightKernels, MarkTheSameCells) {
    std::uint64_t marked = 0;
    for (const bool orthographic : {false, true})
        for (const gpu::uint kind : kinds)
            for (const auto& [width, height] : {std::pair{1, 1}, {15, 17}, {213, 119}, {640, 360}})
                for (const std::size_t count : {std::size_t{1}, std::size_t{33}, std::size_t{1500}}) {
                    const Pairs pairs =
                        pairsOf(viewOf(width, height, orthographic), lightsAround(count, 1, 91), kind);
                    EXPECT_EQ(pairs.different, 0u)
                        << width << "x" << height << ", " << count << " lights, lists " << kind;
                    marked += pairs.marked;
                }
    EXPECT_GT(marked, 1'000'000u);
}

TEST(LightKernels, MarkTheSameCellsOfExtremeLights) {
    std::vector<Light> lights = lightsAround(40, 1, 92);
    for (int decade = -3; decade <= 17; ++decade)
        for (const Light& like : lightsAround(4, 1, 93)) {
            lights.push_back(like);
            lights.back().range = static_cast<float>(std::pow(10.0, decade));
            lights.push_back(lights.back());
            lights.back().position = {0, 0, decade % 2 == 0 ? 0 : -0.1};  // around the camera
        }
    for (const Light& like : lightsAround(6, 1, 94)) {
        lights.push_back(like);
        lights.back().range = std::numeric_limits<float>::infinity();
    }
    for (const bool orthographic : {false, true})
        for (const gpu::uint kind : kinds)
            for (const auto& [width, height] : {std::pair{9, 700}, {320, 180}}) {
                const Pairs pairs = pairsOf(viewOf(width, height, orthographic), lights, kind);
                EXPECT_EQ(pairs.different, 0u) << width << "x" << height << ", lists " << kind;
                EXPECT_GT(pairs.marked, 0u);
            }
}

// Gather tests candidates, not all lights in all cells.
TEST(LightKernels, GatherTestsFewLightsInFewCells) {
    const Scene scene = loadScene("builtin:spheres?lights=16384");
    const View view = makeView(scene, poseAt(scene, 0), "", 640, 360);
    for (const gpu::uint kind : kinds) {
        const Pairs pairs = pairsOf(view, scene.lights, kind);
        print(kind == gpu::LISTS_TILED ? "tiles" : "froxels", pairs);
        EXPECT_EQ(pairs.different, 0u);
        EXPECT_GE(pairs.candidates, pairs.marked);
        EXPECT_LT(pairs.candidates, pairs.all / 10);
    }
}

// Negative control: the masks detect a light that is 1 % smaller.
TEST(LightKernels, ASmallerLightIsFound) {
    const View view = viewOf(213, 119, false);
    std::vector<Light> lights = lightsAround(200, 1, 95);
    const Masks whole = masksOf(view, lights, gpu::LISTS_TILED, LightCullingKernel::scatter);
    for (Light& light : lights) light.range *= 0.99f;
    EXPECT_GT(compared(whole, masksOf(view, lights, gpu::LISTS_TILED, LightCullingKernel::gather)).different,
              0u);
}

}  // namespace
}  // namespace diptych
