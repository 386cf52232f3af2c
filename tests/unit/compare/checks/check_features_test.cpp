// SPDX-License-Identifier: MIT
// The scene features that a person must check by eye, and their descriptions.
#include "compare/checks/check_features.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/load.h"
#include "tests/support/checks_builder.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace diptych {

TEST(CheckFeatures, APlainSurfaceHasNone) {
    EXPECT_EQ(featuresIn(plainScene()), std::set<std::string>{});
}

TEST(CheckFeatures, BuiltinScenesHaveTheirs) {
    const std::vector<std::pair<const char*, std::vector<const char*>>> expected{
        {"vertex_colors", {"vertex colours", "texture transforms", "orientation"}},
        {"mirrored", {"mirrored instances", "normal maps"}},
        {"cutout", {"alpha masks", "double-sided surfaces", "normal maps"}},
        {"unlit_materials", {"unlit materials", "vertex colours"}},
        {"layers", {"clear coats", "anisotropy", "sheen", "iridescence", "normal maps"}},
        {"gallery", {"normal maps", "samplers"}}};
    for (const auto& [name, features] : expected) {
        const Scene scene = loadScene(std::string("builtin:") + name);
        const Pose pose = poseAt(scene, 0);
        std::set<std::string> found;
        for (const FeatureChecks& marks :
             visualChecksOf(scene, pose, makeView(scene, pose, "", 200, 100), nullptr, nullptr))
            found.emplace(marks.feature);
        for (const char* feature : features) EXPECT_TRUE(found.contains(feature)) << name << ": " << feature;
    }
}

TEST(CheckFeatures, AFrameShowsItsSceneAsItWasDrawn) {
    const Scene scene = sceneOf(squareAt(0, 0, -2));
    const SceneView view =
        makeSceneView(scene, {0, "eye=0,0,0 target=0,0,-1 fov=90 near=1", 200, 100, "", 0});
    Frame frame;
    EXPECT_EQ(boxesOf(visualChecksOf(scene, view, frame)), (Boxes{{75, 25, 125, 75}}));
    frame.channels[Channel::material_id] = Image(200, 100, 1, -1);
    EXPECT_EQ(boxesOf(visualChecksOf(scene, view, frame)), Boxes{});
}

// The matrix of KHR_texture_transform.
TEST(CheckFeatures, TextureTransformsAreToldByTheFilesNumbers) {
    Scene scene = plainScene();
    const auto transformed = [&](double x, double y, double degrees, double sx, double sy) {
        const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
        TextureSlot slot;
        slot.texture = 0;
        slot.u = {c * sx, s * sy, x};
        slot.v = {-s * sx, c * sy, y};
        return slot;
    };
    const std::string tail = ". Arrows, frames and seams in the texture are in the right place.";
    Material& m = scene.materials[0];
    const auto told = [&] { return what(scene, "texture transforms"); };
    m.base_color_texture = transformed(0.5, -0.25, 0, 1, 1);
    EXPECT_EQ(told(), "Base colour: offset 0.5 -0.25" + tail);
    m.base_color_texture = transformed(0, 0, 30, 1, 1);
    EXPECT_EQ(told(), "Base colour: rotated 30\u00b0" + tail);
    m.base_color_texture = transformed(0.5, 0, -30, 2, 3);
    EXPECT_EQ(told(), "Base colour: offset 0.5 0, rotated -30\u00b0, scaled 2 \u00d7 3" + tail);
    m.base_color_texture = transformed(0, 0, 60, 2, 3);
    EXPECT_EQ(told(), "Base colour: rotated 60\u00b0, scaled 2 \u00d7 3" + tail);
    m.base_color_texture = transformed(0, -0.5, 60, 2, -3);
    EXPECT_EQ(told(), "Base colour: offset 0 -0.5, rotated 60\u00b0, scaled 2 \u00d7 -3" + tail);
    m.base_color_texture = transformed(0, 0, 0, -1, 1);
    EXPECT_EQ(told(), "Base colour: rotated 180\u00b0, scaled 1 \u00d7 -1" + tail) << "which is the same";
    m.base_color_texture = m.normal_texture = transformed(0, 0, 0, 2, 2);
    m.emissive_texture = transformed(1, 0, 0, 1, 1);
    m.emissive = glm::vec3(1);
    EXPECT_EQ(told(), "Base colour and normal: scaled 2 \u00d7 2; emission: offset 1 0" + tail);
    m.emissive = glm::vec3(0);
    EXPECT_EQ(told(), "Base colour and normal: scaled 2 \u00d7 2" + tail)
        << "nothing reads the emissive slot";
}

