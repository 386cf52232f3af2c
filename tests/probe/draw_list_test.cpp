// SPDX-License-Identifier: MIT
// Instances that a view renders, their order and their transforms.
#include "shared/draw/draw_list.h"

#include "shared/contract/features.h"
#include "shared/vulkan/device/device.h"
#include "shared/vulkan/device/resources.h"
#include "tests/probe/probe.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace diptych {
namespace {

// Square of 1 m with a corner at the origin, in the plane z = 0, facing +Z. Primitive 0 has the opaque
// material 0, primitive 1 the masked material 1.
Scene squares() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].alpha_mode = AlphaMode::mask;
    const Primitive p = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Primitive masked = p;
    masked.material = 1;
    scene.meshes = {{"square", {p, masked}}};
    return scene;
}

glm::dmat4 placed(const glm::dvec3& at, const glm::dvec3& scale = glm::dvec3(1)) {
    return glm::scale(glm::translate(glm::dmat4(1), at), scale);
}

// From (5, 6, 7) along -Z, 90 degrees high and wide, from 1 m to 100 m.
View viewAlongZ(bool orthographic = false) {
    View view;
    view.camera.world_from_camera[3] = {5, 6, 7, 1};
    view.camera.yfov = glm::radians(90.0);
    view.camera.orthographic = orthographic;
    view.camera.ymag = 10;
    view.camera.near = 1;
    view.camera.far = 100;
    view.width = view.height = 64;
    return view;
}
const glm::dvec3 eye(5, 6, 7);
glm::dmat4 at(double depth) {
    return placed(eye + glm::dvec3(0, 0, -depth));
}

DrawList listOf(const Scene& scene, const Pose& pose, const View& view) {
    Uploader uploader(probeDevice());
    const Geometry geometry(probeDevice(), uploader, scene);
    const Materials materials(probeDevice(), uploader, scene);
    uploader.flush();
    return makeDrawList(pose, geometry, materials, view);
}

// Draw list of instances with these transforms, of the opaque square or of the given primitives.
DrawList listOf(const std::vector<glm::dmat4>& transforms, const View& view,
                const std::vector<int>& primitives = {}) {
    Pose pose;
    for (std::size_t i = 0; i < transforms.size(); ++i)
        pose.instances.push_back({0, primitives.empty() ? 0 : primitives[i], 0, 0, transforms[i]});
    return listOf(squares(), pose, view);
}

// Squares of 1 cm at a depth of 10 m, each a millimetre inside or outside an edge of the image; and the
// same at the near and far planes.
TEST(DrawList, WhatLiesWhollyBeyondAPlaneOfTheViewIsLeftOut) {
    constexpr double size = 0.01, hair = 0.001;
    for (const bool orthographic : {false, true}) {
        std::vector<glm::dmat4> within, beyond;
        const auto square = [&](const glm::dvec3& at) { return placed(eye + at, glm::dvec3(size)); };
        for (const double off : {-size - hair, hair}) {
            auto& list = off < 0 ? within : beyond;
            list.push_back(square({10 + off, 0, -10}));
            list.push_back(square({0, 10 + off, -10}));
            list.push_back(square({-10 - size - off, 0, -10}));
            list.push_back(square({0, -10 - size - off, -10}));
            list.push_back(square({0, 0, off < 0 ? -1.1 : -0.9}));
            list.push_back(square({0, 0, off < 0 ? -95 : -110}));
        }
        beyond.push_back(square({0, 0, 10}));
        const DrawList in = listOf(within, viewAlongZ(orthographic)),
                       out = listOf(beyond, viewAlongZ(orthographic));
        EXPECT_EQ(in.items.size(), within.size()) << orthographic;
        EXPECT_EQ(in.culled, 0u);
        EXPECT_EQ(out.items.size(), 0u) << orthographic;
        EXPECT_EQ(out.culled, beyond.size());
    }
}

TEST(DrawList, WhatCrossesAPlaneIsDrawn) {
    const DrawList list =
        listOf({placed(eye + glm::dvec3(9.5, 0, -10)), placed(eye + glm::dvec3(0, -10.5, -10)),
                placed(eye + glm::dvec3(-500, -500, -10), glm::dvec3(1000)),
                placed(eye + glm::dvec3(-0.5, -0.5, -5), glm::dvec3(1, 1, 1))},
               viewAlongZ());
    EXPECT_EQ(list.items.size(), 4u);
    EXPECT_EQ(list.draws.size(), 4u);
}

