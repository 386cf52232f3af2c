// SPDX-License-Identifier: MIT
// Tangents of morphed surfaces, compared with MikkTSpace on a morphed copy and with closed forms.
#include "shared/scene/motion/morphed_tangents.h"

#include "shared/scene/model/tangents.h"
#include "shared/scene/motion/posed.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

namespace diptych {
namespace {

const TextureSlot plain{.texture = 0};

Scene morphScene(Primitive primitive, const TextureSlot& map, std::vector<float> amounts) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].normal_texture = map;
    scene.meshes.resize(1);
    scene.meshes[0].primitives = {std::move(primitive)};
    scene.meshes[0].weights = std::move(amounts);
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    return scene;
}

PosedVertices posedOf(const Scene& scene) {
    const Pose pose = poseAt(scene, 0);
    return posedVertices(scene, pose, pose.instances.at(0));
}

// A grid of n x n cells over the unit square in z = 0, with upright UVs.
Primitive sheet(int n) {
    Primitive p;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const glm::vec2 at = glm::vec2(x, y) / static_cast<float>(n);
            p.positions.emplace_back(at, 0);
            p.normals.emplace_back(0, 0, 1);
            p.texcoords[0].emplace_back(at.x, 1 - at.y);
        }
    const auto row = static_cast<std::uint32_t>(n + 1);
    for (std::uint32_t y = 0; y + 1 < row; ++y)
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
            const std::uint32_t a = y * row + x;
            p.indices.insert(p.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
        }
    return p;
}

// A sphere of rings and sectors. Its image goes once around and is mirrored on the other half, so vertices
// at both seams belong to two groups of different handedness. The poles have degenerate triangles.
Primitive globe() {
    constexpr int rings = 6, sectors = 10;
    Primitive p;
    for (int r = 0; r <= rings; ++r)
        for (int s = 0; s <= sectors; ++s) {
            const double theta = std::numbers::pi * r / rings,
                         phi = 2 * std::numbers::pi * (s % sectors) / sectors;
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                              -std::sin(theta) * std::sin(phi));
            p.positions.push_back(r == 0 ? glm::vec3(0, 1, 0) : r == rings ? glm::vec3(0, -1, 0) : n);
            p.normals.push_back(p.positions.back());
            p.texcoords[0].emplace_back(static_cast<float>(std::min(s, sectors - s)) / 5,
                                        static_cast<float>(r) / rings);
        }
    for (std::uint32_t r = 0; r < rings; ++r)
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const std::uint32_t a = r * (sectors + 1) + s, b = a + sectors + 1;
            p.indices.insert(p.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    return p;
}

enum Moves : unsigned { positions = 1, normals = 2, texcoords = 4 };

// Adds a target whose deltas are equal where position and normal are equal, so the surface stays closed.
void addTarget(Primitive& p, unsigned moves, int seed) {
    MorphTarget target;
    const auto wave = [&](const glm::vec3& at, double shift) {
        const glm::dvec3 k(1.3 + seed, 2.1 - seed, 1.7);
        return static_cast<float>(0.12 * std::sin(glm::dot(k, glm::dvec3(at)) + shift));
    };
    for (std::size_t v = 0; v < p.positions.size(); ++v) {
        const glm::vec3& at = p.positions[v];
        if (moves & positions) target.positions.emplace_back(wave(at, 0), wave(at, 1), wave(at, 2));
        if (moves & normals) target.normals.emplace_back(wave(at, 3), wave(at, 4), wave(at, 5));
        if (moves & texcoords) target.texcoords[0].push_back(0.2f * glm::vec2(wave(at, 6), wave(at, 7)));
    }
    p.targets.push_back(std::move(target));
}

// The primitive baked in that pose, in float32.
Primitive morphedCopy(Primitive p, const std::vector<float>& amounts) {
    for (std::size_t t = 0; t < p.targets.size(); ++t)
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            const MorphTarget& target = p.targets[t];
            if (!target.positions.empty()) p.positions[v] += amounts[t] * target.positions[v];
            if (!target.normals.empty()) p.normals[v] += amounts[t] * target.normals[v];
            if (!target.texcoords[0].empty()) p.texcoords[0][v] += amounts[t] * target.texcoords[0][v];
        }
    for (glm::vec3& n : p.normals) n = glm::normalize(n);
    p.targets.clear();
    return p;
}

