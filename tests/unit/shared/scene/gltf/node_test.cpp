// SPDX-License-Identifier: MIT
#include "shared/scene/motion/bounds.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace diptych;
using Json = nlohmann::json;

// A child before its parent in the list, TRS and matrix. Nodes outside the scene are not drawn.
TEST(GltfNode, NodesAreChainedInAnyOrder) {
    GltfFile f = GltfFile::triangle();
    const double s = std::sqrt(0.5);
    f.json["nodes"] = {
        {{"mesh", 0}, {"translation", {1, 0, 0}}},
        {{"children", {0}}, {"rotation", {0, 0, s, s}}, {"scale", {2, 2, 2}}},  // 90 degrees around +Z
        {{"mesh", 0}},
        {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}}};
    f.json["scenes"] = {{{"nodes", {3}}}};
    const Scene scene = f.load();
    ASSERT_EQ(scene.nodes.size(), 3u);
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.instances.size(), 1u);
    const glm::dvec4 origin = pose.instances[0].world_from_object * glm::dvec4(0, 0, 0, 1);
    const glm::dvec4 x = pose.instances[0].world_from_object * glm::dvec4(1, 0, 0, 1);
    const double expected[2][3] = {{10, 22, 30}, {10, 24, 30}};
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(origin[c], expected[0][c], 1e-12);
        EXPECT_NEAR(x[c], expected[1][c], 1e-12);
    }
    EXPECT_NEAR(worldBounds(scene, pose).min.x, 8, 1e-12);
}

TEST(GltfNode, DeepHierarchiesNeedNoStack) {
    GltfFile f = GltfFile::triangle();
    constexpr int depth = 20000;
    for (int i = 0; i < depth; ++i)
        f.json["nodes"][static_cast<std::size_t>(i)] = {{"children", {i + 1}}, {"translation", {1, 0, 0}}};
    f.json["nodes"][depth] = {{"mesh", 0}};
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 0).instances.at(0).world_from_object[3].x, depth);
}

TEST(GltfNode, SingularTransformsEndWell) {
    GltfFile f = GltfFile::triangle();
    f.json["nodes"][0]["scale"] = {0, 0, 0};
    const Scene scene = f.load();
    const Bounds bounds = worldBounds(scene, poseAt(scene, 0));
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(bounds.radius(), 0);
}

TEST(GltfNode, LightsOfEveryKindDirectionalFirst) {
    GltfFile f = GltfFile::triangle();
    f.json["extensionsUsed"] = f.json["extensionsRequired"] = {"KHR_lights_punctual"};
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}},
         {"range", 7},
         {"intensity", 30}},
        {{"type", "point"}, {"color", {1, 0.5, 0}}, {"name", "bulb"}},
        {{"type", "directional"}, {"intensity", 3}}};
    const auto lit = [](int light) { return Json{{"KHR_lights_punctual", {{"light", light}}}}; };
    const double s = std::sqrt(0.5);
    f.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3}}, {"scale", {2, 3, 4}}},
                       {{"extensions", lit(0)},
                        {"rotation", {-s, 0, 0, s}},
                        {"name", "lamp"}},  // -90 degrees around +X: -Z to -Y
                       {{"extensions", lit(1)}, {"translation", {1, 1, 1}}},
                       {{"extensions", lit(2)}}};
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.lights.size(), 3u);
    const Light &sun = pose.lights[0], &spot = pose.lights[1], &point = pose.lights[2];
    EXPECT_EQ(sun.kind, LightKind::directional);
    EXPECT_EQ(sun.intensity, 3);
    EXPECT_EQ(sun.direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(spot.name, "lamp");
    EXPECT_NEAR(glm::length(spot.direction - glm::dvec3(0, -1, 0)), 0, 1e-12) << "scale does not count";
    EXPECT_EQ(spot.range, 7);
    EXPECT_EQ(spot.inner_cone, 0.25f);
    EXPECT_EQ(spot.outer_cone, 0.5f);
    EXPECT_EQ(point.name, "bulb");
    EXPECT_EQ(point.position, glm::dvec3(2, 3, 4));
    EXPECT_EQ(point.color, glm::vec3(1, 0.5, 0));
    EXPECT_TRUE(std::isinf(point.range));
}

