// SPDX-License-Identifier: MIT
// Culling tests of lights against tiles and froxels, compared with exact intersections in double
// precision. There must be no false negatives; false positives are counted.
#include "shared/contract/features.h"
#include "shared/light/light_grid.h"
#include "shared/vulkan/device/device.h"
#include "tests/probe/cells.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

namespace diptych {
namespace {

struct CullCase {
    LitRegion region;
    Cell cell;
};

std::vector<CullCase> randomCases(std::size_t count, bool spots, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<CullCase> cases;
    while (cases.size() < count) {
        CullCase c;
        const double depth = std::pow(10.0, 3 * unit(random) - 1),
                     thick = 1 + std::pow(10.0, 2 * unit(random) - 2);
        c.cell.z = {unit(random) < 0.1 ? 0.0 : depth, depth * thick};
        const double side = std::pow(10.0, 2 * unit(random) - 2.5);
        c.cell.x = glm::dvec2(both(random)) + glm::dvec2(0, side);
        c.cell.y = glm::dvec2(both(random)) + glm::dvec2(0, side);
        const double range = depth * std::pow(10.0, 2 * unit(random) - 1.5);
        c.region.range = static_cast<double>(static_cast<float>(range));
        // About one light range from the cell, so that about half of the lights reach it.
        const auto corners = c.cell.corners();
        const glm::dvec3 at = glm::mix(corners[0], corners[7], unit(random));
        glm::dvec3 away(both(random), both(random), both(random));
        c.region.apex = glm::dvec3(glm::vec3(at + glm::normalize(away) * range * (0.5 + unit(random))));
        if (spots) {
            const double full = std::pow(unit(random), 2.0) * 179;
            c.region.half = glm::radians(full / 2);
            glm::dvec3 aim = glm::normalize(at - c.region.apex);
            c.region.axis = glm::normalize(aim + glm::dvec3(both(random), both(random), both(random)) * 0.8);
            c.region.range *= 1 + unit(random);
            c.region.range = static_cast<double>(static_cast<float>(c.region.range));
        } else {
            c.region.axis = {0, 0, 1};
        }
        cases.push_back(c);
    }
    return cases;
}

// Tiny cells just within the lit region: at the rim of a cone's cap, on its side, on a sphere's surface.
std::vector<CullCase> edgeCases(std::size_t count, bool spots, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<CullCase> cases;
    while (cases.size() < count) {
        CullCase c;
        const double depth = std::pow(10.0, 2 * unit(random));
        const glm::dvec3 p(both(random) * depth, both(random) * depth, depth);
        c.region.range = static_cast<double>(static_cast<float>(depth * (0.1 + unit(random))));
        c.region.axis = glm::normalize(glm::dvec3(both(random), both(random), both(random)));
        glm::dvec3 towards = c.region.axis;
        if (spots) {
            c.region.half = glm::radians(1 + 88 * unit(random));
            const glm::dvec3 across = glm::normalize(
                glm::cross(c.region.axis, glm::dvec3(both(random), both(random), both(random))));
            const double angle = 0.998 * c.region.half;
            towards = c.region.axis * std::cos(angle) + across * std::sin(angle);
        }
        const double along = spots && unit(random) < 0.5 ? 0.2 + 0.7 * unit(random) : 0.998;
        c.region.apex = glm::dvec3(glm::vec3(p - towards * (along * c.region.range)));
        c.cell.x = glm::dvec2(p.x / depth) + glm::dvec2(-1e-5, 1e-5);
        c.cell.y = glm::dvec2(p.y / depth) + glm::dvec2(-1e-5, 1e-5);
        c.cell.z = depth * glm::dvec2(1 - 1e-5, 1 + 1e-5);
        if (!spots && unit(random) < 0.5) {
            // Or a froxel as deep as a slice, whose near or far face the sphere barely crosses.
            const bool far = unit(random) < 0.5;
            c.cell = {{-0.05, 0.05}, {-0.05, 0.05}, {depth, 1.1 * depth}};
            c.region.apex = {
                0, 0,
                far ? 1.1 * depth + c.region.range - 2e-4 * depth : depth - c.region.range + 2e-4 * depth};
            c.region.apex = glm::dvec3(glm::vec3(c.region.apex));
        }
        cases.push_back(c);
    }
    return cases;
}

// Bounds as the program makes them. View axes are the world's with y and z inverted.
std::vector<gpu::LightBound> boundsOf(const std::vector<CullCase>& cases, bool spots) {
    std::vector<Light> lights;
    for (const CullCase& c : cases) {
        Light light;
        light.kind = spots ? LightKind::spot : LightKind::point;
        light.position = {c.region.apex.x, -c.region.apex.y, -c.region.apex.z};
        light.direction = {c.region.axis.x, -c.region.axis.y, -c.region.axis.z};
        light.range = static_cast<float>(c.region.range);
        light.outer_cone = static_cast<float>(c.region.half);
        lights.push_back(light);
    }
    View view;
    view.width = view.height = 64;
    return lightBounds(gpuLights(lights, glm::dvec3(0)), view);
}

// The input that is made 1 % smaller for the shader.
enum class Shrunk { nothing, radius, sides, depths, cone };

struct Answer {
    bool sphere, cone, row;
};

std::vector<Answer> ask(Probes& probes, const std::vector<CullCase>& cases, bool spots, Shrunk shrunk) {
    const std::vector<gpu::LightBound> bounds = boundsOf(cases, spots);
    std::vector<float> input;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        gpu::LightBound b = bounds[i];
        if (shrunk == Shrunk::radius) b.radius *= 0.99f;
        if (shrunk == Shrunk::cone) {
            const double half = 0.99 * std::acos(static_cast<double>(b.cos_cone));
            b.cos_cone = static_cast<float>(std::cos(half));
            b.sin_cone = static_cast<float>(std::sin(half));
        }
        const auto inset = [](glm::dvec2 pair, bool on) {
            const double by = on ? 0.005 * (pair.y - pair.x) : 0.0;
            return glm::dvec2(pair.x + by, pair.y - by);
        };
        const glm::dvec2 x = inset(cases[i].cell.x, shrunk == Shrunk::sides),
                         y = inset(cases[i].cell.y, shrunk == Shrunk::sides),
                         z = inset(cases[i].cell.z, shrunk == Shrunk::depths);
        for (const float v : {b.centre.x, b.centre.y, b.centre.z, b.radius, b.apex.x, b.apex.y, b.apex.z,
                              b.cos_cone, b.axis.x, b.axis.y, b.axis.z, b.sin_cone})
            input.push_back(v);
        for (const double v : {x.x, x.y, y.x, y.y, z.x, z.y}) input.push_back(static_cast<float>(v));
    }
    const std::vector<float> out = probes.run("light_cull", input, 18, 3);
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < cases.size(); ++i)
        answers.push_back({out[3 * i] != 0, out[3 * i + 1] != 0, out[3 * i + 2] != 0});
    return answers;
}

