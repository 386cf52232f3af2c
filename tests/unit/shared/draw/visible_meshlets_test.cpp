// SPDX-License-Identifier: MIT
// Culled triangles cover no sample, whatever the device's rounding; and most triangles that can be culled
// are.
#include "shared/draw/visible_meshlets.h"

#include "tests/support/rasteriser.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace diptych {
namespace {

using namespace tests;

struct Counts {
    std::size_t triangles = 0, kept = 0, shown = 0;
};

// Cuts the mesh into meshlets, culls, and compares the culled triangles with those that cover samples.
Counts expectNothingShownIsLeftOut(const TriangleMesh& mesh, const SampleGrid& grid,
                                   const glm::dmat4& clipFromObject, bool mirrored, bool culls,
                                   const std::string& name) {
    std::vector<std::uint32_t> indices = mesh.indices;
    const std::vector<Meshlet> meshlets = buildMeshlets(mesh.positions, indices);
    glm::dvec3 min(mesh.positions[0]), max(min);
    for (const glm::vec3& p : mesh.positions) {
        min = glm::min(min, glm::dvec3(p));
        max = glm::max(max, glm::dvec3(p));
    }
    MeshletTriangles triangles;
    const VisibleMeshlets shown(grid, clipFromObject, min, max, culls, mirrored);
    Counts counts;
    for (std::size_t k = 0; k < meshlets.size(); ++k) {
        const Meshlet& meshlet = meshlets[k];
        const auto of = std::span(std::as_const(indices)).subspan(meshlet.first_index, meshlet.index_count);
        triangles.add(meshlet, mesh.positions, of);
        const TriangleSet set = shown.of(meshlet, triangles, triangles[k]);
        EXPECT_EQ(set & ~triangles[k].all(), 0u) << name;
        for (std::size_t i = 0; i < of.size() / 3; ++i) {
            std::array<glm::vec3, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) corners[c] = mesh.positions[of[3 * i + c]];
            const bool isKept = (set >> i & 1u) != 0;
            bool shows = false;
            for (const bool truncates : {false, true})
                for (const bool reversed : {false, true})
                    shows = shows || Rasteriser(grid, truncates, reversed)
                                         .shows(glm::mat4(clipFromObject), corners, mirrored, !culls);
            counts.triangles += 1;
            counts.kept += isKept;
            counts.shown += shows;
            EXPECT_TRUE(isKept || !shows) << name << ": cluster " << k << ", triangle " << i;
        }
    }
    return counts;
}

glm::dmat4 clipOf(const SampleGrid& grid, const glm::dvec3& eye, const glm::dvec3& target, double fov,
                  double near, bool orthographic) {
    return glm::translate(viewOf(grid, eye, target, fov, near, orthographic).clipFromWorld(), -eye);
}

TEST(VisibleMeshlets, NothingThatCoversASampleIsLeftOut) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(-1, 1);
    Counts all;
    for (int round = 0; round < 240; ++round) {
        const SampleGrid grid{48 + round % 37, 40, round % 3 == 0 ? (round % 2 == 0 ? 4 : 8) : 1,
                              round % 2 == 0 ? 1.0 / 256 : 1.0 / 16};
        // Sometimes far from its own origin, so that products lose digits.
        const glm::vec3 middle = round % 5 == 0 ? glm::vec3(900, -300, 500) : glm::vec3(0);
        const TriangleMesh ball = ballOf(6 + round % 17, round % 4 == 0 ? 0.3 : 0.0, random, middle);
        const bool mirrored = round % 7 == 3;
        const glm::dvec3 stretched(mirrored ? -1 : 1, round % 6 == 0 ? 0.05 : 1, 1 + 0.5 * part(random));
        const glm::dmat4 placed =
            glm::translate(glm::scale(glm::rotate(glm::dmat4(1), 3 * part(random),
                                                  glm::normalize(glm::dvec3(part(random), 1, part(random)))),
                                      stretched),
                           -glm::dvec3(middle));
        const double away = std::exp(3.0 + 2.5 * part(random));
        const glm::dvec3 eye = away * glm::normalize(glm::dvec3(part(random), part(random), part(random)));
        const glm::dvec3 target =
            (round % 3 == 1 ? 0.4 * away : 0.5) * glm::dvec3(part(random), part(random), part(random));
        const glm::dmat4 clip =
            clipOf(grid, eye, target, round % 2 == 0 ? 0.9 : 0.2, 0.05, round % 8 == 5) * placed;
        const Counts counts = expectNothingShownIsLeftOut(ball, grid, clip, mirrored, round % 9 != 0,
                                                          fmt::format("round {}", round));
        all.triangles += counts.triangles;
        all.kept += counts.kept;
        all.shown += counts.shown;
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(all.shown, 5000u);
    EXPECT_LT(all.kept, all.triangles);
}

