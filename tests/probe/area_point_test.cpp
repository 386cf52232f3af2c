// SPDX-License-Identifier: MIT
// Representative-point area lights compared with their definition in double: the point nearest to each
// lobe's ray (Karis 2013, "Real Shading in Unreal Engine 4"; Drobot 2014, GPU Pro 5), the solid angle, and
// the lowered peak. Independently of that definition, small lights must have the irradiance of their solid
// angle.
#include "compare/reference/scattering/brdf.h"
#include "tests/probe/area_builder.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

using reference::pi;

struct PointOfLight {
    glm::dvec3 diffuse_at, specular_at;  // from the surface, m
    double solid_angle;
    glm::dvec2 half_size;  // widens the lobe, m
};

// Intersection of the ray with the light's plane; if there is none, the point 1000 times the light's
// distance along the ray.
glm::dvec3 onPlaneOf(const Light& light, const glm::dvec3& ray) {
    const glm::dvec3& c = light.position;
    const double towards = glm::dot(ray, light.direction), away = glm::dot(c, light.direction);
    const glm::dvec3 p = towards * away > 0 ? ray * (away / towards) : ray * (1e3 * glm::length(c));
    return p - light.direction * glm::dot(p - c, light.direction);
}

glm::dvec3 nearestOf(const Light& light, const glm::dvec3& ray) {
    const glm::dvec3& c = light.position;
    if (light.kind == LightKind::rect) {
        const glm::dvec3 from = onPlaneOf(light, ray) - c, across = glm::cross(light.direction, light.axis);
        const double w = double{light.width} / 2, h = double{light.height} / 2;
        return c + light.axis * std::clamp(glm::dot(from, light.axis), -w, w) +
               across * std::clamp(glm::dot(from, across), -h, h);
    }
    if (light.kind == LightKind::disc) {
        const glm::dvec3 from = onPlaneOf(light, ray) - c;
        const double far = glm::length(from);
        return far > double{light.radius} ? c + from * (double{light.radius} / far) : c + from;
    }
    // Ternary search for the point of the axis nearest to the ray's line.
    const auto apart = [&](double s) {
        const glm::dvec3 p = c + light.axis * s;
        return glm::length(p - ray * glm::dot(p, ray));
    };
    double low = -double{light.length} / 2, high = -low;
    for (int i = 0; i < 200; ++i) {
        const double third = (high - low) / 3;
        (apart(low + third) < apart(high - third) ? high : low) +=
            (apart(low + third) < apart(high - third) ? -third : third);
    }
    const glm::dvec3 p = c + light.axis * ((low + high) / 2);
    const glm::dvec3 to_ray = ray * std::max(glm::dot(p, ray), 0.0) - p;
    const double way = glm::length(to_ray);
    return p + to_ray * std::min(double{light.radius} / std::max(way, 1e-12), 1.0);
}

// At most pi sr, the cosine-weighted solid angle of a hemisphere.
double solidAngle(double area, double square) {
    return area / (square + area / pi);
}

PointOfLight pointOf(const Light& light, const Receiver& r) {
    const glm::dvec3 n(0, 0, 1), c = light.position;
    const double alpha = r.roughness * r.roughness;
    const glm::dvec3 mirrored(-r.to_viewer.x, -r.to_viewer.y, r.to_viewer.z);
    // Lagarde and de Rousiers 2014, listing 22.
    const double towards = (1 - alpha) * (std::sqrt(1 - alpha) + alpha);
    PointOfLight p{nearestOf(light, glm::normalize(n + glm::normalize(c))),
                   nearestOf(light, glm::normalize(n * (1 - towards) + mirrored * towards)),
                   0,
                   {}};
    const double square = glm::dot(p.diffuse_at, p.diffuse_at), radius = double{light.radius};
    const glm::dvec3 l = p.diffuse_at / std::sqrt(square);
    if (light.kind == LightKind::tube) {
        const double length = double{light.length};
        p.solid_angle =
            solidAngle(apparentArea(light, l), std::sqrt(square * (square + length * length / 4)));
        p.half_size = {radius, length / 2 + radius};
        return p;
    }
    p.solid_angle =
        solidAngle(apparentArea(light, light.direction), square) * std::abs(glm::dot(l, light.direction));
    // Ellipse with the rectangle's area: pi a b = width x height.
    p.half_size = light.kind == LightKind::rect
                      ? glm::dvec2(double{light.width}, double{light.height}) / std::sqrt(pi)
                      : glm::dvec2(radius);
    return p;
}

// Radiance of both lobes: a punctual light at each point with the irradiance of the solid angle; the
// specular one scaled by the peak ratio of the widened lobe.
std::array<double, 2> byDefinition(const Light& light, const Receiver& r) {
    const PointOfLight p = pointOf(light, r);
    reference::Surface s;
    s.normal = s.geometric_normal = {0, 0, 1};
    s.to_viewer = r.to_viewer;
    s.albedo = glm::dvec3(r.albedo);
    s.metallic = r.metallic;
    s.roughness = r.roughness;
    s.dielectric_f0 = glm::dvec3(r.f0);
    s.dielectric_f90 = r.f90;
    const reference::Brdf brdf(s);
    const double far = glm::length(p.specular_at), alpha = r.roughness * r.roughness;
    const double width2 = alpha * alpha * r.nDotV();
    const glm::dvec2 tangent = p.half_size / (2 * far);
    const double lowered =
        width2 / std::sqrt((width2 + tangent.x * tangent.x) * (width2 + tangent.y * tangent.y));
    return {brdf(glm::normalize(p.diffuse_at)).diffuse.g * p.solid_angle,
            brdf(p.specular_at / far).specular.g * p.solid_angle * lowered};
}

