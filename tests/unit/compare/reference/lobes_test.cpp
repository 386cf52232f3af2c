// SPDX-License-Identifier: MIT
// The reference's material and its reflection of area lights, compared with independent formulas and sums.
#include "tests/support/layer_formulas.h"
#include "tests/support/reference_builder.h"

#include "compare/reference/scattering/brdf.h"

#include <functional>
#include <random>

namespace diptych::reference {
namespace {

// glTF 2.0, appendix B, with f0 and f90 of KHR_materials_specular, on a surface that faces +Z. First colour
// component only.
double appendixB(const Surface& s, const glm::dvec3& l) {
    if (l.z <= 0) return 0;
    const double vh = glm::dot(s.to_viewer, glm::normalize(l + s.to_viewer));
    const double lobe = stretchedLobe(glm::dvec2(s.roughness * s.roughness), l, s.to_viewer);
    const glm::dvec3 layer = s.dielectric_f0 + (s.dielectric_f90 - s.dielectric_f0) * schlick(vh, 0);
    const double base = (1 - std::max({layer.r, layer.g, layer.b})) * s.albedo.r / pi * l.z;
    return s.metallic * schlick(vh, s.albedo.r) * lobe + (1 - s.metallic) * (base + layer.r * lobe);
}

double red(const Reflected& r) {
    return r.diffuse.r + r.specular.r;
}

Surface plastic(double roughness, double angle, double metallic) {
    Surface s = mirror(roughness, angle);
    s.albedo = {0.8, 0.3, 0.1};
    s.metallic = metallic;
    s.dielectric_f0 = {0.04, 0.05, 0.02};
    s.dielectric_f90 = 0.9;
    return s;
}

TEST(ReferenceLobes, TheMaterialIsAppendixB) {
    for (const double roughness : {0.045, 0.1, 0.3, 0.7, 1.0})
        for (const double metallic : {0.0, 0.4, 1.0})
            for (const double view : {0.0, 0.6, 1.2, 1.55})
                for (const double light : {0.01, 0.6, 1.2, 1.5})
                    for (const double turn : {0.0, 1.0, pi}) {
                        const Surface s = plastic(roughness, view, metallic);
                        const double expected = appendixB(s, polar(light, turn));
                        EXPECT_NEAR(red(Brdf(s)(polar(light, turn))), expected, 1e-9 * expected);
                    }
    EXPECT_EQ(red(Brdf(plastic(0.3, 0.5, 0.5))(polar(1.6, 0))), 0) << "below the horizon";
}

TEST(ReferenceLobes, LightAndViewerMayChangePlaces) {
    for (const double roughness : {0.045, 0.3, 1.0})
        for (const double metallic : {0.0, 1.0})
            for (const double turn : {0.3, 2.5}) {
                Surface there = plastic(roughness, 0, metallic), back = there;
                there.to_viewer = polar(0.4, 0);
                back.to_viewer = polar(1.1, turn);
                EXPECT_NEAR(red(Brdf(there)(back.to_viewer)) / std::cos(1.1),
                            red(Brdf(back)(there.to_viewer)) / std::cos(0.4),
                            1e-9 * red(Brdf(there)(back.to_viewer)));
            }
}

// A limit of the model (compare/reference/README.md, "The model"): roughness below 0.045 is clamped to
// 0.045.
TEST(ReferenceLobes, AMirrorIsAsRoughAsTheModelsSmoothest) {
    const glm::dvec3 l = polar(0.501, pi);
    EXPECT_EQ(red(Brdf(mirror(0, 0.5))(l)), red(Brdf(mirror(0.045, 0.5))(l)));
    EXPECT_NE(red(Brdf(mirror(0.05, 0.5))(l)), red(Brdf(mirror(0.045, 0.5))(l)));
}

// ---- uniform light -----------------------------------------------------------------------------------

double hemisphere(const Surface& s, int steps) {
    const Brdf brdf(s);
    const double alpha = std::pow(std::max(s.roughness, 0.045), 2);
    double sum = 0;
    for (const auto& [l, weight] : reflectedDirections(s.to_viewer, alpha, steps, steps / 2))
        sum += red(brdf(l)) * weight;
    return sum;
}

TEST(ReferenceLobes, TheWhiteFurnacesMetrics) {
    for (const auto& [roughness, albedo] : whiteAlbedos)
        EXPECT_NEAR(hemisphere(mirror(roughness, 0), 400), albedo, 5e-5);
    for (const double roughness : {0.045, 0.2, 0.6, 1.0})
        for (const double angle : {0.0, 0.7, 1.3, 1.5})
            EXPECT_LE(hemisphere(mirror(roughness, angle), 200), 1 + 1e-4);
}

TEST(ReferenceLobes, TheWhiteFurnacesLosses) {
    for (const auto& [roughness, loss] : whiteLosses) {
        double mean = 0;
        constexpr int views = 32;
        for (int i = 0; i < views; ++i)
            mean += hemisphere(mirror(roughness, std::acos(std::sqrt((i + 0.5) / views))), 240) / views;
        EXPECT_NEAR(1 - mean, loss, loss < 0.1 ? 3e-4 : 1e-3) << roughness;
    }
}

// ---- area lights -------------------------------------------------------------------------------------

// Simpson's rule with the substitution x = middle + width sinh t: points are dense within `width` of the
// lobe's centre. The derivative is an additional factor.
struct Crowded {
    double from, to, middle, width;
    template <class F>
    double operator()(int steps, F&& f) const {
        const double t0 = std::asinh((from - middle) / width), t1 = std::asinh((to - middle) / width);
        double sum = 0;
        for (int i = 0; i <= steps; ++i) {
            const double t = t0 + (t1 - t0) * i / steps;
            sum += f(middle + width * std::sinh(t)) * width * std::cosh(t) *
                   (i == 0 || i == steps ? 1
                    : i % 2              ? 4
                                         : 2);
        }
        return sum * (t1 - t0) / steps / 3;
    }
};

// A rectangle at z = 1 facing down, from x0 to x1 and y0 to y1; the lobe's centre is at `mirrored`.
double ceilingLight(const Surface& s, const glm::dvec4& extent, const glm::dvec2& mirrored) {
    const double alpha = s.roughness * s.roughness;
    const Crowded along_x{extent.x, extent.y, mirrored.x, alpha},
        along_y{extent.z, extent.w, mirrored.y, alpha};
    return along_x(300, [&](double x) {
        return along_y(300, [&](double y) {
            const double square = x * x + y * y + 1;
            return appendixB(s, glm::normalize(glm::dvec3(x, y, 1))) / (square * std::sqrt(square));
        });
    });
}

Light ceilingRect(const glm::dvec4& e) {
    Light light = lightOf(LightKind::rect, {(e.x + e.y) / 2, (e.z + e.w) / 2, 1});
    light.axis = {1, 0, 0};
    light.width = static_cast<float>(e.y - e.x);
    light.height = static_cast<float>(e.w - e.z);
    return light;
}

// The mirror direction hits the light's centre, a corner or an edge, or misses it. Sizes are exact in
// float32. Half a metal: its light is the mean of a metal's and a dielectric's.
TEST(ReferenceLobes, ARectangleInALobeOfAnyWidth) {
    for (const double roughness : {0.045, 0.1, 0.3, 1.0})
        for (const double angle : {0.0, 0.6, 1.2}) {
            const Surface s = plastic(roughness, angle, 0.5);
            const glm::dvec2 m{-std::tan(angle), 0};
            for (const glm::dvec4& location : {glm::dvec4(-1, 1, -1, 1),
                                               {-4, 0.0625, -0.03125, 2},
                                               {0, 8, -4, 4},
                                               {0.125, 1, 0.25, 1},
                                               {-0.015625, 0.5, -0.015625, 0.0625}}) {
                // The light's float32 centre is off by 1e-7 / alpha, relative to the narrowest lobe.
                Light light = ceilingRect(location);
                light.position.x += m.x;
                const glm::dvec4 e = location + glm::dvec4(m.x, m.x, 0, 0);
                const double expected = ceilingLight(s, e, m);
                const Shading shading = shadedBy(std::span(&light, 1), s);
                EXPECT_NEAR(red(shading.reflected), expected, 1e-6 * expected)
                    << roughness << " " << angle << " " << location.x;
                EXPECT_LE(shading.uncertainty, 1e-6 * expected);
            }
        }
}

// At a grazing angle the lobe becomes a streak, cut by the plane's horizon.
TEST(ReferenceLobes, AWallSeenAtAGrazingAngle) {
    for (const double roughness : {0.045, 0.2, 0.6}) {
        const Surface s = plastic(roughness, 1.5, 0);
        Light wall = lightOf(LightKind::rect, {-2, 0, 0}, {1, 0, 0});
        wall.axis = {0, 1, 0};
        wall.width = wall.height = 2;  // from z = -1 to 1
        const double alpha = roughness * roughness, mirrored = 2 / std::tan(1.5);
        const Crowded along_y{-1, 1, 0, alpha / 4}, along_z{0, 1, mirrored, alpha / 4};
        const double expected = along_y(600, [&](double y) {
            return along_z(1200, [&](double z) {
                const double square = 4 + y * y + z * z;
                return z > 0 ? appendixB(s, glm::normalize(glm::dvec3(-2, y, z))) * 2 /
                                   (square * std::sqrt(square))
                             : 0;
            });
        });
        EXPECT_NEAR(red(shadedBy(std::span(&wall, 1), s).reflected), expected, 2e-6 * expected) << roughness;
    }
}

// A disc and a tube that fill the lobe show the mirror's albedo, whatever their outline. The hemisphere's
// sum gives this albedo for F = 1.
TEST(ReferenceLobes, ALightThatFillsTheLobeIsSeenInIt) {
    const Surface s = mirror(0.045, 0.4);
    const double all = hemisphere(s, 300);
    Light disc = lightOf(LightKind::disc, {0, 0, 0.5});
    disc.radius = 400;
    EXPECT_NEAR(red(shadedBy(std::span(&disc, 1), s).reflected), all, 2e-4);
    Light tube = lightOf(LightKind::tube, {-0.4 * 3, 0, 3});
    tube.axis = {0, 1, 0};
    tube.radius = 1;
    tube.length = 40;
    const double mirrored = red(shadedBy(std::span(&tube, 1), s).reflected);
    EXPECT_NEAR(mirrored, all, 5e-3) << "what is beyond the tube's sides is the lobe's tail";
    EXPECT_LT(mirrored, all);
}

TEST(ReferenceLobes, ASunInAMirror) {
    const Surface s = mirror(0.1, 0.3);
    Light sun = lightOf(LightKind::directional, {0, 0, 0}, -polar(0.3, pi));
    sun.angle = 0.0093f;
    sun.intensity = 1;
    // In polar coordinates around the sun's centre the lobe is smooth.
    const glm::dvec3 z = -sun.direction, x = sun.axis, y = glm::cross(z, x);
    const double edge = double{sun.angle} / 2;
    double sum = 0;
    constexpr int steps = 400;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double a = (i + 0.5) / steps * edge, t = 2 * pi * (j + 0.5) / steps;
            sum += appendixB(s, z * std::cos(a) + (x * std::cos(t) + y * std::sin(t)) * std::sin(a)) *
                   std::sin(a);
        }
    const double radiance = 1 / (pi * std::pow(std::sin(edge), 2));
    const double expected = sum * edge / steps * 2 * pi / steps * radiance;
    EXPECT_NEAR(red(shadedBy(std::span(&sun, 1), s).reflected), expected, 2e-6 * expected);
}

// ---- rounding ----------------------------------------------------------------------------------------

// The light of a point in float32, without cancellation in the lobe: GGX, Smith's height-correlated masking
// and KHR_lights_punctual's window.
double lightInFloat(const Light& light, const glm::vec3& location, const glm::vec3& n, float alpha) {
    const glm::vec3 away = glm::vec3(light.position) - location, v = -location / glm::length(location);
    const float d2 = glm::dot(away, away), x = d2 * (1 / (light.range * light.range));
    const glm::vec3 l = away / std::sqrt(d2), s = l + v, across = glm::cross(n, s);
    const float up = glm::dot(n, s), alpha2 = alpha * alpha, q = glm::dot(across, across) + up * up * alpha2;
    const float n_dot_v = glm::dot(n, v), n_dot_l = glm::dot(n, l);
    const float smith_v = std::sqrt(n_dot_v * n_dot_v * (1 - alpha2) + alpha2),
                smith_l = std::sqrt(n_dot_l * n_dot_l * (1 - alpha2) + alpha2);
    const float a = alpha * glm::dot(s, s);
    const float lobe =
        a * a / (2 * std::numbers::pi_v<float> * q * q * (n_dot_l * smith_v + n_dot_v * smith_l));
    return double{lobe * n_dot_l * ((1 - x * x) / d2)};
}

// Float32 errs by more than the constant fraction where light grazes, nears its range or meets a sharp lobe,
// and by less than the bound. A lobe that is 1 % too wide or 0.1 % too bright errs by more at almost all
// lights, and the bound leaves blunt lobes in the middle of a light's range alone.
TEST(ReferenceLobes, RoundingIsBoundedAndAWrongLobeIsNot) {
    std::mt19937 random(3);
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto anywhere = [&] {
        return glm::normalize(glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)));
    };
    enum { sharp, grazing, ending, easy, all };
    for (int kind = 0; kind < all; ++kind) {
        int lights = 0, beyond_fraction = 0, wider_seen = 0, brighter_seen = 0;
        double closest = 0, max = 0;
        for (int i = 0; i < 20000; ++i) {
            const glm::vec3 location(anywhere() * number(5, 20)), n = glm::normalize(glm::vec3(anywhere()));
            Surface s = mirror(kind == sharp ? number(0, 0.2) : number(0.3, 1), 0);
            s.position = glm::dvec3(location);
            s.to_viewer = -glm::normalize(s.position);
            s.normal = s.geometric_normal = glm::normalize(glm::dvec3(n));
            const double alpha = std::pow(std::max(s.roughness, min_roughness), 2);
            const glm::dvec3 facet = glm::normalize(s.normal + anywhere() * (alpha * number(0, 4)));
            glm::dvec3 l = facet * (2 * glm::dot(facet, s.to_viewer)) - s.to_viewer;
            if (kind == grazing)
                l = glm::normalize(glm::cross(s.normal, l)) + s.normal * std::exp(number(-8, -4));
            const double up = glm::dot(s.normal, l = glm::normalize(l));
            if (!(glm::dot(s.normal, s.to_viewer) > 0.1 && up > (kind == grazing ? 0 : 0.1))) continue;
            const double distance = number(1, 20);
            Light light = lightOf(LightKind::point, s.position + l * distance);
            light.range = static_cast<float>(
                distance * (1 + (kind == ending ? std::exp(number(-8, -4)) : number(0.5, 3))));
            const Shading shading = shadedBy(std::span(&light, 1), s);
            const auto errorOf = [&](double width, double factor) {
                return std::abs(factor * lightInFloat(light, location, n, static_cast<float>(width)) -
                                shading.reflected.specular.g);
            };
            const double fraction = everywhereRounded * shading.reflected.specular.g,
                         bound = std::max(fraction, shading.rounding.y), error = errorOf(alpha, 1);
            EXPECT_LE(error, bound) << kind << " " << s.roughness << " " << up;
            ++lights;
            beyond_fraction += error > fraction;
            closest = std::max(closest, error / bound);
            max = std::max(max, bound / fraction);
            wider_seen += errorOf(1.01 * alpha, 1) > bound;
            brighter_seen += errorOf(alpha, 1.001) > bound;
        }
        SCOPED_TRACE(kind);
        EXPECT_GT(lights, 1000);
        EXPECT_GT(wider_seen, lights * 9 / 10);
        if (kind == easy) {
            EXPECT_EQ(max, 1);
            EXPECT_EQ(brighter_seen, lights);
            continue;
        }
        EXPECT_GT(beyond_fraction, lights / 100);
        EXPECT_GT(closest, 0.1) << "the bound is not far above the errors";
        EXPECT_GT(brighter_seen, lights / 2);
    }
}

}  // namespace
}  // namespace diptych::reference