// Bit for bit at the node's origin, along its -Z, although lights in extras may have their own position.
TEST(GltfNode, LightsStandAtTheOriginOfTheirNode) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-100, 100);
    for (int i = 0; i < 1000; ++i) {
        Scene scene;
        glm::dmat4& m = scene.nodes.emplace_back().parent_from_node;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row) m[column][row] = number(random);
        scene.lights.emplace_back().node = 0;
        const Light light = poseAt(scene, 0).lights.at(0);
        const glm::dvec3 z(m[2]);
        EXPECT_EQ(light.position, glm::dvec3(m[3]));
        EXPECT_EQ(light.direction, -z / glm::length(z));
    }
}

TEST(GltfNode, Cameras) {
    GltfFile f = GltfFile::triangle();
    f.json["cameras"] = {
        {{"type", "perspective"},
         {"perspective", {{"yfov", 0.7}, {"aspectRatio", 2.5}, {"znear", 0.5}}},
         {"name", "wide"}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}}};
    f.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}},
                       {{"camera", 1}, {"name", "plan"}},
                       {{"camera", 0}, {"translation", {0, 0, 5}}}};
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.cameras.size(), 2u);
    EXPECT_EQ(pose.cameras[0].name, "wide");
    EXPECT_EQ(pose.cameras[0].world_from_camera[3].z, 5);
    EXPECT_TRUE(std::isinf(pose.cameras[0].far));
    EXPECT_EQ(pose.cameras[1].name, "plan");
    EXPECT_TRUE(pose.cameras[1].orthographic);
    EXPECT_EQ(pose.cameras[0].aspect, 2.5);
    EXPECT_EQ(pose.cameras[1].xmag, 2);
    EXPECT_EQ(pose.cameras[1].ymag, 3);
    EXPECT_EQ(pose.cameras[1].far, 9);
}

// Invalid values are repaired if the intention is clear; otherwise the camera is skipped.
TEST(GltfNode, CamerasThatCannotBeAreRepairedOrLeftOut) {
    constexpr double none = std::numeric_limits<double>::infinity();
    struct Case {
        Json camera;
        const char* note;
        bool stays;
        double far;
    };
    const auto perspective = [](double yfov, double near, double far) {
        return Json{{"type", "perspective"},
                    {"perspective", {{"yfov", yfov}, {"znear", near}, {"zfar", far}}}};
    };
    const auto orthographic = [](double xmag, double ymag, double near, double far) {
        return Json{{"type", "orthographic"},
                    {"orthographic", {{"xmag", xmag}, {"ymag", ymag}, {"znear", near}, {"zfar", far}}}};
    };
    const Case cases[] = {
        {perspective(4, 1, 9), "camera 0: yfov 4 is not between 0 and pi: left out", false, 0},
        {perspective(1, 0, 9), "camera 0: znear 0 is not above 0: left out", false, 0},
        {perspective(1, -2, 9), "camera 0: znear -2 is not above 0: left out", false, 0},
        {perspective(1, 2, 2), "camera 0: zfar 2 is not beyond znear 2: no far plane is used", true, none},
        {perspective(1, 2, -1), "camera 0: zfar -1 is not beyond znear 2: no far plane is used", true, none},
        {perspective(1, 2, 0), "camera 0: zfar 0: ignored", true, none},
        {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"aspectRatio", -2}, {"znear", 1}}}},
         "camera 0: aspectRatio -2: ignored",
         true,
         none},
        {orthographic(1, 0, 0, 9), "camera 0: ymag is 0: left out", false, 0},
        {orthographic(1, 1, -1, 9), "camera 0: znear -1 is negative: left out", false, 0},
        {orthographic(1, 1, 9, 9), "camera 0: zfar 9 is not beyond znear 9: left out", false, 0},
        {orthographic(1, -3, 0, 9), "camera 0: ymag -3: 3 is used", true, 9},
        {orthographic(-2, 3, 0, 9), "camera 0: xmag -2: 2 is used", true, 9},
        {{{"type", "orthographic"}}, "camera 0: is orthographic but has no orthographic: left out", false, 0},
    };
    for (const Case& c : cases) {
        GltfFile f = GltfFile::triangle();
        f.json["cameras"] = Json::array({c.camera});
        f.json["nodes"][0]["camera"] = 0;
        const Scene scene = f.load();
        EXPECT_EQ(scene.cameras.size(), c.stays ? 1u : 0u) << c.note;
        EXPECT_EQ(std::ranges::count(scene.notes, c.note), 1) << c.note;
        EXPECT_EQ(scene.notes.size(), 1u) << c.note;
        if (!c.stays) continue;
        EXPECT_EQ(scene.cameras.at(0).far, c.far) << c.note;
        EXPECT_EQ(scene.cameras[0].ymag, scene.cameras[0].orthographic ? 3 : 1);
        EXPECT_GE(scene.cameras[0].aspect, 0);
    }
}