struct Tally {
    int meeting = 0, apart = 0, false_no = 0, false_yes = 0;
    int row_no = 0;  // reaches the cell, but the row test rejects it
};

Tally tally(Probes& probes, bool spots, Shrunk shrunk, unsigned seed) {
    std::vector<CullCase> cases = randomCases(spots ? 10000 : 20000, spots, seed);
    for (const CullCase& c : edgeCases(4000, spots, seed)) cases.push_back(c);
    const std::vector<Answer> answers = ask(probes, cases, spots, shrunk);
    Tally t;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const bool yes = answers[i].sphere && (!spots || answers[i].cone);
        const double distance = gap(cases[i].region, cases[i].cell);
        if (distance < 0) continue;
        if (distance < 1e-12 * cases[i].region.range) {
            ++t.meeting;
            t.false_no += !yes;
            t.row_no += !answers[i].row;
        } else {
            ++t.apart;
            t.false_yes += yes;
        }
    }
    return t;
}

void print(const char* what, const Tally& t) {
    std::printf("%s: %d pairs meet, %d do not, of which %.2f %% were kept\n", what, t.meeting, t.apart,
                100.0 * t.false_yes / t.apart);
}

TEST(LightCull, ABallIsNeverMissed) {
    Probes probes;
    const Tally t = tally(probes, false, Shrunk::nothing, 21);
    print("spheres against froxels", t);
    EXPECT_EQ(t.false_no, 0);
    EXPECT_EQ(t.row_no, 0);
    EXPECT_GT(t.meeting, 5000);
    EXPECT_GT(t.apart, 5000);
    // The nearest point of a froxel is exact, unless Newton's iteration ends on another piece.
    EXPECT_LT(t.false_yes, t.apart / 200) << "a test that keeps everything would pass the rest";
}

