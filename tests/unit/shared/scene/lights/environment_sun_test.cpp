// SPDX-License-Identifier: MIT
// The sun of painted and real environments: sun and residual together are the environment.
#include "shared/scene/lights/environment_sun.h"

#include "compare/reference/light/environment.h"
#include "shared/scene/image/environment.h"
#include "shared/scene/model/luminance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <tuple>
#include <vector>

namespace diptych {
namespace {

constexpr double halfTurn = std::numbers::pi;

// Direction of a position in the image, in pixels, as defined in shared/scene/model/scene.h.
glm::dvec3 placeInSky(const Image& image, double x, double y) {
    const double azimuth = 2 * halfTurn * x / image.width - halfTurn, polar = halfTurn * y / image.height;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// Means over 4 x 4 samples per pixel.
Environment painted(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    Environment sky{"painted", Image(width, height, 3)};
    std::vector<glm::dvec3> columns, rows;  // of samples, on the horizon and on the meridian of -Z
    for (int i = 0; i < 4 * width; ++i)
        columns.push_back(placeInSky(sky.radiance, (i + 0.5) / 4, height / 2.0));
    for (int i = 0; i < 4 * height; ++i) rows.push_back(placeInSky(sky.radiance, width / 2.0, (i + 0.5) / 4));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            for (int k = 0; k < 16; ++k) {
                const glm::dvec3 &across = columns[static_cast<std::size_t>(4 * x + k % 4)],
                                 &down = rows[static_cast<std::size_t>(4 * y + k / 4)];
                sum += radiance({-down.z * across.x, down.y, -down.z * across.z});
            }
            for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = static_cast<float>(sum[c] / 16);
        }
    return sky;
}

// Bluer above, brighter at the horizon.
glm::dvec3 clearSky(const glm::dvec3& d) {
    return d.y < 0 ? glm::dvec3(0.2, 0.18, 0.15) : glm::dvec3(0.4, 0.6, 1.0) * (1.5 - d.y);
}

Environment sunnySky(const glm::dvec3& to_sun, double degrees, const glm::dvec3& sun, int height = 256) {
    const double min = std::cos(glm::radians(degrees / 2));
    return painted(2 * height, height, [&](const glm::dvec3& d) {
        return clearSky(d) + (glm::dot(d, to_sun) >= min ? sun : glm::dvec3(0));
    });
}

// The difference of two images, at 8 x 8 samples of each pixel near a difference.
struct Difference {
    glm::dvec3 direction, radiance;  // times solid angle
};
std::vector<Difference> differenceOf(const Environment& a, const Environment& b) {
    const int width = a.radiance.width, height = a.radiance.height;
    std::vector<bool> near(a.radiance.pixels(), false);
    const auto mark = [&](int x, int y) {
        if (y >= 0 && y < height)
            near[static_cast<std::size_t>(y * width + (x % width + width) % width)] = true;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            bool same = true;
            for (int c = 0; c < 3; ++c) same &= a.radiance.at(x, y, c) == b.radiance.at(x, y, c);
            if (same) continue;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) mark(x + dx, y + dy);
            for (int all = 0; all < width && (y == 0 || y + 1 == height); ++all) mark(all, y);
        }
    const reference::EnvironmentLight before(a, 1), after(b, 1);
    std::vector<Difference> result;
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (!near[i]) continue;
        const auto x = static_cast<double>(i % static_cast<std::size_t>(width)),
                   y = static_cast<double>(i / static_cast<std::size_t>(width));
        constexpr int side = 8;
        for (int k = 0; k < side * side; ++k) {
            const double u = x + (k % side + 0.5) / side, v = y + (k / side + 0.5) / side;
            const glm::dvec3 d = placeInSky(a.radiance, u, v);
            const double angle =
                2 * halfTurn / width * halfTurn / height / (side * side) * std::sin(halfTurn * v / height);
            result.push_back({d, (before.radiance(d) - after.radiance(d)) * angle});
        }
    }
    return result;
}

glm::dvec3 lux(const Light& light) {
    return glm::dvec3(light.color) * double{light.intensity};
}

