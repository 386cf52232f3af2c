// SPDX-License-Identifier: MIT
// Closed forms of the shaders' area lights, compared with quadrature in double.
#include "tests/probe/area_builder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

glm::dvec3 randomUnit(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    for (;;) {
        const glm::dvec3 v(unit(random), unit(random), unit(random));
        if (const double l = glm::length(v); l > 0.1 && l < 1) return v / l;
    }
}

Light lightAround(std::mt19937& random, LightKind kind, double min, double max) {
    std::uniform_real_distribution<double> size(std::log(min), std::log(max)), unit(0, 1);
    const auto metres = [&] { return static_cast<float>(std::exp(size(random))); };
    Light light;
    light.kind = kind;
    light.position = randomUnit(random) * std::exp(size(random) * 0.5);
    light.direction = randomUnit(random);
    if (unit(random) < 0.7 && glm::dot(light.direction, light.position) > 0)
        light.direction = -light.direction;
    light.axis = glm::normalize(glm::cross(light.direction, randomUnit(random)));
    light.width = metres(), light.height = metres(), light.radius = metres() / 2, light.length = metres();
    light.two_sided = unit(random) < 0.3;
    return light;
}

std::string text(const Light& l, const Receiver& r) {
    const auto v = [](const glm::dvec3& a) { return fmt::format("[{}, {}, {}]", a.x, a.y, a.z); };
    return fmt::format(
        "kind {} at {} towards {} axis {} width {} height {} radius {} length {}{}; roughness {}, view {}",
        static_cast<int>(l.kind), v(l.position), v(l.direction), v(l.axis), l.width, l.height, l.radius,
        l.length, l.two_sided ? " two-sided" : "", r.roughness, v(r.to_viewer));
}

// Light that shines down on the surface, slightly tilted.
Light lightOf(LightKind kind) {
    Light light = reference::lightOf(kind, {0.4, -0.3, 1.2}, {0.1, 0.2, -1});
    light.width = 1, light.height = 0.6f, light.radius = 0.3f, light.length = 1;
    return light;
}

class AreaShapes : public testing::TestWithParam<LightKind> {};

// Lambertian lobe, and specular lobes of metals and layers: the transformed cosine integrated over the
// light, with the lobe's own value in the mean direction. Both closed forms sum a dozen float32 terms that
// largely cancel, and M^-1 amplifies rounding by up to 500. The tolerance, 2e-5 of the sky, is ten times
// the measured error.
TEST_P(AreaShapes, AreIntegratedExactly) {
    Probes probes;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<float> input;
    std::vector<std::array<double, 2>> expected;
    std::vector<std::string> names;
    for (int i = 0; i < 600; ++i) {
        const Light light = lightAround(random, GetParam(), 0.02, 20);
        Receiver r;
        r.roughness = std::max(unit(random), 0.045);
        r.to_viewer = viewAt(88 * unit(random), 6.28 * unit(random));
        r.metallic = i % 3 == 0 ? 1 : i % 3 == 1 ? 0 : unit(random);
        r.albedo = 0.2 + 0.8 * unit(random);
        const LtcCell cell = ltcTable().at(r.roughness, r.nDotV());
        const double plain = fractionOfSky(light, {}, r.to_viewer);
        expected.push_back({plain, specularOf(light, cell, r)});
        names.push_back(text(light, r));
        Receiver lambert = r;
        lambert.metallic = 0, lambert.albedo = 1, lambert.f0 = 0, lambert.f90 = 0;
        pushArea(input, light, lambert);
        pushArea(input, light, r);
    }
    const auto rows = shadeArea(probes, input);
    int lit = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(rows[2 * i][0], expected[i][0], 2e-5) << "diffuse: " << names[i];
        EXPECT_NEAR(rows[2 * i + 1][1], expected[i][1], 2e-5) << "specular: " << names[i];
        lit += expected[i][0] > 0.01;
    }
    EXPECT_GT(lit, 150) << "the comparison has lost its point: nothing is lit";
}

