// SPDX-License-Identifier: MIT
// Each tile's light list, read back from the device, compared with exact intersections in double between
// the tile's nearest and farthest depths.
#include "tests/probe/cells.h"
#include "tests/probe/kernel_frame.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cstdio>
#include <random>
#include <set>

namespace diptych {
namespace {

constexpr int width = 103, height = 61, block = 4;  // seven by four tiles, the last ones cut off
constexpr int side = static_cast<int>(gpu::LIGHT_TILE);

// View depths of the image, m, constant in each block of pixels; 0: background. Tiles of all kinds: fully
// covered, near and far together, half background, only background.
struct Depths {
    static constexpr int across = (width + block - 1) / block, down = (height + block - 1) / block;
    std::vector<double> blocks = std::vector<double>(std::size_t{across} * down);
    double& at(int x, int y) { return blocks[static_cast<std::size_t>(y * across + x)]; }
    double at(int x, int y) const { return blocks[static_cast<std::size_t>(y * across + x)]; }
};

Depths randomDepths(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Depths depths;
    constexpr int perTile = side / block;
    for (int y = 0; y < Depths::down; y += perTile)
        for (int x = 0; x < Depths::across; x += perTile) {
            const double near = 1 + 19 * unit(random), thick = 1 + unit(random), empty = unit(random);
            const double background = empty < 0.2 ? 1 : empty < 0.5 ? 0.3 : 0;
            for (int v = y; v < std::min(y + perTile, Depths::down); ++v)
                for (int u = x; u < std::min(x + perTile, Depths::across); ++u)
                    depths.at(u, v) = unit(random) < background ? 0 : near * (1 + thick * unit(random));
        }
    return depths;
}

// Points, then spots.
std::vector<Light> randomLights(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<Light> lights;
    for (int i = 0; i < 360; ++i) {
        Light light;
        const double depth = i % 20 == 0 ? -1 : 45 * unit(random) * unit(random);
        light.position = {1.2 * depth * both(random), 0.8 * depth * both(random), -depth};
        light.range = static_cast<float>((0.2 + std::abs(depth)) * std::pow(10.0, 1.5 * unit(random) - 1.5));
        if (i >= 240) {
            light.kind = LightKind::spot;
            light.direction = glm::normalize(glm::dvec3(both(random), both(random), both(random)));
            light.outer_cone = static_cast<float>(glm::radians(1 + 88 * unit(random)));
            light.range *= 2;
        }
        lights.push_back(light);
    }
    return lights;
}

LitRegion litRegionOf(const Light& light) {
    const glm::dvec3 at(glm::vec3(light.position)), axis(glm::vec3(light.direction));
    LitRegion region;
    region.apex = {at.x, -at.y, -at.z};
    region.axis = glm::normalize(glm::dvec3(axis.x, -axis.y, -axis.z));
    region.range = static_cast<double>(light.range);
    if (light.kind == LightKind::spot) region.half = static_cast<double>(light.outer_cone);
    return region;
}

struct Lists {
    gpu::LightGrid grid{};
    std::vector<std::vector<gpu::uint>> lists;  // in light order
};

// `nearer`: factor on the image's depths before rendering. `in_front`: the scene has blended surfaces.
Lists listsOf(const View& view, const Depths& depths, const GpuLights& lights, LightCullingKernel kernel,
              double nearer = 1, bool in_front = false) {
    KernelFrame frame(probeDevice(), view);
    LightLists made(probeDevice(), frame.uploader(), frame.lists(), {gpu::LISTS_TILED, kernel, in_front},
                    view, lights);
    made.bind(frame.sets());
    Pipelines pipelines(probeDevice(), VK_NULL_HANDLE);
    PassList passes(probeDevice(), width, height);
    const ImageRef depth = passes.image("depth", VK_FORMAT_D32_SFLOAT);
    passes.draw("depth").depth(depth, Load::clear).record([&](VkCommandBuffer commands) {
        for (int y = 0; y < Depths::down; ++y)
            for (int x = 0; x < Depths::across; ++x) {
                if (depths.at(x, y) == 0) continue;
                const double z = reversedOf(view, nearer * depths.at(x, y));
                const VkClearAttachment value{
                    VK_IMAGE_ASPECT_DEPTH_BIT, 0, {.depthStencil = {static_cast<float>(z), 0}}};
                const VkClearRect rect{{{x * block, y * block},
                                        {static_cast<std::uint32_t>(std::min(block, width - x * block)),
                                         static_cast<std::uint32_t>(std::min(block, height - y * block))}},
                                       0,
                                       1};
                vkCmdClearAttachments(commands, 1, &value, 1, &rect);
            }
    });
    Variant variant;
    variant.set(gpu::FEATURE_spot_lights);
    made.addPasses(passes, pipelines, variant, frame.set(), depth);
    passes.run();
    EXPECT_EQ(made.overflowed(), 0u);
    Lists result;
    result.grid = made.grid();
    const auto heads = contents<gpu::LightListHead>(probeDevice(), made.heads());
    const auto indices = contents<gpu::uint>(probeDevice(), made.indices());
    for (gpu::uint list = 0; list < made.grid().lists; ++list) {
        result.lists.emplace_back();
        for (gpu::uint i = heads[list].begin * made.grid().width; i < heads[list].end * made.grid().width;
             ++i)
            if (indices[i] != made.grid().null_light) result.lists.back().push_back(indices[i]);
    }
    return result;
}

struct TileCell {
    bool drawn = false, background = false;
    Cell cell;
};

// Depth interval of a tile, from the image's depths alone.
TileCell cellOf(const View& view, const Depths& depths, int x, int y) {
    TileCell tile;
    const double pixel = 2 * std::tan(view.camera.yfov / 2) / height;
    Cell& cell = tile.cell;
    cell.x = (glm::dvec2(x, x + 1) * double{side} - width / 2.0) * pixel;
    cell.y = (glm::dvec2(y, y + 1) * double{side} - height / 2.0) * pixel;
    cell.z = {std::numeric_limits<double>::infinity(), 0};
    for (int v = y * side / block; v < std::min((y + 1) * side / block, Depths::down); ++v)
        for (int u = x * side / block; u < std::min((x + 1) * side / block, Depths::across); ++u) {
            const double d = depths.at(u, v);
            (d > 0 ? tile.drawn : tile.background) = true;
            if (d > 0) cell.z = {std::min(cell.z.x, d), std::max(cell.z.y, d)};
        }
    return tile;
}

// For each tile a point light behind its farthest depth and one before its nearest, each reaching 0.3 % of
// the depth into the interval.
std::vector<Light> edgeLights(const View& view, const Depths& depths) {
    std::vector<Light> lights;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 7; ++x) {
            const TileCell tile = cellOf(view, depths, x, y);
            if (!tile.drawn) continue;
            const glm::dvec2 z = tile.cell.z;
            for (const bool behind : {false, true}) {
                const double from = behind ? z.y : z.x, range = 0.05 * from;
                Light light;
                light.range = static_cast<float>(range);
                const double depth = behind ? 0.997 * from + range : 1.003 * from - range;
                light.position = {glm::dot(tile.cell.x, glm::dvec2(0.5)) * depth,
                                  -glm::dot(tile.cell.y, glm::dvec2(0.5)) * depth, -depth};
                lights.push_back(light);
            }
        }
    return lights;
}

struct Count {
    int meeting = 0, missed = 0, apart = 0, kept = 0, far_kept = 0, outside = 0;
};

// Compares one tile's list with all lights. A light is falsely kept if even a sphere of twice its size
// would not reach the tile. A spot's sphere and its cone may each reach a tile that their intersection
// does not (light_overlap.glsl).
void hold(Count& count, const std::vector<gpu::uint>& list, const std::vector<Light>& lights,
          const std::vector<gpu::LightBound>& bounds, const Cell& cell) {
    const std::set<gpu::uint> listed(list.begin(), list.end());
    EXPECT_EQ(listed.size(), list.size()) << "a light is listed once";
    EXPECT_TRUE(std::ranges::is_sorted(list));
    for (gpu::uint i = 0; i < lights.size(); ++i) {
        const bool is = listed.contains(i);
        const LitRegion region = litRegionOf(lights[i]);
        const double distance = gap(region, cell);
        if (distance < 0) continue;
        if (distance < 1e-12 * region.range) {
            ++count.meeting;
            count.missed += !is;
            continue;
        }
        ++count.apart;
        count.kept += is;
        LitRegion wider;
        wider.apex = glm::dvec3(bounds[i].centre);
        wider.range = 2 * static_cast<double>(bounds[i].radius);
        if (glm::distance(wider.apex, nearestInCell(wider.apex, cell)) > wider.range) {
            ++count.outside;
            count.far_kept += is;
        }
    }
}

struct Held {
    Count count;
    int empty = 0, only_background = 0, part_background = 0;
};

Held held(double nearer = 1) {
    Held all;
    for (const unsigned seed : {31u, 32u, 33u}) {
        const View view = plainView(width, height);
        const Depths depths = randomDepths(seed);
        // Points first, then spots: lists are in this order too.
        std::vector<Light> lights = edgeLights(view, depths);
        for (const Light& light : randomLights(seed)) lights.push_back(light);
        const GpuLights gpu = gpuLights(lights, glm::dvec3(0));
        EXPECT_EQ(gpu.local(), lights.size());
        const std::vector<gpu::LightBound> bounds = lightBounds(gpu, view);
        const Lists lists = listsOf(view, depths, gpu, LightCullingKernel::scatter, nearer);
        if (nearer == 1) {
            EXPECT_EQ(lists.lists, listsOf(view, depths, gpu, LightCullingKernel::gather).lists);
        }
        EXPECT_EQ(lists.grid.tiles, gpu::uvec2(7, 4));
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 7; ++x) {
                const std::vector<gpu::uint>& list = lists.lists.at(static_cast<std::size_t>(y * 7 + x));
                const TileCell tile = cellOf(view, depths, x, y);
                if (tile.drawn)
                    hold(all.count, list, lights, bounds, tile.cell);
                else
                    all.empty += list.empty();
                all.only_background += !tile.drawn;
                all.part_background += tile.drawn && tile.background;
            }
    }
    return all;
}

