// SPDX-License-Identifier: MIT
// What a person must look at: where it is, what is said of it, and what is left out.
#include "compare/marks.h"
#include "compare/mark_features.h"
#include "compare/material_pixels.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/view.h"

#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace diptych {

void PrintTo(const PixelBox& b, std::ostream* out) {
    *out << b.x0 << "," << b.y0 << " " << b.x1 << "," << b.y1;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// 200 x 100 pixels from the origin along -Z. With fov 90 a point (x, y, -d) is seen at
// (100 + 50 x / d, 50 - 50 y / d): half the height is d metres, half the width 2 d.
View viewOf(double near = 1, double far = infinity) {
    View view{Camera{}, 200, 100};
    view.camera.yfov = std::acos(0.0);
    view.camera.near = near;
    view.camera.far = far;
    return view;
}

Primitive shapeOf(std::vector<glm::vec3> positions) {
    Primitive p;
    p.normals.assign(positions.size(), {0, 0, 1});
    p.tangents.assign(positions.size(), {1, 0, 0, 1});
    for (std::uint32_t i = 2; i < positions.size(); ++i) p.indices.insert(p.indices.end(), {0, i - 1, i});
    p.positions = std::move(positions);
    return p;
}
// 2 m wide and high around (x, y), facing +Z; texture coordinates from 0 to 1.
Primitive squareAt(float x, float y, float z) {
    Primitive p = shapeOf({{x - 1, y - 1, z}, {x + 1, y - 1, z}, {x + 1, y + 1, z}, {x - 1, y + 1, z}});
    p.texcoords[0] = p.texcoords[1] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    return p;
}

// One node with one mesh of one primitive. Its material has one feature: it is double-sided.
Scene sceneOf(Primitive primitive) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    scene.meshes.push_back({"mesh", {std::move(primitive)}});
    scene.nodes.emplace_back().mesh = 0;
    return scene;
}
// The same with nothing to tell, and a texture that a slot may read.
Scene plainScene() {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    scene.materials[0].double_sided = false;
    scene.images.push_back({"image", 1, 1, {255, 255, 255, 255}});
    scene.textures.push_back({0, {}});
    return scene;
}

std::vector<FeatureMarks> marksIn(const Scene& scene, const View& view, const Image* ids = nullptr,
                                  const Image* positions = nullptr) {
    return marksOf(scene, poseAt(scene, 0), view, ids, positions);
}

// The boxes of a scene that has one feature at most.
std::vector<PixelBox> boxesOf(const std::vector<FeatureMarks>& features) {
    EXPECT_LE(features.size(), 1u);
    std::vector<PixelBox> boxes;
    for (const FeatureMarks& feature : features)
        for (const Mark& mark : feature.marks) boxes.push_back(mark.box);
    return boxes;
}
using Boxes = std::vector<PixelBox>;

std::string what(const Scene& scene, const std::string& feature) {
    for (const FeatureMarks& marks : marksIn(scene, viewOf()))
        if (marks.feature == feature) return marks.marks.at(0).what;
    return "";
}
std::set<std::string> featuresIn(const Scene& scene) {
    std::set<std::string> names;
    for (const FeatureMarks& marks : marksIn(scene, viewOf())) names.emplace(marks.feature);
    return names;
}

}  // namespace

// ---- where -------------------------------------------------------------------------------------------

// From (-1, -1) to (1, 1) at 2 m: 25 pixels a metre around (100, 50).
TEST(Marks, TheBoxOfATriangleByHand) {
    const Scene scene = sceneOf(shapeOf({{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}}));
    EXPECT_EQ(boxesOf(marksIn(scene, viewOf())), (Boxes{{75, 25, 125, 75}}));
}