Light shining(std::mt19937& random, LightKind kind) {
    std::uniform_real_distribution<double> unit(-1, 1), size(std::log(0.05), std::log(3.0));
    const auto direction = [&] {
        for (;;) {
            const glm::dvec3 v(unit(random), unit(random), unit(random));
            if (const double l = glm::length(v); l > 0.2 && l < 1) return v / l;
        }
    };
    Light light;
    light.kind = kind;
    light.position = direction() * std::exp(size(random));
    light.position.z = std::abs(light.position.z) + 0.1;
    light.direction = direction();
    if (glm::dot(light.direction, light.position) > 0) light.direction = -light.direction;
    light.axis = glm::normalize(glm::cross(light.direction, direction()));
    const auto metres = [&] { return static_cast<float>(std::exp(size(random)) / 2); };
    light.width = metres(), light.height = metres(), light.radius = metres() / 4, light.length = metres();
    return light;
}

class AreaPoints : public testing::TestWithParam<LightKind> {};

// Tolerances cover float32 rounding: some six roundings in a lobe with relative slope 1 / alpha^2 per
// radian. If two points of a light are almost equally near to the ray, the choice moves by the light's
// whole width, but its radiance there is about the same.
TEST_P(AreaPoints, FollowTheirDefinition) {
    Probes probes;
    std::mt19937 random(21);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<float> input;
    std::vector<std::array<double, 2>> expected;
    std::vector<std::string> names;
    while (expected.size() < 400) {
        const Light light = shining(random, GetParam());
        Receiver r{.roughness = 0.15 + 0.85 * unit(random), .metallic = expected.size() % 2 == 0 ? 1.0 : 0.0};
        r.to_viewer = viewAt(85 * unit(random), 6.28 * unit(random));
        // Inside a tube, the light is zero.
        const double along = glm::dot(light.position, light.axis);
        if (light.kind == LightKind::tube &&
            glm::length(light.position - light.axis * along) < 1.01 * double{light.radius})
            continue;
        pushArea(input, light, r);
        expected.push_back(byDefinition(light, r));
        names.push_back(fmt::format("case {}, roughness {:.3f}", expected.size() - 1, r.roughness));
    }
    const auto rows = shadeArea(probes, input, true);
    int lit = 0, glossy = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(rows[i][0], expected[i][0], 2e-5 * expected[i][0] + 1e-6) << names[i];
        EXPECT_NEAR(rows[i][1], expected[i][1], 2e-4 * expected[i][1] + 1e-6) << names[i];
        lit += expected[i][0] > 0.01;
        glossy += expected[i][1] > 0.01;
    }
    EXPECT_GT(lit, 60) << "the comparison has lost its point: nothing is lit";
    EXPECT_GT(glossy, 30);
}

// Lights of 1 % of their distance have the irradiance of their solid angle wherever the representative
// point lies: diffuse radiance is solid angle x cosine / pi, up to the square of their size.
TEST_P(AreaPoints, SmallLightsHaveTheirSolidAngle) {
    Probes probes;
    std::vector<float> input;
    std::vector<double> expected;
    for (const double size : {0.01, 0.003})
        for (const glm::dvec3& direction : {glm::dvec3(0.1, 0.2, -1), glm::dvec3(-0.6, 0.3, -0.7)}) {
            Light light = reference::lightOf(GetParam(), {0.4, -0.3, 1.2}, direction);
            const double far = glm::length(light.position), cosine = light.position.z / far;
            light.width = static_cast<float>(size * far), light.height = light.width / 2;
            light.length = light.width, light.radius = light.width / 6;
            Receiver lambert{.roughness = 1, .metallic = 0, .f0 = 0, .f90 = 0, .to_viewer = viewAt(20)};
            pushArea(input, light, lambert);
            expected.push_back(apparentArea(light, light.position / far) / (far * far) * cosine / pi);
        }
    const auto rows = shadeArea(probes, input, true);
    // A point at the light's rim instead of its centre shifts direction and distance by half its size.
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(rows[i][0], expected[i], 0.015 * expected[i]) << i;
}

// Negative control: half the length or width, or a quarter of the solid angle, is far from the definition.
TEST_P(AreaPoints, HalfASizeIsSeen) {
    std::mt19937 random(22);
    for (int i = 0; i < 20; ++i) {
        const Light light = shining(random, GetParam());
        Light half = light;
        half.length /= 2, half.width /= 2, half.radius /= 2;
        const Receiver r{.roughness = 0.5, .to_viewer = viewAt(30)};
        const double whole = byDefinition(light, r)[1], less = byDefinition(half, r)[1];
        if (whole > 1e-3) {
            EXPECT_GT(std::abs(whole - less), 0.02 * whole) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, AreaPoints, testing::ValuesIn(areaKinds), lightKindName);

}  // namespace
}  // namespace diptych::tests
