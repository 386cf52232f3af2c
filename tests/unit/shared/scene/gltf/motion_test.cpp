// SPDX-License-Identifier: MIT
// Morph targets and animations.
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// The triangle with two morph targets: one of positions; one of normals and sparse positions without a
// bufferView.
struct MorphedFile : GltfFile {
    MorphedFile() : GltfFile(triangle()) {
        primitive()["attributes"]["NORMAL"] = accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
        const int up = accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, FLOAT, "VEC3", 3);
        const int tilt = accessor<float>({1, 0, 0, 0, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
        const int index = accessor<std::uint8_t>({1}, UBYTE, "SCALAR", 1);
        const int value = accessor<float>({7, 8, 9}, FLOAT, "VEC3", 3);
        json["accessors"].push_back({{"componentType", FLOAT},
                                     {"count", 3},
                                     {"type", "VEC3"},
                                     {"sparse",
                                      {{"count", 1},
                                       {"indices", {{"bufferView", index}, {"componentType", UBYTE}}},
                                       {"values", {{"bufferView", value}}}}}});
        const int sparse = static_cast<int>(json["accessors"].size()) - 1;
        primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", sparse}, {"NORMAL", tilt}}};
        json["meshes"][0]["weights"] = {0.5, 0.25};
    }
};

// One channel of node 0, with keys at 0, 1 and 2 s.
struct AnimatedFile : MorphedFile {
    AnimatedFile() { json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}}; }
    void channel(const char* path, const char* interpolation, int output, int input = -1) {
        if (input < 0) input = accessor<float>({0, 1, 2}, FLOAT, "SCALAR", 1);
        Json& animation = json["animations"][0];
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", interpolation}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", 0}, {"path", path}}}});
    }
    int vectors(std::size_t count, const char* type = "VEC3", std::size_t width = 3) {
        std::vector<float> values;
        for (std::size_t i = 0; i < count * width; ++i) values.push_back(static_cast<float>(i));
        return accessor(values, FLOAT, type, width);
    }
};

}  // namespace

// ---- morph targets -----------------------------------------------------------------------------------

TEST(GltfMotion, MorphTargetsHaveTheirDeltas) {
    MorphedFile f;
    f.json["nodes"][0]["weights"] = {1, 0};
    const Scene scene = f.load();
    const Primitive& p = f.only(scene);
    ASSERT_EQ(p.targets.size(), 2u);
    EXPECT_EQ(p.targets[0].positions, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}));
    EXPECT_TRUE(p.targets[0].normals.empty());
    EXPECT_EQ(p.targets[1].positions, (std::vector<glm::vec3>{{0, 0, 0}, {7, 8, 9}, {0, 0, 0}}));
    EXPECT_EQ(p.targets[1].normals[2], glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.meshes[0].weights, (std::vector<float>{0.5f, 0.25f}));
    ASSERT_EQ(scene.nodes[0].weights, 0);
    EXPECT_EQ(scene.weights.at(0), (std::vector<float>{1, 0}));
    EXPECT_FALSE(p.flat);
    EXPECT_EQ(p.positions[1], glm::vec3(1, 0, 0)) << "as they are without them";
}

// A corner that gets its own vertex for its flat normal keeps its morph deltas.
TEST(GltfMotion, DeltasFollowTheirVertices) {
    MorphedFile f;
    f.primitive()["attributes"].erase("NORMAL");
    f.primitive()["indices"] = f.accessor<std::uint8_t>({1, 2, 0}, UBYTE, "SCALAR", 1);
    const Scene scene = f.load();
    const Primitive& p = f.only(scene);
    EXPECT_TRUE(p.flat);
    EXPECT_EQ(p.targets[0].positions, (std::vector<glm::vec3>{{0, 0, 2}, {0, 0, 3}, {0, 0, 1}}));
    EXPECT_TRUE(p.targets[1].normals.empty()) << "a delta to nothing";
}

TEST(GltfMotion, MorphTargetsThatDoNotFitAreRefusedInOneLine) {
    const auto ends = [](const std::string& line, const std::string& end) { return line.ends_with(end); };
    MorphedFile f;
    f.json["meshes"][0]["primitives"].push_back(f.primitive());
    f.json["meshes"][0]["primitives"][1]["targets"].erase(1);
    EXPECT_TRUE(mentions(f.load().notes,
                         "mesh 0, primitive 1: 1 morph targets, but the mesh's first "
                         "primitive has 2: left out"));
    f = {};
    f.json["meshes"][0]["weights"] = {1};
    EXPECT_PRED2(ends, f.error(), "mesh 0: 1 weight for 2 morph targets");
    f = {};
    f.json["nodes"][0]["weights"] = {1, 2, 3};
    EXPECT_PRED2(ends, f.error(), "node 0: 3 weights for 2 morph targets");
    f = {};
    f.primitive()["targets"][0]["POSITION"] = f.accessor<float>({0, 0, 1}, FLOAT, "VEC3", 3);
    EXPECT_PRED2(ends, f.error(), "mesh 0, primitive 0: target 0: POSITION: has 1 elements for 3 positions");
}

