// SPDX-License-Identifier: MIT
// KHR_animation_pointer: animated properties, and ranges.
#include "shared/scene/model/animated.h"
#include "shared/scene/motion/pose.h"
#include "shared/scene/requirements.h"
#include "tests/support/layer_table.h"
#include "tests/unit/shared/scene/gltf/pointer_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace diptych {
namespace {

using Json = nlohmann::json;

const Material& materialAt(const Scene& scene, const Pose& pose) {
    return materialsOf(scene, pose).at(0);
}

// ---- every property ----------------------------------------------------------------------------------

// Each is animated alone, from 0.25 to 0.75: at half a second every component is 0.5.
TEST(GltfAnimationPointer, MovesEveryPropertyThatIsModelled) {
    using Read = std::function<std::vector<double>(const Scene&, const Pose&)>;
    const auto material = [](auto member) {
        return [member](const Scene& s, const Pose& p) {
            return std::vector<double>{static_cast<double>(materialAt(s, p).*member)};
        };
    };
    const auto rgb = [](const glm::vec3& c) { return std::vector<double>{c.r, c.g, c.b}; };
    const std::string lights = "/extensions/KHR_lights_punctual/lights/0/", m = "/materials/0/";
    std::vector<std::tuple<std::string, std::size_t, Read>> cases{
        {"/nodes/0/translation", 3,
         [](const Scene&, const Pose& p) {
             const glm::dmat4& w = p.instances.at(0).world_from_object;
             return std::vector<double>{w[3].x, w[3].y, w[3].z};
         }},
        {"/nodes/0/scale", 3,
         [](const Scene&, const Pose& p) {
             const glm::dmat4& w = p.instances.at(0).world_from_object;
             return std::vector<double>{w[0].x, w[1].y, w[2].z};
         }},
        {"/nodes/0/weights", 2, [](const Scene&, const Pose& p) { return p.weights.at(0); }},
        {"/meshes/0/weights", 2, [](const Scene&, const Pose& p) { return p.weights.at(0); }},
        {lights + "color", 3, [&](const Scene&, const Pose& p) { return rgb(p.lights.at(1).color); }},
        {lights + "intensity", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.lights.at(1).intensity}; }},
        {lights + "range", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.lights.at(2).range}; }},
        {lights + "spot/outerConeAngle", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.lights.at(2).outer_cone}; }},
        {"/cameras/0/perspective/yfov", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.cameras.at(0).yfov}; }},
        {"/cameras/0/perspective/aspectRatio", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.cameras.at(0).aspect}; }},
        {"/cameras/0/perspective/znear", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.cameras.at(0).near}; }},
        {"/cameras/1/orthographic/ymag", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.cameras.at(1).ymag}; }},
        {"/cameras/1/orthographic/xmag", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.cameras.at(1).xmag}; }},
        {"/cameras/1/orthographic/znear", 1,
         [](const Scene&, const Pose& p) { return std::vector<double>{p.cameras.at(1).near}; }},
        {m + "pbrMetallicRoughness/baseColorFactor", 4,
         [](const Scene& s, const Pose& p) {
             const glm::vec4& c = materialAt(s, p).base_color;
             return std::vector<double>{c.r, c.g, c.b, c.a};
         }},
        {m + "pbrMetallicRoughness/metallicFactor", 1, material(&Material::metallic)},
        {m + "pbrMetallicRoughness/roughnessFactor", 1, material(&Material::roughness)},
        {m + "normalTexture/scale", 1, material(&Material::normal_scale)},
        {m + "occlusionTexture/strength", 1, material(&Material::occlusion_strength)},
        {m + "emissiveFactor", 3,
         [&](const Scene& s, const Pose& p) { return rgb(materialAt(s, p).emissive); }},
        {m + "alphaCutoff", 1, material(&Material::alpha_cutoff)},
        {m + "extensions/KHR_materials_specular/specularFactor", 1, material(&Material::specular)},
        {m + "extensions/KHR_materials_specular/specularColorFactor", 3,
         [&](const Scene& s, const Pose& p) { return rgb(materialAt(s, p).specular_color); }},
        {m + "extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", 1,
         material(&Material::clearcoat_normal_scale)},
    };
    for (const TestedLayer& layer : testedLayers())
        for (const LayerFactor& f : layer.factors)
            if (f.min < 0.25)
                cases.emplace_back(fmt::format("{}extensions/KHR_materials_{}/{}", m, f.extension, f.key),
                                   f.width(), [&rgb, f](const Scene& s, const Pose& p) {
                                       std::vector<double> numbers = rgb(f.of(materialAt(s, p)));
                                       numbers.resize(f.width());
                                       return numbers;
                                   });
    for (const auto& [pointer, width, read] : cases) {
        PointerFile f;
        std::vector<float> values(2 * width, 0.25f);
        std::fill(values.begin() + static_cast<std::ptrdiff_t>(width), values.end(), 0.75f);
        f.channel(pointer, values);
        const Scene scene = f.load();
        ASSERT_EQ(scene.animations.size(), 1u) << pointer << (scene.notes.empty() ? "" : scene.notes[0]);
        for (const auto& [seconds, value] : {std::pair{0.0, 0.25}, {0.5, 0.5}, {1e6, 0.75}})
            EXPECT_EQ(read(scene, poseAt(scene, seconds)), std::vector<double>(width, value))
                << pointer << " at " << seconds;
        EXPECT_FALSE(mentions(scene.notes, "animation")) << pointer;
    }
}