TEST(DrawList, OpaqueDrawsComeFirstAndBothFromNearToFar) {
    const DrawList list = listOf({at(40), at(2), at(3), at(90), at(20)}, viewAlongZ(), {0, 1, 0, 1, 0});
    std::vector<std::uint32_t> order;
    for (const DrawItem& item : list.items) order.push_back(item.instance);
    for (std::uint32_t i = 0; i < list.items.size(); ++i)
        EXPECT_EQ(list.items[i].draw, i) << "numbered in this order";
    EXPECT_EQ(order, (std::vector<std::uint32_t>{2, 4, 0, 1, 3}));
    EXPECT_FALSE(list.items[2].masked);
    EXPECT_TRUE(list.items[3].masked);
    EXPECT_EQ(list.items[3].range.material, 1u);
}

// They write depth. Equal ones stay in scene order.
TEST(DrawList, TransmissiveDrawsGoFromNearToFar) {
    Scene scene = squares();
    scene.materials[0].transmission = 1;
    Pose pose;
    for (const double depth : {40, 2, 90, 2, 20}) pose.instances.push_back({.world_from_object = at(depth)});
    const DrawList list = listOf(scene, pose, viewAlongZ());
    std::vector<std::uint32_t> order;
    for (const DrawItem& item : list.transmissive()) order.push_back(item.instance);
    EXPECT_EQ(order, (std::vector<std::uint32_t>{1, 3, 4, 0, 2}));
}

// The node's scale is the thickness's, of morphed meshes too; a skin places its vertices in the world.
TEST(DrawList, AThicknessHasTheScaleOfItsNode) {
    Scene scene = squares();
    scene.materials[0].transmission = 1;
    const glm::dmat4 world = placed({5, 6, -3}, {2, -4, 1});
    Pose pose;
    pose.boxes.push_back({.origin = {5, 6, -3}, .min = glm::dvec3(-1), .max = glm::dvec3(1)});
    for (const bool posed : {false, true})
        pose.instances.push_back(
            {.world_from_object = world, .weights = posed ? 0 : -1, .box = posed ? 0 : -1});
    pose.instances.push_back({.world_from_object = world, .skin = 0, .box = 0});
    const DrawList list = listOf(scene, pose, viewAlongZ());
    ASSERT_EQ(list.transmissive().size(), 3u);
    for (const DrawItem& item : list.transmissive())
        EXPECT_NEAR(item.scale, item.instance == 2 ? 1 : 2, 1e-6) << item.instance;
}

// Positions are relative to the camera. Normals are perpendicular to the scaled surface, on its front side
// even if a transform mirrors.
TEST(DrawList, TransformsAreThoseOfPositionsAndNormals) {
    const glm::dmat4 plain = placed({5, 6, -3}),
                     flat = glm::rotate(placed({5, 6, -3}), 0.5, glm::dvec3(1, 0, 0)) *
                            glm::scale(glm::dmat4(1), glm::dvec3(2, 1, 0.25)),
                     mirrored = plain * glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)),
                     turned = plain * glm::scale(glm::dmat4(1), glm::dvec3(-1, -1, 1));
    const View view = viewAlongZ();
    for (const glm::dmat4& world : {plain, flat, mirrored, turned}) {
        const DrawList list = listOf({world}, view);
        ASSERT_EQ(list.draws.size(), 1u);
        const gpu::Draw& draw = list.draws[0];
        const bool mirrors = glm::determinant(glm::dmat3(world)) < 0;
        EXPECT_EQ(draw.handedness, mirrors ? -1 : 1);
        EXPECT_EQ(list.items[0].mirrored, mirrors);
        for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0.5, 0.25)}) {
            const glm::dvec3 expected = glm::dvec3(world * glm::dvec4(p, 1)) - eye;
            const glm::vec3 relative = draw.world_from_object * glm::vec4(p, 1);
            EXPECT_LT(glm::distance(glm::dvec3(relative), expected), 1e-5);
            const glm::dvec4 clip = view.clipFromWorld() * glm::dvec4(expected, 1);
            EXPECT_LT(glm::distance(glm::dvec4(draw.clip_from_object * glm::vec4(p, 1)), clip), 1e-4);
        }
        // Perpendicular to both edges of a surface, towards its front.
        const glm::dvec3 x = glm::dmat3(world) * glm::dvec3(1, 0.5, 0.25),
                         y = glm::dmat3(world) * glm::dvec3(0, 1, 1),
                         normal(draw.normal_from_object *
                                glm::vec3(glm::cross(glm::dvec3(1, 0.5, 0.25), glm::dvec3(0, 1, 1))));
        const glm::dvec3 expected = glm::normalize(glm::cross(x, y)) * (mirrors ? -1.0 : 1.0);
        EXPECT_LT(glm::distance(glm::normalize(normal), expected), 1e-5);
    }
}

