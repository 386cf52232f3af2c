// SPDX-License-Identifier: MIT
// EXT_mesh_gpu_instancing.
#include "shared/scene/motion/bounds.h"
#include "shared/scene/requirements.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace diptych {
namespace {

using Json = nlohmann::json;

// The triangle, drawn by node 0 as often as `attributes` say.
struct InstancedFile : GltfFile {
    InstancedFile() : GltfFile(triangle()) { json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"}; }
    Json& attributes() { return json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]; }
    void translations(const std::vector<float>& values) {
        attributes()["TRANSLATION"] = accessor(values, FLOAT, "VEC3", 3);
    }
};

TEST(GltfInstancing, TranslationRotationAndScaleOfEach) {
    InstancedFile f;
    f.json["nodes"][0]["translation"] = {0, 10, 0};
    f.translations({1, 0, 0, 0, 2, 0});
    // No rotation, and 90 degrees around +Z.
    f.attributes()["ROTATION"] =
        f.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170}, SHORT, "VEC4", 4, true);
    f.attributes()["SCALE"] = f.accessor<float>({1, 1, 1, 3, 1, 1}, FLOAT, "VEC3", 3);
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.instances.size(), 2u) << "and none at the node itself";
    EXPECT_EQ(pose.instances[0].copy, 0);
    EXPECT_EQ(pose.instances[1].copy, 1);
    EXPECT_EQ(pose.instances[1].node, 0);
    const auto at = [&](std::size_t i) {
        return glm::dvec3(pose.instances[i].world_from_object * glm::dvec4(1, 0, 0, 1));
    };
    EXPECT_EQ(at(0), glm::dvec3(2, 10, 0));
    // Scaled by 3, rotated to +Y, moved by 2, then by the node's 10.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(1)[c], glm::dvec3(0, 15, 0)[c], 1e-6);
    EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
    EXPECT_EQ(requirements(scene, pose).draws, 2u);
}

TEST(GltfInstancing, NodesAndTargetsMoveAll) {
    InstancedFile f;
    f.translations({1, 0, 0, 0, 2, 0, 0, 0, 3});
    const int up = f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
    f.primitive()["targets"] = {{{"POSITION", up}}};
    f.json["meshes"][0]["weights"] = {0.5};
    const int times = f.accessor<float>({0, 1}, FLOAT, "SCALAR", 1);
    const int moves = f.accessor<float>({0, 0, 0, 0, 0, 8}, FLOAT, "VEC3", 3);
    f.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 1);
    ASSERT_EQ(pose.instances.size(), 3u);
    EXPECT_EQ(pose.weights.size(), 1u) << "shared";
    const glm::dvec3 places[] = {{1, 0, 8}, {0, 2, 8}, {0, 0, 11}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(glm::dvec3(pose.instances[i].world_from_object[3]), places[i]);
        ASSERT_TRUE(pose.instances[i].deformed());
        const PosedBox& box = pose.boxes.at(static_cast<std::size_t>(pose.instances[i].box));
        // Boxes have a margin for float32 rounding: 1e-5 of their diagonal.
        EXPECT_NEAR(box.origin.z + box.min.z, places[i].z + 0.5, 2e-5);
    }
    const Bounds bounds = worldBounds(scene, pose);
    EXPECT_EQ(bounds.max, glm::dvec3(2, 3, 11.5));
}

TEST(GltfInstancing, NoneIsDrawnWhereThereAreNone) {
    InstancedFile f;
    f.json["accessors"].push_back({{"componentType", FLOAT}, {"count", 0}, {"type", "VEC3"}});
    f.attributes()["TRANSLATION"] = f.json["accessors"].size() - 1;
    EXPECT_TRUE(poseAt(f.load(), 0).instances.empty());
}

TEST(GltfInstancing, CustomAttributesSayHowManyAndNothingElse) {
    InstancedFile f;
    f.attributes()["_ID"] = f.accessor<float>({1, 2, 3}, FLOAT, "SCALAR", 1);
    EXPECT_EQ(poseAt(f.load(), 0).instances.size(), 3u);
}

// With notes: notes_test.cpp.
TEST(GltfInstancing, WhereItHasNoMeaningOneIsDrawn) {
    InstancedFile skinned;
    skinned.translations({1, 0, 0, 0, 2, 0});
    skinned.primitive()["attributes"]["JOINTS_0"] =
        skinned.accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, UBYTE, "VEC4", 4);
    skinned.primitive()["attributes"]["WEIGHTS_0"] =
        skinned.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, FLOAT, "VEC4", 4);
    skinned.json["skins"] = {{{"joints", {0}}}};
    skinned.json["nodes"][0]["skin"] = 0;
    EXPECT_EQ(poseAt(skinned.load(), 0).instances.size(), 1u);
    InstancedFile unsaid;
    unsaid.attributes() = Json::object();
    EXPECT_EQ(poseAt(unsaid.load(), 0).instances.size(), 1u);
    InstancedFile far;
    far.translations({1, 0, 0, 1e19f, 0, 0});
    EXPECT_EQ(poseAt(far.load(), 0).instances.size(), 1u);
}

TEST(GltfInstancing, FaultyAttributesAreErrors) {
    const auto ends = [](const std::string& text, const std::string& end) { return text.ends_with(end); };
    InstancedFile f;
    f.translations({1, 0, 0, 0, 2, 0});
    f.attributes()["SCALE"] = f.accessor<float>({1, 1, 1}, FLOAT, "VEC3", 3);
    EXPECT_NE(f.error().find("instances, but other attributes have"), std::string::npos) << f.error();
    InstancedFile type;
    type.attributes()["TRANSLATION"] = type.accessor<float>({1, 0}, FLOAT, "VEC2", 2);
    EXPECT_PRED2(ends, type.error(), "is not VEC3 of floats");
    InstancedFile integers;
    integers.attributes()["ROTATION"] =
        integers.accessor<std::uint8_t>({0, 0, 0, 255}, UBYTE, "VEC4", 4, true);
    EXPECT_PRED2(ends, integers.error(), "is not VEC4 of floats or normalized signed integers");
    InstancedFile infinite;
    infinite.translations({INFINITY, 0, 0});
    EXPECT_PRED2(ends, infinite.error(), "TRANSLATION: has values that are not finite");
    InstancedFile absent;
    absent.attributes()["TRANSLATION"] = 99;
    EXPECT_NE(absent.error().find("TRANSLATION"), std::string::npos) << absent.error();
}

// A few bytes of JSON that request 2^24 instances: refused by their number before any is created.
TEST(GltfInstancing, AsManyAsTheFileHasBytesFor) {
    InstancedFile f;
    f.json["accessors"].push_back({{"componentType", FLOAT}, {"count", 1 << 24}, {"type", "VEC3"}});
    f.attributes()["TRANSLATION"] = f.json["accessors"].size() - 1;
    EXPECT_NE(f.error().find("16777216 more instances exceed the memory limit"), std::string::npos)
        << f.error();
}

}  // namespace
}  // namespace diptych
