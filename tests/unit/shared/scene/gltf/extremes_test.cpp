// SPDX-License-Identifier: MIT
// Broken, huge, tiny, distant or overlapping geometry: loading gives a scene of the valid parts, a note,
// or a one-line error.
#include "shared/scene/model/tangents.h"
#include "shared/scene/motion/bounds.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// A strip of four triangles over six vertices, as a list.
GltfFile strip(std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["POSITION"] = f.accessor(positions, FLOAT, "VEC3", 3);
    f.primitive()["indices"] =
        f.accessor<std::uint16_t>({0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}, USHORT, "SCALAR", 1);
    return f;
}

std::vector<float> flatNormals(std::size_t vertices) {
    std::vector<float> normals;
    for (std::size_t v = 0; v < vertices; ++v) normals.insert(normals.end(), {0, 0, 1});
    return normals;
}

}  // namespace

// Vertex 5 is a corner of one triangle, vertex 4 of two.
TEST(GltfExtremes, TrianglesAtBrokenVerticesAreLeftOutWithACount) {
    for (const float broken : {NAN, INFINITY, 2e18f, -2e18f}) {
        GltfFile f = strip({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, broken, 0});
        const Scene scene = f.load();
        const Primitive& p = f.only(scene);
        EXPECT_EQ(p.indices.size(), 9u) << broken;
        for (const glm::vec3& v : p.positions) EXPECT_LE(glm::length(v), 3) << "its vertex is gone as well";
        EXPECT_EQ(worldBounds(scene, poseAt(scene, 0)).max, glm::dvec3(1, 2, 0));
    }
    GltfFile f = strip({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, NAN, 0, 0, 2, 0, 1, 2, 0});
    Scene scene = f.load();
    EXPECT_EQ(f.only(scene).indices.size(), 3u);
    f = strip(std::vector<float>(18, NAN));
    try {
        f.load();
        FAIL() << "nothing is left of it";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("mesh 0, primitive 0: every triangle has a vertex that is not"),
                  std::string::npos)
            << e.what();
    }
}

TEST(GltfExtremes, AttributesThatAreNotFiniteAreRepaired) {
    GltfFile f = GltfFile::triangle();
    Json& attributes = f.primitive()["attributes"];
    attributes["NORMAL"] = f.accessor<float>({0, NAN, 0, 0, 0, 2, INFINITY, 0, 0}, FLOAT, "VEC3", 3);
    attributes["TANGENT"] = f.accessor<float>({1, 0, 0, -1, NAN, 0, 0, 1, 0, 0, 0, 1}, FLOAT, "VEC4", 4);
    attributes["TEXCOORD_0"] = f.accessor<float>({0.5f, 0.5f, NAN, 0, 0, INFINITY}, FLOAT, "VEC2", 2);
    attributes["COLOR_0"] = f.accessor<float>({NAN, 0, 0, 0.5f, 2, -1, INFINITY, 0, 0}, FLOAT, "VEC3", 3);
    const Scene scene = f.load();
    const Primitive& p = f.only(scene);
    EXPECT_EQ(p.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_EQ(p.tangents[0], glm::vec4(1, 0, 0, -1));
    EXPECT_NEAR(glm::dot(glm::vec3(p.tangents[1]), p.normals[1]), 0, 1e-6f);
    EXPECT_NEAR(glm::length(glm::vec3(p.tangents[1])), 1, 1e-6f);
    EXPECT_EQ(p.texcoords[0], (std::vector<glm::vec2>{{0.5f, 0.5f}, {0, 0}, {0, 0}}));
    EXPECT_EQ(p.colors, (std::vector<glm::vec4>{{1, 1, 1, 1}, {0.5f, 1, 0, 1}, {1, 1, 1, 1}}));
}

// Finite values beyond maxCoordinate are not reported as infinite.
TEST(GltfExtremes, AttributesBeyondWhatIsDrawnAreNamedSo) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["TEXCOORD_0"] =
        f.accessor<float>({1e19f, 0.5f, NAN, 0, 0.25f, -2e18f}, FLOAT, "VEC2", 2);
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).texcoords[0], (std::vector<glm::vec2>(3, {0, 0})));
    EXPECT_TRUE(mentions(scene.notes, "TEXCOORD_0: 1 is not finite: 0, 0"));
    EXPECT_TRUE(mentions(scene.notes, "TEXCOORD_0: 2 are beyond 1e+18: 0, 0"));
}

// Vertices that no triangle uses have no effect, even if they are not finite.
TEST(GltfExtremes, UntouchedVerticesAreNotKept) {
    GltfFile f = strip({0, 0, 0, 1, 0, 0, 0, 1, 0, NAN, 1, 0, 0, 2, 0, 9, 9, 9});
    f.primitive()["attributes"]["NORMAL"] = f.accessor(flatNormals(6), FLOAT, "VEC3", 3);
    f.primitive()["indices"] = f.accessor<std::uint16_t>({1, 4, 0}, USHORT, "SCALAR", 1);
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}));
    EXPECT_EQ(f.only(scene).indices, (std::vector<std::uint32_t>{1, 2, 0}));
    EXPECT_TRUE(scene.notes.empty());
}