TEST(GltfNode, LightsThatCannotBeAreRepaired) {
    struct Case {
        Json change;
        const char* note;
        float (*value)(const Light&);
        float expected;
    };
    const auto cone = [](double inner, double outer) {
        return Json{{"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}};
    };
    const auto range = [](const Light& l) { return l.range; };
    const auto inner = [](const Light& l) { return l.inner_cone; };
    const auto outer = [](const Light& l) { return l.outer_cone; };
    const float right = static_cast<float>(std::acos(0.0)), none = std::numeric_limits<float>::infinity();
    const Case cases[] = {
        {{{"color", {1, -0.5, 0}}},
         "light 0: color -0.5: 0 is used",
         [](const Light& l) { return l.color.g; },
         0},
        {{{"intensity", -3}},
         "light 0: intensity -3: 0 is used",
         [](const Light& l) { return l.intensity; },
         0},
        {{{"range", 0}}, "light 0: range 0: ignored", range, none},
        {{{"range", -2}}, "light 0: range -2: ignored", range, none},
        {cone(0.5, 0.25), "light 0: innerConeAngle 0.5: 0.25 is used", inner, 0.25f},
        {cone(-1, 0.25), "light 0: innerConeAngle -1: 0 is used", inner, 0},
        {cone(0.25, 3), "light 0: outerConeAngle 3: 1.5708 is used", outer, right},
    };
    for (const Case& c : cases) {
        GltfFile f = GltfFile::triangle();
        Json light = {{"type", "spot"}, {"spot", Json::object()}};
        light.update(c.change);
        f.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
        const Json lit = {{"KHR_lights_punctual", {{"light", 0}}}};
        f.json["nodes"][0] = {{"mesh", 0}, {"children", {1}}, {"extensions", lit}};
        f.json["nodes"][1] = {{"extensions", lit}};  // the same light again, but only one note
        const Scene scene = f.load();
        EXPECT_EQ(scene.notes, std::vector<std::string>{c.note});
        EXPECT_EQ(c.value(scene.lights.at(1)), c.expected) << c.note;
    }
}

TEST(GltfNode, TransformsThatCannotBeAreNoted) {
    GltfFile f = GltfFile::triangle();
    f.json["nodes"][0] = {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}, {"translation", {1, 2, 3}}};
    Scene scene = f.load();
    EXPECT_EQ(scene.notes, std::vector<std::string>{"node 0: rotation 0 0 0 0: no rotation is used"});
    EXPECT_EQ(scene.nodes[0].parent_from_node, glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1));
    f.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1};
    scene = f.load();
    EXPECT_EQ(scene.notes,
              std::vector<std::string>{
                  "node 0: has a matrix and translation, rotation or scale: the matrix is used"});
    EXPECT_EQ(scene.nodes[0].parent_from_node, glm::dmat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 7, 8, 9, 1));
}

// Products of float32 matrices may end in 0 0 0 0.99999994, and a spot light without a penumbra has two
// equal angles. Both are accepted.
TEST(GltfNode, RoundedMatricesAndHardSpotsAreRight) {
    GltfFile f = GltfFile::triangle();
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}};
    f.json["nodes"][0]["matrix"] = {1, 0, 0, 1e-17, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 0.99999994};
    f.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const Scene scene = f.load();
    EXPECT_EQ(scene.nodes[0].parent_from_node[3], glm::dvec4(2, 3, 4, 1));
    EXPECT_EQ(scene.nodes[0].parent_from_node[0], glm::dvec4(1, 0, 0, 0));
    EXPECT_EQ(scene.lights.at(0).inner_cone, scene.lights.at(0).outer_cone);
    f.json["nodes"][0]["matrix"][15] = 0.99;
    EXPECT_NE(f.error().find("node 0: the last row of its matrix is not 0 0 0 1"), std::string::npos);
}