TEST(GltfMotion, DeltasThatAreNotFiniteAreZeroWithANote) {
    MorphedFile f;
    f.primitive()["targets"][0]["POSITION"] =
        f.accessor<float>({NAN, 0, 1, 0, 0, 2, 0, 0, INFINITY}, FLOAT, "VEC3", 3);
    const Scene scene = f.load();
    EXPECT_EQ(f.only(scene).targets[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 2}, {0, 0, 0}}));
    EXPECT_TRUE(mentions(scene.notes, "target 0: POSITION: 2 are not finite: 0"));
}

// ---- animations --------------------------------------------------------------------------------------

TEST(GltfMotion, AnimationsOfEveryPartAndInterpolation) {
    AnimatedFile f;
    f.json["nodes"][0]["translation"] = {1, 2, 3};
    f.json["nodes"][0]["scale"] = {2, 2, 2};
    f.channel("translation", "LINEAR", f.vectors(3));
    f.channel("rotation", "STEP",
              f.accessor<std::int16_t>({0, 0, 0, 32767, 0, 32767, 0, 0, 32767, 0, 0, -32768}, SHORT, "VEC4",
                                       4, true));
    f.channel("scale", "CUBICSPLINE", f.vectors(9));
    f.channel("weights", "LINEAR",
              f.accessor<std::uint8_t>({0, 255, 51, 102, 255, 0}, UBYTE, "SCALAR", 1, true));
    f.json["animations"][0]["name"] = "wave";
    const Scene scene = f.load();
    ASSERT_EQ(scene.animations.size(), 1u);
    const Animation& a = scene.animations[0];
    EXPECT_EQ(a.name, "wave");
    ASSERT_EQ(a.channels.size(), 4u);
    const auto keys = [&](std::size_t c) {
        return a.keyframes.at(static_cast<std::size_t>(a.channels[c].keyframes));
    };
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(a.channels[c].node, 0);
        EXPECT_EQ(keys(c).times, (std::vector<float>{0, 1, 2}));
    }
    EXPECT_EQ(a.channels[0].part, AnimatedPart::translation);
    EXPECT_EQ(keys(0).values, (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(keys(1).interpolation, Interpolation::step);
    EXPECT_EQ(keys(1).width, 4u);
    // 32767 is 1, -32768 counts as -1, and rotations are normalized: (1, 0, 0, -1) / sqrt 2.
    EXPECT_EQ(keys(1).values[3], 1);
    EXPECT_FLOAT_EQ(keys(1).values[8], std::sqrt(0.5f));
    EXPECT_FLOAT_EQ(keys(1).values[11], -std::sqrt(0.5f));
    EXPECT_EQ(keys(2).interpolation, Interpolation::cubic_spline);
    EXPECT_EQ(keys(2).values.size(), 27u);
    EXPECT_EQ(keys(2).width, 3u);
    EXPECT_EQ(a.channels[3].part, AnimatedPart::weights);
    EXPECT_EQ(keys(3).width, 2u);
    EXPECT_FLOAT_EQ(keys(3).values[2], 0.2f);
    EXPECT_EQ(keys(3).values[4], 1);

    ASSERT_EQ(scene.nodes[0].transform, 0);
    EXPECT_EQ(scene.transforms.at(0).translation, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.transforms[0].rotation, glm::dquat(1, 0, 0, 0));
    EXPECT_EQ(scene.transforms[0].scale, glm::dvec3(2));
    EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
}

TEST(GltfMotion, ChannelsShareKeyframes) {
    AnimatedFile f;
    f.channel("translation", "LINEAR", f.vectors(3));
    f.json["nodes"].push_back({{"name", "other"}});
    f.json["scenes"][0]["nodes"] = {0, 1};
    Json second = f.json["animations"][0]["channels"][0];
    second["target"]["node"] = 1;
    f.json["animations"][0]["channels"].push_back(second);
    const Scene scene = f.load();
    ASSERT_EQ(scene.animations.at(0).channels.size(), 2u);
    EXPECT_EQ(scene.animations[0].keyframes.size(), 1u);
    EXPECT_EQ(scene.transforms.size(), 2u);
}

TEST(GltfMotion, WhatMovesNothingOfTheSceneIsIgnored) {
    AnimatedFile f;
    f.channel("translation", "LINEAR", f.vectors(3));
    f.json["nodes"].push_back({{"name", "elsewhere"}});
    f.json["animations"][0]["channels"][0]["target"]["node"] = 1;  // a node of no scene
    EXPECT_TRUE(f.load().animations.empty());
    // A target without a node is defined by extensions (glTF 2.0, 5.6).
    f.json["animations"][0]["channels"][0]["target"].erase("node");
    const Scene scene = f.load();
    EXPECT_TRUE(scene.animations.empty());
    EXPECT_FALSE(mentions(scene.notes, "animation"));
}

TEST(GltfMotion, KeysAtOneTimeAreRead) {
    AnimatedFile f;
    f.channel("translation", "LINEAR", f.vectors(3), f.accessor<float>({0, 0, 2}, FLOAT, "SCALAR", 1));
    EXPECT_EQ(f.load().animations.at(0).keyframes.at(0).times, (std::vector<float>{0, 0, 2}));
}

// Animations are optional: a faulty channel is skipped with a note on its fault.
TEST(GltfMotion, FaultyChannelsAreLeftOutWithTheirFault) {
    using Change = std::function<void(AnimatedFile&)>;
    const auto timesAre = [](const std::vector<float>& times) -> Change {
        return [=](AnimatedFile& f) {
            f.channel("translation", "LINEAR", f.vectors(3), f.accessor(times, FLOAT, "SCALAR", 1));
        };
    };
    const auto vectorsOf = [](std::size_t count, const char* path, const char* interpolation) -> Change {
        return [=](AnimatedFile& f) { f.channel(path, interpolation, f.vectors(count)); };
    };
    const auto valuesAre = [](const char* path, const char* type, const auto& values, int component) {
        return [=](AnimatedFile& f) {
            const auto width = static_cast<std::size_t>(type[3] - '0');
            f.channel(path, "LINEAR", f.accessor(values, component, type, width, component != FLOAT));
        };
    };
    const std::pair<const char*, Change> cases[] = {
        {"input: key 2 at 0.5 s is before the previous key", timesAre({0, 1, 0.5f})},
        {"input: key 1 has the invalid time nan s", timesAre({0, NAN, 2})},
        {"input: key 0 has the invalid time -1 s", timesAre({-1, 0, 2})},
        {"input: key 2 has the invalid time inf s", timesAre({0, 1, INFINITY})},
        {"input: accessor 0 is not SCALAR of floats",
         [](AnimatedFile& f) { f.channel("translation", "LINEAR", f.vectors(3), 0); }},
        {"output: 2 elements for 3 keys", vectorsOf(2, "translation", "LINEAR")},
        {"output: 3 elements for 3 keys", vectorsOf(3, "translation", "CUBICSPLINE")},
        {"is not VEC4 of floats or normalized integers", vectorsOf(3, "rotation", "LINEAR")},
        {"is not VEC3 of floats", valuesAre("scale", "VEC3", std::vector<std::uint8_t>(9, 1), UBYTE)},
        {"rotation 0 is 0 0 0 0", valuesAre("rotation", "VEC4", std::vector<float>(12, 0), FLOAT)},
        {"output: has values that are not finite",
         valuesAre("scale", "VEC3", std::vector<float>(9, NAN), FLOAT)},
        {"3 weights per key, but node 0 has 2 morph targets",
         [](AnimatedFile& f) { f.channel("weights", "STEP", f.vectors(9, "SCALAR", 1)); }},
        {"node 0 has a matrix, which cannot be animated", [](AnimatedFile& f) {
             f.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
             f.channel("scale", "LINEAR", f.vectors(3));
         }}};
    for (const auto& [fault, change] : cases) {
        AnimatedFile f;
        change(f);
        const Scene scene = f.load();
        EXPECT_TRUE(scene.animations.empty()) << fault;
        EXPECT_TRUE(mentions(scene.notes, "animation 0: 1 of 1 channels left out: channel 0: ")) << fault;
        EXPECT_TRUE(mentions(scene.notes, fault))
            << fault << " -> " << (scene.notes.empty() ? "" : scene.notes[0]);
        EXPECT_EQ(scene.nodes[0].transform, -1);
    }
    AnimatedFile twice;
    twice.channel("translation", "LINEAR", twice.vectors(3));
    twice.channel("translation", "STEP", twice.vectors(3));
    const Scene scene = twice.load();
    EXPECT_EQ(scene.animations.at(0).channels.size(), 1u);
    EXPECT_TRUE(mentions(scene.notes,
                         "1 of 2 channels left out: channel 1: an earlier channel already animates node 0"));
}
