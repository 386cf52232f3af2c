// SPDX-License-Identifier: MIT
#include "shared/scene/lights/rig.h"
#include "shared/scene/load.h"
#include "shared/scene/motion/bounds.h"
#include "shared/scene/scene_view.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych {
namespace {

const Bounds ROOM{{-5, 0, -8}, {5, 4, 8}};

std::string rigFault(const std::string& lights, const Bounds& bounds = ROOM) {
    return faultOf([&] { makeLights(lights, 0, bounds); });
}

TEST(Rig, HashHasThePublishedValues) {
    EXPECT_EQ(pcg(0), 129708002u);
    EXPECT_EQ(pcg(1), 2831084092u);
    EXPECT_EQ(pcg(2), 2055130248u);
    EXPECT_EQ(pcg(65536), 688544357u);
    EXPECT_EQ(u01(0), 129708002.0 / 4294967296.0);
}

TEST(Rig, SameSeedSameLightsOtherSeedOthers) {
    const auto a = makeLights("point:20,spot:5", 7, ROOM), b = makeLights("point:20,spot:5", 7, ROOM),
               c = makeLights("point:20,spot:5", 8, ROOM);
    ASSERT_EQ(a.size(), 25u);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
        EXPECT_EQ(a[i].color, b[i].color);
        EXPECT_EQ(a[i].intensity, b[i].intensity);
        EXPECT_NE(a[i].position, c[i].position);
        EXPECT_EQ(a[i].kind, i < 20 ? LightKind::point : LightKind::spot);
    }
}

TEST(Rig, ALightDoesNotDependOnHowManyThereAre) {
    const auto few = makeLights("point:8,spot:3", 1, ROOM), many = makeLights("point:500,spot:100", 1, ROOM);
    for (std::size_t i = 0; i < few.size(); ++i) {
        const Light &a = few[i], &b = many[i < 8 ? i : 500 + i - 8];
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.color, b.color);
        EXPECT_EQ(a.direction, b.direction);
        EXPECT_EQ(a.outer_cone, b.outer_cone);
        EXPECT_GT(a.range, b.range);
    }
    const auto split = makeLights("point:4,point:4", 1, ROOM);  // the sequence continues
    for (std::size_t i = 0; i < split.size(); ++i) EXPECT_EQ(split[i].position, few[i].position);
}

TEST(Rig, LightsLieInTheBoundsEquallyBright) {
    for (const Light& light : makeLights("point:300,spot:300", 3, ROOM)) {
        for (int axis : {0, 1, 2}) {
            EXPECT_GE(light.position[axis], ROOM.min[axis]);
            EXPECT_LE(light.position[axis], ROOM.max[axis]);
        }
        const glm::vec3 c = light.color;
        EXPECT_FLOAT_EQ(std::max({c.r, c.g, c.b}), 1.0f);
        const float range = light.kind == LightKind::spot ? light.range / 2 : light.range;
        // Six roundings to float32 (colour, weights, intensity, range squared) of 6e-8 each.
        EXPECT_NEAR(
            (0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b) * light.intensity / (0.4f * range * range), 1.0f,
            1e-6f);
        if (light.kind != LightKind::spot) continue;
        EXPECT_GE(light.position.y, 2.0);
        EXPECT_LT(light.inner_cone, light.outer_cone);
        EXPECT_LE(light.direction.y, -std::cos(glm::radians(35.0)) + 1e-12);
        EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
    }
}