TEST(Marks, NothingBehindTheCameraOrBesideThePicture) {
    EXPECT_EQ(boxesOf(marksIn(sceneOf(squareAt(0, 0, 2)), viewOf())), Boxes{});
    EXPECT_EQ(boxesOf(marksIn(sceneOf(squareAt(0, 0, -0.5f)), viewOf())), Boxes{}) << "before the near plane";
    EXPECT_EQ(boxesOf(marksIn(sceneOf(squareAt(0, 0, -9)), viewOf(1, 8))), Boxes{}) << "beyond the far plane";
    EXPECT_EQ(boxesOf(marksIn(sceneOf(squareAt(5.5f, 0, -2)), viewOf())), Boxes{}) << "from pixel 212 on";
}

// A floor 1 m below the eye from 2 m ahead to 5 m behind is seen from 1 m, where 2 m are 100 pixels, on; with
// a far plane at 3 m a floor that goes on to 10 m ends at 50 + 50 / 3 = 66.7 pixels.
TEST(Marks, WhatReachesThroughAPlaneIsCutOff) {
    const Scene through = sceneOf(shapeOf({{-1, -1, -2}, {1, -1, -2}, {1, -1, 5}, {-1, -1, 5}}));
    EXPECT_EQ(boxesOf(marksIn(through, viewOf())), (Boxes{{50, 75, 150, 100}}));
    const Scene away = sceneOf(shapeOf({{-1, -1, -2}, {1, -1, -2}, {1, -1, -10}, {-1, -1, -10}}));
    EXPECT_EQ(boxesOf(marksIn(away, viewOf(1, 3))), (Boxes{{75, 66, 125, 75}}));
}

TEST(Marks, WhatReachesOutOfThePictureEndsAtItsEdge) {
    EXPECT_EQ(boxesOf(marksIn(sceneOf(squareAt(4, 2, -2)), viewOf())), (Boxes{{175, 0, 200, 25}}));
}

// Half the height is 2 m: 25 pixels a metre at any distance.
TEST(Marks, OrthographicByHand) {
    View view = viewOf(0, 100);
    view.camera.orthographic = true;
    view.camera.ymag = 2;
    EXPECT_EQ(boxesOf(marksIn(sceneOf(squareAt(1, 0, -7)), view)), (Boxes{{100, 25, 150, 75}}));
}

TEST(Marks, InstancesStandWhereTheirNodesPutThem) {
    Scene scene = sceneOf(squareAt(0, 0, 0));
    scene.nodes[0].parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(1e7, 2, -4));
    View view = viewOf();
    view.camera.world_from_camera[3] = {1e7, 2, 0, 1};
    EXPECT_EQ(boxesOf(marksIn(scene, view)), (Boxes{{87, 37, 113, 63}})) << "12.5 pixels a metre";
}

TEST(Marks, TransformsThatAreNoNumbersMarkNothing) {
    const Scene scene = sceneOf(squareAt(0, 0, -2));
    for (const double bad : {infinity, std::nan("")}) {
        Pose pose = poseAt(scene, 0);
        pose.instances[0].world_from_object[3] = glm::dvec4(glm::dvec3(bad), 1);
        for (const FeatureMarks& feature : marksOf(scene, pose, viewOf(), nullptr, nullptr))
            for (const Mark& mark : feature.marks) EXPECT_FALSE(mark.box.empty());
    }
}

// ---- whether it is seen ------------------------------------------------------------------------------

TEST(Marks, WhatNoPixelShowsIsHidden) {
    const Scene scene = sceneOf(squareAt(0, 0, -2));
    Image ids(200, 100, 1, -1);
    ids.at(10, 10) = 0;  // outside of its box
    ids.at(100, 50) = 7;
    EXPECT_EQ(boxesOf(marksIn(scene, viewOf(), &ids)), Boxes{});
    ids.at(80, 30) = ids.at(90, 70) = 0;
    const std::vector<FeatureMarks> seen = marksIn(scene, viewOf(), &ids);
    EXPECT_EQ(boxesOf(seen), (Boxes{{80, 30, 91, 71}}));
    EXPECT_EQ(seen[0].marks[0].pixels, 2u);
}

