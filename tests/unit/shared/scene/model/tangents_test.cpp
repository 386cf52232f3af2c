// SPDX-License-Identifier: MIT
#include "shared/scene/model/tangents.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <vector>

using namespace diptych;

namespace {

// Rounding of a unit vector's components to float, plus the sums before it.
constexpr float slack = 1e-6f;

Primitive quad(const std::array<glm::vec2, 4>& uv) {
    Primitive p;
    p.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    p.normals.assign(4, {0, 0, 1});
    p.texcoords[0].assign(uv.begin(), uv.end());
    p.indices = {0, 1, 2, 0, 2, 3};
    return p;
}

void expectTangent(const glm::vec4& tangent, const glm::vec3& direction, float sign) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(tangent[c], direction[c], slack);
    EXPECT_EQ(tangent.w, sign);
}

void expectUnitFrames(const Primitive& p) {
    ASSERT_EQ(p.tangents.size(), p.positions.size());
    for (std::size_t v = 0; v < p.tangents.size(); ++v) {
        const glm::vec3 t(p.tangents[v]);
        EXPECT_NEAR(glm::length(t), 1, slack) << v;
        EXPECT_NEAR(glm::dot(t, p.normals[v]), 0, slack) << v;
        EXPECT_EQ(std::abs(p.tangents[v].w), 1) << v;
    }
}

// A closed sphere without UV seams: u and v are functions of position, so no vertex is split.
Primitive ball() {
    constexpr int rings = 8, sectors = 12;
    constexpr double pi = 3.14159265358979323846;
    Primitive p;
    const auto vertex = [&](double theta, double phi) {
        const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        p.positions.push_back(n);
        p.normals.push_back(n);
        p.texcoords[0].push_back({n.x + 0.3f * n.y, n.z - 0.2f * n.y});
    };
    vertex(0, 0);
    for (int r = 1; r < rings; ++r)
        for (int s = 0; s < sectors; ++s) vertex(pi * r / rings, 2 * pi * s / sectors);
    vertex(pi, 0);
    const auto at = [](int r, int s) {
        return static_cast<std::uint32_t>(1 + (r - 1) * sectors + s % sectors);
    };
    const auto south = static_cast<std::uint32_t>(p.positions.size() - 1);
    for (int s = 0; s < sectors; ++s) {
        p.indices.insert(p.indices.end(), {0, at(1, s + 1), at(1, s)});
        p.indices.insert(p.indices.end(), {south, at(rings - 1, s), at(rings - 1, s + 1)});
        for (int r = 1; r + 1 < rings; ++r)
            p.indices.insert(p.indices.end(), {at(r, s), at(r, s + 1), at(r + 1, s), at(r, s + 1),
                                               at(r + 1, s + 1), at(r + 1, s)});
    }
    return p;
}

}  // namespace

// glTF's v grows downwards: v = 0 is the image's top. Right is +X, top is +Y. With normal +Z, the
// bitangent cross(n, t) * w = +Y requires w = +1. Either UV set is read where the other has another image.
TEST(Tangents, FollowTheImage) {
    using Corners = std::array<glm::vec2, 4>;
    const Corners upright{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}}, upside_down{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
        turned{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};  // its right is world +Y, its top world -X
    for (const auto& [image, direction, sign] : {std::tuple{upright, glm::vec3(1, 0, 0), 1.0f},
                                                 {upside_down, {1, 0, 0}, -1.0f},
                                                 {turned, {0, 1, 0}, 1.0f}})
        for (const int set : {0, 1}) {
            Primitive p = quad(set == 0 ? image : upside_down);
            p.texcoords[1].assign(image.begin(), image.end());
            if (set == 0) p.texcoords[1].assign(turned.rbegin(), turned.rend());
            makeTangents(p, {.texcoord = set});
            ASSERT_EQ(p.positions.size(), 4u);
            for (const glm::vec4& t : p.tangents) expectTangent(t, direction, sign);
        }
}