TEST(LightCull, ASpotIsNeverMissed) {
    Probes probes;
    const Tally t = tally(probes, true, Shrunk::nothing, 22);
    print("spots against froxels", t);
    EXPECT_EQ(t.false_no, 0);
    EXPECT_EQ(t.row_no, 0);
    EXPECT_GT(t.meeting, 2000);
    EXPECT_GT(t.apart, 2000);
    EXPECT_LT(t.false_yes, t.apart / 2);
}

// An empty tile has its minimum depth behind its maximum: no light reaches it, however large.
TEST(LightCull, NothingReachesACellWithoutAnythingDrawn) {
    Probes probes;
    std::vector<CullCase> cases;
    for (const double range : {1.0, 10.0, 1000.0}) {
        CullCase c;
        c.region.apex = {0, 0, 3};
        c.region.axis = {0, 0, 1};
        c.region.range = range;
        c.cell = {{-0.1, 0.1}, {-0.1, 0.1}, {2, 4}};
        cases.push_back(c);
        c.cell.z = {4, 2};
        cases.push_back(c);
        c.cell.z = {3.0001, 3};
        cases.push_back(c);
        c.cell.z = {3, 3};
        cases.push_back(c);
    }
    const std::vector<Answer> answers = ask(probes, cases, false, Shrunk::nothing);
    for (std::size_t i = 0; i < answers.size(); i += 4) {
        EXPECT_TRUE(answers[i].sphere);
        EXPECT_FALSE(answers[i + 1].sphere);
        EXPECT_FALSE(answers[i + 2].sphere);
        EXPECT_TRUE(answers[i + 3].sphere) << "one depth";
    }
}

TEST(LightCull, WhatIsOnePerCentTooSmallIsCaught) {
    Probes probes;
    const Tally radius = tally(probes, false, Shrunk::radius, 21),
                sides = tally(probes, false, Shrunk::sides, 21),
                depths = tally(probes, false, Shrunk::depths, 21);
    EXPECT_GT(radius.false_no, 0) << "a light's radius";
    EXPECT_GT(sides.false_no, 0) << "a tile's sides";
    EXPECT_GT(depths.false_no, 0) << "a slice's depths";
    EXPECT_GT(radius.row_no, 0) << "a light's radius, of its rows";
    EXPECT_GT(sides.row_no, 0) << "a row's sides";
    EXPECT_GT(depths.row_no, 0) << "a slice's depths, of rows";
    EXPECT_GT(tally(probes, true, Shrunk::radius, 22).false_no, 0) << "a spot's radius";
    EXPECT_GT(tally(probes, true, Shrunk::cone, 22).false_no, 0) << "a spot's cone";
}

// ---- the scatter shader's rectangles -----------------------------------------------------------------

// Grid of an image, a sphere and a depth slab, for which the rectangle of tiles is computed.
struct RectCase {
    gpu::LightGrid grid;
    glm::dvec3 centre;
    double radius;          // lit region
    gpu::LightBound bound;  // input of the compute shader
    SliceDepths slab;
};

