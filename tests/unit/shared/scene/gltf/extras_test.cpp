// SPDX-License-Identifier: MIT
#include "shared/scene/motion/pose.h"
#include "tests/support/gltf_builder.h"

#include <glm/geometric.hpp>

#include <cmath>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// The triangle, with one or several lights in the scene's extras.
GltfFile with(const Json& lights) {
    GltfFile f = GltfFile::triangle();
    f.json["scenes"][0]["extras"]["diptych"]["lights"] = lights.is_array() ? lights : Json::array({lights});
    return f;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, const char* what) {
    EXPECT_NEAR(glm::length(a - b), 0, 1e-12) << what;
}

}  // namespace

TEST(GltfExtras, LightsOfTheSceneStandInTheWorld) {
    const Scene scene =
        with({{{"type", "rect"}, {"size", {3, 2}}, {"position", {1, 2, 3}}, {"name", "window"}},
              {{"type", "point"}, {"intensity", 7}}})
            .load();
    EXPECT_TRUE(scene.notes.empty()) << scene.notes.front();
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::rect);
    EXPECT_EQ(scene.lights[0].name, "window");
    EXPECT_EQ(scene.lights[0].width, 3);
    EXPECT_EQ(scene.lights[0].node, -1);
    EXPECT_EQ(poseAt(scene, 0).lights[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.lights[1].kind, LightKind::point);
    EXPECT_EQ(scene.lights[1].intensity, 7);
}

// A node rotated by 90 degrees around +Z, scaled and moved: the light's position is transformed, its sizes
// are not.
TEST(GltfExtras, OnANodeTheyStandInItsSpace) {
    GltfFile f = with({{{"type", "rect"}, {"node", 1}, {"size", {3, 2}}},
                       {{"type", "tube"}, {"node", 1.0}, {"position", {1, 0, 0}}, {"direction", {0, 1, 0}}},
                       {{"type", "rect"}, {"node", 1}, {"direction", {0, 1, 0}}, {"axis", {1, 0, 0}}}});
    const double s = std::sqrt(0.5);
    f.json["nodes"] = {{{"mesh", 0}, {"children", {1}}, {"translation", {10, 0, 0}}},
                       {{"rotation", {0, 0, s, s}}, {"scale", {2, 4, 8}}, {"name", "lamp"}}};
    const Scene scene = f.load();
    EXPECT_TRUE(scene.notes.empty()) << scene.notes.front();
    const Pose pose = poseAt(scene, 0);
    ASSERT_EQ(pose.lights.size(), 3u);
    const Light &rect = pose.lights[0], &tube = pose.lights[1], &turned = pose.lights[2];
    EXPECT_EQ(rect.node, -1);
    EXPECT_EQ(rect.name, "lamp");
    expectNear(rect.position, {10, 0, 0}, "position");
    expectNear(rect.direction, {0, 0, -1}, "direction");
    expectNear(rect.axis, {0, 1, 0}, "axis");
    EXPECT_EQ(rect.width, 3);
    EXPECT_EQ(rect.height, 2);
    expectNear(tube.position, {10, 2, 0}, "position, scaled");
    expectNear(tube.axis, {0, 1, 0}, "a tube's axis");
    expectNear(turned.direction, {-1, 0, 0}, "direction in the node's space");
    expectNear(turned.axis, {0, 1, 0}, "axis in the node's space");
}