// Irradiance from flat pixels, W/m^2, on surfaces with these normals; the last entry sums over all
// directions.
std::vector<glm::dvec3> irradiancesOf(const Environment& sky, const std::vector<glm::dvec3>& normals) {
    const Image& image = sky.radiance;
    std::vector<glm::dvec3> sums(normals.size() + 1, glm::dvec3(0));
    for (int y = 0; y < image.height; ++y) {
        const double solid =
            2 * halfTurn / image.width *
            (std::cos(halfTurn * y / image.height) - std::cos(halfTurn * (y + 1) / image.height));
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 d = placeInSky(image, x + 0.5, y + 0.5);
            const float* p = &image.data[image.offset(x, y)];
            const glm::dvec3 light = glm::dvec3(p[0], p[1], p[2]) * solid;
            for (std::size_t i = 0; i < normals.size(); ++i)
                sums[i] += light * std::max(glm::dot(d, normals[i]), 0.0);
            sums.back() += light;
        }
    }
    return sums;
}

// Sun plus residual have the original's irradiance within 0.1 %: on surfaces that see all of the sun or
// nothing of it, and summed over all directions. A light has one direction, but each colour has its own
// centre in the image. So each component may be off by 0.1 % of the irradiance of a surface facing the
// sun.
void expectAllIsKept(const Environment& sky, const EnvironmentSun& sun, const std::string& what) {
    ASSERT_TRUE(sun.found) << what << ": " << sun.why;
    const std::vector<Difference> difference = differenceOf(sky, sun.residual);
    ASSERT_FALSE(difference.empty()) << what;
    const glm::dvec3 centre = -sun.light.direction;
    EXPECT_NEAR(glm::length(centre), 1, 1e-12);
    glm::dvec3 power(0);
    double reach = 0;
    for (const auto& [direction, radiance] : difference) {
        power += radiance;
        if (radiance != glm::dvec3(0)) reach = std::max(reach, glm::length(direction - centre));
    }
    std::vector<glm::dvec3> normals{centre};
    for (int i = 0; i < 40; ++i) {
        const double y = 1 - (2 * i + 1) / 40.0, across = std::sqrt(1 - y * y), turn = 2.4 * i;
        normals.emplace_back(across * std::cos(turn), y, across * std::sin(turn));
    }
    const std::vector<glm::dvec3> whole = irradiancesOf(sky, normals);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lux(sun.light)[c], power[c], 1e-3 * whole.back()[c]) << what;
    int tried = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double cosine = glm::dot(normals[i], centre);
        if (std::abs(cosine) < reach) continue;
        ++tried;
        glm::dvec3 removed(0);
        for (const auto& [direction, radiance] : difference)
            removed += radiance * std::max(glm::dot(direction, normals[i]), 0.0);
        const glm::dvec3 light = lux(sun.light) * std::max(cosine, 0.0);
        EXPECT_NEAR(luminance(light), luminance(removed), 1e-3 * luminance(whole[i])) << what << " " << i;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(light[c], removed[c], 1e-3 * whole.front()[c]) << what << " " << i;
    }
    EXPECT_GT(tried, 30) << what;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// A disc of 4 degrees: high in the sky, across the seam at u = 0, and at either pole.