// Images of any shape, from one pixel up, with the grids that the program makes for them.
std::vector<RectCase> rectCases(bool orthographic, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<RectCase> cases;
    for (int image = 0; image < 120; ++image) {
        View view;
        view.width = 1 + static_cast<int>(400 * unit(random) * unit(random));
        view.height = 1 + static_cast<int>(300 * unit(random) * unit(random));
        view.camera.orthographic = orthographic;
        view.camera.yfov = glm::radians(5 + 130 * unit(random));
        view.camera.ymag = 0.5 + 5 * unit(random);
        view.camera.far = orthographic ? 50 : std::numeric_limits<double>::infinity();
        const double half = orthographic ? view.camera.ymag : std::tan(view.camera.yfov / 2);
        const double aspect = static_cast<double>(view.width) / view.height;
        std::vector<Light> lights(40);
        for (Light& light : lights) {
            // Inside the image and around it, a few behind the camera, some around the camera.
            const double depth = 30 * unit(random) * unit(random) - 1,
                         scale = orthographic ? 1 : std::abs(depth);
            light.position = {1.3 * half * aspect * scale * both(random), 1.3 * half * scale * both(random),
                              -depth};
            light.range = static_cast<float>((0.05 + std::abs(depth)) * std::pow(10.0, 2 * unit(random) - 2));
        }
        const GpuLights gpu = gpuLights(lights, glm::dvec3(0));
        const std::vector<gpu::LightBound> bounds = lightBounds(gpu, view);
        const bool tiled = image % 3 == 0;
        const gpu::LightGrid grid =
            makeLightGrid({tiled ? gpu::LISTS_TILED : gpu::LISTS_CLUSTERED}, view, gpu, bounds,
                          probeDevice().profile().costs, std::uint64_t{128} << 20);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const glm::dvec3 at(gpu.lights[i].position);
            RectCase c{grid, {at.x, -at.y, -at.z}, static_cast<double>(lights[i].range), bounds[i], {}};
            // One of the slices that it reaches, if any.
            std::vector<SliceDepths> slabs;
            for (gpu::uint s = 0; s < grid.slices; ++s) {
                const SliceDepths slab = tiled ? SliceDepths{0, gpu::MAX_BOUND_RADIUS} : sliceDepths(grid, s);
                if (c.centre.z + c.radius >= double{slab.near} && c.centre.z - c.radius <= double{slab.far})
                    slabs.push_back(slab);
            }
            if (slabs.empty()) continue;
            c.slab = slabs[random() % slabs.size()];
            cases.push_back(c);
        }
    }
    return cases;
}

enum class RectShrunk { nothing, radius, pixel, last_column, last_row };

// Errors of the rectangles, counted by tile.
struct RectTally {
    std::size_t meeting = 0, missed = 0, walked = 0, tiles = 0;
    std::size_t row_missed = 0, row_walked = 0;  // by the columns of each row
};

double distanceTo(const RectCase& c, gpu::uint x, gpu::uint y, bool orthographic) {
    const double side = std::ldexp(double{c.grid.pixel}, static_cast<int>(c.grid.tile_shift));
    const glm::dvec2 middle = glm::dvec2(c.grid.centre) * double{c.grid.pixel};
    const glm::dvec2 xs = glm::dvec2(x, x + 1) * side - middle.x, ys = glm::dvec2(y, y + 1) * side - middle.y;
    // Depths beyond the sphere have no effect, and the last slice has no end.
    const glm::dvec2 zs(c.slab.near, std::min(double{c.slab.far}, c.centre.z + c.radius + 1));
    if (!orthographic) return glm::distance(c.centre, nearestInCell(c.centre, {xs, ys, zs}));
    const glm::dvec3 low(xs.x, ys.x, zs.x), high(xs.y, ys.y, zs.y);
    return glm::distance(c.centre, glm::clamp(c.centre, low, high));
}

