// SPDX-License-Identifier: MIT
// The reference under environments: directions, furnace tests, and its confidence intervals.
#include "tests/support/layer_formulas.h"
#include "tests/support/reference_builder.h"

#include "compare/reference/light/environment.h"

namespace diptych::reference {
namespace {

Environment constantSky(float radiance, int width = 8, int height = 4) {
    return {"sky", Image(width, height, 3, radiance)};
}

// One texel of radiance 1000, all others 0.1.
Environment sunnySky(int x, int y) {
    Environment sky = constantSky(0.1f, 16, 8);
    for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = 1000;
    return sky;
}

Shading under(const Environment& sky, const Surface& s, std::uint64_t seed, double factor = 1) {
    return Lighting({.environment = &sky, .environment_factor = factor})(s, {}, seed);
}

// scene.h: azimuth 2 pi (x + 0.5) / width - pi, 0 at -Z, positive towards +X; polar angle pi (y + 0.5) /
// height from +Y.
glm::dvec3 ofTexel(double x, double y, int width, int height) {
    const double azimuth = 2 * pi * (x + 0.5) / width - pi, down = pi * (y + 0.5) / height;
    return {std::sin(down) * std::sin(azimuth), std::cos(down), -std::sin(down) * std::cos(azimuth)};
}

TEST(ReferenceEnvironment, EachTexelIsWhereTheSceneSaysItIs) {
    Environment sky = constantSky(0, 8, 4);
    for (std::size_t i = 0; i < sky.radiance.data.size(); ++i) sky.radiance.data[i] = static_cast<float>(i);
    const EnvironmentLight light(sky, 2);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(light.radiance(ofTexel(x, y, 8, 4))[c], 2 * ((y * 8 + x) * 3 + c), 1e-10);
    // The axes by hand: -Z is between columns 3 and 4, rows 1 and 2; +X between columns 5 and 6; +Z at the
    // seam.
    const auto mean = [&](int a, int b) { return 3.0 * (8 + a + 8 + b + 16 + a + 16 + b) / 4 * 2; };
    EXPECT_NEAR(light.radiance({0, 0, -1}).r, mean(3, 4), 1e-10);
    EXPECT_NEAR(light.radiance({1, 0, 0}).r, mean(5, 6), 1e-10);
    EXPECT_NEAR(light.radiance({-1, 0, 0}).r, mean(1, 2), 1e-10);
    EXPECT_NEAR(light.radiance({0, 0, 1}).r, mean(0, 7), 1e-10);
}

// Without other lights, all reflected light is the environment's share, with any multiple scattering.
TEST(ReferenceEnvironment, ItsPartOfTheLightIsToldApart) {
    const Environment sky = sunnySky(3, 2);
    Surface s = mirror(0.9, 0.5);
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    const Light sun = lightOf(LightKind::directional, {}, {0.3, 0.4, -1});
    for (const Multiscatter each : {Multiscatter::off, Multiscatter::walk})
        for (const double metallic : {0.0, 1.0}) {
            s.metallic = metallic;
            const auto shaded = [&](std::span<const Light> lights, const Environment* environment) {
                return Lighting({.lights = lights, .environment = environment, .multiscatter = each})(s, {},
                                                                                                      1);
            };
            const Shading alone = shaded({}, &sky), beside = shaded(std::span(&sun, 1), &sky),
                          none = shaded(std::span(&sun, 1), nullptr);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(alone.environment.diffuse[c], alone.reflected.diffuse[c], 1e-12);
                EXPECT_NEAR(alone.environment.specular[c], alone.reflected.specular[c], 1e-12);
                EXPECT_NEAR(beside.environment.diffuse[c], alone.environment.diffuse[c],
                            0.02 * alone.environment.diffuse[c] + 1e-9);
            }
            EXPECT_GT(alone.environment.specular.g, 1e-3);
            EXPECT_EQ(none.environment.size(), 0);
        }
}

TEST(ReferenceEnvironment, PolesAndSeamAreContinuous) {
    Environment sky = constantSky(0, 8, 4);
    for (std::size_t i = 0; i < sky.radiance.data.size(); ++i)
        sky.radiance.data[i] = static_cast<float>((i * 37) % 101);
    const EnvironmentLight light(sky, 1);
    constexpr double step = 1e-7;
    for (const double y : {-1.0, -0.6, 0.1, 0.9, 1.0})
        for (int i = 0; i < 64; ++i) {
            const double turn = 2 * pi * i / 64, across = std::sqrt(1 - y * y);
            const glm::dvec3 d(across * std::sin(turn), y, across * std::cos(turn));
            for (const glm::dvec3 aside :
                 {glm::dvec3(step, 0, 0), {-step, 0, 0}, {0, 0, step}, {0, 0, -step}})
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(light.radiance(d)[c], light.radiance(glm::normalize(d + aside))[c],
                                std::abs(y) == 1 ? 101 : 1e-3)
                        << y << " " << turn;
        }
    // Across a pole, rows continue rotated by 180 degrees.
    for (int i = 0; i < 16; ++i) {
        const double turn = 2 * pi * i / 16;
        const glm::dvec3 aside(step * std::sin(turn), 0, step * std::cos(turn)), up(0, 1, 0);
        EXPECT_NEAR(light.radiance(glm::normalize(up + aside)).r,
                    light.radiance(glm::normalize(up - aside)).r, 1e-3);
        EXPECT_NEAR(light.radiance(glm::normalize(aside - up)).r,
                    light.radiance(glm::normalize(-up - aside)).r, 1e-3);
    }
}

// The stated density is that of the samples, and never 0 where there is relevant light.
TEST(ReferenceEnvironment, SamplesComeAsOftenAsTheDensitySays) {
    const Environment sky = sunnySky(15, 1);
    const EnvironmentLight light(sky, 1);
    const std::vector<EnvironmentLight::Sampler::Weight> weights{
        [](const glm::dvec3&, double) { return 1.0; }, [](const glm::dvec3& d, double) { return 1.5 + d.x; },
        [](const glm::dvec3& d, double) { return d.z > 0 ? 1.0 : 0.0; }};
    constexpr int rows = 16, columns = 32, steps = 512;
    for (const auto& weight : weights) {
        const EnvironmentLight::Sampler sampler(light, weight);
        std::vector<double> drawn(rows * columns), said(rows * columns);
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const glm::dvec3 d = sampler({(i + 0.5) / steps, (j + 0.5) / steps});
                ASSERT_NEAR(glm::length(d), 1, 1e-12);
                const int x = static_cast<int>((std::atan2(d.x, -d.z) / (2 * pi) + 0.5) * columns);
                const int y = static_cast<int>(std::acos(d.y) / pi * rows);
                drawn[static_cast<std::size_t>(std::clamp(y, 0, rows - 1) * columns +
                                               std::clamp(x, 0, columns - 1))] += 1.0 / (steps * steps);
            }
        double sum = 0;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const double solid =
                    2 * pi / columns * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
                const double density = sampler.density(ofTexel(x, y, columns, rows));
                EXPECT_EQ(density > 0, weight(ofTexel(x / 2, y / 2, 16, 8), 0) > 0);
                said[static_cast<std::size_t>(y * columns + x)] = density * solid;
                sum += density * solid;
            }
        EXPECT_NEAR(sum, 1, 1e-12);
        // Allows one grid step in either direction at each edge.
        for (std::size_t i = 0; i < drawn.size(); ++i)
            EXPECT_NEAR(drawn[i], said[i], 4.0 / steps * said[i] + 2e-3) << i;
    }
}