// Seen along a triangle's plane, from slightly in front or behind: near the decision.
TEST(VisibleMeshlets, NothingSeenAlongItsPlaneIsLeftOutThatCoversASample) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-1, 1);
    std::size_t shown = 0, left = 0;
    for (int round = 0; round < 600; ++round) {
        const SampleGrid grid{640 + round % 101, 360, round % 4 == 0 ? 4 : 1,
                              round % 3 == 0 ? 1.0 / 16 : 1.0 / 256};
        const TriangleMesh ball = ballOf(3 + round % 6, round % 2 == 0 ? 0.15 : 0.0, random);
        const bool mirrored = round % 7 == 3;
        const glm::dmat4 placed = glm::scale(
            glm::rotate(glm::dmat4(1), 3 * part(random), glm::normalize(glm::dvec3(1, 2, part(random)))),
            glm::dvec3(mirrored ? -1 : 1, 1, 1 + 0.5 * part(random)));
        const std::size_t chosen = random() % (ball.indices.size() / 3);
        std::array<glm::dvec3, 3> at;
        for (std::size_t c = 0; c < 3; ++c)
            at[c] =
                glm::dvec3(placed * glm::dvec4(glm::dvec3(ball.positions[ball.indices[3 * chosen + c]]), 1));
        const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
        if (!(glm::length(normal) > 1e-9)) continue;
        // Along one of the edges or across, off the plane by a fraction of the distance.
        const double turn = 3.2 * part(random);
        const glm::dvec3 edge = glm::normalize(at[1] - at[0]), up = glm::normalize(normal),
                         along = std::cos(turn) * edge + std::sin(turn) * glm::cross(up, edge);
        const double away = std::exp(1.6 + 0.5 * part(random)),
                     fraction = std::pow(10.0, -3 + 1.5 * part(random)) * (round % 2 == 0 ? 1 : -1);
        const glm::dvec3 eye = at[round % 3] + away * (along + fraction * up);
        const glm::dmat4 clip = clipOf(grid, eye, {0, 0, 0}, 0.9, 0.05, round % 8 == 5) * placed;
        const Counts counts =
            expectNothingShownIsLeftOut(ball, grid, clip, mirrored, true, fmt::format("round {}", round));
        shown += counts.shown;
        left += counts.triangles - counts.kept;
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(shown, 10000u);
    EXPECT_GT(left, 10000u);
}