// A map's own transform rotates or mirrors its directions on the surface (KHR_texture_transform).
TEST(Tangents, FollowTheTransformOfTheirMap) {
    const auto expect = [](const glm::dvec3& u, const glm::dvec3& v, const glm::vec3& direction, float sign) {
        Primitive p = quad({{{0, 1}, {1, 1}, {1, 0}, {0, 0}}});
        makeTangents(p, {.texcoord = 0, .u = u, .v = v});
        EXPECT_EQ(p.positions.size(), 4u);
        for (const glm::vec4& t : p.tangents) expectTangent(t, direction, sign);
    };
    expect({3, 0, 0.25}, {0, 0.5, 7}, {1, 0, 0}, 1);
    expect({-1, 0, 1}, {0, 1, 0}, {-1, 0, 0}, -1);
    expect({1, 0, 0}, {0, -1, 1}, {1, 0, 0}, -1);
    // Coordinates rotated by an angle (row u: cos, sin): along the image's right u' grows and v' is
    // constant.
    for (const double angle : {0.3, 1.5707963267948966, 2.5, -2.0}) {
        const double c = std::cos(angle), s = std::sin(angle);
        expect({c, s, 0}, {-s, c, 0}, {c, -s, 0}, 1);
    }
    // Sheared coordinates: u' = u + v, v' = v; then u' = u, v' = u + v.
    const double h = std::sqrt(0.5);
    expect({1, 1, 0}, {0, 1, 0}, {1, 0, 0}, 1);
    expect({1, 0, 0}, {1, 1, 0}, {h, h, 0}, 1);
}

// In one float with the bitangent's sign, which is exactly 1 without a turn.
TEST(Tangents, ATurnIsStoredWithTheSign) {
    EXPECT_EQ(TangentRotation{}.times(-1), -1);
    EXPECT_EQ(TangentRotation::of(-1).cosine, 1);
    EXPECT_EQ(TangentRotation::of(-1).sine, 0);
    for (const bool mirrored : {false, true})
        for (const float sign : {-1.0f, 1.0f})
            for (int i = -1000; i <= 1000; ++i) {
                // Also turns that are nearly none or whole.
                const double angle = i % 2 == 0 ? i * 6.283185307 / 1000 : i * 1e-10;
                const TangentRotation rotation{std::cos(angle), std::sin(angle), mirrored};
                const float stored = rotation.times(sign);
                const TangentRotation read = TangentRotation::of(stored);
                EXPECT_EQ(signOf(stored), sign);
                EXPECT_EQ(read.mirrored, mirrored) << angle;
                EXPECT_NEAR(read.cosine, rotation.cosine, 1e-6) << angle;
                EXPECT_NEAR(read.sine, rotation.sine, 1e-6) << angle;
            }
}

// Two quads share the edge x = 0 and mirror their image there: u = |x|. The edge's two vertices have one
// position, normal and UV, but two orientations: each becomes two vertices.
TEST(Tangents, MirroredImageSplitsTheSharedEdge) {
    Primitive p;
    for (const float x : {-1.0f, 0.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f}) {
            p.positions.push_back({x, y, 0});
            p.normals.push_back({0, 0, 1});
            p.texcoords[0].push_back({std::abs(x), y < 0 ? 1 : 0});
            p.colors.push_back({x, y, 0, 1});
        }
    p.indices = {0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3};
    makeTangents(p, {.texcoord = 0});
    ASSERT_EQ(p.positions.size(), 8u);
    ASSERT_EQ(p.colors.size(), 8u) << "every attribute is split along";
    for (std::size_t i = 0; i < p.indices.size(); ++i) {
        const bool left = i < 6;
        expectTangent(p.tangents[p.indices[i]], {left ? -1 : 1, 0, 0}, left ? -1.0f : 1.0f);
    }
    const std::vector<std::uint32_t> before{0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3};
    for (std::size_t i = 0; i < before.size(); ++i) {
        const int x = static_cast<int>(before[i] / 2) - 1;
        EXPECT_EQ(p.positions[p.indices[i]].x, static_cast<float>(x)) << "a split moves no corner";
        EXPECT_EQ(p.colors[p.indices[i]].r, static_cast<float>(x));
    }
}

// Vertices that are separate in the list but equal in every respect are welded. A quad of two separate
// triangles gives the same result as one sheet, even where the two derivatives differ.
TEST(Tangents, EqualVerticesAreWelded) {
    Primitive sheet = quad({{{0, 1}, {1, 1}, {0.7f, 0.2f}, {0, 0}}}), loose = sheet;
    loose.positions.clear(), loose.normals.clear(), loose.texcoords[0].clear(), loose.indices.clear();
    for (const std::uint32_t v : sheet.indices) {
        loose.indices.push_back(static_cast<std::uint32_t>(loose.positions.size()));
        loose.positions.push_back(sheet.positions[v]);
        loose.normals.push_back(sheet.normals[v]);
        loose.texcoords[0].push_back(sheet.texcoords[0][v]);
    }
    makeTangents(sheet, {.texcoord = 0});
    makeTangents(loose, {.texcoord = 0});
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(sheet.tangents[sheet.indices[i]], loose.tangents[loose.indices[i]]);
    EXPECT_NE(sheet.tangents[1], sheet.tangents[3]) << "or the test says nothing";
}