// A wrap mode is only visible where a texture coordinate exceeds the edge.
TEST(CheckFeatures, SamplersAreToldWhereTheyShow) {
    Scene scene = plainScene();
    TextureSlot& slot = scene.materials[0].base_color_texture;
    slot.texture = 0;
    Sampler& sampler = scene.textures[0].sampler;
    sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;
    EXPECT_EQ(what(scene, "samplers"), "");
    slot.u.x = 2;
    EXPECT_EQ(what(scene, "samplers"), "Base colour: stripes of its edge texels beyond its edge along u.");
    slot.v.y = 2;
    EXPECT_EQ(what(scene, "samplers"),
              "Base colour: stripes of its edge texels beyond its edge along u and v.");
    // From 0.5 to 0.75, then up to or down from an edge, in either direction.
    const auto seen = [&](double u, double v) {
        slot = {0, 0, {0.25, 0, u}, {0, 0.25, v}};
        return what(scene, "samplers");
    };
    const std::string along = "Base colour: stripes of its edge texels beyond its edge along ";
    EXPECT_EQ(seen(0.5, 0.5), "");
    EXPECT_EQ(seen(0.75, 0), "") << "up to both edges";
    EXPECT_EQ(seen(-0.125, 0.5), along + "u.");
    EXPECT_EQ(seen(0.875, 0.5), along + "u.");
    EXPECT_EQ(seen(0.5, -0.125), along + "v.");
    EXPECT_EQ(seen(0.5, 0.875), along + "v.");
    slot = {0, 0, {1, 0, 2}, {0, 2, 0}};
    sampler.wrap_s = Wrap::repeat;
    sampler.wrap_t = Wrap::mirrored_repeat;
    sampler.magnify_linear = false;
    EXPECT_EQ(what(scene, "samplers"),
              "Base colour: mirrored copies beyond its edge along v, enlarged texels are sharp squares.");
}

TEST(CheckFeatures, SecondTextureCoordinates) {
    Scene scene = plainScene();
    TextureSlot& slot = scene.materials[0].occlusion_texture;
    slot.texture = 0;
    slot.texcoord = 1;
    EXPECT_TRUE(what(scene, "second UV set").starts_with("Occlusion: laid out by TEXCOORD_1."));
    scene.meshes[0].primitives[0].texcoords[1].clear();
    EXPECT_TRUE(what(scene, "second UV set").starts_with("Occlusion: one texel everywhere"));
    scene.materials[0].occlusion_strength = 0;
    EXPECT_EQ(what(scene, "second UV set"), "");
}

TEST(CheckFeatures, NormalMapsSayWhoseTangents) {
    Scene scene = plainScene();
    scene.materials[0].normal_texture.texture = 0;
    EXPECT_NE(what(scene, "normal maps").find("the mesh's own tangents"), std::string::npos);
    scene.meshes[0].primitives[0].tangents_made = true;
    EXPECT_NE(what(scene, "normal maps").find("generated tangents"), std::string::npos);
}

TEST(CheckFeatures, LayersOfLitMaterials) {
    Scene scene = plainScene();
    scene.materials[0].clearcoat = scene.materials[0].anisotropy = 0.5f;
    EXPECT_NE(what(scene, "clear coats").find("clear coat reflects"), std::string::npos);
    EXPECT_NE(what(scene, "anisotropy").find("the mesh's own tangents"), std::string::npos);
    scene.meshes[0].primitives[0].tangents_made = true;
    EXPECT_NE(what(scene, "anisotropy").find("generated tangents"), std::string::npos);
    EXPECT_EQ(what(scene, "sheen"), "");
    scene.materials[0].sheen_color = {0, 0.5f, 0};
    EXPECT_NE(what(scene, "sheen").find("soft sheen"), std::string::npos);
    EXPECT_EQ(what(scene, "iridescence"), "");
    scene.materials[0].iridescence = 0.5f;
    EXPECT_NE(what(scene, "iridescence").find("thin film"), std::string::npos);
    EXPECT_EQ(what(scene, "transmission"), "");
    scene.materials[0].transmission = 0.5f;
    EXPECT_NE(what(scene, "transmission").find("show through in place"), std::string::npos);
    scene.materials[0].thickness = 0.1f;
    EXPECT_NE(what(scene, "transmission").find("bent as by a lens"), std::string::npos);
    EXPECT_EQ(what(scene, "diffuse transmission"), "");
    scene.materials[0].diffuse_transmission = 0.5f;
    EXPECT_NE(what(scene, "diffuse transmission").find("Light from behind"), std::string::npos);
    scene.materials[0].unlit = true;
    for (const char* layer :
         {"clear coats", "anisotropy", "sheen", "iridescence", "transmission", "diffuse transmission"})
        EXPECT_EQ(what(scene, layer), "") << layer;
}

TEST(CheckFeatures, TexturesOfLayersAreToldByName) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.sheen_color = {1, 1, 1};
    m.iridescence = 1;
    for (const auto& [slot, name] : {std::pair{&Material::sheen_color_texture, "Sheen colour: "},
                                     {&Material::sheen_roughness_texture, "Sheen roughness: "},
                                     {&Material::iridescence_texture, "Iridescence: "},
                                     {&Material::iridescence_thickness_texture, "Film thickness: "}}) {
        m.*slot = {0, 1, {1, 0, 0}, {0, 1, 0}};
        EXPECT_TRUE(what(scene, "second UV set").starts_with(name)) << name;
        m.*slot = {};
    }
}