// Compares every corner of every triangle with an area.
void expectAsMadeAfresh(const Primitive& primitive, const TextureSlot& map,
                        const std::vector<float>& amounts) {
    Primitive morphable = primitive, afresh = morphedCopy(primitive, amounts);
    makeTangents(morphable, map);
    makeTangents(afresh, map);
    ASSERT_FALSE(morphable.tangent_groups.empty());
    ASSERT_EQ(morphable.indices.size(), afresh.indices.size());
    const PosedVertices v = posedOf(morphScene(morphable, map, amounts));
    std::size_t compared = 0;
    for (std::size_t i = 0; i < afresh.indices.size(); ++i) {
        const std::uint32_t* t = &afresh.indices[i / 3 * 3];
        const auto& q = afresh.positions;
        if (glm::length(glm::cross(q[t[1]] - q[t[0]], q[t[2]] - q[t[0]])) < 1e-4f) continue;
        const glm::vec4& expected = afresh.tangents[afresh.indices[i]];
        const std::uint32_t vertex = morphable.indices[i];
        // Edges of 0.3 m in position and 0.1 in texture coordinates, each rounded to float32.
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(v.tangents[vertex][c], expected[c], 1e-5) << "corner " << i;
        ASSERT_EQ(morphable.tangents[vertex].w, expected.w) << "corner " << i;
        ++compared;
    }
    EXPECT_GT(compared, afresh.indices.size() / 2);
}

TEST(MorphedTangents, AreThoseMadeAfreshOfAMorphedCopy) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    TextureSlot turned = plain;
    turned.u = {2 * c, 2 * s, 0.3};
    turned.v = {-s, c, 0};
    TextureSlot mirrored = plain;
    mirrored.u = {-1, 0, 1};
    for (const TextureSlot& map : {plain, turned, mirrored})
        for (const unsigned moves : {+positions, +normals, +texcoords, positions | normals | texcoords})
            for (const std::vector<float>& amounts : {std::vector<float>{1, 0}, {-0.5f, 0.75f}, {1.5f, 1}}) {
                Primitive p = globe();
                addTarget(p, moves, 0);
                addTarget(p, moves, 1);
                SCOPED_TRACE(testing::Message()
                             << "u " << map.u.x << " moves " << moves << " " << amounts[0]);
                expectAsMadeAfresh(p, map, amounts);
            }
}

// A vertex's mean tangent depends on the triangles that share it: a flat primitive's triangles share none.
TEST(MorphedTangents, OfAFlatPrimitiveAreItsTrianglesOwn) {
    Primitive p = sheet(3);
    addTarget(p, positions | texcoords, 0);
    makeFlatNormals(p);
    p.flat = true;
    Primitive afresh = morphedCopy(p, {1});
    makeFlatNormals(afresh);
    makeTangents(p, plain);
    makeTangents(afresh, plain);
    const PosedVertices v = posedOf(morphScene(p, plain, {1}));
    for (std::size_t i = 0; i < p.indices.size(); ++i) {
        const glm::vec4& expected = afresh.tangents[afresh.indices[i]];
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(v.tangents[p.indices[i]][c], expected[c], 1e-5) << i;
        EXPECT_NEAR(glm::dot(v.tangents[p.indices[i]], v.normals[p.indices[i]]), 0, 1e-12);
    }
}

// A target that shears y by half of x makes dP/du (1, 1/2, 0); one that rotates the image by 90 degrees
// makes it -Y.
TEST(MorphedTangents, FollowShearAndSlideInClosedForm) {
    Primitive p = sheet(2);
    MorphTarget shear, turn;
    for (const glm::vec3& at : p.positions) {
        shear.positions.emplace_back(0, at.x, 0);
        turn.texcoords[0].push_back(glm::vec2(1 - at.y, 1 - at.x) - glm::vec2(at.x, 1 - at.y));
    }
    p.targets = {shear, turn};
    makeTangents(p, plain);
    for (const glm::dvec3& t : posedOf(morphScene(p, plain, {0.5f, 0})).tangents)
        EXPECT_LT(glm::length(t - glm::normalize(glm::dvec3(1, 0.5, 0))), 1e-7);
    for (const glm::dvec3& t : posedOf(morphScene(p, plain, {0, 1})).tangents)
        EXPECT_LT(glm::length(t - glm::dvec3(0, -1, 0)), 1e-7);
    for (const glm::dvec3& t : posedOf(morphScene(p, plain, {0, 0})).tangents)
        EXPECT_LT(glm::length(t - glm::dvec3(1, 0, 0)), 1e-7) << "at rest";
}

// Computed before the joints move the surface, then moved with it.
TEST(MorphedTangents, ComeBeforeJoints) {
    Primitive p = sheet(2);
    MorphTarget shear;
    for (const glm::vec3& at : p.positions) shear.positions.emplace_back(0, at.x, 0);
    p.targets = {shear};
    makeTangents(p, plain);
    p.joint_sets = {{std::vector<glm::u16vec4>(p.positions.size(), glm::u16vec4(0)),
                     std::vector<glm::vec4>(p.positions.size(), {1, 0, 0, 0})}};
    Scene scene = morphScene(p, plain, {1});
    scene.nodes.resize(2);
    scene.nodes[0].skin = 0;
    scene.nodes[1].parent_from_node = glm::scale(glm::dmat4(1), {1, 4, 1});
    scene.skins = {{"", {1}, {glm::mat4(1)}, -1}};
    for (const glm::dvec3& t : posedOf(scene).tangents)
        EXPECT_LT(glm::length(t - glm::normalize(glm::dvec3(1, 4, 0))), 1e-7);
}

