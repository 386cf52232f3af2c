// SPDX-License-Identifier: MIT
#include "shared/scene/lights/lights_json.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"
#include "tests/support/light_kinds.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

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

// As in KHR_lights_punctual.
TEST(LightsJson, TypesAndTheirDefaults) {
    const auto lights = read(R"({"type": "directional"}, {"type": "point"}, {"type": "spot"},
                                {"type": "rect"}, {"type": "disc"}, {"type": "tube"})");
    ASSERT_EQ(lights.size(), everyLightKind().size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(lights[i].kind, everyLightKind()[i]);
        EXPECT_EQ(lights[i].color, glm::vec3(1));
        EXPECT_EQ(lights[i].intensity, 1);
        EXPECT_TRUE(std::isinf(lights[i].range));
        EXPECT_EQ(lights[i].direction, glm::dvec3(0, 0, -1));
        EXPECT_EQ(lights[i].inner_cone, 0);
        EXPECT_FLOAT_EQ(lights[i].outer_cone, std::acos(-1.0f) / 4);
    }
}

// ---- keys of each type -------------------------------------------------------------------------------

namespace {

// A key of a light, the types that take it, and what it sets.
struct LightKey {
    const char* text;
    std::vector<LightKind> types;
    void (*set)(Light&) = nullptr;
};

std::vector<LightKey> lightKeys() {
    using K = LightKind;
    const std::vector<K>& any = everyLightKind();
    return {
        {R"("name": "lamp")", any, [](Light& l) { l.name = "lamp"; }},
        {R"("position": [1, 2, 3])", any, [](Light& l) { l.position = glm::dvec3(1, 2, 3); }},
        {R"("direction": [0, -2, 0])", any, [](Light& l) { l.direction = glm::dvec3(0, -1, 0); }},
        {R"("color": [1, 0.5, 0])", any, [](Light& l) { l.color = glm::vec3(1, 0.5f, 0); }},
        {R"("intensity": 40)", any, [](Light& l) { l.intensity = 40; }},
        {R"("range": 6)", any,
         [](Light& l) {
             if (l.kind != K::directional) l.range = 6;  // a directional light has none
         }},
        {R"("importance": "auto")", any, [](Light&) {}},
        {R"("importance": "important")", any, [](Light& l) { l.importance = Importance::important; }},
        {R"("importance": "not_important")", any, [](Light& l) { l.importance = Importance::not_important; }},
        {R"("shadow": true)", {K::point, K::spot}, [](Light& l) { l.shadow = true; }},
        {R"("shadow": false)", {K::point, K::spot}, [](Light&) {}},
        {R"("angle": 0.0093)", {K::directional}, [](Light& l) { l.angle = 0.0093f; }},
        {R"("angle": 3.1415927)", {K::directional}, [](Light& l) { l.angle = gpu::PI; }},  // a rounded pi
        {R"("spot": {})", {K::spot}, [](Light&) {}},
        {R"("spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2})",
         {K::spot},
         [](Light& l) { l.inner_cone = 0.1f, l.outer_cone = 0.2f; }},
        {R"("innerConeAngle": 0.3)", {K::spot}, [](Light& l) { l.inner_cone = 0.3f; }},
        {R"("outerConeAngle": 0.4)", {K::spot}, [](Light& l) { l.outer_cone = 0.4f; }},
        {R"("size": [3, 2])", {K::rect}, [](Light& l) { l.width = 3, l.height = 2; }},
        {R"("axis": [0, 2, 0])", {K::rect, K::tube}, [](Light& l) { l.axis = glm::dvec3(0, 1, 0); }},
        {R"("twoSided": true)", {K::rect, K::disc}, [](Light& l) { l.two_sided = true; }},
        {R"("radius": 0.25)", {K::disc, K::tube}, [](Light& l) { l.radius = 0.25f; }},
        {R"("length": 1.5)", {K::tube}, [](Light& l) { l.length = 1.5f; }},
        {R"("width": 1)", {}},
        {R"("two_sided": true)", {}},
    };
}

auto membersOf(const Light& l) {
    return std::tuple(l.name, l.kind, l.color, l.intensity, l.range, l.inner_cone, l.outer_cone, l.angle,
                      l.width, l.height, l.radius, l.length, l.two_sided, l.importance, l.shadow, l.node,
                      l.position, l.direction, l.axis, l.source);
}

}  // namespace

class LightsJsonOf : public testing::TestWithParam<LightKind> {};

// A key that a type does not take is probably a mistake in the type, so it is an error.
TEST_P(LightsJsonOf, EachKeySetsItsMemberOrBelongsToOtherTypes) {
    for (const LightKey& key : lightKeys()) {
        SCOPED_TRACE(key.text);
        const std::string light = "{\"type\": \"" + std::string(nameOf(GetParam())) + "\", " + key.text + "}";
        if (std::ranges::count(key.types, GetParam()) > 0) {
            Light expected;
            expected.kind = GetParam();
            key.set(expected);
            EXPECT_EQ(membersOf(read(light).at(0)), membersOf(expected));
        } else {
            const char* const why = key.types.empty() ? "light 0: " : "applies only to";
            EXPECT_NE(lightsFault("{\"lights\": [" + light + "]}").find(why), std::string::npos);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, LightsJsonOf, testing::ValuesIn(everyLightKind()), lightKindName);

// ---- single keys -------------------------------------------------------------------------------------

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
    EXPECT_EQ(read(R"({"type": "tube", "direction": [1, 0, 0]})")[0].axis, glm::dvec3(0, 0, 1));
    const Light tube = read(R"({"type": "tube", "axis": [0, 3, 4]})")[0];
    EXPECT_NEAR(glm::length(tube.axis - glm::dvec3(0, 0.6, 0.8)), 0, 1e-15) << "a tube's axis is its own";
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