TEST(Rig, AreaLightsAreAMixAsBrightAsPoints) {
    const auto lights = makeLights("area:300", 3, ROOM), again = makeLights("area:300", 3, ROOM);
    const float candela = 0.4f * lights[0].range * lights[0].range;  // of a white light
    std::array<int, 3> kinds{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        EXPECT_EQ(light.width, again[i].width);
        EXPECT_EQ(light.kind, again[i].kind);
        for (int axis : {0, 1, 2}) {
            EXPECT_GE(light.position[axis], ROOM.min[axis]);
            EXPECT_LE(light.position[axis], ROOM.max[axis]);
        }
        EXPECT_GE(light.position.y, 2.0);
        EXPECT_LE(light.direction.y, -std::cos(glm::radians(35.0)) + 1e-12);
        EXPECT_NEAR(glm::length(light.axis), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(light.axis, light.direction), 0.0, 1e-12);
        float area = light.width * light.height;
        if (light.kind == LightKind::disc) area = glm::pi<float>() * light.radius * light.radius;
        if (light.kind == LightKind::tube) area = 2 * light.radius * light.length;
        const glm::vec3 c = light.color;
        // Eight roundings to float32 of 6e-8 each.
        EXPECT_NEAR((0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b) * light.intensity * area / candela, 1.0f,
                    1e-6f);
        ASSERT_TRUE(isArea(light.kind));
        if (light.kind == LightKind::rect) {
            EXPECT_NEAR(light.width / light.range, 0.35, 0.151);
            EXPECT_NEAR(light.height / light.width, 0.625, 0.376);
        }
        ++kinds[static_cast<std::size_t>(light.kind) - static_cast<std::size_t>(LightKind::rect)];
    }
    for (const int count : kinds) EXPECT_GT(count, 60);  // of 100 expected; five standard deviations are 41
    const auto mixed = makeLights("point:4,area:2", 3, ROOM);
    EXPECT_EQ(mixed[4].position, lights[0].position) << "whatever else there is";
}

// Random numbers of spot and area lights, as fractions of their ranges.
std::map<std::string, std::vector<double>> fractionsOf(const std::vector<Light>& lights) {
    std::map<std::string, std::vector<double>> of;
    const auto turn = [](double y, double x) { return std::atan2(y, x) / glm::two_pi<double>() + 0.5; };
    const auto add = [&](const char* name, double value, double low, double high) {
        of[name].push_back((value - low) / (high - low));
    };
    for (const Light& light : lights) {
        const glm::dvec3& d = light.direction;
        add("tilt squared", std::pow(glm::degrees(std::acos(std::min(-d.y, 1.0))) / 35, 2), 0, 1);
        add("azimuth", turn(d.z, d.x), 0, 1);
        const double range = double{light.range};
        if (light.kind == LightKind::spot) {
            add("cone", glm::degrees(double{light.outer_cone}), 20, 40);
            continue;
        }
        // The cross product of the direction with a horizontal vector, whose azimuth is uniform.
        add("axis", turn(light.axis.z, light.axis.x), 0, 1);
        if (light.kind == LightKind::rect) {
            add("width", double{light.width} / range, 0.2, 0.5);
            add("height", double{light.height} / double{light.width}, 0.25, 1);
        } else if (light.kind == LightKind::disc) {
            add("radius", double{light.radius} / range, 0.1, 0.25);
        } else {
            add("length", double{light.length} / range, 0.3, 0.7);
            add("thickness", double{light.radius} / double{light.length}, 0.01, 0.05);
        }
    }
    return of;
}

// Kolmogorov and Smirnov: the distance of N uniform numbers' distribution exceeds 2 / sqrt(N) with a
// probability of 0.07 %.
TEST(Rig, RandomNumbersAreUniform) {
    const auto all = fractionsOf(makeLights("spot:1000,area:3000", 3, ROOM));
    EXPECT_EQ(all.size(), 9u);
    for (auto [name, fractions] : all) {
        std::ranges::sort(fractions);
        const auto count = static_cast<double>(fractions.size());
        EXPECT_GT(count, 900) << name;
        double distance = 0;
        for (std::size_t i = 0; i < fractions.size(); ++i)
            distance = std::max({distance, std::abs(fractions[i] - static_cast<double>(i) / count),
                                 std::abs(fractions[i] - static_cast<double>(i + 1) / count)});
        EXPECT_LT(distance, 2 / std::sqrt(count)) << name;
    }
}

TEST(Rig, SixPointLightsReachTheMiddle) {
    // Mean number of lights over points in the middle half of the box. Ranges there stay inside this cube,
    // so the expectation is exactly 6. A low-discrepancy sequence of 512 deviates by a few per cent at
    // most.
    const Bounds cube{{0, 0, 0}, {10, 10, 10}};
    const auto lights = makeLights("point:512", 5, cube);
    ASSERT_LT(lights[0].range, 2.5f);
    int reached = 0, points = 0;
    for (double x = 2.5; x <= 7.5; x += 0.5)
        for (double y = 2.5; y <= 7.5; y += 0.5)
            for (double z = 2.5; z <= 7.5; z += 0.5, ++points)
                for (const Light& light : lights)
                    reached += glm::distance(light.position, glm::dvec3(x, y, z)) < light.range;
    EXPECT_NEAR(static_cast<double>(reached) / points, 6.0, 0.3);
}