// Negative control: a light that is 1 % larger is detected.
TEST_P(AreaShapes, OnePerCentMoreIsSeen) {
    Probes probes;
    Light light = lightOf(GetParam());
    std::vector<float> input;
    pushArea(input, light, {});
    light.width *= 1.01f, light.radius *= 1.01f;
    pushArea(input, light, {});
    const auto rows = shadeArea(probes, input);
    EXPECT_GT(std::abs(rows[0][1] - rows[1][1]), 1e-4);
}

double solidAngleOf(const Light& light) {
    const double distance = glm::length(light.position);
    return apparentArea(light, light.position / distance) / (distance * distance);
}
glm::dvec3 inLobe(const Light& light, const Receiver& r) {
    const glm::dvec3 l = glm::normalize(light.position),
                     x = -glm::normalize(glm::dvec3(r.to_viewer.x, r.to_viewer.y, 0));
    return {glm::dot(l, x), glm::dot(l, glm::cross(glm::dvec3(0, 0, 1), x)), l.z};
}

// Distant and tiny lights behave like points: within 0.1 %, down to 1e-6 of the distance in size.
TEST_P(AreaShapes, FarAwayTheyArePoints) {
    Probes probes;
    std::vector<float> input;
    std::vector<double> expected;
    for (const double distance : {1.0, 100.0, 1e5})
        for (const double fraction : {0.3, 0.03, 1e-3, 1e-5, 1e-6}) {
            Light light = lightOf(GetParam());
            light.position *= distance;
            light.width = light.height = light.length = static_cast<float>(fraction * distance);
            light.radius = light.width / 3;
            Receiver r{.roughness = 0.4, .to_viewer = viewAt(30)};
            const LtcCell cell = ltcTable().at(r.roughness, r.nDotV());
            pushArea(input, light, r);
            // Where rounding dominates the outline's sum, expect solid angle times density.
            const glm::dvec3 l = inLobe(light, r);
            expected.push_back(
                fraction > 1e-2
                    ? specularOf(light, cell, r)
                    : specularOf(solidAngleOf(light) * transformOf(cell, r).density(l), l, cell, r));
        }
    const auto rows = shadeArea(probes, input);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(rows[i][1], expected[i], 1e-3 * expected[i]) << "case " << i;
}

// A disc that faces the surface subtends a round cone, whose axes are undetermined: sin^2 of its half
// angle times the cosine of its direction while it is above the horizon.
TEST(AreaDiscs, ThatFaceTheSurfaceAreRound) {
    Probes probes;
    std::vector<float> input;
    std::vector<double> expected;
    for (const double degrees : {0.0, 20.0, 45.0, 60.0})
        for (const double azimuth : {0.0, 1.0, reference::pi})
            for (const double distance : {0.5, 1.0, 3.0})
                for (const double radius : {0.01, 0.15, 0.25}) {
                    const glm::dvec3 towards = viewAt(degrees, azimuth);
                    Light light = reference::lightOf(LightKind::disc, towards * distance, -towards);
                    light.radius = static_cast<float>(radius);
                    pushArea(input, light, {.metallic = 0, .f0 = 0, .f90 = 0, .to_viewer = viewAt(45)});
                    expected.push_back(towards.z * radius * radius / (radius * radius + distance * distance));
                }
    const auto rows = shadeArea(probes, input);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(rows[i][0], expected[i], 2e-6) << i;
}

// At and beyond the range, from behind and from inside: exactly zero, so that culling changes no bit.
TEST_P(AreaShapes, GiveExactlyNothingWhereTheyEnd) {
    Probes probes;
    std::vector<float> input;
    for (const bool points : {false, true}) {
        input.clear();
        Light light = lightOf(GetParam());
        light.range = static_cast<float>(glm::length(light.position));
        for (const float factor : {1.0f, 0.999f, 0.5f, 1e-3f}) {
            Light shorter = light;
            shorter.range *= factor;
            pushArea(input, shorter, {});
        }
        Light behind = light;
        behind.range = std::numeric_limits<float>::infinity();
        behind.direction = -behind.direction;
        if (GetParam() == LightKind::tube) behind.position = behind.axis * 0.05, behind.radius = 0.2f;
        pushArea(input, behind, {});
        for (const auto& row : shadeArea(probes, input, points)) {
            EXPECT_EQ(row[0], 0);
            EXPECT_EQ(row[1], 0);
        }
        light.range *= 1.01f;
        input.clear();
        pushArea(input, light, {});
        EXPECT_GT(shadeArea(probes, input, points)[0][1], 0);
    }
}

