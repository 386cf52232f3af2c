// SPDX-License-Identifier: MIT
// Morph targets of texture coordinates and colours, and their effect on tangents.
#include "tests/support/gltf_builder.h"

#include <cmath>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// The triangle with both UV sets and colours, and one target without deltas.
struct MorphFile : GltfFile {
    MorphFile() : GltfFile(triangle()) {
        Json& attributes = primitive()["attributes"];
        attributes["NORMAL"] = accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
        attributes["TEXCOORD_0"] = accessor<float>({0, 1, 1, 1, 0, 0}, FLOAT, "VEC2", 2);
        attributes["TEXCOORD_1"] = accessor<float>({0, 1, 1, 1, 0, 0}, FLOAT, "VEC2", 2);
        attributes["COLOR_0"] = accessor<float>({1, 1, 1, 0, 0, 0, 0, 1, 0}, FLOAT, "VEC3", 3);
        primitive()["targets"] = Json::array({Json::object()});
    }
    Json& target() { return primitive()["targets"][0]; }
    MorphTarget loaded() { return only(load()).targets.at(0); }
    // A material with a normal texture that uses this UV set.
    void addNormalMap(int texcoord = 0) {
        json["images"] = {{{"uri", twoPixels}}};
        json["textures"] = {{{"source", 0}}};
        json["materials"] = {{{"normalTexture", {{"index", 0}, {"texCoord", texcoord}}}}};
        primitive()["material"] = 0;
    }
};

const std::vector<float> raised{0, 0, 0, 0, 0, 1, 0, 0, 0};

}  // namespace

TEST(GltfMorph, TexcoordsAndColorsHaveTheirDeltas) {
    MorphFile f;
    f.target()["TEXCOORD_0"] = f.accessor<float>({0, 0, 0.5f, -2, 0, 0}, FLOAT, "VEC2", 2);
    f.target()["TEXCOORD_1"] = f.accessor<std::int8_t>({127, -128, 0, 0, 0, 127}, BYTE, "VEC2", 2, true);
    f.target()["COLOR_0"] =
        f.accessor<float>({-1, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0, 3, -0.25f}, FLOAT, "VEC4", 4);
    const MorphTarget target = f.loaded();
    EXPECT_EQ(target.texcoords[0], (std::vector<glm::vec2>{{0, 0}, {0.5f, -2}, {0, 0}}));
    EXPECT_EQ(target.texcoords[1], (std::vector<glm::vec2>{{1, -1}, {0, 0}, {0, 1}}));
    EXPECT_EQ(target.colors, (std::vector<glm::vec4>{{-1, 0, 0, 0.5f}, {0, 0, 0, 0}, {0, 0, 3, -0.25f}}));
    EXPECT_TRUE(target.positions.empty());
}

TEST(GltfMorph, ColorsWithoutAlphaLeaveItAsItIs) {
    MorphFile f;
    f.target()["COLOR_0"] = f.accessor<float>({-1, 0, 0, 0, 0.5f, 0, 0, 0, 1}, FLOAT, "VEC3", 3);
    EXPECT_EQ(f.loaded().colors, (std::vector<glm::vec4>{{-1, 0, 0, 0}, {0, 0.5f, 0, 0}, {0, 0, 1, 0}}));
    f = {};
    // A row of 8-bit elements is 4 bytes long.
    f.target()["COLOR_0"] =
        f.accessor<std::uint8_t>({255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0, 255}, UBYTE, "VEC4", 4, true);
    EXPECT_EQ(f.loaded().colors, (std::vector<glm::vec4>{{1, 0, 0, 0.2f}, {0, 0, 0, 0}, {0, 0, 0, 1}}));
    f = {};
    f.target()["COLOR_0"] =
        f.accessor<std::uint8_t>({255, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 255}, UBYTE, "VEC4", 4);
    EXPECT_NE(f.error().find("target 0: COLOR_0: accessor"), std::string::npos);
    EXPECT_NE(f.error().find("has integers that are not normalized"), std::string::npos);
}

TEST(GltfMorph, SparseDeltasAreReadWhereTheyAre) {
    MorphFile f;
    const int index = f.accessor<std::uint8_t>({2}, UBYTE, "SCALAR", 1);
    const auto sparse = [&](const std::vector<float>& value, const char* type) {
        f.accessor<float>(value, FLOAT, type, value.size());
        const std::size_t values = f.json["bufferViews"].size() - 1;
        const Json indices = {{"bufferView", index}, {"componentType", UBYTE}};
        f.json["accessors"].push_back(
            {{"componentType", FLOAT},
             {"count", 3},
             {"type", type},
             {"sparse", {{"count", 1}, {"indices", indices}, {"values", {{"bufferView", values}}}}}});
        return f.json["accessors"].size() - 1;
    };
    f.target()["TEXCOORD_0"] = sparse({3, 4}, "VEC2");
    f.target()["COLOR_0"] = sparse({1, 2, 3}, "VEC3");
    const MorphTarget target = f.loaded();
    EXPECT_EQ(target.texcoords[0], (std::vector<glm::vec2>{{0, 0}, {0, 0}, {3, 4}}));
    EXPECT_EQ(target.colors, (std::vector<glm::vec4>{{0, 0, 0, 0}, {0, 0, 0, 0}, {1, 2, 3, 0}}));
}

