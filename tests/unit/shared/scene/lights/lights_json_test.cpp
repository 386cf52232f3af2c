// SPDX-License-Identifier: MIT
#include "shared/scene/lights/lights_json.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

using namespace diptych;

namespace {

std::filesystem::path written(const std::string& text) {
    const std::filesystem::path file = testFolder() / "lights.json";
    std::ofstream(file) << text;
    return file;
}

std::vector<Light> read(const std::string& lights) {
    return readLights(written("{\"lights\": [" + lights + "]}"));
}

std::string lightsFault(const std::string& text) {
    return faultOf([&] { readLights(written(text)); });
}

}  // namespace

TEST(LightsJson, EveryField) {
    const auto lights =
        read(R"({"type": "spot", "name": "lamp", "position": [1, 2, 3], "direction": [0, -2, 0],
        "color": [1, 0.5, 0], "intensity": 40, "range": 6,
        "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}})");
    ASSERT_EQ(lights.size(), 1u);
    const Light& l = lights[0];
    EXPECT_EQ(l.kind, LightKind::spot);
    EXPECT_EQ(l.name, "lamp");
    EXPECT_EQ(l.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(l.direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(l.color, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(l.intensity, 40);
    EXPECT_EQ(l.range, 6);
    EXPECT_FLOAT_EQ(l.inner_cone, 0.1f);
    EXPECT_FLOAT_EQ(l.outer_cone, 0.2f);
    EXPECT_EQ(l.node, -1);
}

TEST(LightsJson, DefaultsAreThoseOfKhrLightsPunctual) {
    const auto lights = read(R"({"type": "point"}, {"type": "spot"}, {"type": "directional", "range": 3})");
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].color, glm::vec3(1));
    EXPECT_EQ(lights[0].intensity, 1);
    EXPECT_TRUE(std::isinf(lights[0].range));
    EXPECT_EQ(lights[1].inner_cone, 0);
    EXPECT_FLOAT_EQ(lights[1].outer_cone, std::acos(-1.0f) / 4);
    EXPECT_EQ(lights[1].direction, glm::dvec3(0, 0, -1));
    EXPECT_TRUE(std::isinf(lights[2].range)) << "a directional light has none";
}

TEST(LightsJson, ConeAnglesMayStandBesideTheType) {
    const auto lights = read(R"({"type": "spot", "innerConeAngle": 0.3, "outerConeAngle": 0.4})");
    EXPECT_FLOAT_EQ(lights[0].inner_cone, 0.3f);
    EXPECT_FLOAT_EQ(lights[0].outer_cone, 0.4f);
}

TEST(LightsJson, AreaLights) {
    const auto lights =
        read(R"({"type": "rect", "position": [1, 2, 3], "direction": [0, -4, 0], "axis": [0, 0, 2],
          "size": [3, 2], "intensity": 500, "range": 9, "twoSided": true},
        {"type": "disc", "radius": 0.25}, {"type": "tube", "length": 1.5, "radius": 0.02, "axis": [0, 3, 4]},
        {"type": "directional", "angle": 0.0093})");
    ASSERT_EQ(lights.size(), 4u);
    const Light &rect = lights[0], &disc = lights[1], &tube = lights[2], &sun = lights[3];
    EXPECT_EQ(rect.kind, LightKind::rect);
    EXPECT_EQ(rect.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(rect.direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(rect.axis, glm::dvec3(0, 0, 1));
    EXPECT_EQ(rect.width, 3);
    EXPECT_EQ(rect.height, 2);
    EXPECT_EQ(rect.intensity, 500);
    EXPECT_EQ(rect.range, 9);
    EXPECT_TRUE(rect.two_sided);
    EXPECT_EQ(disc.kind, LightKind::disc);
    EXPECT_EQ(disc.radius, 0.25f);
    EXPECT_FALSE(disc.two_sided);
    EXPECT_TRUE(std::isinf(disc.range));
    EXPECT_EQ(tube.kind, LightKind::tube);
    EXPECT_EQ(tube.length, 1.5f);
    EXPECT_EQ(tube.radius, 0.02f);
    EXPECT_NEAR(glm::length(tube.axis - glm::dvec3(0, 0.6, 0.8)), 0, 1e-15) << "a tube's axis is its own";
    EXPECT_EQ(sun.angle, 0.0093f);
    EXPECT_EQ(read(R"({"type": "directional", "angle": 3.1415927})")[0].angle, gpu::PI)
        << "a rounded pi is one";
}

TEST(LightsJson, ImportanceOfAnyType) {
    for (const std::string type : {"point", "spot", "directional", "rect", "disc", "tube"}) {
        const std::string light = "{\"type\": \"" + type + "\"";
        const auto lights =
            read(light + "}, " + light + R"(, "importance": "auto"}, )" + light +
                 R"(, "importance": "important"}, )" + light + R"(, "importance": "not_important"})");
        ASSERT_EQ(lights.size(), 4u) << type;
        EXPECT_EQ(lights[0].importance, Importance::automatic) << type;
        EXPECT_EQ(lights[1].importance, Importance::automatic) << type;
        EXPECT_EQ(lights[2].importance, Importance::important) << type;
        EXPECT_EQ(lights[3].importance, Importance::not_important) << type;
    }
}

TEST(LightsJson, PointsAndSpotsAskForAShadow) {
    const auto lights = read(R"({"type": "point", "shadow": true}, {"type": "spot", "shadow": true},
                                {"type": "spot", "shadow": false}, {"type": "point"})");
    EXPECT_TRUE(lights[0].shadow && lights[1].shadow);
    EXPECT_FALSE(lights[2].shadow || lights[3].shadow);
}

TEST(LightsJson, TheAxisStandsAtRightAnglesToTheDirection) {
    const std::pair<const char*, glm::dvec3> cases[] = {
        {R"("axis": [1, 0, 5])", {1, 0, 0}},  // the component along the direction is removed
        {R"("axis": [0, -2, 1])", {0, -1, 0}},
        {R"("name": "none")", {1, 0, 0}},
        {R"("direction": [1, 0, 0])", {0, 0, 1}},  // to the right when looking along the direction
        {R"("direction": [-1, 7, 0])", {0, 0, -1}},
        {R"("direction": [0, 1, 0])", {1, 0, 0}},  // these two directions have no horizontal right
        {R"("direction": [0, -1, 0])", {1, 0, 0}},
    };
    for (const auto& [words, axis] : cases) {
        const Light light = read(std::string("{\"type\": \"rect\", ") + words + "}")[0];
        EXPECT_NEAR(glm::length(light.axis - axis), 0, 1e-15) << words;
    }
    const Light tube = read(R"({"type": "tube", "direction": [1, 0, 0]})")[0];
    EXPECT_EQ(tube.axis, glm::dvec3(0, 0, 1));
}

// A key without effect for the given type is probably a mistake in the type, so it is an error.
TEST(LightsJson, EveryKeyBelongsToItsTypes) {
    const std::pair<const char*, std::set<std::string>> keys[] = {
        {R"("angle": 0.1)", {"directional"}},
        {R"("spot": {})", {"spot"}},
        {R"("innerConeAngle": 0.1)", {"spot"}},
        {R"("outerConeAngle": 0.1)", {"spot"}},
        {R"("size": [1, 1])", {"rect"}},
        {R"("axis": [1, 0, 0])", {"rect", "tube"}},
        {R"("twoSided": true)", {"disc", "rect"}},
        {R"("radius": 1)", {"disc", "tube"}},
        {R"("length": 1)", {"tube"}},
        {R"("width": 1)", {}},
        {R"("two_sided": true)", {}},
    };
    for (const auto& [key, types] : keys)
        for (const std::string type : {"point", "spot", "directional", "rect", "disc", "tube"}) {
            const std::string light = "{\"type\": \"" + type + "\", " + key + "}";
            const std::string error = lightsFault("{\"lights\": [" + light + "]}");
            EXPECT_EQ(error.empty(), types.contains(type)) << light << ": " << error;
            if (!types.empty() && !error.empty()) {
                EXPECT_NE(error.find("applies only to"), error.npos) << error;
            }
        }
}

TEST(LightsJson, ErrorsNameFileLightAndField) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"type": "area", "size": [2, 1]})",
         "type: \"area\" is not one of point, spot, directional, rect, disc, tube"},
        {R"({"type": "laser"})", "type"},
        {R"({"type": "point", "position": [0, 2e18, 0]})", "position: 2e+18 is above 1e+18"},
        {R"({"type": "rect", "size": [0, 1]})", "size: 0 is below 1e-18"},
        {R"({"type": "rect", "size": [1, -1]})", "size: -1 is below 1e-18"},
        {R"({"type": "rect", "size": [1, 1e19]})", "size: 1e+19 is above 1e+18"},
        {R"({"type": "rect", "size": 2})", "size: is not two numbers"},
        {R"({"type": "rect", "size": [1, 1, 1]})", "size: is not two numbers"},
        {R"({"type": "rect", "size": [1, null]})", "size: is not two finite numbers"},
        {R"({"type": "rect", "axis": [0, 0, 3]})", "axis: is parallel to direction"},
        {R"({"type": "rect", "axis": [0, 0, 0]})", "axis: has no length"},
        {R"({"type": "rect", "twoSided": 1})", "twoSided: is not true or false"},
        {R"({"type": "disc", "radius": 0})", "radius: 0 is below 1e-18"},
        {R"({"type": "disc", "radius": "1"})", "radius: is not a number"},
        {R"({"type": "tube", "length": -2})", "length: -2 is below 1e-18"},
        {R"({"type": "tube", "axis": [1, 0]})", "axis: is not three numbers"},
        {R"({"type": "directional", "angle": -0.1})", "angle: -0.1 is below 0"},
        {R"({"type": "directional", "angle": 3.15})", "angle: 3.15 is above pi"},
        {R"({"type": "rect", "shadow": true})",
         "shadow: applies only to point and spot lights; this is a rect"},
        {R"({"type": "point", "shadow": 1})", "shadow: is not true or false"},
        {R"({"type": "point", "importance": "high"})",
         "importance: \"high\" is not one of auto, important, not_important"},
        {R"({"type": "rect", "importance": "not important"})", "importance: \"not important\" is not one of"},
        {R"({"type": "spot", "importance": "Important"})", "importance: \"Important\" is not one of"},
        {R"({"type": "point", "importance": ""})", "importance: \"\" is not one of"},
        {R"({"type": "point", "importance": "a\nb"})", "importance: \"a?b\" is not one of"},
        {R"({"type": "point", "importance": true})", "importance: is not"},
        {R"({"type": "tube", "importance": 2})", "importance: is not"},
        {R"({"type": "point", "importance": null})", "importance: is not"},
        {R"({"position": [0, 0, 0]})", "type"},
        {R"({"type": "point", "position": [0, 0]})", "position"},
        {R"({"type": "point", "position": [0, 0, "x"]})", "position"},
        {R"({"type": "spot", "direction": [0, 0, 0]})", "direction"},
        {R"({"type": "point", "color": [1, -1, 1]})", "color"},
        {R"({"type": "point", "intensity": -1})", "intensity"},
        {R"({"type": "point", "intensity": 1e300})", "intensity"},
        {R"({"type": "point", "intensity": "bright"})", "intensity"},
        {R"({"type": "point", "range": 0})", "range"},
        {R"({"type": "spot", "outerConeAngle": 2})", "outerConeAngle"},
        {R"({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}})", "innerConeAngle"},
        {R"({"type": "spot", "spot": {"outer": 0.5}})", "outer"},
        {R"({"type": "point", "colour": [1, 1, 1]})", "colour"},
        {R"("point")", "object"},
    };
    for (const auto& [light, field] : cases) {
        const std::string error =
            lightsFault(std::string("{\"lights\": [{\"type\": \"point\"}, ") + light + "]}");
        EXPECT_NE(error.find(".json: light 1"), error.npos) << error;
        EXPECT_NE(error.find(field), error.npos) << light << ": " << error;
        EXPECT_EQ(error.find('\n'), error.npos) << "one line: " << error;
    }
    for (const char* text : {"", "{", "[]", "{\"lights\": 3}", "{}"})
        EXPECT_NE(lightsFault(text).find(".json"), std::string::npos) << text;
    EXPECT_THROW(readLights("no/such/file.json"), std::runtime_error);
}