TEST(EnvironmentSun, OfAPaintedSkyIsTheDisc) {
    const glm::dvec3 radiance(900, 800, 600);
    const Environment plain = sunnySky({0, 1, 0}, 4, glm::dvec3(0));
    for (const glm::dvec3& to_sun :
         {glm::normalize(glm::dvec3(0.6, 0.5, -0.4)), glm::normalize(glm::dvec3(0.01, 0.6, 0.8)),
          glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::normalize(glm::dvec3(0.04, 1, 0.01))}) {
        const std::string what = fmt::format("{:.2f} {:.2f} {:.2f}", to_sun.x, to_sun.y, to_sun.z);
        const Environment sky = sunnySky(to_sun, 4, radiance);
        const EnvironmentSun sun = environmentSun(sky);
        expectAllIsKept(sky, sun, what);
        // Power and centre as painted: with pixels of 0.7 degrees the disc's edge is blurred, more so at a
        // pole.
        glm::dvec3 power(0), mean(0);
        for (const auto& [direction, light] : differenceOf(sky, plain)) {
            power += light;
            mean += direction * luminance(light);
        }
        EXPECT_LT(angleBetween(-sun.light.direction, mean), 0.01) << what;
        EXPECT_LT(angleBetween(mean, to_sun), 0.1) << what;
        EXPECT_NEAR(glm::degrees(double{sun.light.angle}), 4, 0.5) << what;
        const double sine = std::sin(glm::radians(2.0));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(lux(sun.light)[c], power[c], 0.005 * power[c]) << what;
            EXPECT_NEAR(power[c], radiance[c] * halfTurn * sine * sine, 0.05 * power[c]) << what;
        }
        EXPECT_EQ(sun.light.kind, LightKind::directional);
        EXPECT_LT(*std::ranges::max_element(sun.residual.radiance.data), 12) << what;
        EXPECT_GT(sun.fraction, 0.1) << what;
        EXPECT_LT(sun.fraction, 0.6) << what;
    }
}

TEST(EnvironmentSun, OfOneTexelIsThatTexel) {
    for (const auto& [x, y, height] : {std::tuple{100, 40, 128},
                                       {0, 64, 128},
                                       {255, 70, 128},
                                       {31, 0, 128},
                                       {7, 127, 128},
                                       {40, 12, 32},
                                       {300, 170, 512}}) {
        const Environment sky{"sky", Image(2 * height, height, 3, 35)};
        Environment sunny = sky;
        for (int c = 0; c < 3; ++c) sunny.radiance.at(x, y, c) = 6e4f;
        const EnvironmentSun sun = environmentSun(sunny);
        // A pole's texel is a sliver of 2e-6 sr: others are as close all around.
        if (y == 0 || y + 1 == height) {
            EXPECT_FALSE(sun.found);
            continue;
        }
        const std::string what = fmt::format("{} {} of {}", x, y, height);
        expectAllIsKept(sunny, sun, what);
        EXPECT_EQ(sun.residual.radiance.data, sky.radiance.data) << what;
        // A hundredth of a pixel: away from the horizon the texel's tent is wider on one side.
        EXPECT_LT(angleBetween(-sun.light.direction, placeInSky(sky.radiance, x + 0.5, y + 0.5)),
                  1.8 / height);
    }
}

TEST(EnvironmentSun, WhatIsNoCompactBrightSpotIsNone) {
    const auto lamp = [](const std::function<bool(const glm::dvec3&)>& isLamp, double radiance) {
        return painted(256, 128, [&](const glm::dvec3& d) {
            return isLamp(d) ? glm::dvec3(radiance) : glm::dvec3(0.1);
        });
    };
    const std::pair<const char*, Environment> skies[] = {
        {"black", {"", Image(64, 32, 3)}},
        {"even", {"", Image(64, 32, 3, 1)}},
        {"one pixel", {"", Image(1, 1, 3, 1)}},
        {"six pixels", {"", Image(3, 2, 3, 1)}},
        {"a window", lamp([](const auto& d) { return d.z < -0.95 && d.y > 0; }, 40)},
        {"a tube",
         lamp([](const auto& d) { return d.z < 0 && std::abs(d.y - 0.3) < 0.01 && std::abs(d.x) < 0.2; },
              400)},
        {"a star", lamp([](const auto& d) { return d.z < -0.9999; }, 4)},
        {"a dim disc", lamp([](const auto& d) { return d.z < -0.9995; }, 1)},
    };
    for (const auto& [what, sky] : skies) {
        const EnvironmentSun sun = environmentSun(sky);
        EXPECT_FALSE(sun.found) << what;
        EXPECT_NE(sun.why.find("16 times"), std::string::npos) << what;
    }
    // A brighter or smaller version of each is a sun.
    EXPECT_TRUE(environmentSun(lamp([](const auto& d) { return d.z < -0.9995; }, 100)).found);
    EXPECT_TRUE(environmentSun(lamp([](const auto& d) { return d.z < -0.9992; }, 100)).found);
}