// A few indices into a large accessor are read one by one, also for sparse elements.
TEST(GltfExtremes, AFewVerticesOfManyAreFound) {
    GltfFile f = GltfFile::triangle();
    std::vector<float> positions(3 * 1000);
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i / 3 * (1 + i % 3));
    const int many = f.accessor(positions, FLOAT, "VEC3", 3);
    const int where = f.accessor<std::uint16_t>({7, 500, 999}, USHORT, "SCALAR", 1);
    const int what = f.accessor<float>({7, 8, 9, 4, 5, 6, 1, 2, 3}, FLOAT, "VEC3", 3);
    f.json["accessors"][static_cast<std::size_t>(many)]["sparse"] = {
        {"count", 3},
        {"indices", {{"bufferView", where}, {"componentType", USHORT}}},
        {"values", {{"bufferView", what}}}};
    f.primitive()["attributes"]["POSITION"] = many;
    f.primitive()["attributes"]["NORMAL"] = f.accessor(flatNormals(1000), FLOAT, "VEC3", 3);
    f.primitive()["indices"] = f.accessor<std::uint32_t>({999, 20, 7, 20, 999, 7}, UINT, "SCALAR", 1);
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{7, 8, 9}, {20, 40, 60}, {1, 2, 3}}));
    EXPECT_EQ(f.only(scene).indices, (std::vector<std::uint32_t>{2, 1, 0, 1, 2, 0}));
}

// A file of a few kilobytes that would decode to gigabytes.
TEST(GltfExtremes, WhatDecodesToTooMuchIsRefusedBeforehand) {
    GltfFile f = GltfFile::triangle();
    f.json["accessors"].push_back({{"componentType", FLOAT}, {"count", 3000000}, {"type", "VEC3"}});
    f.primitive()["attributes"]["POSITION"] = f.json["accessors"].size() - 1;
    const Json one = f.primitive();
    for (int i = 0; i < 1000; ++i) f.json["meshes"][0]["primitives"].push_back(one);
    const std::string error = f.error();
    EXPECT_NE(error.find("primitive 1: "), error.npos) << error;
    EXPECT_NE(error.find("bytes of geometry so far from 36 bytes of buffers; the limit is 268436608"),
              error.npos)
        << error;

    // A thousand primitives that each use one triangle of the same accessor need little memory.
    const int indices = f.accessor<std::uint32_t>({0, 2999999, 7}, UINT, "SCALAR", 1);
    for (Json& primitive : f.json["meshes"][0]["primitives"]) primitive["indices"] = indices;
    const Scene scene = f.load();
    EXPECT_EQ(scene.meshes[0].primitives.size(), 1001u);
    EXPECT_EQ(scene.meshes[0].primitives[1000].positions.size(), 3u);
}

TEST(GltfExtremes, MeshesThatNothingDrawsAreNotRead) {
    GltfFile f = GltfFile::triangle();
    f.json["meshes"].push_back(f.json["meshes"][0]);
    // An accessor of floats, which is refused as indices once the mesh is used.
    f.json["meshes"][1]["primitives"][0]["indices"] = 0;
    const Scene scene = f.load();
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_TRUE(scene.meshes[1].primitives.empty());
    f.json["nodes"][0]["mesh"] = 1;
    EXPECT_NE(f.error().find("mesh 1, primitive 0: indices: accessor 0 is not SCALAR"), std::string::npos);
}

TEST(GltfExtremes, ScalesAndPlacesOfEverySize) {
    for (const double scale : {1e-30, 1e-3, 1e4, 1e15}) {
        GltfFile f = GltfFile::triangle();
        f.json["nodes"][0]["scale"] = {scale, scale, scale};
        f.json["nodes"][0]["translation"] = {3e6, -3e6, 0};
        const Scene scene = f.load();
        const Pose pose = poseAt(scene, 0);
        ASSERT_EQ(pose.instances.size(), 1u) << scale;
        EXPECT_EQ(worldBounds(scene, pose).max.x, 3e6 + scale) << "in double, whatever float32 holds";
        EXPECT_TRUE(scene.notes.empty());
    }
}

TEST(GltfExtremes, WhatLiesBeyondFloatIsLeftOutWithACount) {
    GltfFile f = GltfFile::triangle();
    f.json["extensionsUsed"] = {"KHR_lights_punctual"};
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    f.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    const Json lit = {{"KHR_lights_punctual", {{"light", 0}}}};
    // Two nested scales of 1e30 exceed float32: the child's mesh, light and camera are skipped.
    f.json["nodes"] = {{{"mesh", 0}},
                       {{"scale", {1e30, 1e30, 1e30}}, {"children", {2}}},
                       {{"scale", {1e30, 1e30, 1e30}}, {"children", {3}}},
                       {{"mesh", 0}, {"camera", 0}, {"extensions", lit}},
                       {{"mesh", 0}, {"translation", {2e18, 0, 0}}}};
    f.json["scenes"][0]["nodes"] = {0, 1, 4};
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.instances.size(), 1u);
    EXPECT_EQ(pose.instances[0].node, 0);
    EXPECT_TRUE(pose.lights.empty());
    EXPECT_TRUE(pose.cameras.empty());
    EXPECT_TRUE(mentions(scene.notes, "2 drawn nodes are not finite or beyond 1e+18 m: left out"));
    EXPECT_TRUE(mentions(scene.notes, "1 light is not finite"));
    EXPECT_TRUE(mentions(scene.notes, "1 camera is not finite"));
}