// A sheared node's axes are not orthogonal; the light's axes stay orthogonal.
TEST(GltfExtras, AShearedNodeKeepsTheAxisAtRightAngles) {
    GltfFile f = with({{"type", "rect"}, {"node", 0}});
    f.json["nodes"][0]["matrix"] = {1, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const Light light = poseAt(f.load(), 0).lights.at(0);
    expectNear(light.direction, {0, 0, -1}, "direction");
    expectNear(light.axis, {1, 0, 0}, "axis");
    // Projecting +X leaves only rounding errors perpendicular to -Z.
    f.json["nodes"][0]["matrix"] = {0.3, 0.7, 0.1, 0, 0, 1, 0, 0, 0.9, 2.1, 0.3, 0, 0, 0, 0, 1};
    const Light squashed = poseAt(f.load(), 0).lights.at(0);
    EXPECT_NEAR(glm::dot(squashed.axis, squashed.direction), 0, 1e-9);
    EXPECT_NEAR(glm::length(squashed.axis), 1, 1e-12);
}

TEST(GltfExtras, OnlyTheScenesOwn) {
    GltfFile f = with({{"type", "disc"}});
    f.json["scenes"].push_back({{"nodes", {0}}, {"name", "dark"}});
    f.json["scenes"][1]["extras"]["diptych"]["lights"] = Json::array({{{"type", "laser"}}});
    const std::string file = f.written();
    EXPECT_EQ(loadScene(file).lights.size(), 1u);
    EXPECT_FALSE(mentions(loadScene(file).notes, "laser")) << "a fault of a scene that is not drawn";
    const Scene dark = loadScene(file + "?scene=dark");
    EXPECT_TRUE(dark.lights.empty());
    EXPECT_TRUE(mentions(dark.notes, "scene 1: extras: diptych: light 0: type: \"laser\""));
}

// The same faults as in a lights file, but here they only skip the light, with a note.
TEST(GltfExtras, WhatIsWrongIsLeftOutWithANote) {
    const std::pair<Json, const char*> cases[] = {
        {{{"type", "rect"}, {"size", {0, 1}}}, "size: 0 is below 1e-18: left out"},
        {{{"type", "rect"}, {"radius", 1}}, "radius: applies only to disc and tube lights"},
        {{{"type", "disc"}, {"colour", {1, 1, 1}}}, "colour: is not a known field of a light: left out"},
        {{{"type", "disc"}, {"node", 3}}, "node: is not an index of the 2 nodes: left out"},
        {{{"type", "disc"}, {"node", -1}}, "node: is not an index of the 2 nodes: left out"},
        {{{"type", "disc"}, {"node", 0.5}}, "node: is not an index of the 2 nodes: left out"},
        {{{"type", "disc"}, {"node", "lamp"}}, "node: is not an index of the 2 nodes: left out"},
        {{{"type", "disc"}, {"node", 1}}, "node: 1 is not in the scene: left out"},
        {"disc", "is not an object: left out"},
        {nullptr, "is not an object: left out"},
    };
    for (const auto& [light, note] : cases) {
        GltfFile f = with(Json::array({Json{{"type", "tube"}}, light}));
        f.json["nodes"].push_back(Json::object());
        const Scene scene = f.load();
        ASSERT_EQ(scene.lights.size(), 1u) << light;
        EXPECT_EQ(scene.lights[0].kind, LightKind::tube);
        ASSERT_EQ(scene.notes.size(), 1u) << light;
        EXPECT_TRUE(mentions(scene.notes, std::string("scene 0: extras: diptych: light 1: ") + note))
            << scene.notes[0];
    }
}

TEST(GltfExtras, OthersMayBeAnything) {
    for (const Json& extras : {Json(3), Json(nullptr), Json::array({1}), Json{{"lights", 3}}}) {
        GltfFile f = GltfFile::triangle();
        f.json["scenes"][0]["extras"] = extras;
        EXPECT_TRUE(f.load().lights.empty()) << extras;
        EXPECT_FALSE(mentions(f.load().notes, "diptych")) << extras;
    }
    const std::pair<Json, const char*> ours[] = {
        {3, "scene 0: extras: diptych: is not an object: left out"},
        {{{"lights", 3}}, "scene 0: extras: diptych: lights: is not an array: left out"},
        {{{"lamps", 3}, {"lights", Json::array()}}, "scene 0: extras: diptych: lamps: is ignored"},
    };
    for (const auto& [value, note] : ours) {
        GltfFile f = GltfFile::triangle();
        f.json["scenes"][0]["extras"]["diptych"] = value;
        EXPECT_TRUE(mentions(f.load().notes, note)) << value;
    }
}

namespace {

// The triangle's node is also a KHR_lights_punctual light.
Scene lit(const Json& light) {
    GltfFile f = GltfFile::triangle();
    f.json["extensionsUsed"] = {"KHR_lights_punctual"};
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
    f.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    return f.load();
}

}  // namespace

TEST(GltfExtras, ASunHasAnAngle) {
    const auto sun = [](const Json& ours) {
        return Json{{"type", "directional"}, {"intensity", 5}, {"extras", {{"diptych", ours}}}};
    };
    Scene scene = lit(sun({{"angle", 0.0093}}));
    EXPECT_TRUE(scene.notes.empty()) << scene.notes.front();
    EXPECT_EQ(scene.lights.at(0).angle, 0.0093f);
    EXPECT_EQ(scene.lights.at(0).intensity, 5);

    const std::pair<Json, const char*> faults[] = {
        {sun({{"angle", -1}}), "light 0: extras: diptych: angle: -1 is below 0: left out"},
        {sun({{"angle", 4}}), "light 0: extras: diptych: angle: 4 is above pi: left out"},
        {sun({{"angle", "wide"}}), "light 0: extras: diptych: angle: is not a number: left out"},
        {sun({{"size", 1}}), "light 0: extras: diptych: size: is ignored"},
        {sun(7), "light 0: extras: diptych: is not an object: left out"},
        {{{"type", "point"}, {"extras", {{"diptych", {{"angle", 1}}}}}},
         "light 0: extras: diptych: angle: applies only to directional lights: left out"},
    };
    for (const auto& [light, note] : faults) {
        scene = lit(light);
        ASSERT_EQ(scene.lights.size(), 1u) << light;
        EXPECT_EQ(scene.lights[0].angle, 0) << light;
        EXPECT_TRUE(mentions(scene.notes, note)) << light;
    }
}

TEST(GltfExtras, LightsHaveImportance) {
    const std::pair<const char*, Importance> marks[] = {{"auto", Importance::automatic},
                                                        {"important", Importance::important},
                                                        {"not_important", Importance::not_important}};
    for (const auto& [word, mark] : marks) {
        for (const char* type : {"point", "spot", "directional"}) {
            Json light{{"type", type}, {"extras", {{"diptych", {{"importance", word}}}}}};
            if (light["type"] == "spot") light["spot"] = Json::object();
            const Scene scene = lit(light);
            EXPECT_TRUE(scene.notes.empty()) << scene.notes.front();
            ASSERT_EQ(scene.lights.size(), 1u);
            EXPECT_EQ(scene.lights[0].importance, mark) << type << " " << word;
            EXPECT_EQ(poseAt(scene, 0).lights.at(0).importance, mark) << "as it is drawn";
        }
        const Scene scene = with({{"type", "rect"}, {"importance", word}}).load();
        EXPECT_TRUE(scene.notes.empty()) << scene.notes.front();
        EXPECT_EQ(scene.lights.at(0).importance, mark) << "of the scene, " << word;
    }
}

TEST(GltfExtras, PointsAndSpotsAskForAShadow) {
    for (const char* type : {"point", "spot", "directional"}) {
        Json light{{"type", type}, {"extras", {{"diptych", {{"shadow", true}}}}}};
        if (light["type"] == "spot") light["spot"] = Json::object();
        const Scene scene = lit(light);
        ASSERT_EQ(scene.lights.size(), 1u);
        const bool asks = light["type"] != "directional";
        EXPECT_EQ(scene.lights[0].shadow, asks) << type;
        EXPECT_EQ(poseAt(scene, 0).lights.at(0).shadow, asks) << "as it is drawn";
        EXPECT_EQ(
            mentions(scene.notes,
                     "light 0: extras: diptych: shadow: applies only to point and spot lights: left out"),
            !asks)
            << type;
    }
    const Scene odd = lit({{"type", "point"}, {"extras", {{"diptych", {{"shadow", "yes"}}}}}});
    EXPECT_FALSE(odd.lights.at(0).shadow);
    EXPECT_TRUE(mentions(odd.notes, "shadow: is not true or false")) << odd.notes.at(0);
}

TEST(GltfExtras, AnImportanceThatIsNoneIsLeftOutWithANote) {
    const std::pair<Json, const char*> faults[] = {
        {"high", "importance: \"high\" is not one of auto, important, not_important: left out"},
        {"not important",
         "importance: \"not important\" is not one of auto, important, not_important: left out"},
        {"a\nb", "importance: \"a?b\" is not one of auto, important, not_important: left out"},
        {1, "importance: is not text: left out"},
        {nullptr, "importance: is not text: left out"},
    };
    for (const auto& [word, note] : faults) {
        const Scene sun = lit(
            {{"type", "directional"}, {"extras", {{"diptych", {{"importance", word}, {"angle", 0.01}}}}}});
        ASSERT_EQ(sun.lights.size(), 1u) << word;
        EXPECT_EQ(sun.lights[0].importance, Importance::automatic) << word;
        EXPECT_EQ(sun.lights[0].angle, 0.01f) << "what is right beside it stays";
        ASSERT_EQ(sun.notes.size(), 1u) << word;
        EXPECT_EQ(sun.notes[0].find('\n'), std::string::npos) << sun.notes[0];
        EXPECT_TRUE(mentions(sun.notes, std::string("light 0: extras: diptych: ") + note)) << sun.notes[0];
        const Scene hung =
            with(Json::array({{{"type", "disc"}}, {{"type", "disc"}, {"importance", word}}})).load();
        EXPECT_EQ(hung.lights.size(), 1u) << "a light of our own is whole or not there";
        EXPECT_TRUE(mentions(hung.notes, std::string("light 1: ") + note)) << hung.notes.at(0);
    }
}

TEST(GltfExtras, WhatStandsBeyondIsLeftOut) {
    GltfFile f = with({{"type", "disc"}, {"node", 0}, {"position", {1e17, 0, 0}}});
    EXPECT_EQ(f.load().lights.size(), 1u);
    f.json["nodes"][0]["scale"] = {1e3, 1, 1};
    const Scene scene = f.load();
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(mentions(scene.notes, "1 light is not finite or beyond 1e+18 m: left out"));
}