TEST(CheckFeatures, WhiteVertexColoursShowNothing) {
    Scene scene = plainScene();
    std::vector<glm::vec4>& colors = scene.meshes[0].primitives[0].colors;
    colors.assign(4, glm::vec4(1));
    EXPECT_EQ(what(scene, "vertex colours"), "");
    colors[3].b = 0.5f;
    EXPECT_NE(what(scene, "vertex colours"), "");
}

// alpha = factor x texel x vertex colour: 128 / 255 is just above one half
TEST(CheckFeatures, MasksThatCutNothingOutSaySo) {
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
    scene.images[0] = {"image", 2, 1, {}, {}, {0, 0, 0, 2, 0, 0, 0, 0.49f}};
    EXPECT_TRUE(cuts());
    scene.images[0] = {"image", 2, 1, {}, {}, {0, 0, 0, 2, 0, 0, 0, 0.5f}};
    EXPECT_FALSE(cuts());
    m.base_color.a = 0.9f;
    EXPECT_TRUE(cuts());
    m.alpha_cutoff = 0.4f;
    EXPECT_FALSE(cuts());
    scene.meshes[0].primitives[0].colors.assign(4, glm::vec4(1, 1, 0, 1));
    scene.meshes[0].primitives[0].colors[2] = glm::vec4(1, 1, 1, 0.5f);
    EXPECT_TRUE(cuts());
}

TEST(CheckFeatures, MirroredImagesNeedNotBeReadable) {
    Scene scene = plainScene();
    scene.materials[0].base_color_texture.texture = 0;
    EXPECT_EQ(featuresIn(scene), (std::set<std::string>{"orientation"}));
    scene.nodes[0].parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
    EXPECT_EQ(featuresIn(scene), (std::set<std::string>{"mirrored instances"}));
}

TEST(CheckFeatures, BlendingShowsWhatIsBehindUnlessAlphaIsOne) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.alpha_mode = AlphaMode::blend;
    m.base_color_texture.texture = 0;
    const auto isTransparent = [&] {
        const std::string sentence = what(scene, "blending");
        EXPECT_NE(sentence, "");
        return sentence.starts_with("Transparent: ");
    };
    EXPECT_FALSE(isTransparent());
    scene.images[0].rgba[3] = 254;
    EXPECT_TRUE(isTransparent());
    scene.images[0] = {"image", 1, 1, {}, {}, {0, 0, 0, 1}};
    EXPECT_FALSE(isTransparent());
    scene.images[0].rgba32[3] = 0.99f;
    EXPECT_TRUE(isTransparent());
    scene.images[0].rgba32[3] = 1;
    m.transmission = 0.5f;
    EXPECT_TRUE(isTransparent());
    m.unlit = true;
    EXPECT_FALSE(isTransparent()) << "transmission has no effect";
    m.base_color.a = 0.5f;
    EXPECT_TRUE(isTransparent());
}

TEST(CheckFeatures, MorphTargetsDeformUnlessTheirWeightsAreZero) {
    Scene scene = plainScene();
    Mesh& mesh = scene.meshes[0];
    mesh.primitives[0].targets.resize(2);
    mesh.weights = {0, 0};
    EXPECT_EQ(what(scene, "morph targets"),
              "Its 2 morph targets have weight 0 at this time: the mesh as modelled.");
    mesh.weights = {0, 0.5f};
    for (MorphTarget& target : mesh.primitives[0].targets) target.positions.resize(4);
    EXPECT_EQ(what(scene, "morph targets"), "Deformed by its 2 morph targets: no vertex is out of place.");
}

TEST(CheckFeatures, SkinsWhereJointsMoveTheMesh) {
    Scene scene = plainScene();
    scene.nodes[0].skin = 0;
    scene.skins.push_back({"skin", {0}, {glm::mat4(1)}});
    EXPECT_EQ(what(scene, "skins"), "") << "no vertex has a joint";
    const std::size_t count = scene.meshes[0].primitives[0].positions.size();
    scene.meshes[0].primitives[0].joint_sets = {
        {std::vector<glm::u16vec4>(count, glm::u16vec4(0)), std::vector<glm::vec4>(count, {1, 0, 0, 0})}};
    EXPECT_TRUE(what(scene, "skins").starts_with("Follows its joints: "));
}

TEST(CheckFeatures, FlatNormalsWhereTheyCanBeTold) {
    Scene scene = plainScene();
    Primitive& p = scene.meshes[0].primitives[0];
    p.flat = true;
    EXPECT_EQ(what(scene, "flat normals"), "") << "a plane looks the same with smooth ones";
    p.normals[0] = {1, 0, 0};
    EXPECT_NE(what(scene, "flat normals"), "");
}

TEST(CheckFeatures, DeepImagesByTheirSlot) {
    Scene scene = plainScene();
    scene.materials[0].metallic_roughness_texture.texture = 0;
    EXPECT_EQ(what(scene, "images with more than 8 bits"), "");
    scene.images[0] = {"image", 1, 1, {}, {1, 2, 3, 4}};
    EXPECT_EQ(what(scene, "images with more than 8 bits"),
              "Metallic-roughness: more than 8 bits per component. Gradients run without steps.");
}

}  // namespace diptych