// A part that is a single point at rest has tangents once it unfolds.
TEST(MorphedTangents, OfWhatUnfoldsAreMade) {
    Primitive p = sheet(2);
    MorphTarget unfold;
    for (glm::vec3& at : p.positions) {
        unfold.positions.emplace_back(at.y, 0, -at.x);  // in the plane y = 0, u along -Z
        at = glm::vec3(0);
    }
    unfold.normals.assign(p.normals.size(), {0, 1, -0.5f});  // (0, 2, 0) at weight 2
    p.targets = {unfold};
    makeTangents(p, plain);
    for (const glm::dvec3& t : posedOf(morphScene(p, plain, {2})).tangents)
        EXPECT_LT(glm::length(t - glm::dvec3(0, 0, -1)), 1e-7);
}

// Two halves that coincide along a line at rest and then separate: no tangent is the mean of both.
TEST(MorphedTangents, WhatPartsHasTangentsOfItsOwn) {
    Primitive p = sheet(2), other = sheet(2);
    const auto count = static_cast<std::uint32_t>(p.positions.size());
    MorphTarget part;
    part.positions.assign(p.positions.size(), glm::vec3(0));
    for (std::uint32_t v = 0; v < count; ++v) {  // on the other side of x = 1, sheared
        const glm::vec3 at = other.positions[v] + glm::vec3(1, 0, 0);
        p.positions.push_back(at);
        p.normals.push_back(other.normals[v]);
        p.texcoords[0].emplace_back(at.x, 1 - at.y);
        part.positions.emplace_back(0.1f, at.x - 1, 0);
    }
    for (const std::uint32_t i : other.indices) p.indices.push_back(count + i);
    p.targets = {part};
    makeTangents(p, plain);
    const PosedVertices v = posedOf(morphScene(p, plain, {1}));
    for (std::size_t i = 0; i < p.indices.size(); ++i) {
        const bool moved = i >= other.indices.size();
        const glm::dvec3 expected = glm::normalize(glm::dvec3(1, moved ? 1 : 0, 0));
        EXPECT_LT(glm::length(v.tangents[p.indices[i]] - expected), 1e-6) << i;
    }
}

// Two triangles that share one vertex and no edge: at rest it has one tangent, in the pose one for each.
TEST(MorphedTangents, AVertexOfTwoGroupsIsSplit) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    p.normals.assign(5, {0, 0, 1});
    for (const glm::vec3& at : p.positions) p.texcoords[0].emplace_back(at.x, 1 - at.y);
    p.indices = {0, 1, 2, 0, 3, 4};
    p.targets.resize(1);
    p.targets[0].positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, -1, 0}, {0, -1, 0}};
    makeTangents(p, plain);
    EXPECT_EQ(p.positions.size(), 6u);
    const PosedVertices v = posedOf(morphScene(p, plain, {1}));
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::dvec3 expected = glm::normalize(glm::dvec3(1, i < 3 ? 0 : 1, 0));
        EXPECT_LT(glm::length(v.tangents[p.indices[i]] - expected), 1e-7) << i;
    }
}

TEST(MorphedTangents, EveryVertexHasItsGroupAndEveryCornerIsInOne) {
    Primitive p = globe();
    addTarget(p, positions, 0);
    makeTangents(p, plain);
    const TangentGroups& groups = p.tangent_groups;
    ASSERT_EQ(groups.of_vertex.size(), p.positions.size());
    ASSERT_EQ(groups.first.front(), 0u);
    ASSERT_EQ(groups.first.back(), groups.corners.size());
    std::set<std::uint32_t> seen(groups.corners.begin(), groups.corners.end());
    EXPECT_EQ(seen.size(), groups.corners.size()) << "none twice";
    // Half the triangles of the rings at the two poles have no area in any pose.
    EXPECT_EQ(groups.corners.size(), p.indices.size() - std::size_t{3} * 2 * 10);
    for (std::uint32_t g = 0; g < groups.count(); ++g)
        for (std::uint32_t i = groups.first[g]; i < groups.first[g + 1]; ++i) {
            const std::uint32_t v = p.indices[groups.corners[i]];
            EXPECT_EQ(groups.of_vertex[v], g);
            EXPECT_EQ(p.positions[v], p.positions[p.indices[groups.corners[groups.first[g]]]]);
        }
    for (const std::uint32_t v : p.indices) EXPECT_LT(groups.of_vertex[v], groups.count());
}

}  // namespace
}  // namespace diptych