TEST(TileLists, HoldWhatReachesATileAndLittleElse) {
    const Held all = held();
    const Count& count = all.count;
    std::printf("%d lights meet their tile, %d do not, of which %.2f %% were kept\n", count.meeting,
                count.apart, 100.0 * count.kept / count.apart);
    EXPECT_EQ(count.missed, 0);
    EXPECT_GT(count.meeting, 1000);
    EXPECT_EQ(count.far_kept, 0);
    EXPECT_GT(count.outside, 1000) << "there are lights that must not be listed";
    EXPECT_LT(count.kept, count.apart / 20);
    EXPECT_GT(all.only_background, 3);
    EXPECT_GT(all.part_background, 10);
    EXPECT_EQ(all.empty, all.only_background) << "nothing to light";
}

// With blended surfaces a tile has a second list that starts at the viewer, and has no end where a pixel
// shows the background. The opaque list is unchanged.
TEST(TileLists, OfWhatIsBlendedReachFromTheViewer) {
    const View view = plainView(width, height);
    const Depths depths = randomDepths(34);
    const std::vector<Light> lights = randomLights(34);
    const GpuLights gpu = gpuLights(lights, glm::dvec3(0));
    const std::vector<gpu::LightBound> bounds = lightBounds(gpu, view);
    const Lists solid = listsOf(view, depths, gpu, LightCullingKernel::scatter);
    const std::size_t tiles = solid.lists.size();
    for (const LightCullingKernel kernel : {LightCullingKernel::scatter, LightCullingKernel::gather}) {
        const Lists both = listsOf(view, depths, gpu, kernel, 1, true);
        ASSERT_EQ(both.lists.size(), 2 * tiles);
        Count count;
        std::size_t longer = 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 7; ++x) {
                const std::size_t tile = static_cast<std::size_t>(y * 7 + x);
                EXPECT_EQ(both.lists[tile], solid.lists[tile]) << x << "," << y;
                TileCell cell = cellOf(view, depths, x, y);
                cell.cell.z.x = 0;
                if (cell.background) cell.cell.z.y = 1e6;
                const std::vector<gpu::uint>& blended = both.lists[tiles + tile];
                hold(count, blended, lights, bounds, cell.cell);
                EXPECT_TRUE(std::ranges::includes(blended, solid.lists[tile]));
                longer += blended.size() > solid.lists[tile].size();
            }
        EXPECT_EQ(count.missed, 0);
        EXPECT_GT(count.meeting, 1000);
        EXPECT_EQ(count.far_kept, 0);
        EXPECT_GT(longer, tiles / 2) << "the second test leaves lights out";
    }
}

// Negative control: lists for an image that is 1 % nearer lack lights of this one.
TEST(TileLists, DepthsThatAreOnePerCentOffAreCaught) {
    for (const double nearer : {0.99, 1.01}) {
        EXPECT_GT(held(nearer).count.missed, 0) << nearer;
    }
}

}  // namespace
}  // namespace diptych
