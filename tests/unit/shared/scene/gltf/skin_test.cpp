// SPDX-License-Identifier: MIT
#include "shared/scene/motion/bounds.h"
#include "shared/scene/motion/posed.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// GltfFile's triangle with a skin of two joints, nodes 1 and 2; node 0 draws it.
struct SkinnedFile : GltfFile {
    SkinnedFile() : GltfFile(triangle()) {
        json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                         {{"children", {2}}, {"translation", {0, 5, 0}}},
                         {{"translation", {0, 1, 0}}}};
        json["scenes"] = {{{"nodes", {0, 1}}}};
        json["skins"] = {{{"joints", {1, 2}}, {"name", "arm"}}};
        setJoints({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
        setWeights({1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0});
    }
    void setJoints(const std::vector<std::uint8_t>& joints) {
        primitive()["attributes"]["JOINTS_0"] = accessor(joints, UBYTE, "VEC4", 4);
    }
    void setWeights(const std::vector<float>& weights) {
        primitive()["attributes"]["WEIGHTS_0"] = accessor(weights, FLOAT, "VEC4", 4);
    }
    // Sets both joints' inverse bind matrices to translations.
    void setInverseBinds(const glm::vec3& first, const glm::vec3& second) {
        std::vector<float> values;
        for (const glm::vec3& t : {first, second})
            values.insert(values.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, t.x, t.y, t.z, 1});
        json["skins"][0]["inverseBindMatrices"] = accessor(values, FLOAT, "MAT4", 16);
    }
};

}  // namespace

TEST(GltfSkin, SkinsJointsAndWeights) {
    SkinnedFile f;
    f.json["skins"][0]["skeleton"] = 1;
    f.setInverseBinds({0, -5, 0}, {0, -6, 0});
    const Scene scene = f.load();
    ASSERT_EQ(scene.skins.size(), 1u);
    const Skin& skin = scene.skins[0];
    EXPECT_EQ(skin.name, "arm");
    EXPECT_EQ(skin.joints, (std::vector<int>{1, 2}));
    EXPECT_EQ(skin.skeleton, 1);
    ASSERT_EQ(skin.joint_from_mesh.size(), 2u);
    EXPECT_EQ(skin.joint_from_mesh[1][3], glm::vec4(0, -6, 0, 1));
    EXPECT_EQ(scene.nodes[0].skin, 0);
    EXPECT_EQ(scene.nodes[1].skin, -1);
    // With flat normals every corner has its own vertex, here in the file's order.
    const JointSet& set = f.only(scene).joint_sets.at(0);
    ASSERT_EQ(set.joints.size(), 3u);
    EXPECT_EQ(set.joints[1], glm::u16vec4(1, 0, 0, 0));
    EXPECT_EQ(set.weights[2], glm::vec4(0.25f, 0.75f, 0, 0));
}

// The node's own translation by 100 has no effect: joint 0 (y = 5) and its inverse bind matrix (y - 4)
// place the vertices.
TEST(GltfSkin, SkinnedMeshesStandInBindPose) {
    SkinnedFile f;
    f.setInverseBinds({0, -4, 0}, {0, -5, 0});
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 0).instances.at(0).world_from_object[3], glm::dvec4(0, 1, 0, 1));
    // A joint with scale 0 in y: the node's own transform is used instead.
    f.json["nodes"][1]["scale"] = {1, 0, 1};
    const Scene flat = f.load();
    EXPECT_EQ(poseAt(flat, 0).instances.at(0).world_from_object[3], glm::dvec4(100, 0, 0, 1));
}

// A real model: modelled with +Z up, only its joints make it stand upright. The extent is from the assets'
// own table.
TEST(GltfSkin, CesiumManStandsOnItsFeet) {
    const auto file =
        std::filesystem::path(DIPTYCH_SOURCE_DIR "/../shared") / "assets/scenes/cesium_man/CesiumMan.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "NO ASSETS at " << file << ": no real skin is tried";
    const Scene scene = loadScene(file.string());
    EXPECT_EQ(scene.skins.at(0).joints.size(), 19u);
    EXPECT_EQ(scene.animations.at(0).channels.size(), 57u) << "three parts of 19 joints";
    // In bind pose, not at the animation's first key.
    Scene resting = scene;
    resting.animations.clear();
    Pose bind = poseAt(resting, 0);
    for (Instance& instance : bind.instances) instance.skin = -1;
    const Bounds bounds = worldBounds(scene, bind);
    const glm::dvec3 extent = bounds.max - bounds.min, expected(1.14, 1.51, 0.31);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(extent[c], expected[c], 0.005) << "the table has two decimals";
    EXPECT_NEAR(bounds.min.y, 0, 1e-3) << "a foot's sole to a millimetre";
}