// Derivatives by hand with t = 1 - v. Triangle (0, 1, 2): s, t edges (1, 0) and (1, 1); dP/ds = (2, 0, 0).
// Triangle (0, 2, 3) has sheared UVs: edges (1, 1) and (1, 2); dP/ds = 2 d1 - 1 d2 = (4, 4) - (0, 2) = (4,
// 2, 0). Both meet vertex 0 with 45 degrees, so the mean direction bisects the two.
TEST(Tangents, GroupsAreWeightedByAngle) {
    Primitive p = quad({{{0, 1}, {1, 1}, {1, 0}, {1, -1}}});
    makeTangents(p, {.texcoord = 0});
    ASSERT_EQ(p.positions.size(), 4u);
    const glm::vec3 first(1, 0, 0), second = glm::normalize(glm::vec3(2, 1, 0));
    expectTangent(p.tangents[1], first, 1);
    expectTangent(p.tangents[3], second, 1);
    expectTangent(p.tangents[0], glm::normalize(first + second), 1);
    expectTangent(p.tangents[2], glm::normalize(first + second), 1);
}

// The tangent is in the plane of the vertex normal, not of the triangle: +X projected onto it.
TEST(Tangents, TangentIsProjectedIntoTheNormalsPlane) {
    Primitive p = quad({{{0, 1}, {1, 1}, {1, 0}, {0, 0}}});
    p.normals.assign(4, glm::normalize(glm::vec3(1, 0, 1)));
    makeTangents(p, {.texcoord = 0});
    for (const glm::vec4& t : p.tangents) expectTangent(t, glm::normalize(glm::vec3(1, 0, -1)), 1);
}