// One behind the other, of one material; the picture shows the nearer one alone.
TEST(Marks, PositionsTellInstancesOfOneMaterialApart) {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    scene.nodes.emplace_back().mesh = 0;
    scene.nodes[1].parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2));
    Image ids(200, 100, 1, -1), positions(200, 100, 3);
    for (int y = 25; y < 75; ++y)
        for (int x = 75; x < 125; ++x) {
            ids.at(x, y) = 0;
            positions.at(x, y, 0) = (static_cast<float>(x) + 0.5f - 100) / 25;
            positions.at(x, y, 1) = (50 - static_cast<float>(y) - 0.5f) / 25;
            positions.at(x, y, 2) = -2;
        }
    EXPECT_EQ(marksIn(scene, viewOf(), &ids).at(0).found, 2u);
    const std::vector<FeatureMarks> marks = marksIn(scene, viewOf(), &ids, &positions);
    ASSERT_EQ(boxesOf(marks), (Boxes{{75, 25, 125, 75}}));
    EXPECT_EQ(marks[0].marks[0].pixels, 2500u);
}

// Against counting pixel by pixel, over sizes that tiles do not divide.
TEST(Marks, MaterialPixelsAreWhatIsThere) {
    std::mt19937 random(1);
    Image ids(53, 37, 1), positions(53, 37, 3);
    for (float& id : ids.data)
        id = static_cast<float>(random() % 40 == 0 ? random() % 4 : random() % 20 / 19) - 1;
    for (float& p : positions.data) p = static_cast<float>(random() % 5);
    const MaterialPixels byMaterial(ids, nullptr), byBoth(ids, &positions);
    const Bounds reach{{1, 0, 0}, {3, 4, 2}};
    for (int round = 0; round < 500; ++round) {
        const int x = static_cast<int>(random() % 53), y = static_cast<int>(random() % 37);
        const PixelBox box{x, y, x + 1 + static_cast<int>(random() % static_cast<unsigned>(53 - x)),
                           y + 1 + static_cast<int>(random() % static_cast<unsigned>(37 - y))};
        const int material = static_cast<int>(random() % 4);
        MaterialPixels::Seen all, near;
        for (int v = box.y0; v < box.y1; ++v)
            for (int u = box.x0; u < box.x1; ++u) {
                if (ids.at(u, v) != static_cast<float>(material)) continue;
                all.add(1, {u, v, u + 1, v + 1});
                const float px = positions.at(u, v, 0), pz = positions.at(u, v, 2);
                if (px >= 1 && px <= 3 && pz <= 2) near.add(1, {u, v, u + 1, v + 1});
            }
        const MaterialPixels::Seen a = byMaterial.within(material, box, reach),
                                   b = byBoth.within(material, box, reach);
        ASSERT_EQ(a.pixels, all.pixels);
        ASSERT_EQ(a.box, all.box);
        ASSERT_EQ(b.pixels, near.pixels);
        ASSERT_EQ(b.box, near.box);
    }
}

// ---- how many ----------------------------------------------------------------------------------------

TEST(Marks, TheLargestComeFirstAndAllAreCounted) {
    Scene scene = sceneOf(squareAt(0, 0, 0));
    scene.nodes.clear();
    for (int i = 0; i < 30; ++i) {  // the 10th is nearest, two are as far as each other
        Node& node = scene.nodes.emplace_back();
        node.name = "node " + std::to_string(i);
        node.mesh = 0;
        node.parent_from_node = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -2 - std::abs(i - 10)));
    }
    const std::vector<FeatureMarks> features = marksIn(scene, viewOf());
    ASSERT_EQ(features.size(), 1u);
    EXPECT_EQ(features[0].found, 30u);
    ASSERT_EQ(features[0].marks.size(), marksShown);
    EXPECT_EQ(features[0].marks[0].name, "node 10");
    EXPECT_EQ(features[0].marks[1].name, "node 9");
    EXPECT_EQ(features[0].marks[2].name, "node 11");
    EXPECT_TRUE(std::ranges::is_sorted(features[0].marks, std::greater<>(), &Mark::pixels));
}