TEST(Rig, FlatPointlikeEmptyAndDistantBoundsStayFinite) {
    const Bounds plane{{-20, 0, -20}, {20, 0, 20}}, line{{0, 0, 0}, {0, 0, 1e-3}},
        point{{3, 4, 5}, {3, 4, 5}}, none, distant{{1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6 + 1}};
    for (const Bounds& bounds : {plane, line, point, none, distant}) {
        const auto lights = makeLights("point:10,spot:10", 2, bounds);
        for (const Light& light : lights) {
            for (int axis : {0, 1, 2}) EXPECT_TRUE(std::isfinite(light.position[axis]));
            EXPECT_TRUE(std::isfinite(light.range) && light.range > 0) << light.range;
            EXPECT_TRUE(std::isfinite(light.intensity) && light.intensity > 0) << light.intensity;
        }
        EXPECT_NE(lights[0].position, lights[1].position);
    }
    for (const Light& light : makeLights("point:50", 2, plane)) {
        EXPECT_GE(light.position.y, 0);  // never below the ground
        EXPECT_LE(light.position.y, 5);  // an eighth of 40 m
    }
}

TEST(Rig, WrongOrdersNameTheOptionAndTheFault) {
    for (const char* wrong :
         {"areas:4", "point", "point:", "point:-1", "point:1x", "disco:3", "point:1,", ",", "point:1.5", " ",
          "point:2147483649", "point:2147483648,spot:1", "point:99999999999999999999999"}) {
        const std::string error = rigFault(wrong);
        EXPECT_EQ(error.find("--lights"), 0u) << wrong << ": " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
    EXPECT_NE(rigFault("areas:4").find("area"), std::string::npos);
    EXPECT_NE(rigFault("point:2147483649").find("2^31"), std::string::npos);
    EXPECT_NE(rigFault("point:1147483648,spot:1000000000").find("needs about"), std::string::npos)
        << "more memory than any machine has is refused before it is taken";
    EXPECT_NE(rigFault("point:1", {{0, 0, 0}, {INFINITY, 1, 1}}).find("not finite"), std::string::npos);
    EXPECT_TRUE(makeLights("", 0, ROOM).empty());
    EXPECT_TRUE(makeLights("point:0", 0, ROOM).empty());
}

TEST(Rig, FilesAreRead) {
    const auto file = folder() / "lights.json";
    std::ofstream(file)
        << R"({ "lights": [ { "type": "point", "position": [1, 2, 3], "intensity": 5, "range": 4 } ] })";
    const auto lights = makeLights(file.string(), 0, ROOM);
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_NE(rigFault("/nonexistent/lights.json").find("/nonexistent/lights.json"), std::string::npos);
}

// --scene-lights off removes the scene's own lights and the default sun of a scene without lights; those
// of --lights stay.
TEST(Rig, TheScenesOwnLightsCanBeSwitchedOff) {
    for (const char* name : {"builtin:points", "builtin:normals"}) {
        const Scene scene = loadScene(name);
        ViewRequest request;
        request.width = request.height = 8;
        EXPECT_FALSE(makeSceneView(scene, request).lights.empty());
        request.scene_lights = false;
        EXPECT_TRUE(makeSceneView(scene, request).lights.empty());
        EXPECT_FALSE(makeSceneView(scene, request).default_sun);
        request.lights = "point:3";
        EXPECT_EQ(makeSceneView(scene, request).lights.size(), 3u);
    }
}

TEST(Rig, TheDefaultSunLightsWhatTheDefaultViewSees) {
    for (const glm::dvec3 eye : {glm::dvec3(1, 0.6, 1), glm::dvec3(-1, -0.6, -1), glm::dvec3(0, 1, 0)}) {
        const Light sun = defaultSun(eye);
        EXPECT_EQ(sun.kind, LightKind::directional);
        EXPECT_EQ(sun.intensity, 3.0f);
        EXPECT_NEAR(glm::length(sun.direction), 1.0, 1e-12);
        EXPECT_LT(glm::dot(sun.direction, glm::normalize(eye)), -0.4);  // from behind the viewer
    }
    EXPECT_LT(defaultSun().direction.y, -0.5);  // and from above
}

}  // namespace
}  // namespace diptych