TEST(Tangents, CubeHasTheFacesOwnAxes) {
    const std::array<glm::vec3, 6> rights{
        {{1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}}};
    const std::array<glm::vec3, 6> tops{{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
    Primitive p;
    for (std::size_t f = 0; f < 6; ++f) {
        const glm::vec3 n = glm::cross(rights[f], tops[f]);
        const auto base = static_cast<std::uint32_t>(p.positions.size());
        for (const glm::vec2 uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
            p.positions.push_back(n + rights[f] * (2 * uv.x - 1) + tops[f] * (1 - 2 * uv.y));
            p.normals.push_back(n);
            p.texcoords[0].push_back(uv);
        }
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(base + i);
    }
    makeTangents(p, {.texcoord = 0});
    ASSERT_EQ(p.positions.size(), 24u);
    for (std::size_t v = 0; v < 24; ++v) {
        expectTangent(p.tangents[v], rights[v / 4], 1);
        const glm::vec3 bitangent = glm::cross(p.normals[v], glm::vec3(p.tangents[v])) * p.tangents[v].w;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(bitangent[c], tops[v / 4][c], slack);
    }
}

TEST(Tangents, DegenerateUvsAndTrianglesStillGetUnitTangents) {
    Primitive flat = quad({{{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}}});
    makeTangents(flat, {.texcoord = 0});
    expectUnitFrames(flat);

    Primitive line = quad({{{0, 0}, {1, 0}, {2, 0}, {3, 0}}});
    makeTangents(line, {.texcoord = 0});
    expectUnitFrames(line);

    // A triangle without area takes its neighbour's tangent.
    Primitive needle = quad({{{0, 1}, {1, 1}, {1, 0}, {0, 0}}});
    needle.indices = {0, 0, 1, 0, 1, 2, 0, 2, 3, 2, 2, 2};
    makeTangents(needle, {.texcoord = 0});
    for (const glm::vec4& t : needle.tangents) expectTangent(t, {1, 0, 0}, 1);

    // A triangle whose UVs have no area joins the group across the edge.
    Primitive joined = quad({{{0, 1}, {1, 1}, {1, 0}, {0.5f, 0.5f}}});
    makeTangents(joined, {.texcoord = 0});
    expectUnitFrames(joined);
    EXPECT_EQ(joined.tangents[joined.indices[0]], joined.tangents[joined.indices[3]]);
}

// A needle beside a triangle with the same tangents: the cosine of its angle is rounded, to more than 1 too.
TEST(Tangents, ANeedleChangesNothing) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(0.1f, 1);
    for (int i = 0; i < 200; ++i) {
        Primitive p;
        const float x = coordinate(random), y = coordinate(random);
        p.positions = {{0, 0, 0}, {x, y, 0}, {2 * x, 2 * y, 1e-12f}, {0, 0, -1}};
        p.normals.assign(4, glm::normalize(glm::vec3(y, -x, 0)));
        p.texcoords[0] = {{0, 0}, {1, 0}, {2, 1e-12f}, {0, -1}};
        p.indices = {0, 1, 2, 1, 0, 3};
        makeTangents(p, {.texcoord = 0});
        for (std::size_t k = 3; k < 6; ++k)
            EXPECT_NEAR(glm::dot(glm::vec3(p.tangents[p.indices[k]]), glm::normalize(glm::vec3(x, y, 0))), 1,
                        slack);
    }
}

TEST(Tangents, ThousandTrianglesAroundOneVertexEndWell) {
    Primitive fan;
    fan.positions = {{0, 0, 0}};
    fan.texcoords[0] = {{0.5f, 0.5f}};
    constexpr std::uint32_t spokes = 1000;
    for (std::uint32_t i = 0; i < spokes; ++i) {
        const double a = 2 * 3.14159265358979323846 * i / spokes;
        fan.positions.push_back({std::cos(a), std::sin(a), 0});
        fan.texcoords[0].push_back({0.5 + 0.5 * std::cos(a), 0.5 - 0.5 * std::sin(a)});
        fan.indices.insert(fan.indices.end(), {0, 1 + i, 1 + (i + 1) % spokes});
    }
    fan.normals.assign(fan.positions.size(), {0, 0, 1});
    makeTangents(fan, {.texcoord = 0});
    ASSERT_EQ(fan.positions.size(), spokes + 1);
    // UVs are floats around 0.5, so the derivative of one 6 mm spoke is good to 1e-5.
    for (const glm::vec4& t : fan.tangents) EXPECT_NEAR(t.x, 1, 1e-5f);
}

TEST(Tangents, SmoothClosedMeshDoesNotDependOnTriangleOrder) {
    Primitive straight = ball(), shuffled = straight;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < straight.indices.size(); i += 3)
        triangles.push_back({straight.indices[i], straight.indices[i + 1], straight.indices[i + 2]});
    std::mt19937 random(7);
    std::shuffle(triangles.begin(), triangles.end(), random);
    shuffled.indices.clear();
    for (std::array<std::uint32_t, 3> t : triangles) {
        std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        shuffled.indices.insert(shuffled.indices.end(), t.begin(), t.end());
    }
    makeTangents(straight, {.texcoord = 0});
    makeTangents(shuffled, {.texcoord = 0});
    expectUnitFrames(straight);
    ASSERT_EQ(straight.positions.size(), shuffled.positions.size());

    // By position and sign: the order decides which copy of a split vertex comes first.
    const auto key = [](const Primitive& p, std::uint32_t v) {
        const glm::vec3& q = p.positions[v];
        return std::array{q.x, q.y, q.z, p.tangents[v].w};
    };
    std::map<std::array<float, 4>, glm::vec3> expected;
    for (const std::uint32_t v : straight.indices)
        expected[key(straight, v)] = glm::vec3(straight.tangents[v]);
    EXPECT_GT(expected.size(), straight.normals.size() / 2);
    for (const std::uint32_t v : shuffled.indices) {
        const auto at = expected.find(key(shuffled, v));
        ASSERT_NE(at, expected.end());
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(at->second[c], shuffled.tangents[v][c], slack);
    }
}

TEST(Tangents, WithoutThatUvSetAnyPerpendicularUnitVector) {
    for (const int set : {-1, 0, 1}) {
        Primitive p = ball();
        p.texcoords[0].clear();
        p.tangent_groups = {.of_vertex = {0}, .first = {0, 1}, .corners = {0}};  // of earlier coordinates
        makeTangents(p, {.texcoord = set});
        expectUnitFrames(p);
        EXPECT_TRUE(p.tangent_groups.empty());
        for (const glm::vec4& t : p.tangents) EXPECT_EQ(t.w, 1);
    }
}

TEST(FlatNormals, EveryTriangleHasItsOwn) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    p.texcoords[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    p.indices = {0, 1, 2, 0, 3, 1, 2, 2, 2};
    makeFlatNormals(p);
    ASSERT_EQ(p.positions.size(), 9u);
    ASSERT_EQ(p.texcoords[0].size(), 9u);
    const std::array<glm::vec3, 3> expected{{{0, 0, 1}, {0, -1, 0}, {0, 0, 1}}};  // the last has no area
    for (std::size_t v = 0; v < 9; ++v) {
        EXPECT_EQ(p.indices[v], v);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(p.normals[v][c], expected[v / 3][c], slack) << v;
    }
    EXPECT_EQ(p.positions[4], glm::vec3(0, 0, -1));
}
