// SPDX-License-Identifier: MIT
// The tests that keep lights out of cells, against exact intersections in double precision: never a false no,
// and how many false yeses.
#include "shared/light/light_grid.h"
#include "tests/probe/probe.h"

#include <gtest/gtest.h>

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

// A frustum's cell in view axes: sides over depth, and depths.
struct Cell {
    glm::dvec2 x, y, z;

    std::array<glm::dvec3, 8> corners() const {
        std::array<glm::dvec3, 8> result;
        for (int i = 0; i < 8; ++i) {
            const double depth = z[(i >> 2) & 1];
            result[static_cast<std::size_t>(i)] = {x[i & 1] * depth, y[(i >> 1) & 1] * depth, depth};
        }
        return result;
    }
    bool holds(const glm::dvec3& p) const {
        return p.z >= z.x && p.z <= z.y && p.x >= x.x * p.z && p.x <= x.y * p.z && p.y >= y.x * p.z &&
               p.y <= y.y * p.z;
    }
};

glm::dvec3 nearestOnTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                             const glm::dvec3& c) {
    // Ericson 2004, "Real-Time Collision Detection", 5.1.5: by the regions of the triangle's plane.
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
                 d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    return a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
}

glm::dvec3 nearestInCell(const glm::dvec3& p, const Cell& cell) {
    if (cell.holds(p)) return p;
    const auto c = cell.corners();
    constexpr std::size_t faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    glm::dvec3 best = c[0];
    for (const auto& face : faces) {
        const glm::dvec3 q = nearestOnTriangle(p, c[face[0]], c[face[1]], c[face[2]]);
        if (glm::distance(p, q) < glm::distance(p, best)) best = q;
    }
    return best;
}

// A ball, or the sector of one: what a point light or a spot lights.
struct Felt {
    glm::dvec3 apex, axis;
    double range = 1, half = glm::pi<double>();  // half: the cone's half angle, rad

    glm::dvec3 nearest(const glm::dvec3& p) const {
        const glm::dvec3 v = p - apex;
        const double length = glm::length(v);
        if (length == 0) return apex;
        const double along = glm::dot(v, axis);
        if (half < 3 && along < length * std::cos(half)) {
            // On the cone's side, or the apex.
            glm::dvec3 across = v - axis * along;
            across = glm::length(across) > 0 ? glm::normalize(across) : glm::dvec3(0);
            const glm::dvec3 side = axis * std::cos(half) + across * std::sin(half);
            return apex + side * std::clamp(glm::dot(v, side), 0.0, range);
        }
        return length > range ? apex + v * (range / length) : p;
    }
};

// The distance between the two convex sets, by alternating projections (Cheney and Goldstein 1959, "Proximity
// maps for convex sets"), from several starts; negative where it has not settled.
double gap(const Felt& felt, const Cell& cell) {
    const auto corners = cell.corners();
    double least = std::numeric_limits<double>::infinity();
    const glm::dvec3 middle = (corners[0] + corners[7]) * 0.5;
    glm::dvec3 p = nearestInCell(felt.apex, cell);
    if (glm::distance(p, felt.nearest(p)) > glm::distance(middle, felt.nearest(middle))) p = middle;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 q = felt.nearest(p);
        p = nearestInCell(q, cell);
        least = glm::distance(p, q);
        if (least < 1e-13 || (i % 50 == 49 && before - least < 1e-12 * felt.range)) return least;
        if (i % 50 == 49) before = least;
    }
    return -1;
}

struct Case {
    Felt felt;
    Cell cell;
};

std::vector<Case> randomCases(std::size_t count, bool spots, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<Case> cases;
    while (cases.size() < count) {
        Case c;
        const double depth = std::pow(10.0, 3 * unit(random) - 1),
                     thick = 1 + std::pow(10.0, 2 * unit(random) - 2);
        c.cell.z = {unit(random) < 0.1 ? 0.0 : depth, depth * thick};
        const double side = std::pow(10.0, 2 * unit(random) - 2.5);
        c.cell.x = glm::dvec2(both(random)) + glm::dvec2(0, side);
        c.cell.y = glm::dvec2(both(random)) + glm::dvec2(0, side);
        const double range = depth * std::pow(10.0, 2 * unit(random) - 1.5);
        c.felt.range = static_cast<double>(static_cast<float>(range));
        // Where being felt is a toss: about a range away from the cell.
        const auto corners = c.cell.corners();
        const glm::dvec3 at = glm::mix(corners[0], corners[7], unit(random));
        glm::dvec3 away(both(random), both(random), both(random));
        c.felt.apex = glm::dvec3(glm::vec3(at + glm::normalize(away) * range * (0.5 + unit(random))));
        if (spots) {
            const double full = std::pow(unit(random), 2.0) * 179;
            c.felt.half = glm::radians(full / 2);
            glm::dvec3 aim = glm::normalize(at - c.felt.apex);
            c.felt.axis = glm::normalize(aim + glm::dvec3(both(random), both(random), both(random)) * 0.8);
            c.felt.range *= 1 + unit(random);
            c.felt.range = static_cast<double>(static_cast<float>(c.felt.range));
        } else {
            c.felt.axis = {0, 0, 1};
        }
        cases.push_back(c);
    }
    return cases;
}

