// SPDX-License-Identifier: MIT
// The shaders' BRDF compared with closed forms and tables.
#include "compare/reference/scattering/brdf.h"
#include "shared/contract/features.h"
#include "tests/probe/probe.h"
#include "tests/support/layer_formulas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace diptych {
namespace {

using Vec = std::array<double, 3>;

Vec direction(double mu, double phi) {
    const double s = std::sqrt(std::max(0.0, 1 - mu * mu));
    return {s * std::cos(phi), s * std::sin(phi), mu};
}

Vec normalised(Vec a) {
    const double length = std::hypot(a[0], a[1], a[2]);
    return {a[0] / length, a[1] / length, a[2] / length};
}

struct Material {
    double roughness = 0.5, metallic = 0, albedo = 1, f0 = 0.04, f90 = 1;
};

void push(std::vector<float>& input, const Vec& v, const Vec& l, const Material& m) {
    for (const Vec& a : {v, l})
        for (const double c : a) input.push_back(static_cast<float>(c));
    for (const double x : {m.roughness, m.metallic, m.albedo, m.f0, m.f90})
        input.push_back(static_cast<float>(x));
}

// Directional albedo: the integral of radiance over l for unit irradiance from l. Returns {diffuse,
// specular}; diffuse converges for rough lobes only.
std::array<double, 2> directionalAlbedo(Probes& probes, double mu, const Material& m) {
    const Vec v = direction(mu, 0);
    const auto directions = reflectedDirections({v[0], v[1], v[2]}, m.roughness * m.roughness, 512, 64);
    std::vector<float> input;
    for (const auto& [l, weight] : directions) push(input, v, {l.x, l.y, l.z}, m);
    const std::vector<float> output = probes.run("brdf", input, 11, 2);
    std::array<double, 2> sum{};
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (std::size_t c = 0; c < 2; ++c) sum[c] += double{output[i * 2 + c]} * directions[i].weight;
    return sum;
}

// Tolerance: half of the fourth digit, and as much for the quadrature.
TEST(Brdf, DirectionalAlbedoOfAWhiteMetal) {
    Probes probes;
    for (const auto& [roughness, albedo] : whiteAlbedos)
        EXPECT_NEAR(directionalAlbedo(probes, 1, {.roughness = roughness, .metallic = 1})[1], albedo, 1e-4);
}

// White furnace: 1 - the cosine-weighted mean of directional albedo over all views, F = 1.
TEST(Brdf, WhiteFurnaceLossMeetsTheTable) {
    Probes probes;
    for (const auto& [roughness, loss] : whiteLosses) {
        double reflected = 0;
        constexpr int views = 24;
        for (int i = 0; i < views; ++i) {
            const double mu = std::sqrt((i + 0.5) / views);  // cosine-weighted views
            reflected += directionalAlbedo(probes, mu, {.roughness = roughness, .metallic = 1})[1] / views;
        }
        // The table has three digits; half a percent of the loss for the quadrature of grazing views.
        EXPECT_NEAR(1 - reflected, loss, 0.0005 + 0.005 * loss) << "roughness " << roughness;
    }
}

// Diffuse albedo, by cosine-weighted directions.
double diffuseAlbedo(Probes& probes, double mu, const Material& m) {
    constexpr int rings = 64, sectors = 64;
    std::vector<float> input;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j)
            push(input, direction(mu, 0),
                 direction(std::sqrt((i + 0.5) / rings), 2 * std::numbers::pi * (j + 0.5) / sectors), m);
    const std::vector<float> output = probes.run("brdf", input, 11, 2);
    double sum = 0;
    for (std::size_t i = 0; i < output.size() / 2; ++i)
        sum += double{output[i * 2]} * std::numbers::pi / (double{input[i * 11 + 5]} * rings * sectors);
    return sum;
}

TEST(Brdf, NoLobeReflectsMoreThanItGets) {
    Probes probes;
    for (const double metallic : {0.0, 0.5, 1.0})
        for (const double roughness : {0.1, 0.5, 1.0})
            for (const double mu : {0.05, 0.3, 0.7, 1.0}) {
                const Material m{.roughness = roughness, .metallic = metallic};
                const double diffuse = diffuseAlbedo(probes, mu, m),
                             specular = directionalAlbedo(probes, mu, m)[1];
                // Each lobe alone. Their sum may exceed 1: glTF dims the base by the half vector's
                // Fresnel, not by the layer's reflection towards the viewer.
                EXPECT_LE(diffuse, 1 - metallic + 1e-3) << metallic << " " << roughness << " " << mu;
                EXPECT_LE(specular, 1 + 1e-3) << metallic << " " << roughness << " " << mu;
                EXPECT_GE(diffuse, 0.25 * (1 - metallic));
                EXPECT_GT(specular, 0.01);
            }
}

