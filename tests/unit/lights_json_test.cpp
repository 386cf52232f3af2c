// SPDX-License-Identifier: MIT
#include "shared/scene/lights_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace diptych;

namespace {

std::filesystem::path written(const std::string& text) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::string("diptych_") + test->name() + ".json");
    std::ofstream(file) << text;
    return file;
}

std::vector<Light> read(const std::string& lights) {
    return readLights(written("{\"lights\": [" + lights + "]}"));
}

std::string errorOf(const std::string& text) {
    try {
        readLights(written(text));
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST(LightsJson, EveryField) {
    const auto lights =
        read(R"({"type": "spot", "name": "lamp", "position": [1, 2, 3], "direction": [0, -2, 0],
        "color": [1, 0.5, 0], "intensity": 40, "range": 6, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}})");
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

TEST(LightsJson, ErrorsNameFileLightAndField) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"type": "rect"})", "type: rect lights are not built yet"},
        {R"({"type": "area", "width": 2, "height": 1})", "type: area lights are not built yet"},
        {R"({"type": "disc", "radius": 1})", "type: disc lights are not built yet"},
        {R"({"type": "tube", "length": 1})", "type: tube lights are not built yet"},
        {R"({"type": "laser"})", "type"},
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
            errorOf(std::string("{\"lights\": [{\"type\": \"point\"}, ") + light + "]}");
        EXPECT_NE(error.find(".json: light 1"), error.npos) << error;
        EXPECT_NE(error.find(field), error.npos) << light << ": " << error;
    }
    for (const char* text : {"", "{", "[]", "{\"lights\": 3}", "{}"})
        EXPECT_NE(errorOf(text).find(".json"), std::string::npos) << text;
    EXPECT_THROW(readLights("no/such/file.json"), std::runtime_error);
}
