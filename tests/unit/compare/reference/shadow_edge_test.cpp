// SPDX-License-Identifier: MIT
// Distance to the edge of a shadow, for known edges.
#include "compare/reference/light/shadow_edge.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace diptych::reference {
namespace {

const glm::dvec3 position(3, 0, -4), up(0, 1, 0);

// A half plane of shadow on the ground, `away` metres from `position` in the direction `angle`.
SeesLight straightEdge(double away, double angle) {
    const glm::dvec3 outwards(std::cos(angle), 0, std::sin(angle));
    return [=](const glm::dvec3& p) { return glm::dot(p - position, outwards) < away; };
}

TEST(ShadowEdge, AStraightEdgeIsNoFartherThanItIs) {
    for (const double away : {1e-5, 1e-3, 0.02, 0.3, 4.0, 60.0})
        for (int i = 0; i < 40; ++i) {
            const double angle = i * std::numbers::pi / 20 + 0.01;
            const double found = edgeDistance(straightEdge(away, angle), position, up, up, 100);
            EXPECT_LE(found, away) << away << " " << angle;
            // Error of the directions' angle, twice, and a sixteenth of the ring. Closer than the first
            // ring, any value from 0 is allowed.
            if (away > 5 * 0x1p-13) {
                EXPECT_GE(found, 0.8 * away) << away << " " << angle;
            }
        }
}

// Measured across the light, not along the ground: an edge 1 m away under a sun 30 degrees high.
TEST(ShadowEdge, IsMeasuredAcrossTheLight) {
    const glm::dvec3 to_light(std::sqrt(0.75), 0.5, 0);
    const double along = edgeDistance(straightEdge(1, 0), position, up, to_light, 100),
                 across = edgeDistance(straightEdge(1, std::numbers::pi / 2), position, up, to_light, 100);
    EXPECT_LE(along, 0.5);
    EXPECT_GE(along, 0.8 * 0.5);
    EXPECT_LE(across, 1);
    EXPECT_GE(across, 0.8);
}

TEST(ShadowEdge, WhereThereIsNoneItIsInfinite) {
    EXPECT_TRUE(std::isinf(edgeDistance([](const glm::dvec3&) { return true; }, position, up, up, 100)));
    EXPECT_TRUE(std::isinf(edgeDistance(straightEdge(300, 0), position, up, up, 100)))
        << "beyond what is sought";
    EXPECT_TRUE(std::isinf(edgeDistance([](const glm::dvec3&) { return false; }, {0, 0, 0}, up, up, 100)))
        << "at the camera itself";
}

// A spot of light around `position`, as wide as a gap between leaves.
TEST(ShadowEdge, ASpotEndsWhereItEnds) {
    const auto spot = [](const glm::dvec3& p) { return glm::distance(p, position) < 0.05; };
    const double found = edgeDistance(spot, position, up, up, 100);
    EXPECT_LE(found, 0.05);
    EXPECT_GE(found, 0.8 * 0.05);
}

}  // namespace
}  // namespace diptych::reference