// f(v, l) = f(l, v): radiance from l to v, divided by n.l, is symmetric.
TEST(Brdf, IsReciprocal) {
    Probes probes;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0.02, 1), angle(0, 6.28);
    std::vector<float> input;
    for (int i = 0; i < 5000; ++i) {
        const Vec v = direction(unit(random), angle(random)), l = direction(unit(random), angle(random));
        const Material m{.roughness = unit(random), .metallic = unit(random), .albedo = unit(random)};
        push(input, v, l, m);
        push(input, l, v, m);
    }
    const std::vector<float> out = probes.run("brdf", input, 11, 2);
    for (std::size_t i = 0; i < 5000; ++i) {
        const double nl = double{input[i * 22 + 5]}, nv = double{input[i * 22 + 2]};
        for (std::size_t c = 0; c < 2; ++c) {
            const double a = double{out[i * 4 + c]} / nl, b = double{out[i * 4 + 2 + c]} / nv;
            // float32 half vectors near a sharp peak: 1e-3 of the value.
            ASSERT_NEAR(a, b, 1e-3 * std::max(a, b) + 1e-6) << "pair " << i << " lobe " << c;
        }
    }
}

// D in double compared with the shader's, near the highlight at roughness 0.1. The textbook form is off by
// over 1e-4 for 40 % of the samples; this one for none.
TEST(Brdf, GgxIsStableNearTheHighlight) {
    Probes probes;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1), tilt(0, 0.03);
    const double alpha = 0.01;
    std::vector<float> input;
    std::vector<double> expected;
    int textbookOff = 0;
    const int samples = 20'000;
    for (int i = 0; i < samples; ++i) {
        Vec n = normalised({unit(random), unit(random), unit(random)});
        for (double& c : n) c = static_cast<double>(static_cast<float>(c));
        Vec t = normalised({n[1] - n[2], n[2] - n[0], n[0] - n[1]});
        const double angle = tilt(random);
        Vec h;
        for (std::size_t c = 0; c < 3; ++c)
            h[c] = static_cast<double>(static_cast<float>(std::cos(angle) * n[c] + std::sin(angle) * t[c]));
        input.push_back(static_cast<float>(alpha));
        for (const Vec& a : {n, h})
            for (const double c : a) input.push_back(static_cast<float>(c));
        const double dot = n[0] * h[0] + n[1] * h[1] + n[2] * h[2];
        const Vec x{n[1] * h[2] - n[2] * h[1], n[2] * h[0] - n[0] * h[2], n[0] * h[1] - n[1] * h[0]};
        const double cross2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
        const double k = alpha / (cross2 + dot * dot * alpha * alpha);
        expected.push_back(k * k / std::numbers::pi);
        float dotF = 0;
        for (std::size_t c = 0; c < 3; ++c) dotF += static_cast<float>(n[c]) * static_cast<float>(h[c]);
        const float a2 = static_cast<float>(alpha * alpha), q = dotF * dotF * (a2 - 1) + 1;
        const double textbook = double{a2} / (std::numbers::pi * double{q} * double{q});
        textbookOff += std::abs(textbook / expected.back() - 1) > 1e-4;
    }
    const std::vector<float> out = probes.run("ggx", input, 7, 1);
    int off = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        off += std::abs(double{out[i]} / expected[i] - 1) > 1e-4;
    EXPECT_EQ(off, 0);
    EXPECT_GT(textbookOff, samples / 5)
        << "the comparison has lost its point: the textbook form is stable here";
}

// The reference evaluates, in double, the row that push() made.
reference::Reflected ofReference(const float* row) {
    const auto in = [&](std::size_t at) { return double{row[at]}; };
    reference::Surface s;
    s.to_viewer = {in(0), in(1), in(2)};
    s.roughness = in(6);
    s.metallic = in(7);
    s.albedo = glm::dvec3(in(8));
    s.dielectric_f0 = glm::dvec3(in(9));
    s.dielectric_f90 = in(10);
    return reference::Brdf(s)({in(3), in(4), in(5)});
}