TEST(GltfAnimationPointer, RestIsAsTheFileSays) {
    PointerFile f;
    f.channel("/materials/0/alphaCutoff", {0.25f, 0.75f});
    const Scene scene = f.load();
    Material moved = poseAt(scene, 0.5).materials.at(0);
    const Material& rest = scene.materials[0];
    EXPECT_EQ(moved.alpha_cutoff, 0.5f);
    EXPECT_EQ(moved.base_color, rest.base_color);
    EXPECT_EQ(moved.emissive, rest.emissive);
    EXPECT_EQ(moved.normal_texture.u, rest.normal_texture.u);
    EXPECT_EQ(rest.alpha_cutoff, 0.5f) << "the default";
    PointerFile still;
    still.channel("/nodes/0/translation", {0, 0, 0, 1, 1, 1});
    EXPECT_TRUE(poseAt(still.load(), 0.5).materials.empty()) << "nothing of a material moves";
}

TEST(GltfAnimationPointer, RotationsTakeTheShortArc) {
    PointerFile f;
    const float s = static_cast<float>(std::sin(std::numbers::pi / 4));
    f.channel("/nodes/0/rotation", {0, 0, 0, 1, 0, 0, -s, -s});  // 90 degrees, with opposite sign
    const glm::dmat4 w = poseAt(f.load(), 0.5).instances.at(0).world_from_object;
    EXPECT_NEAR(w[0].x, std::sqrt(0.5), 1e-7);
    EXPECT_NEAR(w[0].y, std::sqrt(0.5), 1e-7) << "45 degrees, not -135";
}

// Factor and strength may be animated separately; the file's value is used for the other.
TEST(GltfAnimationPointer, EmissionIsFactorTimesStrength) {
    const auto at = [](const std::function<void(PointerFile&)>& change) {
        PointerFile f;
        f.json["materials"][0]["emissiveFactor"] = {1, 0.5, 0};
        f.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 8;
        change(f);
        const Scene scene = f.load();
        return poseAt(scene, 1).materials.at(0).emissive;
    };
    const std::string strength = "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength";
    const auto factor = [](PointerFile& f) {
        f.channel("/materials/0/emissiveFactor", {0, 0, 0, 0.5f, 1, 0.25f});
    };
    EXPECT_EQ(at(factor), glm::vec3(4, 8, 2));
    EXPECT_EQ(at([&](PointerFile& f) { f.channel(strength, {0, 2}); }), glm::vec3(2, 1, 0));
    EXPECT_EQ(at([&](PointerFile& f) {
                  f.channel(strength, {0, 2});
                  factor(f);
              }),
              glm::vec3(1, 2, 0.5f));
}