TEST(ReferenceEnvironment, ABlackSkyIsNone) {
    const Environment sky = constantSky(0);
    EXPECT_EQ(under(sky, lambertian(), 1).reflected.size(), 0);
    EXPECT_EQ(under(constantSky(1), lambertian(), 1, 0).reflected.size(), 0);
}

// A plane under a constant environment shows its albedo; with F = 1, the furnace's values. 95 % of
// independent errors must be within the stated confidence interval, and none beyond four times it.
void expectConfident(const Environment& sky, const Surface& s, double expected, double worst) {
    int within = 0;
    double mean = 0;
    constexpr int seeds = 100;
    for (int seed = 0; seed < seeds; ++seed) {
        const Shading shading = under(sky, s, static_cast<std::uint64_t>(seed) * 7919);
        const double value = shading.reflected.diffuse.r + shading.reflected.specular.r;
        within += std::abs(value - expected) <= std::max(shading.uncertainty, 1e-12 * expected);
        EXPECT_LE(shading.uncertainty, 1.03 * worst * expected);  // relative to the estimate
        EXPECT_LE(std::abs(value - expected), 4 * shading.uncertainty + 1e-12 * expected) << seed;
        mean += value / seeds;
    }
    EXPECT_GE(within, 90);
    EXPECT_NEAR(mean, expected, expected * samplingError / 5) << "no bias that a mean of many would show";
}