// Compared with the reference in double, which clamps roughness and n.v by constants of its own. Includes
// views below the normal's horizon, which normal maps cause, and the mirror direction for every second
// light.
TEST(Brdf, IsTheReferences) {
    Probes probes;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1), angle(0, 6.28);
    std::vector<float> input;
    constexpr int pairs = 4000;
    for (int i = 0; i < pairs; ++i) {
        const Material m{.roughness = i % 3 == 0 ? 0.1 * unit(random) : unit(random),
                         .metallic = i % 4 == 0 ? 0 : unit(random),
                         .albedo = unit(random),
                         .f0 = 0.5 * unit(random),
                         .f90 = unit(random)};
        const Vec v = direction(i % 5 == 0 ? -0.9 * unit(random) : unit(random), angle(random));
        Vec l = direction(0.01 + 0.99 * unit(random), angle(random));
        if (i % 2 == 0) {
            const double tilt = m.roughness * m.roughness * unit(random), around = angle(random);
            const Vec h = normalised({tilt * std::cos(around), tilt * std::sin(around), 1});
            const double vh = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
            l = normalised({2 * vh * h[0] - v[0], 2 * vh * h[1] - v[1], 2 * vh * h[2] - v[2]});
        }
        push(input, v, l, m);
    }
    const std::vector<float> out = probes.run("brdf", input, 11, 2);
    int below = 0, sharp = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const auto in = [&](std::size_t at) { return double{input[i * 11 + at]}; };
        const reference::Reflected expected = ofReference(&input[i * 11]);
        EXPECT_NEAR(out[2 * i], expected.diffuse.g, 1e-5) << i;
        EXPECT_NEAR(out[2 * i + 1], expected.specular.g, 1e-3 * expected.specular.g + 1e-6)
            << i << ": roughness " << in(6) << ", n.v " << in(2) << ", n.l " << in(5);
        below += in(2) + in(5) <= 0 && in(5) > 0;
        sharp += in(6) < 0.045 && expected.specular.g > 1;
    }
    EXPECT_GT(below, 20) << "no microfacet that faces down is tried";
    EXPECT_GT(sharp, 20) << "no highlight of the least roughness is tried";
}

// Half floats, of roughness 0.5 to 1, with n.v and n.l of at least 0.1 and |l + v| of at least 1. `ulp` is an
// operation's error if the device truncates. To first order, the half vector turns by 4.4 ulp, which D
// magnifies by 2 (1 - alpha^2) / alpha; its length (8), the other operations of D (30) and of the visibility
// (12) err by 50 ulp. Schlick's weight errs by 4 ulp, because 1 - v.h is at most 1/2.
TEST(Brdf, InHalfFloatsItIsNearTheReference) {
    Probes probes;
    constexpr double ulp = 0x1p-10;
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(0, 1), angle(0, 6.28);
    std::vector<float> input;
    constexpr std::size_t pairs = 2000;
    while (input.size() < pairs * 11) {
        const Vec v = direction(0.1 + 0.9 * unit(random), angle(random)),
                  l = direction(0.1 + 0.9 * unit(random), angle(random));
        if (std::hypot(v[0] + l[0], v[1] + l[1], v[2] + l[2]) < 1) continue;
        push(input, v, l,
             {.roughness = 0.5 + 0.5 * unit(random), .metallic = unit(random) < 0.5 ? 0.0 : 1.0, .f0 = 0.2});
    }
    const std::vector<float> out = probes.run("brdf", input, 11, 2, {{gpu::FEATURE_half_shading, 1}});
    std::size_t rounded = 0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const float* const row = &input[i * 11];
        const reference::Reflected expected = ofReference(row);
        const double alpha = double{row[6]} * double{row[6]}, specular = expected.specular.g;
        const double lobe = 50 + 8.8 * (1 - alpha * alpha) / alpha, fresnel = row[7] > 0 ? 0 : 4 / 0.2;
        EXPECT_NEAR(out[2 * i], expected.diffuse.g, 16 * ulp * expected.diffuse.g) << i;
        EXPECT_NEAR(out[2 * i + 1], specular, (lobe + fresnel) * ulp * specular)
            << i << ": alpha " << alpha << ", n.v " << row[2] << ", n.l " << row[5];
        rounded += std::abs(double{out[2 * i + 1]} - specular) > 1e-4 * specular;
    }
    EXPECT_GT(rounded, pairs / 2) << "it is computed in 32 bits";
}

// A quarter of the light that enters the base is transmitted, the other three are diffuse, and the layer's
// reflection is unchanged.
TEST(Brdf, WhatPassesTheSurfaceIsNotDiffuse) {
    Probes probes;
    std::vector<float> input;
    for (const double metallic : {0.0, 0.5})
        for (const double mu : {0.2, 0.9})
            push(input, direction(mu, 0), direction(0.6, 2), {.roughness = 0.4, .metallic = metallic});
    const std::vector<float> opaque = probes.run("brdf", input, 11, 2),
                             glass = probes.run("brdf", input, 11, 2, {{gpu::FEATURE_transmission, 1}});
    for (std::size_t i = 0; i < opaque.size(); i += 2) {
        EXPECT_GT(opaque[i], 0.01) << i;
        EXPECT_FLOAT_EQ(glass[i], 0.75f * opaque[i]) << i;
        EXPECT_EQ(glass[i + 1], opaque[i + 1]) << i;
    }
}

// alpha is clamped at the smallest roughness: roughness 0 is finite and equals that roughness.
TEST(Brdf, RoughnessZeroIsTheSmallestRoughness) {
    Probes probes;
    std::vector<float> input;
    const Vec up = direction(1, 0);
    push(input, up, up, {.roughness = 0, .metallic = 1});
    push(input, up, up, {.roughness = 0.045, .metallic = 1});
    const std::vector<float> out = probes.run("brdf", input, 11, 2);
    EXPECT_EQ(out[1], out[3]);
    EXPECT_TRUE(std::isfinite(out[1]));
}

}  // namespace
}  // namespace diptych
