// SPDX-License-Identifier: MIT
// Uniform ambient light: the reference's integral against closed forms and brute force, and the paths'
// integral against the reference's.
#include "tests/support/reference_builder.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/quadrature.h"
#include "shared/contract/albedo.h"
#include "shared/environment/directional_albedo.h"
#include "tests/support/cubic.h"

namespace diptych::reference {
namespace {

Reflected ambientAlbedo(const Surface& s) {
    return {diffuseAlbedo(s), specularAlbedo(s)};
}

// Integrates over the hemisphere with parameters that do not depend on the lobe.
Reflected bruteForce(const Surface& surface) {
    const Brdf brdf(surface);
    const auto integrand = [&](double u, double v) {
        const double cosine = u, sine = std::sqrt(1 - u * u), phi = 2 * pi * v;
        return brdf({sine * std::cos(phi), sine * std::sin(phi), cosine}) * (2 * pi);
    };
    // At least 8 x 8 cells, then adaptive.
    const auto mustSplit = [](const Cell& cell) {
        return cell.u1 - cell.u0 > 0.125 ? Split::u : cell.v1 - cell.v0 > 0.125 ? Split::v : Split::none;
    };
    return Quadrature(integrand, mustSplit, 1e-8, nullptr)().value;
}

TEST(ReferenceAmbient, AWhiteLambertianSurfaceSendsItBack) {
    for (const double angle : {0.0, 0.8, 1.5}) {
        Surface s = mirror(0.5, angle);
        s.metallic = 0;
        s.dielectric_f90 = 0;
        const Reflected fraction = ambientAlbedo(s);
        EXPECT_NEAR(fraction.diffuse.g, 1, 1e-12);
        EXPECT_EQ(fraction.specular.g, 0);
    }
}

// Height-correlated Smith masking at normal incidence and alpha = 1: D = 1 / pi, G / (4 n.l) = 1 / (2 (1 +
// n.l)). The integral of 2 n.l / (2 (1 + n.l)) over n.l from 0 to 1 is 1 - ln 2.
TEST(ReferenceAmbient, ARoughMirrorSeenFromAboveLosesTheLogarithmOfTwo) {
    EXPECT_NEAR(ambientAlbedo(mirror(1, 0)).specular.g, 1 - std::numbers::ln2, 1e-6);
}

TEST(ReferenceAmbient, IsTheBrdfsIntegral) {
    for (const double roughness : {0.3, 0.55, 0.8, 1.0})
        for (const double angle : {0.0, 0.4, 1.1, 1.5}) {
            Surface s = mirror(roughness, angle);
            s.metallic = 0.25;
            s.albedo = {0.9, 0.5, 0.1};
            s.dielectric_f0 = {0.04, 0.1, 0.3};
            s.dielectric_f90 = 0.9;
            const Reflected fraction = ambientAlbedo(s), expected = bruteForce(s);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(fraction.diffuse[c], expected.diffuse[c], 5e-6) << roughness << " " << angle;
                EXPECT_NEAR(fraction.specular[c], expected.specular[c], 5e-6) << roughness << " " << angle;
            }
        }
}

TEST(ReferenceAmbient, NothingReflectsMoreThanThereIs) {
    for (const double roughness : {0.0, 0.05, 0.2, 0.5, 1.0})
        for (const double cosine : {-0.5, 1e-6, 1e-3, 0.02, 0.2, 0.9, 1.0}) {
            Surface s = mirror(roughness, std::acos(cosine));
            for (const double metallic : {0.0, 0.5, 1.0}) {
                s.metallic = metallic;
                s.dielectric_f0 = glm::dvec3(0.04);
                s.dielectric_f90 = 1;
                const Reflected fraction = ambientAlbedo(s);
                // A base under Schlick's layer is weighted by 1 - F of the half vector, so it gains energy
                // at grazing angles.
                EXPECT_LE(fraction.specular.g, 1 + 1e-6);
                EXPECT_LE(fraction.diffuse.g, 1 + 1e-6);
                EXPECT_GE(fraction.size(), 0);
            }
        }
}

// The paths' own integrals have another derivation. Compared from the smoothest to the roughest, at all
// angles.
TEST(ReferenceAmbient, ThePathsTabulateTheSame) {
    for (const double roughness : {0.045, 0.07, 0.15, 0.3, 0.6, 1.0})
        for (const double cosine : {1e-4, 1e-3, 0.004, 0.02, 0.1, 0.35, 0.8, 1.0}) {
            Surface s = mirror(roughness, std::acos(cosine));
            const glm::dvec2 table = diptych::specularAlbedo(cosine, roughness * roughness);
            EXPECT_NEAR(table.x + table.y, ambientAlbedo(s).specular.g, 1e-5) << roughness << " " << cosine;
            s.metallic = 0;
            s.dielectric_f0 = glm::dvec3(0);
            s.dielectric_f90 = 1;
            EXPECT_NEAR(table.y, ambientAlbedo(s).specular.g, 1e-5) << roughness << " " << cosine;
        }
}

// The shaders' table contains the integral, read as its contract says.
TEST(ReferenceAmbient, TheTableHoldsTheIntegrals) {
    constexpr int width = gpu::ALBEDO_TABLE_WIDTH, height = gpu::ALBEDO_TABLE_HEIGHT;
    const std::vector<glm::vec2>& table = directionalAlbedoTable();
    ASSERT_EQ(table.size(), std::size_t{width * height});
    const auto sample = [&](int x, int y, int part) {
        return double{table[static_cast<std::size_t>(y * width + x)][part]};
    };
    for (const double n_dot_v : {1e-4, 1e-3, 0.01, 0.07, 0.2, 0.45, 0.8, 1.0}) {
        const double root = std::sqrt(n_dot_v);
        for (const double roughness : {0.045, 0.06, 0.2, 0.5, 0.77, 1.0}) {
            const double k = 2 * roughness * roughness, blend = double{gpu::ALBEDO_BLEND};
            const double along = blend * std::sqrt(n_dot_v * (1 + k) / (n_dot_v + k)) + (1 - blend) * root;
            const double min = std::sqrt(0.045), down = (std::sqrt(roughness) - min) / (1 - min);
            const glm::dvec2 expected = diptych::specularAlbedo(n_dot_v, roughness * roughness);
            for (const int part : {0, 1})
                EXPECT_NEAR(cubicAt(down * (height - 1), height,
                                    [&](int y) {
                                        return cubicAt(along * (width - 1), width,
                                                       [&](int x) { return sample(x, y, part); });
                                    }),
                            expected[part], 6e-5)
                    << n_dot_v << " " << roughness << " " << part;
        }
    }
}

TEST(ReferenceAmbient, OcclusionDimsItAndNothingElse) {
    Surface s = lambertian();
    s.occlusion = 0.25;
    const Light sun = lightOf(LightKind::directional, {0, 0, 0});
    const glm::dvec3 ambient(1, 2, 4);
    const Shading shading = Lighting({.lights = std::span(&sun, 1), .ambient = ambient})(s, {}, 1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shading.ambient[c], ambient[c] / 4, 1e-12);
    EXPECT_NEAR(shading.reflected.diffuse.g, 1 / pi, 1e-12);
    EXPECT_EQ(shadedBy(std::span(&sun, 1), s).ambient, glm::dvec3(0));
}

}  // namespace
}  // namespace diptych::reference