// Tiny cells just within what is felt: at the rim of a cone's cap, on its side, on a ball's surface.
std::vector<Case> edgeCases(std::size_t count, bool spots, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1), both(-1, 1);
    std::vector<Case> cases;
    while (cases.size() < count) {
        Case c;
        const double depth = std::pow(10.0, 2 * unit(random));
        const glm::dvec3 p(both(random) * depth, both(random) * depth, depth);
        c.felt.range = static_cast<double>(static_cast<float>(depth * (0.1 + unit(random))));
        c.felt.axis = glm::normalize(glm::dvec3(both(random), both(random), both(random)));
        glm::dvec3 towards = c.felt.axis;
        if (spots) {
            c.felt.half = glm::radians(1 + 88 * unit(random));
            const glm::dvec3 across =
                glm::normalize(glm::cross(c.felt.axis, glm::dvec3(both(random), both(random), both(random))));
            const double angle = 0.998 * c.felt.half;
            towards = c.felt.axis * std::cos(angle) + across * std::sin(angle);
        }
        const double along = spots && unit(random) < 0.5 ? 0.2 + 0.7 * unit(random) : 0.998;
        c.felt.apex = glm::dvec3(glm::vec3(p - towards * (along * c.felt.range)));
        c.cell.x = glm::dvec2(p.x / depth) + glm::dvec2(-1e-5, 1e-5);
        c.cell.y = glm::dvec2(p.y / depth) + glm::dvec2(-1e-5, 1e-5);
        c.cell.z = depth * glm::dvec2(1 - 1e-5, 1 + 1e-5);
        if (!spots && unit(random) < 0.5) {
            // Or a froxel as deep as a slice, whose near or far face the ball just passes.
            const bool far = unit(random) < 0.5;
            c.cell = {{-0.05, 0.05}, {-0.05, 0.05}, {depth, 1.1 * depth}};
            c.felt.apex = {
                0, 0, far ? 1.1 * depth + c.felt.range - 2e-4 * depth : depth - c.felt.range + 2e-4 * depth};
            c.felt.apex = glm::dvec3(glm::vec3(c.felt.apex));
        }
        cases.push_back(c);
    }
    return cases;
}

// Bounds as the program makes them: view axes that are the world's, but for y and z.
std::vector<gpu::LightBound> boundsOf(const std::vector<Case>& cases, bool spots) {
    std::vector<Light> lights;
    for (const Case& c : cases) {
        Light light;
        light.kind = spots ? LightKind::spot : LightKind::point;
        light.position = {c.felt.apex.x, -c.felt.apex.y, -c.felt.apex.z};
        light.direction = {c.felt.axis.x, -c.felt.axis.y, -c.felt.axis.z};
        light.range = static_cast<float>(c.felt.range);
        light.outer_cone = static_cast<float>(c.felt.half);
        lights.push_back(light);
    }
    View view;
    view.width = view.height = 64;
    return lightBounds(gpuLights(lights, glm::dvec3(0)), view);
}

// What is made 1 % smaller on the way to the shader, or nothing.
enum class Shrunk { nothing, radius, sides, depths, cone };

struct Answer {
    bool ball, cone;
};

std::vector<Answer> ask(Probes& probes, const std::vector<Case>& cases, bool spots, Shrunk shrunk) {
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
    const std::vector<float> out = probes.run("light_cull", input, 18, 2);
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < cases.size(); ++i) answers.push_back({out[2 * i] != 0, out[2 * i + 1] != 0});
    return answers;
}

struct Tally {
    int felt = 0, apart = 0, false_no = 0, false_yes = 0;
};

Tally tally(Probes& probes, bool spots, Shrunk shrunk, unsigned seed) {
    std::vector<Case> cases = randomCases(spots ? 10000 : 20000, spots, seed);
    for (const Case& c : edgeCases(4000, spots, seed)) cases.push_back(c);
    const std::vector<Answer> answers = ask(probes, cases, spots, shrunk);
    Tally t;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const bool yes = answers[i].ball && (!spots || answers[i].cone);
        const double distance = gap(cases[i].felt, cases[i].cell);
        if (distance < 0) continue;
        if (distance < 1e-12 * cases[i].felt.range) {
            ++t.felt;
            t.false_no += !yes;
        } else {
            ++t.apart;
            t.false_yes += yes;
        }
    }
    return t;
}

void print(const char* what, const Tally& t) {
    std::printf("%s: %d pairs meet, %d do not, of which %.2f %% were kept\n", what, t.felt, t.apart,
                100.0 * t.false_yes / t.apart);
}

TEST(LightCull, ABallIsNeverMissed) {
    Probes probes;
    const Tally t = tally(probes, false, Shrunk::nothing, 21);
    print("balls against froxels", t);
    EXPECT_EQ(t.false_no, 0);
    EXPECT_GT(t.felt, 5000);
    EXPECT_GT(t.apart, 5000);
    // Half of these are nearly felt; of random lights in a scene far fewer are kept for nothing.
    EXPECT_LT(t.false_yes, t.apart / 4) << "a test that keeps everything would pass the rest";
}

TEST(LightCull, ASpotIsNeverMissed) {
    Probes probes;
    const Tally t = tally(probes, true, Shrunk::nothing, 22);
    print("spots against froxels", t);
    EXPECT_EQ(t.false_no, 0);
    EXPECT_GT(t.felt, 2000);
    EXPECT_GT(t.apart, 2000);
    EXPECT_LT(t.false_yes, t.apart / 2);
}

TEST(LightCull, WhatIsOnePerCentTooSmallIsCaught) {
    Probes probes;
    EXPECT_GT(tally(probes, false, Shrunk::radius, 21).false_no, 0) << "a light's radius";
    EXPECT_GT(tally(probes, false, Shrunk::sides, 21).false_no, 0) << "a tile's sides";
    EXPECT_GT(tally(probes, false, Shrunk::depths, 21).false_no, 0) << "a slice's depths";
    EXPECT_GT(tally(probes, true, Shrunk::radius, 22).false_no, 0) << "a spot's radius";
    EXPECT_GT(tally(probes, true, Shrunk::cone, 22).false_no, 0) << "a spot's cone";
}

}  // namespace
}  // namespace diptych