// Blended squares of material 1 at these heights above the plane z = 0, in that order. Primitive 0 is
// opaque, primitive 1 has all heights, primitive 2 only the last.
struct BlendedSquares {
    Scene scene = squares();
    Uploader uploader{probeDevice()};
    std::unique_ptr<Geometry> geometry;
    std::unique_ptr<Materials> materials;

    explicit BlendedSquares(const std::vector<float>& heights) {
        scene.materials[1].alpha_mode = AlphaMode::blend;
        std::vector<Primitive>& primitives = scene.meshes[0].primitives;
        Primitive several = primitives[1];
        primitives[1] = {};
        primitives[1].material = 1;
        for (const float height : heights) {
            Primitive& all = primitives[1];
            for (std::size_t i = 0; i < 6; ++i)
                all.indices.push_back(several.indices[i] + static_cast<std::uint32_t>(all.positions.size()));
            for (glm::vec3& p : several.positions) p.z = height;
            all.positions.insert(all.positions.end(), several.positions.begin(), several.positions.end());
        }
        primitives[1].normals.assign(primitives[1].positions.size(), {0, 0, 1});
        primitives[1].tangents.assign(primitives[1].positions.size(), {1, 0, 0, 1});
        primitives.push_back(several);
        geometry = std::make_unique<Geometry>(probeDevice(), uploader, scene);
        materials = std::make_unique<Materials>(probeDevice(), uploader, scene);
        uploader.flush();
    }
    DrawList listOf(const std::vector<std::pair<int, glm::dmat4>>& instances, const View& view,
                    Transparency transparency = Transparency::triangles) const {
        Pose pose;
        for (const auto& [primitive, transform] : instances)
            pose.instances.push_back({0, primitive, 0, 0, transform});
        return makeDrawList(pose, *geometry, *materials, view, transparency);
    }
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> runsOf(const DrawList& list) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
    for (const SortedRange& run : list.sorted_runs) runs.emplace_back(run.item, run.run.count);
    return runs;
}

// Interleaved squares, at 10, 12 and 14 m and at 11, 13 and 15 m. Both triangles of a square have the same
// depth.
TEST(DrawList, TrianglesOfAllBlendedDrawsAreSortedTogether) {
    const BlendedSquares squares({0, -4, -2});
    const DrawList list = squares.listOf({{0, at(3)}, {1, at(10)}, {0, at(30)}, {1, at(11)}}, viewAlongZ());
    ASSERT_EQ(list.solids().size(), 2u);
    ASSERT_EQ(list.blended().size(), 2u) << "one item a draw, whatever the number of its runs";
    EXPECT_EQ(runsOf(list), (std::vector<std::pair<std::uint32_t, std::uint32_t>>{
                                {1, 6}, {0, 6}, {1, 6}, {0, 6}, {1, 6}, {0, 6}}));
    EXPECT_EQ(list.sorted_indices,
              (std::vector<std::uint32_t>{4, 5, 6,  4, 6,  7,  4, 5, 6, 4, 6, 7, 8, 9, 10, 8, 10, 11,
                                          8, 9, 10, 8, 10, 11, 0, 1, 2, 0, 2, 3, 0, 1, 2,  0, 2,  3}));
    for (std::size_t i = 0; i < list.sorted_runs.size(); ++i) EXPECT_EQ(list.sorted_runs[i].run.first, 6 * i);
}