// Offset, rotation and scale combine as in KHR_texture_transform, whichever are animated.
TEST(GltfAnimationPointer, TextureTransformsOfEverySlot) {
    std::vector<std::pair<std::string, TextureSlot Material::*>> slots{
        {"pbrMetallicRoughness/baseColorTexture", &Material::base_color_texture},
        {"pbrMetallicRoughness/metallicRoughnessTexture", &Material::metallic_roughness_texture},
        {"normalTexture", &Material::normal_texture},
        {"occlusionTexture", &Material::occlusion_texture},
        {"emissiveTexture", &Material::emissive_texture},
        {"extensions/KHR_materials_specular/specularTexture", &Material::specular_texture},
        {"extensions/KHR_materials_specular/specularColorTexture", &Material::specular_color_texture}};
    for (const TestedLayer& layer : testedLayers())
        for (const LayerTexture& t : layer.textures)
            slots.emplace_back(fmt::format("extensions/KHR_materials_{}/{}", t.extension, t.key),
                               materialSlots[t.slot].texture);
    for (const auto& [slot, member] : slots) {
        const std::string at = fmt::format("/materials/0/{}/extensions/KHR_texture_transform/", slot);
        PointerFile f;
        Json& info = f.json.at(Json::json_pointer(fmt::format("/materials/0/{}", slot)));
        info["extensions"]["KHR_texture_transform"] = {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}};
        f.channel(at + "rotation", {0, static_cast<float>(std::numbers::pi)});
        const Scene scene = f.load();
        const TextureSlot turned = poseAt(scene, 0.5).materials.at(0).*member;
        // Rotation by 90 degrees: u' = sin * scale.y * v + offset.x, v' = -sin * scale.x * u + offset.y.
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(turned.u[c], glm::dvec3(0, 3, 0.5)[c], 1e-6) << slot;
            EXPECT_NEAR(turned.v[c], glm::dvec3(-2, 0, 0.25)[c], 1e-6) << slot;
        }
        f.channel(at + "offset", {0, 0, 1, 2}).channel(at + "scale", {1, 1, 5, 7});
        const Scene all = f.load();
        const TextureSlot moved = poseAt(all, 0.5).materials.at(0).*member;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(moved.u[c], glm::dvec3(0, 4, 0.5)[c], 1e-6) << slot;
            EXPECT_NEAR(moved.v[c], glm::dvec3(-3, 0, 1)[c], 1e-6) << slot;
        }
    }
}

TEST(GltfAnimationPointer, OneWeightLeavesTheOthers) {
    PointerFile f;
    f.channel("/nodes/0/weights/1", {0, 4});
    EXPECT_EQ(poseAt(f.load(), 0.5).weights.at(0), (std::vector<double>{0.5, 2})) << "the mesh's at rest";
    f.json["nodes"][0]["weights"] = {7, 8};
    EXPECT_EQ(poseAt(f.load(), 0.5).weights.at(0), (std::vector<double>{7, 2})) << "the node's own at rest";
    PointerFile mesh;
    mesh.channel("/meshes/0/weights/0", {0, 4});
    EXPECT_EQ(poseAt(mesh.load(), 0.5).weights.at(0), (std::vector<double>{2, 0.25}));
    mesh.json["nodes"][0]["weights"] = {7, 8};
    EXPECT_EQ(poseAt(mesh.load(), 0.5).weights.at(0), (std::vector<double>{7, 8}))
        << "the node's own replace it";
}