TEST(Marks, ManyInstancesLeaveFewMarks) {
    const Scene scene = sceneOf(squareAt(0, 0, -20));
    Pose pose = poseAt(scene, 0);
    pose.instances.resize(100'000, pose.instances[0]);
    const Image ids(200, 100, 1, 0);
    const std::vector<FeatureMarks> features = marksOf(scene, pose, viewOf(), &ids, nullptr);
    EXPECT_EQ(features.at(0).found, 100'000u);
    EXPECT_EQ(features.at(0).marks.size(), marksShown);
}

// ---- which -------------------------------------------------------------------------------------------

TEST(Marks, APlainSurfaceHasNone) {
    EXPECT_EQ(featuresIn(plainScene()), std::set<std::string>{});
}

TEST(Marks, BuiltinScenesHaveTheirs) {
    const std::vector<std::pair<const char*, std::vector<const char*>>> expected{
        {"vertex_colors", {"vertex colours", "texture transforms", "orientation"}},
        {"mirrored", {"mirrored instances", "normal maps"}},
        {"cutout", {"alpha masks", "double-sided surfaces", "normal maps"}},
        {"unlit_materials", {"unlit materials", "vertex colours"}},
        {"gallery", {"normal maps", "samplers"}}};
    for (const auto& [name, features] : expected) {
        const Scene scene = loadScene(std::string("builtin:") + name);
        const Pose pose = poseAt(scene, 0);
        std::set<std::string> found;
        for (const FeatureMarks& marks :
             marksOf(scene, pose, makeView(scene, pose, "", 200, 100), nullptr, nullptr))
            found.emplace(marks.feature);
        for (const char* feature : features) EXPECT_TRUE(found.contains(feature)) << name << ": " << feature;
    }
}

TEST(Marks, AFrameShowsItsSceneAsItWasDrawn) {
    const Scene scene = sceneOf(squareAt(0, 0, -2));
    Frame frame;
    frame.settings.size = {200, 100};
    frame.settings.camera = "eye=0,0,0 target=0,0,-1 fov=90 near=1";
    EXPECT_EQ(boxesOf(marksOf(scene, frame)), (Boxes{{75, 25, 125, 75}}));
    frame.channels[static_cast<int>(gpu::DEBUG_material_id)] = Image(200, 100, 1, -1);
    EXPECT_EQ(boxesOf(marksOf(scene, frame)), Boxes{});
}

// The matrix as KHR_texture_transform writes it.
TEST(Marks, TextureTransformsAreToldByTheFilesNumbers) {
    Scene scene = plainScene();
    const auto transformed = [&](double x, double y, double degrees, double sx, double sy) {
        const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
        TextureSlot slot;
        slot.texture = 0;
        slot.u = {c * sx, s * sy, x};
        slot.v = {-s * sx, c * sy, y};
        return slot;
    };
    const std::string tail = ". What is pictured there (arrows, frames, seams) falls into place.";
    Material& m = scene.materials[0];
    const auto told = [&] { return what(scene, "texture transforms"); };
    m.base_color_texture = transformed(0.5, -0.25, 0, 1, 1);
    EXPECT_EQ(told(), "Base colour: offset 0.5 -0.25" + tail);
    m.base_color_texture = transformed(0, 0, 30, 1, 1);
    EXPECT_EQ(told(), "Base colour: turned 30\u00b0" + tail);
    m.base_color_texture = transformed(0.5, 0, -30, 2, 3);
    EXPECT_EQ(told(), "Base colour: offset 0.5 0, turned -30\u00b0, scaled 2 \u00d7 3" + tail);
    m.base_color_texture = transformed(0, 0, 0, -1, 1);
    EXPECT_EQ(told(), "Base colour: turned 180\u00b0, scaled 1 \u00d7 -1" + tail) << "which is the same";
    m.base_color_texture = m.normal_texture = transformed(0, 0, 0, 2, 2);
    m.emissive_texture = transformed(1, 0, 0, 1, 1);
    m.emissive = glm::vec3(1);
    EXPECT_EQ(told(), "Base colour and normal: scaled 2 \u00d7 2; emission: offset 1 0" + tail);
    m.emissive = glm::vec3(0);
    EXPECT_EQ(told(), "Base colour and normal: scaled 2 \u00d7 2" + tail)
        << "nothing reads the emissive slot";
}

// An edge mode shows only where a coordinate passes the edge.
TEST(Marks, SamplersAreToldWhereTheyShow) {
    Scene scene = plainScene();
    TextureSlot& slot = scene.materials[0].base_color_texture;
    slot.texture = 0;
    Sampler& sampler = scene.textures[0].sampler;
    sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;
    EXPECT_EQ(what(scene, "samplers"), "");
    slot.u.x = 2;
    EXPECT_EQ(what(scene, "samplers"), "Base colour: beyond its edge stripes of its last texels along u.");
    slot.v.y = 2;
    EXPECT_EQ(what(scene, "samplers"),
              "Base colour: beyond its edge stripes of its last texels along u and v.");
    sampler.wrap_s = Wrap::repeat;
    sampler.wrap_t = Wrap::mirrored_repeat;
    sampler.magnify_linear = false;
    EXPECT_EQ(what(scene, "samplers"),
              "Base colour: beyond its edge mirrored copies along v, enlarged texels are sharp squares.");
}

TEST(Marks, SecondTextureCoordinates) {
    Scene scene = plainScene();
    TextureSlot& slot = scene.materials[0].occlusion_texture;
    slot.texture = 0;
    slot.texcoord = 1;
    EXPECT_TRUE(what(scene, "second UV set").starts_with("Occlusion: laid out by TEXCOORD_1."));
    scene.meshes[0].primitives[0].texcoords[1].clear();
    EXPECT_TRUE(what(scene, "second UV set").starts_with("Occlusion: one texel all over"));
    scene.materials[0].occlusion_strength = 0;
    EXPECT_EQ(what(scene, "second UV set"), "");
}

TEST(Marks, NormalMapsSayWhoseTangents) {
    Scene scene = plainScene();
    scene.materials[0].normal_texture.texture = 0;
    EXPECT_NE(what(scene, "normal maps").find("the mesh's own tangents"), std::string::npos);
    scene.meshes[0].primitives[0].tangents_made = true;
    EXPECT_NE(what(scene, "normal maps").find("generated tangents"), std::string::npos);
}

TEST(Marks, WhiteVertexColoursShowNothing) {
    Scene scene = plainScene();
    std::vector<glm::vec4>& colors = scene.meshes[0].primitives[0].colors;
    colors.assign(4, glm::vec4(1));
    EXPECT_EQ(what(scene, "vertex colours"), "");
    colors[3].b = 0.5f;
    EXPECT_NE(what(scene, "vertex colours"), "");
}

// Alpha is factor x texel x vertex: 128 / 255 is just above a half.
TEST(Marks, MasksThatCutNothingOutSaySo) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.alpha_mode = AlphaMode::mask;
    m.base_color_texture.texture = 0;
    const auto cuts = [&] {
        return what(scene, "alpha masks").find("nothing is cut out") == std::string::npos;
    };
    EXPECT_FALSE(cuts());
    scene.images[0].rgba[3] = 128;
    EXPECT_FALSE(cuts());
    scene.images[0].rgba[3] = 127;
    EXPECT_TRUE(cuts());
    scene.images[0] = {"image", 1, 1, {}, {0, 0, 0, 32768}};
    EXPECT_FALSE(cuts());
    m.base_color.a = 0.9f;
    EXPECT_TRUE(cuts());
    m.alpha_cutoff = 0.4f;
    EXPECT_FALSE(cuts());
    scene.meshes[0].primitives[0].colors.assign(4, glm::vec4(1, 1, 1, 0.5f));
    EXPECT_TRUE(cuts());
}

TEST(Marks, MirroredPicturesNeedNotBeReadable) {
    Scene scene = plainScene();
    scene.materials[0].base_color_texture.texture = 0;
    EXPECT_EQ(featuresIn(scene), (std::set<std::string>{"orientation"}));
    scene.nodes[0].parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
    EXPECT_EQ(featuresIn(scene), (std::set<std::string>{"mirrored instances"}));
}

TEST(Marks, WhatIsDrawnOtherwise) {
    Scene scene = plainScene();
    scene.materials[0].alpha_mode = AlphaMode::blend;
    EXPECT_NE(what(scene, "blending").find("drawn opaque"), std::string::npos);

    scene = plainScene();
    scene.meshes[0].primitives[0].targets.resize(2);
    EXPECT_NE(what(scene, "morph targets").find("its 2 morph targets"), std::string::npos);

    scene = plainScene();
    scene.nodes[0].skin = 0;
    scene.skins.push_back({"skin", {0}, {glm::mat4(1)}});
    EXPECT_EQ(what(scene, "skins"), "") << "nothing of the mesh moves with it";
    scene.meshes[0].primitives[0].joint_sets.resize(1);
    EXPECT_NE(what(scene, "skins").find("bind pose"), std::string::npos);
}

TEST(Marks, FlatNormalsWhereTheyCanBeTold) {
    Scene scene = plainScene();
    Primitive& p = scene.meshes[0].primitives[0];
    p.flat = true;
    EXPECT_EQ(what(scene, "flat normals"), "") << "a plane looks the same with smooth ones";
    p.normals[0] = {1, 0, 0};
    EXPECT_NE(what(scene, "flat normals"), "");
}

TEST(Marks, DeepImagesByTheirSlot) {
    Scene scene = plainScene();
    scene.materials[0].metallic_roughness_texture.texture = 0;
    EXPECT_EQ(what(scene, "16 bit images"), "");
    scene.images[0] = {"image", 1, 1, {}, {1, 2, 3, 4}};
    EXPECT_EQ(what(scene, "16 bit images"),
              "Metallic-roughness: 16 bits a component. Gradients run without steps.");
}

// ---- names -------------------------------------------------------------------------------------------

TEST(Marks, PlacesAreNamedByWhatTheFileNames) {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    const auto mark = [&] { return marksIn(scene, viewOf()).at(0).marks.at(0); };
    scene.meshes[0].name.clear();
    EXPECT_EQ(mark().name, "mesh 0");
    EXPECT_EQ(mark().where, "material 0, mesh 0");
    scene.materials[0].name = "leaf";
    scene.meshes[0].name = "plane";
    scene.nodes[0].name = "tree";
    EXPECT_EQ(mark().name, "tree");
    EXPECT_EQ(mark().where, "material 0 \"leaf\", mesh 0 \"plane\", node \"tree\"");
    scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
    EXPECT_EQ(mark().name, "tree \u00b7 leaf");
}

TEST(Marks, LongNamesAreCutBetweenCharacters) {
    Scene scene = sceneOf(squareAt(0, 0, -2));
    scene.nodes[0].name = "x";
    for (int i = 0; i < 1000; ++i)
        scene.nodes[0].name += "\u00e9";  // of two bytes; the 60th byte is its second
    const std::string name = marksIn(scene, viewOf()).at(0).marks.at(0).name;
    std::string expected = "x";
    for (int i = 0; i < 29; ++i) expected += "\u00e9";
    EXPECT_EQ(name, expected + "...");
}

}  // namespace diptych
