// SPDX-License-Identifier: MIT
// The shipped area lights: their closed forms against quadrature in double.
#include "tests/probe/area_maker.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <random>

namespace diptych::tests {
namespace {

glm::dvec3 randomUnit(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    for (;;) {
        const glm::dvec3 v(unit(random), unit(random), unit(random));
        if (const double l = glm::length(v); l > 0.1 && l < 1) return v / l;
    }
}

Light lightAround(std::mt19937& random, LightKind kind, double least, double most) {
    std::uniform_real_distribution<double> size(std::log(least), std::log(most)), unit(0, 1);
    const auto metres = [&] { return static_cast<float>(std::exp(size(random))); };
    Light light;
    light.kind = kind;
    light.position = randomUnit(random) * std::exp(size(random) * 0.5);
    light.direction = randomUnit(random);
    if (unit(random) < 0.7 && glm::dot(light.direction, light.position) > 0) light.direction = -light.direction;
    light.axis = glm::normalize(glm::cross(light.direction, randomUnit(random)));
    light.width = metres(), light.height = metres(), light.radius = metres() / 2, light.length = metres();
    light.two_sided = unit(random) < 0.3;
    return light;
}

std::string words(const Light& l, const Receiver& r) {
    const auto v = [](const glm::dvec3& a) { return fmt::format("[{}, {}, {}]", a.x, a.y, a.z); };
    return fmt::format("kind {} at {} towards {} axis {} width {} height {} radius {} length {}{}; roughness {}, view {}",
                       static_cast<int>(l.kind), v(l.position), v(l.direction), v(l.axis), l.width, l.height, l.radius,
                       l.length, l.two_sided ? " two-sided" : "", r.roughness, v(r.to_viewer));
}

class AreaShapes : public testing::TestWithParam<LightKind> {};

// Lambert alone, and a lobe of F = 1: the table's magnitude times the transformed cosine over the light.
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
        const LtcCell cell = ltcTable().at(r.roughness, r.nDotV());
        const ltc::Transform lobe = ltc::transformOf(cell, r.roughness * r.roughness, r.nDotV());
        const double plain = shareOfSky(light, {}, r.to_viewer);
        expected.push_back({plain, double{cell.magnitude} * shareOfSky(light, lobe, r.to_viewer)});
        names.push_back(words(light, r));
        Receiver lambert = r;
        lambert.metallic = 0, lambert.f0 = 0, lambert.f90 = 0;
        pushArea(input, light, lambert);
        pushArea(input, light, r);
    }
    const auto rows = shadeArea(probes, input);
    double worst[2] = {0, 0};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double diffuse = rows[2 * i][0], specular = rows[2 * i + 1][1];
        ASSERT_TRUE(std::isfinite(diffuse) && std::isfinite(specular)) << names[i];
        const double off[2] = {std::abs(diffuse - expected[i][0]), std::abs(specular - expected[i][1])};
        for (int k : {0, 1}) {
            worst[k] = std::max(worst[k], off[k]);
            EXPECT_LE(off[k], 2e-4) << (k ? "specular " : "diffuse ") << (k ? specular : diffuse) << " for "
                                   << expected[i][k] << ": " << names[i];
        }
    }
    fmt::print("worst: diffuse {:.2g}, specular {:.2g}\n", worst[0], worst[1]);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AreaShapes, testing::Values(LightKind::rect, LightKind::disc, LightKind::tube),
                         [](const auto& kind) {
                             return kind.param == LightKind::rect   ? "rect"
                                    : kind.param == LightKind::disc ? "disc"
                                                                    : "tube";
                         });

}  // namespace
}  // namespace diptych::tests