// The file's light is on two nodes, so it is two lights of the scene.
TEST(GltfAnimationPointer, EveryNodeOfALightShowsItsMotion) {
    PointerFile f;
    f.channel("/extensions/KHR_lights_punctual/lights/0/intensity", {0, 8});
    const Pose pose = poseAt(f.load(), 0.5);
    ASSERT_EQ(pose.lights.size(), 3u);
    EXPECT_EQ(pose.lights[0].kind, LightKind::directional);
    EXPECT_EQ(pose.lights[0].intensity, 1);
    EXPECT_EQ(pose.lights[1].intensity, 4);
    EXPECT_EQ(pose.lights[2].intensity, 4);
}

TEST(GltfAnimationPointer, LaterAnimationsWin) {
    PointerFile f;
    f.channel("/materials/0/alphaCutoff", {0, 1})
        .channel("/materials/0/pbrMetallicRoughness/metallicFactor", {1, 0});
    const Json first = f.json["animations"][0];
    f.json["animations"].erase(0);
    f.channel("/materials/0/alphaCutoff", {3, 3});
    f.json["animations"].insert(f.json["animations"].begin(), first);
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 0.5).materials.at(0).alpha_cutoff, 3);
    EXPECT_EQ(poseAt(scene, 0.5).materials[0].metallic, 0.5f);
    EXPECT_EQ(poseAt(scene, 0.5, "0").materials.at(0).alpha_cutoff, 0.5f);
    EXPECT_EQ(poseAt(scene, 0.5, "1").materials.at(0).metallic, 1);
}

// Integers are taken as they are, normalized ones as fractions of the largest.
TEST(GltfAnimationPointer, ValuesMayBeIntegers) {
    PointerFile f;
    const std::string intensity = "/extensions/KHR_lights_punctual/lights/0/intensity";
    f.channelTo(intensity, f.accessor<std::uint16_t>({0, 200}, USHORT, "SCALAR", 1));
    f.channelTo("/materials/0/alphaCutoff", f.accessor<std::uint16_t>({0, 65535}, USHORT, "SCALAR", 1, true));
    const Scene scene = f.load();
    EXPECT_EQ(poseAt(scene, 1).lights.at(1).intensity, 200);
    EXPECT_EQ(poseAt(scene, 0.5).materials.at(0).alpha_cutoff, 0.5f);
}

// ---- ranges ------------------------------------------------------------------------------------------

// A spline from 0 to 1 with steep tangents exceeds both ends; values are clamped there.
TEST(GltfAnimationPointer, SplinesAreHeldWithinTheRange) {
    PointerFile f;
    const std::vector<float> steep{0, 0, -20, -20, 1, 0};  // below 0 first, then above 1
    f.channel("/materials/0/pbrMetallicRoughness/metallicFactor", steep, "CUBICSPLINE");
    f.channel("/extensions/KHR_lights_punctual/lights/0/intensity", steep, "CUBICSPLINE");
    f.channel("/extensions/KHR_lights_punctual/lights/0/range", {0, 0.5f, -20, -20, 1, 0}, "CUBICSPLINE");
    const Scene scene = f.load();
    const Pose low = poseAt(scene, 0.25), high = poseAt(scene, 0.75);
    EXPECT_EQ(low.materials.at(0).metallic, 0);
    EXPECT_EQ(high.materials.at(0).metallic, 1);
    EXPECT_EQ(low.lights.at(1).intensity, 0);
    EXPECT_GT(high.lights.at(1).intensity, 1);
    EXPECT_FLOAT_EQ(low.lights.at(1).range, 1e-6f);
    EXPECT_FALSE(mentions(scene.notes, "outside")) << "its keys are valid";
}