// A light below the horizon contributes to neither lobe, at any roughness and viewing angle.
TEST_P(AreaShapes, NothingComesFromBelow) {
    Probes probes;
    std::vector<float> input;
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double degrees : {0.0, 60.0, 85.0, 89.9}) {
            Light light = lightOf(GetParam());
            light.position.z = -1, light.two_sided = true;
            light.width = light.height = light.length = 0.5f, light.radius = 0.3f;
            pushArea(input, light, {.roughness = roughness, .metallic = 0.5, .to_viewer = viewAt(degrees)});
        }
    for (const auto& row : shadeArea(probes, input)) EXPECT_EQ(row[0] + row[1], 0);
}

// On the light's plane, edge, corner, axis, surface and centre, and edge-on, from 1e-15 m to 1e15 m:
// results are finite, and no lobe exceeds the reflection of a sky of the same radiance.
TEST_P(AreaShapes, StayFiniteAndDarkerThanTheSky) {
    Probes probes;
    for (const bool points : {false, true}) {
        std::vector<float> input;
        for (const double size : {1e-15, 1e-6, 1.0, 1e6, 1e15})
            for (const double x : {0.0, 0.5, 0.5000001, 1.0})
                for (const double z : {0.0, 1e-7, 0.5, 1.0, 1e3})
                    for (const glm::dvec3 direction : {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1),
                                                       glm::dvec3(1, 0, 0), glm::dvec3(-0.6, 0, -0.8)})
                        for (const double degrees : {0.0, 89.999})
                            for (const double roughness : {0.0, 1.0}) {
                                Light light;
                                light.kind = GetParam();
                                light.direction = direction;
                                light.axis = {-direction.z, 0, direction.x};
                                light.position = glm::dvec3(x, 0, z) * size;
                                light.width = light.height = light.length = static_cast<float>(size);
                                light.radius = light.width / 2;
                                light.two_sided = true;
                                pushArea(
                                    input, light,
                                    {.roughness = roughness, .metallic = 0.5, .to_viewer = viewAt(degrees)});
                            }
        const auto rows = shadeArea(probes, input, points);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (const double value : rows[i]) {
                ASSERT_TRUE(std::isfinite(value)) << i;
                ASSERT_GE(value, 0) << i;
                // Each lobe, plus 0.1 % for rounding. The representative point has no such bound.
                if (!points) {
                    ASSERT_LE(value, 1.001) << i;
                }
            }
        }
    }
}

// A layer's reduction of its dielectric base is exact for small lights, up to the square of their apparent
// size, and approximate for large ones.
TEST_P(AreaShapes, TheBaseLosesWhatTheLayerReflects) {
    Probes probes;
    std::vector<float> input;
    std::vector<double> expected, allowed;
    for (const double size : {0.01, 1.0})
        for (const double degrees : {0.0, 45.0, 75.0}) {
            Light light = lightOf(GetParam());
            light.width = light.height = light.length = static_cast<float>(size),
            light.radius = light.width / 3;
            const Receiver r{.roughness = 0.5, .metallic = 0, .f0 = 0.04, .to_viewer = viewAt(degrees, 2)};
            pushArea(input, light, r);
            expected.push_back(referenceArea(light, r)[0]);
            allowed.push_back(size < 0.1 ? 3e-4 : 0.02);
        }
    const auto rows = shadeArea(probes, input);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(rows[i][0], expected[i], allowed[i] * expected[i]) << i;
}

INSTANTIATE_TEST_SUITE_P(Kinds, AreaShapes, testing::ValuesIn(areaKinds), lightKindName);

}  // namespace
}  // namespace diptych::tests