TEST(ReferenceEnvironment, ALambertianPlaneUnderAConstantSkyIsItsAlbedo) {
    Surface s = lambertian({0.3, 0.4, -0.2});
    s.albedo = glm::dvec3(0.6);
    expectConfident(constantSky(2), s, 2 * 0.6, samplingError);
}

TEST(ReferenceEnvironment, TheWhiteFurnacesMetrics) {
    for (const auto& [roughness, albedo] : whiteAlbedos)
        expectConfident(constantSky(1), mirror(roughness, 0), albedo, samplingError);
    // The narrowest lobe loses almost nothing: its albedo, summed over half vectors, is 0.99998.
    expectConfident(constantSky(1), mirror(0.045, 0), 0.99998, samplingError);
}

// Compared with a sum over all directions: at the seam, and at a pole.
TEST(ReferenceEnvironment, OneBrightTexel) {
    for (const glm::ivec2 texel : {glm::ivec2(15, 3), {7, 0}}) {
        const Environment sky = sunnySky(texel.x, texel.y);
        const EnvironmentLight light(sky, 1);
        const Surface s = lambertian(ofTexel(texel.x + 2.5, texel.y + 0.3, 16, 8));
        constexpr int rows = 256, columns = 512;
        double expected = 0;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const glm::dvec3 d = ofTexel(x, y, columns, rows);
                expected += std::max(glm::dot(d, s.normal), 0.0) / pi * light.radiance(d).r * 2 * pi /
                            columns * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
            }
        expectConfident(sky, s, expected, 0.02);
    }
}

// Environments with few pixels, which extend from far below the horizon to above it, and a lobe that does
// not see this part.
TEST(ReferenceEnvironment, ASmoothLayerOverAWhiteBaseUnderACoarseSky) {
    Surface s = lambertian({0.2, 1, 0.1});
    s.roughness = 0.045;
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 0.04;  // F90 = F0: 0.96 of the light reaches the base, the rest is mirrored
    s.to_viewer = s.normal;
    for (const glm::ivec2 size : {glm::ivec2(2, 1), {8, 4}, {64, 32}})
        expectConfident(constantSky(1, size.x, size.y), s, 0.96 + 0.04 * 0.99998, samplingError);
}

// Noise correlated between neighbouring pixels would be visible as a pattern.
TEST(ReferenceEnvironment, NeighboursErrAlone) {
    const Environment sky = constantSky(1);
    constexpr int pixels = 400;
    std::vector<double> error;
    for (std::uint64_t seed = 0; seed <= pixels; ++seed)
        error.push_back(under(sky, lambertian(), seed).reflected.diffuse.r - 1);
    double together = 0, alone = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        together += error[i] * error[i + 1];
        alone += error[i] * error[i];
    }
    EXPECT_LT(std::abs(together / alone), 4 / std::sqrt(double{pixels})) << "four standard deviations";
}

TEST(ReferenceEnvironment, WhatIsHiddenOfASkyIsDark) {
    const Environment sky = constantSky(1);
    const Lighting lighting({.environment = &sky, .shadowed_environment = true});
    const Visibility half = [](const glm::dvec3&d, double) { return d.x > 0; },
                     none = [](const glm::dvec3&, double) { return false; };
    EXPECT_EQ(lighting(lambertian(), none, 1).reflected.size(), 0);
    int within = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Shading shading = lighting(lambertian(), half, seed * 7919);
        within += std::abs(shading.reflected.diffuse.r - 0.5) <= shading.uncertainty;
    }
    EXPECT_GE(within, 90);
}

}  // namespace
}  // namespace diptych::reference
