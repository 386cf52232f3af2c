// SPDX-License-Identifier: MIT
// KHR_animation_pointer: pointers that are left out or ignored.
#include "shared/scene/motion/pose.h"
#include "tests/unit/shared/scene/gltf/pointer_file.h"

#include <functional>
#include <tuple>
#include <utility>

namespace diptych {
namespace {

using Json = nlohmann::json;

TEST(GltfAnimationPointer, FaultyPointersAreLeftOut) {
    const std::string nothing = "names a property that cannot be animated here";
    const std::pair<std::string, std::string> cases[] = {
        {"", nothing},
        {"/", nothing},
        {"nodes/0/scale", nothing},
        {"/nodes/0", nothing},
        {"/nodes/0/scale/", nothing},
        {"/nodes/0/scale/0", nothing},
        {"/nodes/-1/scale", nothing},
        {"/nodes/00/scale", nothing},
        {"/nodes/+0/scale", nothing},
        {"/nodes//scale", nothing},
        {"/nodes/99999999999999999999/scale", nothing},
        {"/nodes/0/matrix", nothing},
        {"/materials/0/extensions/KHR_materials_unlit/unlit", nothing},
        {"/materials/0/doubleSided", nothing},
        {"/materials/0/extras/a", nothing},
        {"/nodes/3/scale", "the file has 3"},
        {"/materials/1/alphaCutoff", "the file has 1"},
        {"/meshes/0/weights/2", "the mesh has 2 morph targets"},
        {"/cameras/0/orthographic/znear", "the camera is perspective"},
        {"/cameras/0/orthographic/xmag", "the camera is perspective"},
        {"/cameras/1/perspective/yfov", "the camera is orthographic"},
    };
    for (const auto& [pointer, fault] : cases) {
        PointerFile f;
        f.channel(pointer, {0, 1});
        const Scene scene = f.load();
        EXPECT_TRUE(scene.animations.empty()) << pointer;
        EXPECT_TRUE(mentions(scene.notes, fault)) << pointer;
        EXPECT_TRUE(mentions(scene.notes, "animation 0: 1 of 1 channels left out: channel 0: pointer"))
            << pointer;
    }
    const std::tuple<const char*, const char*, std::function<void(PointerFile&)>> changed[] = {
        {"/cameras/0/perspective/zfar", "the camera has no zfar", erases("/cameras/0/perspective", "zfar")},
        {"/cameras/0/perspective/aspectRatio", "the camera has no aspectRatio",
         erases("/cameras/0/perspective", "aspectRatio")},
        {"/extensions/KHR_lights_punctual/lights/0/range", "the light has no range",
         erases("/extensions/KHR_lights_punctual/lights/0", "range")},
        {"/materials/0/normalTexture/scale", "the material has no such texture",
         erases("/materials/0", "normalTexture")}};
    for (const auto& [pointer, fault, change] : changed) {
        PointerFile f;
        change(f);
        f.channel(pointer, {1, 2});
        EXPECT_TRUE(mentions(f.load().notes, fault)) << pointer;
    }
}

TEST(GltfAnimationPointer, OutputsFitWhatTheyMove) {
    PointerFile f;
    f.channelTo("/materials/0/alphaCutoff", f.accessor<float>({0, 0, 0, 1, 1, 1}, FLOAT, "VEC3", 3));
    EXPECT_TRUE(mentions(f.load().notes, "is not SCALAR"));
    PointerFile g;
    g.channelTo("/materials/0/alphaCutoff", g.accessor<float>({0, 0, 0, 1}, FLOAT, "SCALAR", 1));
    EXPECT_TRUE(mentions(g.load().notes, "4 elements for 2 keys"));
    PointerFile h;
    h.channel("/nodes/0/weights", {0, 0, 0, 1, 1, 1});
    EXPECT_TRUE(mentions(h.load().notes, "3 weights per key, but node 0 has 2 morph targets"));
}

// By two pointers, by a pointer and a plain target, or by an array and its element.
TEST(GltfAnimationPointer, OneAnimationMovesNothingTwice) {
    const std::pair<const char*, const char*> cases[] = {{"/nodes/0/weights", "/nodes/0/weights"},
                                                         {"/nodes/0/weights", "/nodes/0/weights/1"},
                                                         {"/nodes/0/weights/1", "/nodes/0/weights"},
                                                         {"/meshes/0/weights/1", "/meshes/0/weights/1"},
                                                         {"/meshes/0/weights/0", "/meshes/0/weights"}};
    for (const auto& [first, second] : cases) {
        PointerFile f;
        for (const std::string pointer : {first, second})
            f.channel(pointer, pointer.ends_with("weights") ? std::vector<float>{0, 0, 1, 1}
                                                            : std::vector<float>{0, 1});
        const Scene scene = f.load();
        EXPECT_EQ(scene.animations.at(0).channels.size(), 1u) << first << " " << second;
        EXPECT_TRUE(mentions(scene.notes, "an earlier channel already animates")) << first << second;
    }
    PointerFile elements;
    elements.channel("/nodes/0/weights/0", {0, 1}).channel("/nodes/0/weights/1", {0, 1});
    EXPECT_EQ(elements.load().animations.at(0).channels.size(), 2u);
    PointerFile plain;
    plain.channel("/nodes/0/translation", {0, 0, 0, 1, 1, 1});
    Json second = plain.json["animations"][0]["channels"][0];
    second["target"] = {{"node", 0}, {"path", "translation"}};
    plain.json["animations"][0]["channels"].push_back(second);
    EXPECT_TRUE(mentions(plain.load().notes, "an earlier channel already animates node 0"));
}

// Only the path "pointer" has one; another path moves its node, and without a node nothing.
TEST(GltfAnimationPointer, OnOtherPathsIsIgnored) {
    PointerFile f;
    f.channel("/nodes/1/translation", {0, 0, 0, 1, 1, 1});
    f.json["animations"][0]["channels"][0]["target"]["path"] = "translation";
    EXPECT_TRUE(f.load().animations.empty());
}

// An unlit material only shows its base colour, and a sun has no cone: such channels change nothing.
TEST(GltfAnimationPointer, WhatCannotBeSeenIsIgnored) {
    PointerFile f;
    f.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    f.channel("/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1});
    f.channel("/extensions/KHR_lights_punctual/lights/1/spot/innerConeAngle", {0, 1});
    Scene scene = f.load();
    EXPECT_TRUE(scene.animations.empty());
    EXPECT_FALSE(mentions(scene.notes, "left out: channel"));
    f.channel("/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0, 0, 0, 1, 1, 1, 1});
    scene = f.load();
    EXPECT_EQ(poseAt(scene, 0.5).materials.at(0).base_color, glm::vec4(0.5f));
    EXPECT_TRUE(poseAt(scene, 0.5).materials[0].unlit);
    f.json["extensionsRequired"] = {"KHR_animation_pointer"};
    EXPECT_NO_THROW(f.load());
}

}  // namespace
}  // namespace diptych