// glTF 2.0, 3.7.2.2: a target's attributes must be attributes of the mesh.
TEST(GltfMorph, DeltasToNothingAreLeftOutWithANote) {
    for (const char* name : {"TEXCOORD_0", "TEXCOORD_1", "COLOR_0", "NORMAL", "TEXCOORD_2"}) {
        MorphFile f;
        f.primitive()["attributes"].erase(name);
        const bool uv = std::string(name).starts_with("TEX");
        f.target()[name] = uv ? f.accessor<float>({0, 0, 1, 0, 0, 0}, FLOAT, "VEC2", 2)
                              : f.accessor<float>(raised, FLOAT, "VEC3", 3);
        const Scene scene = f.load();
        const MorphTarget& target = f.only(scene).targets.at(0);
        EXPECT_TRUE(target.texcoords[0].empty() && target.texcoords[1].empty() && target.colors.empty() &&
                    target.normals.empty())
            << name;
        EXPECT_TRUE(mentions(scene.notes, std::string("target 0: ") + name + ": left out")) << name;
    }
}

TEST(GltfMorph, DeltasThatAreNotFiniteAreZeroWithANote) {
    MorphFile f;
    f.target()["TEXCOORD_0"] = f.accessor<float>({NAN, 0, 1, 0, 0, 0}, FLOAT, "VEC2", 2);
    f.target()["COLOR_0"] = f.accessor<float>({INFINITY, 1, 1, 2, 2, 2, 0, 0, 0}, FLOAT, "VEC3", 3);
    const Scene scene = f.load();
    const MorphTarget& target = f.only(scene).targets.at(0);
    EXPECT_EQ(target.texcoords[0][0], glm::vec2(0));
    EXPECT_EQ(target.texcoords[0][1], glm::vec2(1, 0));
    EXPECT_EQ(target.colors[0], glm::vec4(0));
    EXPECT_TRUE(mentions(scene.notes, "target 0: TEXCOORD_0: 1 is not finite: 0"));
    EXPECT_TRUE(mentions(scene.notes, "target 0: COLOR_0: 1 is not finite: 0"));
}

// Vertices split for flat normals or tangents keep all their deltas.
TEST(GltfMorph, DeltasFollowTheirVertices) {
    MorphFile f;
    f.primitive()["attributes"].erase("NORMAL");
    f.primitive()["indices"] = f.accessor<std::uint8_t>({1, 2, 0}, UBYTE, "SCALAR", 1);
    f.target()["TEXCOORD_1"] = f.accessor<float>({1, 1, 2, 2, 3, 3}, FLOAT, "VEC2", 2);
    f.target()["COLOR_0"] = f.accessor<float>({1, 0, 0, 2, 0, 0, 3, 0, 0}, FLOAT, "VEC3", 3);
    const MorphTarget target = f.loaded();
    EXPECT_EQ(target.texcoords[1], (std::vector<glm::vec2>{{2, 2}, {3, 3}, {1, 1}}));
    EXPECT_EQ(target.colors[0].r, 2);
}

// ---- tangent groups ----------------------------------------------------------------------------------

TEST(GltfMorph, TangentGroupsAreThereWhereTargetsMoveMadeTangents) {
    const auto groups = [](const auto& change) {
        MorphFile f;
        f.addNormalMap();
        change(f);
        return f.only(f.load()).tangent_groups.count();
    };
    const auto moved = [](MorphFile& f, const char* name) {
        const bool uv = std::string(name).starts_with("TEX");
        f.target()[name] = uv ? f.accessor<float>({0, 0, 1, 0, 0, 0}, FLOAT, "VEC2", 2)
                              : f.accessor<float>(raised, FLOAT, "VEC3", 3);
    };
    for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"})
        EXPECT_EQ(groups([&](MorphFile& f) { moved(f, name); }), 3u) << name << ": one for each corner";
    EXPECT_EQ(groups([](MorphFile&) {}), 0u) << "a target that moves nothing";
    for (const char* name : {"COLOR_0", "TEXCOORD_1"})
        EXPECT_EQ(groups([&](MorphFile& f) { moved(f, name); }), 0u) << name << ": tangents stay";
    EXPECT_EQ(groups([&](MorphFile& f) {
                  moved(f, "POSITION");
                  f.primitive()["attributes"]["TANGENT"] =
                      f.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, FLOAT, "VEC4", 4);
              }),
              0u)
        << "the file's own tangents";
    EXPECT_EQ(groups([&](MorphFile& f) {
                  moved(f, "POSITION");
                  f.json["materials"][0].erase("normalTexture");
              }),
              0u)
        << "nothing reads them";
    EXPECT_EQ(groups([&](MorphFile& f) {
                  moved(f, "TEXCOORD_1");
                  f.addNormalMap(1);
              }),
              3u)
        << "of the second UV set";
}