TEST(GltfSkin, WithoutInverseBindMatricesTheyAreTheIdentity) {
    SkinnedFile f;
    const Scene scene = f.load();
    EXPECT_EQ(scene.skins.at(0).joint_from_mesh, (std::vector<glm::mat4>{glm::mat4(1), glm::mat4(1)}));
    EXPECT_EQ(poseAt(scene, 0).instances.at(0).world_from_object[3], glm::dvec4(0, 6, 0, 1))
        << "that of the second joint, with 1.75 of 3 shares";
}

// Weights 64, 191, 0 add up to 255 and are 64/255 and 191/255 as normalized bytes. The floats 1 and 3 are
// normalized to 1/4 and 3/4.
TEST(GltfSkin, WeightsAddUpToOneWhateverTheirType) {
    SkinnedFile f;
    f.setWeights({1, 3, 0, 0, 2, 0, 0, 0, 0, 0, 0, 5});
    f.setJoints({0, 1, 9, 9, 1, 9, 9, 9, 9, 9, 9, 0});  // joint 9 does not exist, but has weight 0
    Scene scene = f.load();
    EXPECT_EQ(f.only(scene).joint_sets[0].weights[0], glm::vec4(0.25f, 0.75f, 0, 0));
    EXPECT_EQ(f.only(scene).joint_sets[0].weights[1], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(f.only(scene).joint_sets[0].joints[0], glm::u16vec4(0, 1, 0, 0));
    for (const bool shorts : {false, true}) {
        std::vector<std::uint8_t> bytes;
        std::vector<std::uint16_t> words;
        for (int v = 0; v < 3; ++v)
            for (const int w : {64, 191, 0, 0}) {
                bytes.push_back(static_cast<std::uint8_t>(w));
                words.push_back(static_cast<std::uint16_t>(257 * w));  // 65535 = 257 * 255
            }
        f.primitive()["attributes"]["WEIGHTS_0"] =
            shorts ? f.accessor(words, USHORT, "VEC4", 4, true) : f.accessor(bytes, UBYTE, "VEC4", 4, true);
        f.primitive()["attributes"]["JOINTS_0"] =
            f.accessor<std::uint16_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, USHORT, "VEC4", 4);
        scene = f.load();
        EXPECT_FLOAT_EQ(f.only(scene).joint_sets[0].weights[0].x, 64.0f / 255);
        EXPECT_FLOAT_EQ(f.only(scene).joint_sets[0].weights[0].y, 191.0f / 255);
    }
}

TEST(GltfSkin, EightInfluencesAreTwoSets) {
    SkinnedFile f;
    f.primitive()["attributes"]["JOINTS_1"] = f.primitive()["attributes"]["JOINTS_0"];
    f.primitive()["attributes"]["WEIGHTS_1"] =
        f.accessor<float>({1, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0}, FLOAT, "VEC4", 4);
    const Scene scene = f.load();
    const Primitive& p = f.only(scene);
    ASSERT_EQ(p.joint_sets.size(), 2u);
    EXPECT_EQ(p.joint_sets[0].weights[0].x, 0.5f) << "the sum is over both sets";
    EXPECT_EQ(p.joint_sets[1].weights[0].x, 0.5f);
    EXPECT_EQ(p.joint_sets[1].weights[1].w, 0.75f);
}

// With notes, as the next: notes_test.cpp.
TEST(GltfSkin, WeightsThatDoNotAddUpAreNormalized) {
    SkinnedFile f;
    f.setWeights({0.25f, 0.75f, 0, 0, 0.25f, 0.744f, 0, 0, 1, 3, 0, 0});
    EXPECT_EQ(f.only(f.load()).joint_sets.at(0).weights[2], glm::vec4(0.25f, 0.75f, 0, 0));
}