// A wide glow stays in the residual; only the peak far above it is taken.
TEST(EnvironmentSun, OfAWideGlowIsItsPeak) {
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(-0.3, 0.7, 0.5));
    const Environment sky = painted(512, 256, [&](const glm::dvec3& d) {
        const double angle = glm::radians(angleBetween(d, to_sun));
        return glm::dvec3(0.05 + (angle < 0.01 ? 30000.0 : 60 * std::exp(-10 * angle)));
    });
    const EnvironmentSun sun = environmentSun(sky);
    expectAllIsKept(sky, sun, "glow");
    EXPECT_LT(angleBetween(-sun.light.direction, to_sun), 0.05);
    EXPECT_NEAR(glm::degrees(double{sun.light.angle}), glm::degrees(0.02), 0.4);
}

// The one of two that gives more light, not the one with higher radiance.
TEST(EnvironmentSun, IsTheOneThatGivesMost) {
    const glm::dvec3 small(0, 0, -1), large(1, 0, 0);
    const Environment sky = painted(512, 256, [&](const glm::dvec3& d) {
        return glm::dvec3(0.1 + (angleBetween(d, small) < 0.5 ? 2000 : 0) +
                          (angleBetween(d, large) < 2 ? 400 : 0));
    });
    EXPECT_LT(angleBetween(-environmentSun(sky).light.direction, large), 0.05);
}

TEST(EnvironmentSun, TurnsWithTheEnvironment) {
    Light light;
    light.kind = LightKind::directional;
    light.direction = {-1, 0, 0};  // from +X
    light.intensity = 3;
    const Light turned = rotatedSun(light, 90, 2);
    // Counter-clockwise seen from above, +X moves to -Z.
    EXPECT_LT(glm::length(turned.direction - glm::dvec3(0, 0, 1)), 1e-15);
    EXPECT_EQ(turned.intensity, 6);
    EXPECT_EQ(
        describe(turned, 0.25),
        "of 0 degrees towards (0.000, 0.000, -1.000), 6 lux (6, 6, 6), 25 % of the environment's light");
}

TEST(EnvironmentSun, OfRealEnvironments) {
    const std::filesystem::path folder(DIPTYCH_SOURCE_DIR "/../shared/assets/environments");
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "NO ASSETS at " << folder << ": real files are not tried";
    struct Row {
        const char* name;
        double largest;     // from the images' own list
        std::size_t notes;  // DWA undershoots; the quarry's sun has 153600, beyond half
        double fraction, left;
    };
    for (const auto& [name, largest, noted, fraction, left] :
         {Row{"city.exr", 33952, 1, 0.242, 20}, Row{"quarry_02_1k.exr", 65504, 1, 0.642, 20},
          Row{"vintage_measuring_lab_1k.exr", 49, 0, 0.036, 50},
          Row{"studio_small_08_1k.exr", 105, 0, 0, 0}}) {
        std::vector<std::string> notes;
        const Environment sky = readEnvironment(folder / name, notes);
        EXPECT_EQ(notes.size(), noted) << name;
        EXPECT_EQ(sky.radiance.width, 1024) << name;
        EXPECT_EQ(sky.radiance.height, 512) << name;
        EXPECT_NEAR(*std::ranges::max_element(sky.radiance.data), largest, 0.5) << name;
        EXPECT_GE(*std::ranges::min_element(sky.radiance.data), 0) << name;
        const EnvironmentSun sun = environmentSun(sky);
        RecordProperty(name, sun.found ? describe(sun.light, sun.fraction) : sun.why);
        EXPECT_EQ(sun.found, fraction > 0) << name;
        if (!sun.found) continue;
        expectAllIsKept(sky, sun, name);
        EXPECT_NEAR(sun.fraction, fraction, 1e-3) << name;
        EXPECT_LT(*std::ranges::max_element(sun.residual.radiance.data), left) << name;
    }
}

}  // namespace
}  // namespace diptych