TEST(DrawList, TrianglesThatFollowOneAnotherAreOneRunAndEqualOnesAreAsInTheScene) {
    const BlendedSquares squares({0, -4, -2});
    EXPECT_EQ(runsOf(squares.listOf({{1, at(10)}, {1, at(20)}}, viewAlongZ())),
              (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{1, 18}, {0, 18}}));
    // Primitive 2 coincides with the last square of primitive 1.
    EXPECT_EQ(runsOf(squares.listOf({{2, at(10)}, {1, at(10)}}, viewAlongZ())),
              (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{1, 6}, {0, 6}, {1, 12}}));
    EXPECT_EQ(runsOf(squares.listOf({{1, at(10)}, {2, at(10)}}, viewAlongZ())),
              (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 12}, {1, 6}, {0, 6}}));
}

TEST(DrawList, NothingIsSortedOfWhatIsCulledOpaqueOrDrawnInAnotherOrder) {
    const BlendedSquares squares({0, -4, -2});
    const DrawList behind = squares.listOf({{1, at(-10)}, {0, at(10)}, {2, at(10)}}, viewAlongZ());
    EXPECT_EQ(behind.culled, 1u);
    EXPECT_EQ(behind.sorted_indices.size(), 6u);
    for (const Transparency other : {Transparency::sorted, Transparency::unsorted}) {
        const DrawList list = squares.listOf({{1, at(10)}, {2, at(10)}}, viewAlongZ(), other);
        EXPECT_EQ(list.blended().size(), 2u);
        EXPECT_TRUE(list.sorted_runs.empty() && list.sorted_indices.empty());
    }
    EXPECT_EQ(squares.geometry->hostBytes(), 16 * sizeof(glm::vec3) + 24 * sizeof(std::uint32_t));
    EXPECT_TRUE(squares.geometry->triangles(squares.geometry->range(0, 0)).indices.empty());
    const Scene opaque = diptych::squares();
    Uploader uploader(probeDevice());
    EXPECT_EQ(Geometry(probeDevice(), uploader, opaque).hostBytes(), 0u);
}

// Depths of centroids, from the scene's positions, for any rotation of instance and view.
TEST(DrawList, TrianglesNeverComeNearerBeforeFarther) {
    const BlendedSquares squares({0, 3, -4, 1, -2, 2});
    std::mt19937 random(5);
    const auto number = [&] { return std::uniform_real_distribution(-1.0, 1.0)(random); };
    View view = viewAlongZ();
    view.camera.world_from_camera =
        glm::rotate(glm::translate(glm::dmat4(1), eye), 0.7, glm::normalize(glm::dvec3(1, 2, -1)));
    std::vector<std::pair<int, glm::dmat4>> instances;
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 centre = view.eye() - view.backward() * (30 + 10 * number()) +
                                  5.0 * glm::dvec3(number(), number(), number());
        instances.emplace_back(1 + i % 2, glm::scale(glm::rotate(glm::translate(glm::dmat4(1), centre),
                                                                 3 * number(), glm::dvec3(0.6, 0, 0.8)),
                                                     glm::dvec3(1, -2, 0.5)));
    }
    const DrawList list = squares.listOf(instances, view);
    ASSERT_EQ(list.sorted_indices.size(), 10u * 6 * 7);
    double last = 1e9;
    for (const SortedRange& run : list.sorted_runs) {
        const auto& [primitive, transform] = instances[list.blended()[run.item].instance];
        const Primitive& p = squares.scene.meshes[0].primitives[static_cast<std::size_t>(primitive)];
        for (std::uint32_t i = run.run.first; i < run.run.first + run.run.count; i += 3) {
            double depth = 0;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const glm::dvec4 position(glm::dvec3(p.positions[list.sorted_indices[i + c]]), 1);
                depth -= glm::dot(view.backward(), glm::dvec3(transform * position) - view.eye()) / 3;
            }
            EXPECT_LE(depth, last + 1e-12);
            last = depth;
        }
    }
}

}  // namespace
}  // namespace diptych