TEST(GltfSkin, WeightsOfNothingGoToTheFirstJoint) {
    SkinnedFile f;
    f.setWeights({0, 0, 0, 0, -1, 0, 0, 0, NAN, 1, 0, 0});
    const Scene scene = f.load();
    const JointSet& set = f.only(scene).joint_sets.at(0);
    EXPECT_EQ(set.weights[0], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(set.weights[1], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(set.joints[1].x, 1) << "the first that the vertex names";
    EXPECT_EQ(set.weights[2], glm::vec4(0, 1, 0, 0));
}

TEST(GltfSkin, SkinsThatCannotBeAreRefusedInOneLine) {
    const auto error = [](const auto& change) {
        SkinnedFile f;
        f.setInverseBinds({0, 0, 0}, {0, 0, 0});
        change(f);
        return f.error();
    };
    const auto ends = [](const std::string& line, const std::string& end) { return line.ends_with(end); };
    EXPECT_PRED2(ends, error([](SkinnedFile&) {}), "");
    EXPECT_PRED2(ends, error([](SkinnedFile& f) {
                     f.setJoints({0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0});
                 }),
                 "mesh 0, primitive 0: vertex 1 names joint 2, but its skin has 2");
    EXPECT_PRED2(ends, error(sets("/scenes/0/nodes", {0})), "skin 0: joint node 1 is not in the drawn scene");
    EXPECT_PRED2(ends, error(erases("/meshes/0/primitives/0/attributes", "WEIGHTS_0")),
                 "mesh 0, primitive 0: has JOINTS_0 without WEIGHTS_0");
    EXPECT_PRED2(ends, error([](SkinnedFile& f) {
                     f.json["skins"][0]["inverseBindMatrices"] =
                         f.accessor(std::vector<float>(16, 0), FLOAT, "MAT4", 16);
                 }),
                 "skin 0: inverseBindMatrices: 1 matrices for 2 joints");
    EXPECT_PRED2(ends, error([](SkinnedFile& f) {
                     f.json["skins"][0]["inverseBindMatrices"] =
                         f.accessor(std::vector<float>(32, 0), FLOAT, "MAT4", 16);
                 }),
                 "skin 0: inverseBindMatrices: the last row of matrix 0 is not 0 0 0 1");
    EXPECT_PRED2(ends, error([](SkinnedFile& f) {
                     f.setInverseBinds({NAN, 0, 0}, {0, 0, 0});
                 }),
                 "skin 0: inverseBindMatrices: matrix 0 is not finite");
    EXPECT_PRED2(ends, error(sets("/skins/0/inverseBindMatrices", 0)),
                 "skin 0: inverseBindMatrices: accessor 0 is not MAT4 of floats");
}

TEST(GltfSkin, FaultsOfWhatMovesNothingAreNoFaults) {
    SkinnedFile f;
    f.setJoints({0, 0, 0, 0, 77, 0, 0, 0, 0, 1, 0, 0});
    f.json["nodes"][0].erase("skin");
    EXPECT_EQ(f.error(), "") << "a mesh that no skin moves has no joints";
    EXPECT_TRUE(f.only(f.load()).joint_sets.empty());
    f.json["nodes"][0] = {{"skin", 0}};
    EXPECT_EQ(f.error(), "") << "a node without a mesh may have a skin";
}

// Two nodes draw one mesh, each with its own skin.
TEST(GltfSkin, AMeshMayHaveTwoSkins) {
    SkinnedFile f;
    f.json["nodes"].push_back({{"mesh", 0}, {"skin", 1}});
    f.json["nodes"].push_back({{"translation", {7, 0, 0}}});
    f.json["nodes"].push_back({{"translation", {8, 0, 0}}});
    f.json["scenes"][0]["nodes"] = {0, 1, 3, 4, 5};
    f.json["skins"].push_back({{"joints", {4, 5}}});
    const Scene scene = f.load();
    ASSERT_EQ(scene.skins.size(), 2u);
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.instances.size(), 2u);
    EXPECT_NE(pose.instances[0].skin, pose.instances[1].skin);
    // Vertex 2, (0, 1, 0): a quarter of the first joint and three quarters of the second.
    const std::vector<glm::dvec3> first = posedPositions(scene, pose, pose.instances[0]),
                                  second = posedPositions(scene, pose, pose.instances[1]);
    EXPECT_NEAR(first.at(2).y, 1 + 0.25 * 5 + 0.75 * 6, 1e-12);
    EXPECT_NEAR(first[2].x, 0, 1e-12);
    EXPECT_NEAR(second.at(2).x, 0.25 * 7 + 0.75 * 8, 1e-12);
    EXPECT_NEAR(second[2].y, 1, 1e-12);
}

// As many joints as a 16-bit index can count, without inverse bind matrices: the last two are up.
TEST(GltfSkin, SixtyFiveThousandJoints) {
    constexpr std::size_t count = 65535;
    SkinnedFile f;
    Json joints = Json::array(), roots = {0};
    f.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}};
    for (std::size_t j = 0; j < count; ++j) {
        f.json["nodes"].push_back(Json::object());
        joints.push_back(j + 1);
        roots.push_back(j + 1);
    }
    f.json["nodes"][count - 1]["translation"] = {0, 65.533, 0};
    f.json["nodes"][count]["translation"] = {0, 65.534, 0};
    f.json["scenes"][0]["nodes"] = roots;
    f.json["skins"][0]["joints"] = joints;
    f.primitive()["attributes"]["JOINTS_0"] =
        f.accessor<std::uint16_t>({0, 0, 0, 0, 65534, 0, 0, 0, 65533, 65534, 0, 0}, USHORT, "VEC4", 4);
    const Scene scene = f.load();
    ASSERT_EQ(scene.skins.at(0).joints.size(), count);
    EXPECT_EQ(scene.skins[0].joint_from_mesh[count - 1], glm::mat4(1));
    const Pose pose = poseAt(scene, 0);
    const std::vector<glm::dvec3> posed = posedPositions(scene, pose, pose.instances.at(0));
    EXPECT_EQ(posed.at(0).y, 0);
    EXPECT_NEAR(posed.at(1).y, 65.534, 1e-12);
    EXPECT_NEAR(posed.at(2).y, 1 + 0.25 * 65.533 + 0.75 * 65.534, 1e-12);
}