// Meshlets that cross an edge of the image by a pixel at most.
TEST(VisibleMeshlets, NothingThatReachesIntoTheViewIsLeftOut) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0, 1);
    std::size_t shown = 0, left = 0;
    const TriangleMesh board = boardOf(5);  // one meshlet
    for (int round = 0; round < 800; ++round) {
        const SampleGrid grid{640, 360, round % 3 == 0 ? 4 : 1, 1.0 / 256};
        const bool orthographic = round % 5 == 0;
        const glm::dmat4 view = clipOf(grid, {0, 0, 0}, {0, 0, -1}, 0.9, 0.05, orthographic);
        const double size = orthographic ? 0.2 : 1, sides = orthographic ? 0.5 : 3 * std::tan(0.45),
                     pixel = 2 * sides / grid.height, reach = 1.2 * pixel * part(random);
        const bool across = round % 2 == 0;
        const double edge = across ? sides * grid.width / grid.height : sides,
                     at = (edge + size - reach) * (round % 4 < 2 ? 1 : -1);
        const glm::dmat4 placed =
            glm::scale(glm::translate(glm::dmat4(1),
                                      glm::dvec3(across ? at : 0.3 * sides, across ? 0.3 * sides : at, -3)),
                       glm::dvec3(size));
        const Counts counts = expectNothingShownIsLeftOut(board, grid, view * placed, false, false,
                                                          fmt::format("round {}", round));
        shown += counts.shown;
        left += counts.triangles - counts.kept;
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(shown, 1000u);
    EXPECT_EQ(left, 0u) << "they reach into it";
}

// A ball in the centre of an image of common size: nearly all of the back half is culled.
TEST(VisibleMeshlets, BacksAreLeftOut) {
    std::mt19937 random(3);
    const TriangleMesh ball = ballOf(24, 0, random);
    const SampleGrid grid{640, 360, 1, 1.0 / 256};
    const auto kept = [&](bool orthographic, bool culls) {
        const glm::dmat4 clip = clipOf(grid, {0, 1, 4}, {0, 0, 0}, 0.9, 0.1, orthographic);
        const Counts counts = expectNothingShownIsLeftOut(ball, grid, clip, false, culls, "ball");
        return static_cast<double>(counts.kept) / static_cast<double>(counts.triangles);
    };
    EXPECT_LT(kept(false, true), 0.45);  // (1 - 1 / 4.1) / 2 face the camera
    EXPECT_LT(kept(true, true), 0.58);
    EXPECT_GT(kept(false, false), 0.95);  // some are between samples
}

TEST(VisibleMeshlets, WhatIsBeyondTheViewIsLeftOut) {
    std::mt19937 random(3);
    const TriangleMesh ball = ballOf(24, 0, random);
    const SampleGrid grid{640, 360, 1, 1.0 / 256};
    // From the centre to the right: a little more than half of the half in front.
    const glm::dmat4 clip = clipOf(grid, {0, 0, 0.001}, {0, 0, -1}, 1.5, 0.0001, false);
    const Counts counts = expectNothingShownIsLeftOut(ball, grid, clip, false, false, "inside");
    EXPECT_LT(counts.kept, counts.triangles / 3);
    EXPECT_GT(counts.kept, counts.triangles / 8);
}

// 2,304 triangles within a pixel, and within a quarter of one.
TEST(VisibleMeshlets, WhatIsBetweenSamplesIsLeftOut) {
    std::mt19937 random(3);
    const TriangleMesh ball = ballOf(24, 0, random);
    for (const int samples : {1, 4})
        for (const double off : {0.0, 0.5}) {
            const SampleGrid grid{64, 64, samples, 1.0 / 256};
            // The image centre is between four pixels, half a pixel from each centre.
            const double pixel = 2 * 500.0 * std::tan(0.45) / 64, radius = 0.3 * pixel / samples;
            const glm::dmat4 clip =
                glm::scale(glm::translate(clipOf(grid, {0, 0, 500}, {0, 0, 0}, 0.9, 0.1, false),
                                          glm::dvec3(off * pixel, off * pixel, 0)),
                           glm::dvec3(radius));
            const Counts counts = expectNothingShownIsLeftOut(ball, grid, clip, false, false,
                                                              fmt::format("{} {}", samples, off));
            if (samples == 1 && off > 0) {
                EXPECT_GT(counts.kept, 0u);
            } else {
                EXPECT_EQ(counts.kept, 0u) << samples << " " << off;
            }
        }
}

}  // namespace
}  // namespace diptych