RectTally rectangles(Probes& probes, bool orthographic, RectShrunk shrunk) {
    const std::vector<RectCase> cases = rectCases(orthographic, orthographic ? 62 : 61);
    std::vector<float> input, rows_input;
    for (const RectCase& c : cases) {
        const gpu::LightBound& b = c.bound;
        const float radius = shrunk == RectShrunk::radius ? 0.99f * b.radius : b.radius;
        const float pixel = shrunk == RectShrunk::pixel ? 1.01f * c.grid.pixel : c.grid.pixel;
        const float side = static_cast<float>(1u << c.grid.tile_shift);
        const std::array asked{b.centre.x,
                               b.centre.y,
                               b.centre.z,
                               radius,
                               c.slab.near,
                               c.slab.far,
                               c.grid.centre.x,
                               c.grid.centre.y,
                               pixel,
                               side,
                               static_cast<float>(c.grid.tiles.x),
                               static_cast<float>(c.grid.tiles.y)};
        input.insert(input.end(), asked.begin(), asked.end());
        for (gpu::uint row = 0; row < c.grid.tiles.y; ++row) {
            rows_input.insert(rows_input.end(), asked.begin(), asked.end());
            rows_input.push_back(static_cast<float>(row));
        }
    }
    const std::pair<gpu::uint, gpu::uint> feature{gpu::FEATURE_orthographic, orthographic};
    const std::vector<float> out = probes.run("light_rect", input, 12, 4, {feature});
    const std::vector<float> row_out = probes.run("light_row", rows_input, 13, 2, {feature});
    RectTally tally;
    std::size_t row = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto at = [&](std::size_t k) { return static_cast<gpu::uint>(out[4 * i + k]); };
        gpu::uint columns = at(1), rows = at(3);
        if (shrunk == RectShrunk::last_column && columns > 0) --columns;
        if (shrunk == RectShrunk::last_row && rows > 0) --rows;
        const gpu::uvec2 tiles = cases[i].grid.tiles;
        EXPECT_LE(at(1), tiles.x);
        EXPECT_LE(at(3), tiles.y);
        for (gpu::uint y = 0; y < tiles.y; ++y, ++row)
            for (gpu::uint x = 0; x < tiles.x; ++x) {
                const bool walked = x >= at(0) && x < columns && y >= at(2) && y < rows;
                const auto column = static_cast<float>(x);
                const bool in_row = column >= row_out[2 * row] && column < row_out[2 * row + 1];
                const bool meets = distanceTo(cases[i], x, y, orthographic) <= cases[i].radius;
                tally.meeting += meets;
                tally.missed += meets && !walked;
                tally.walked += walked;
                tally.row_missed += meets && !in_row;
                tally.row_walked += in_row;
                ++tally.tiles;
            }
    }
    return tally;
}

TEST(LightRect, NoTileThatALightReachesIsLeftOut) {
    Probes probes;
    for (const bool orthographic : {false, true}) {
        const RectTally t = rectangles(probes, orthographic, RectShrunk::nothing);
        std::printf("%s rectangles: of %zu tiles %zu are reached, %zu walked, row by row %zu\n",
                    orthographic ? "orthographic" : "perspective", t.tiles, t.meeting, t.walked,
                    t.row_walked);
        EXPECT_EQ(t.missed, 0u);
        EXPECT_EQ(t.row_missed, 0u);
        EXPECT_LT(t.row_walked, t.walked) << "rows are cut shorter than the rectangle";
        EXPECT_GT(t.meeting, 5000u);
        EXPECT_LT(t.walked, t.tiles / 2) << "a rectangle of all tiles would pass the rest";
        // A disc fills pi/4 of its square: at most 4/pi as many, for lights that cover many tiles.
        EXPECT_LT(static_cast<double>(t.walked), 4 / glm::pi<double>() * static_cast<double>(t.meeting));
    }
}

TEST(LightRect, WhatIsTooSmallIsCaught) {
    Probes probes;
    for (const bool orthographic : {false, true}) {
        const RectTally radius = rectangles(probes, orthographic, RectShrunk::radius),
                        pixel = rectangles(probes, orthographic, RectShrunk::pixel);
        EXPECT_GT(radius.missed, 0u) << "a radius, by 1 %";
        EXPECT_GT(radius.row_missed, 0u) << "a radius, by 1 %, of rows";
        EXPECT_GT(pixel.missed, 0u) << "a picture's scale, by 1 %";
        EXPECT_GT(pixel.row_missed, 0u) << "a picture's scale, by 1 %, of rows";
        EXPECT_GT(rectangles(probes, orthographic, RectShrunk::last_column).missed, 0u);
        EXPECT_GT(rectangles(probes, orthographic, RectShrunk::last_row).missed, 0u);
    }
}

}  // namespace
}  // namespace diptych