// The node is close enough, but its scaled vertices are not: 1e10 becomes 1e19 m.
TEST(GltfExtremes, TheMeshCountsNotOnlyItsNode) {
    GltfFile f = strip({0, 0, 0, 1e10f, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0});
    f.json["nodes"][0]["scale"] = {1e9, 1, 1};
    EXPECT_NE(f.error().find("nothing is left to draw: 1 drawn node is not finite or beyond 1e+18 m"),
              std::string::npos);
    f.json["nodes"].push_back({{"mesh", 0}});
    f.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 0).instances.size(), 1u);
    EXPECT_TRUE(mentions(scene.notes, "1 drawn node is not finite or beyond"));
}

// A pose at another time may also exceed float32.
TEST(GltfExtremes, PosesHoldWhatHasAPlace) {
    GltfFile f = GltfFile::triangle();
    Scene scene = f.load();
    scene.nodes[0].parent_from_node[3].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(poseAt(scene, 0).instances.empty());
    scene.nodes[0].parent_from_node[3].x = 1e19;
    EXPECT_TRUE(poseAt(scene, 0).instances.empty());
    scene.nodes[0].parent_from_node[3].x = 1e17;
    EXPECT_EQ(poseAt(scene, 0).instances.size(), 1u);
}

TEST(GltfExtremes, OneVertexAndNoMesh) {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["POSITION"] = f.accessor<float>({1, 2, 3}, FLOAT, "VEC3", 3);
    f.primitive()["attributes"]["TEXCOORD_0"] = f.accessor<float>({0, 0}, FLOAT, "VEC2", 2);
    EXPECT_TRUE(poseAt(f.load(), 0).instances.empty());
    f.primitive()["indices"] = f.accessor<std::uint8_t>({0, 0, 0}, UBYTE, "SCALAR", 1);
    const Scene dot = f.load();
    EXPECT_EQ(worldBounds(dot, poseAt(dot, 0)).min, glm::dvec3(1, 2, 3));
    EXPECT_EQ(worldBounds(dot, poseAt(dot, 0)).radius(), 0);
    f.json.erase("meshes");
    f.json["nodes"] = Json::array({Json::object()});
    EXPECT_TRUE(poseAt(f.load(), 0).instances.empty());
    f.json.erase("nodes");
    f.json.erase("scenes");
    f.json.erase("scene");
    EXPECT_TRUE(f.load().nodes.empty());
}

// More than 16 bits count.
TEST(GltfExtremes, SeventyThousandNodesAreDrawn) {
    GltfFile f = GltfFile::triangle();
    constexpr int count = 70000;
    const Json node = f.json["nodes"][0];
    Json roots = Json::array({0});
    for (int i = 1; i < count; ++i) {
        f.json["nodes"].push_back(node);
        roots.push_back(i);
    }
    f.json["nodes"].back()["translation"] = {count, 0, 0};
    f.json["scenes"][0]["nodes"] = roots;
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    EXPECT_EQ(pose.instances.size(), 70000u);
    EXPECT_EQ(worldBounds(scene, pose).max.x, count + 1);
}

// ---- linear time -------------------------------------------------------------------------------------

// 100 000 separate triangles meet in one vertex, each with another tangent there. Comparing all pairs
// would take minutes, beyond the test's time limit.
TEST(GltfExtremes, ManyTangentsAtOneVertexTakeLinearTime) {
    constexpr std::uint32_t count = 100000;
    Primitive p;
    p.positions = {{0, 0, 0}};
    p.texcoords[0] = {{0, 0}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const double a = 6.283185307179586 * i / count, b = a + 1e-6;
        for (const double angle : {a, b}) {
            p.positions.push_back({std::cos(angle), std::sin(angle), 0});
            // Separate UV coordinates, u along the spoke, so that the tangent rotates with it.
            p.texcoords[0].push_back(angle == a ? glm::vec2(1, 0) : glm::vec2(1, -1));
        }
        p.indices.insert(p.indices.end(), {0, 2 * i + 1, 2 * i + 2});
    }
    p.normals.assign(p.positions.size(), {0, 0, 1});
    makeTangents(p, {.texcoord = 0});
    ASSERT_EQ(p.tangents.size(), p.positions.size());
    EXPECT_GT(p.positions.size(), 2 * count + count / 2) << "or the tangents were not many";
    for (const std::uint32_t i : {0u, 50000u, 99999u})
        EXPECT_EQ(p.positions[p.indices[3 * i]], glm::vec3(0)) << "a copy stays where its vertex is";
}