TEST(GltfAnimationPointer, KeysBeyondTheRangeAreNoted) {
    PointerFile f;
    f.channel("/materials/0/pbrMetallicRoughness/roughnessFactor", {0.5f, 3});
    f.channel("/materials/0/extensions/KHR_materials_ior/ior", {0.5f, 2});
    const Scene scene = f.load();
    EXPECT_TRUE(
        mentions(scene.notes, "animation 0: channel 0: 3 is outside 0 to 1: the nearest value is used"));
    EXPECT_TRUE(mentions(scene.notes, "animation 0: channel 1: ior 0.5 is not 0 or at least 1"));
    EXPECT_EQ(poseAt(scene, 1).materials.at(0).roughness, 1);
    EXPECT_EQ(poseAt(scene, 0).materials.at(0).ior, 1);
    EXPECT_EQ(poseAt(scene, 1).materials.at(0).ior, 2);
    PointerFile endless;
    endless.channel("/materials/0/extensions/KHR_materials_ior/ior", {1, 1e30f});
    EXPECT_EQ(poseAt(endless.load(), 1).materials.at(0).ior, 1e12f);
}

TEST(GltfAnimationPointer, FilmsStayWithinTheirRange) {
    const std::string film = "/materials/0/extensions/KHR_materials_iridescence/iridescence";
    PointerFile f;
    f.channel(film + "Ior", {0.5f, 2}).channel(film + "ThicknessMaximum", {-1, 70000});
    const Scene scene = f.load();
    const Material first = poseAt(scene, 0).materials.at(0), last = poseAt(scene, 1).materials.at(0);
    EXPECT_EQ(first.iridescence_ior, 1);
    EXPECT_EQ(last.iridescence_ior, 2);
    EXPECT_EQ(first.iridescence_thickness_max, 0);
    EXPECT_EQ(last.iridescence_thickness_max, 65504);
    EXPECT_TRUE(mentions(scene.notes, "channel 1: -1 is outside 0 to 65504: the nearest value is used"));
}

TEST(GltfAnimationPointer, ConesAndPlanesStayInOrder) {
    PointerFile f;
    f.channel("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", {0.5f, 0.0625f});
    f.channel("/cameras/0/perspective/znear", {0.5f, 20}).channel("/cameras/1/orthographic/znear", {0, 20});
    const Scene scene = f.load();
    const Pose pose = poseAt(scene, 1);
    EXPECT_EQ(pose.lights.at(1).outer_cone, 0.0625f);
    EXPECT_EQ(pose.lights[1].inner_cone, 0.0625f) << "at most the outer one";
    EXPECT_EQ(pose.cameras.at(0).near, 20);
    EXPECT_TRUE(std::isinf(pose.cameras[0].far));
    EXPECT_GT(pose.cameras.at(1).far, 20);
    EXPECT_LT(pose.cameras[1].far, 20.001);
    EXPECT_EQ(poseAt(scene, 0).cameras.at(1).near, 0);
}

// ---- factors that switch on a feature ----------------------------------------------------------------

TEST(GltfAnimationPointer, WhatAFactorSwitchesOnIsNeeded) {
    PointerFile f;
    f.json["materials"][0].erase("emissiveTexture");
    f.channel("/materials/0/emissiveFactor", {0, 0, 0, 0.5f, 0.25f, 0});
    f.channel("/materials/0/extensions/KHR_materials_transmission/transmissionFactor", {0, 1});
    f.channel("/materials/0/normalTexture/scale", {0, 1});
    f.channel("/materials/0/normalTexture/extensions/KHR_texture_transform/offset", {0, 0, 1, 0});
    const Scene scene = f.load();
    const Requirements start = requirements(scene, poseAt(scene, 0)),
                       end = requirements(scene, poseAt(scene, 1));
    EXPECT_FALSE(start.emission || start.rough_glass || start.normal_maps || start.texture_transform);
    EXPECT_TRUE(end.emission && end.rough_glass && end.normal_maps && end.texture_transform);
    EXPECT_EQ(end.max_emission, 0.5f);
    EXPECT_EQ(materialsThatBlend(scene), (std::vector<bool>{true}));
    EXPECT_EQ(start.layers, 0u);
    EXPECT_EQ(end.layers, gpu::LAYER_TRANSMISSION);
}

}  // namespace
}  // namespace diptych
