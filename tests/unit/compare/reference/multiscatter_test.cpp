// SPDX-License-Identifier: MIT
// The reference's energy compensations, compared with their papers' values and in a white furnace.
#include "tests/support/reference_builder.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/multiscatter.h"

namespace diptych::reference {
namespace {

constexpr std::array compensations{Multiscatter::energy, Multiscatter::fdez};

double specularBy(Multiscatter multiscatter, const Surface& s) {
    return specularAlbedo(s, compensationOf(s, multiscatter)).g;
}
double allBy(Multiscatter multiscatter, const Surface& s) {
    return specularBy(multiscatter, s) + diffuseAlbedo(s, compensationOf(s, multiscatter)).g;
}

// F0 0.9, alpha 1, n.v 0.95: results of the formulas with that view's albedo, known to three digits.
TEST(ReferenceMultiscatter, ARoughMetalReflectsWhatThePapersSay) {
    Surface s = mirror(1, std::acos(0.95));
    s.albedo = glm::dvec3(0.9);
    EXPECT_NEAR(specularBy(Multiscatter::off, s), 0.286, 0.001);
    EXPECT_NEAR(specularBy(Multiscatter::fdez, s), 0.747, 0.001);
    EXPECT_NEAR(specularBy(Multiscatter::energy, s), 0.839, 0.001);
}

TEST(ReferenceMultiscatter, AWhiteMetalIsInvisibleInAFurnace) {
    for (const double roughness : {0.0, 0.1, 0.3, 0.6, 1.0})
        for (const double cosine : {1e-3, 0.05, 0.3, 0.7, 1.0}) {
            const Surface s = mirror(roughness, std::acos(cosine));
            EXPECT_LE(specularBy(Multiscatter::off, s), 1 + 1e-6);
            for (const Multiscatter each : compensations)
                EXPECT_NEAR(specularBy(each, s), 1, 1e-5)
                    << nameOf(each) << " " << roughness << " " << cosine;
        }
}

// The base gets the light that the layer does not reflect. Without compensation the two do not add up to 1
// (glTF 2.0, appendix B).
TEST(ReferenceMultiscatter, AWhiteDielectricIsInvisibleInAFurnace) {
    double max = 0;
    for (const double roughness : {0.0, 0.3, 1.0})
        for (const double cosine : {1e-3, 0.05, 0.5, 1.0}) {
            Surface s = mirror(roughness, std::acos(cosine));
            s.metallic = 0;
            s.dielectric_f0 = glm::dvec3(0.04);
            s.dielectric_f90 = 1;
            max = std::max(max, allBy(Multiscatter::off, s));
            for (const Multiscatter each : compensations)
                EXPECT_NEAR(allBy(each, s), 1, 1e-5) << nameOf(each) << " " << roughness << " " << cosine;
        }
    EXPECT_GT(max, 1.5) << "appendix B gains nothing at grazing angles: has it changed?";
}

// The compensation of a mix is the mix of two compensations. Compensating the mixed F0 is off by 0.05 and
// more.
TEST(ReferenceMultiscatter, DielectricAndMetalAreCompensatedApart) {
    Surface s = mirror(1, 0.3);
    s.albedo = {1.0, 0.6, 0.2};
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    for (const Multiscatter each : compensations) {
        const auto at = [&](double metallic) {
            Surface mixed = s;
            mixed.metallic = metallic;
            return specularAlbedo(mixed, compensationOf(mixed, each));
        };
        const glm::dvec3 half = at(0.5), expected = 0.5 * (at(0) + at(1));
        Surface blended = s;
        blended.albedo = 0.5 * (s.albedo + s.dielectric_f0);
        const glm::dvec3 wrong = specularAlbedo(blended, compensationOf(blended, each));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], expected[c], 1e-9) << nameOf(each);
        EXPECT_GT(std::abs(wrong.r - expected.r), 0.05) << nameOf(each);
    }
}

// Summing directional lights over the hemisphere: direct light has the same compensation as ambient light.
TEST(ReferenceMultiscatter, DirectLightSumsToTheSame) {
    Surface s = mirror(0.9, 0.7);
    s.metallic = 0.6;
    s.albedo = {0.95, 0.6, 0.3};
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    for (const Multiscatter each : compensations) {
        const Compensation compensation = compensationOf(s, each);
        constexpr int across = 160;
        std::vector<Light> suns;
        for (int i = 0; i < across; ++i)
            for (int j = 0; j < across; ++j) {
                const double z = std::sqrt((i + 0.5) / across), r = std::sqrt(1 - z * z),
                             phi = 2 * pi * (j + 0.5) / across;
                Light sun = lightOf(LightKind::directional, {}, {-r * std::cos(phi), -r * std::sin(phi), -z});
                sun.intensity = static_cast<float>(pi / (z * across * across));
                suns.push_back(sun);
            }
        const Shading shading = Lighting({.lights = suns, .multiscatter = each})(s, {}, 1);
        const glm::dvec3 specular = specularAlbedo(s, compensation), diffuse = diffuseAlbedo(s, compensation);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(shading.reflected.specular[c], specular[c], 1e-3) << nameOf(each);
            EXPECT_NEAR(shading.reflected.diffuse[c], diffuse[c], 1e-3) << nameOf(each);
        }
    }
}

// A film may reflect ten times as much as the layer without it. The base gets the rest, whatever the film's
// weight.
TEST(ReferenceMultiscatter, AFilmGainsNothingInAFurnace) {
    for (const Multiscatter kind : {Multiscatter::energy, Multiscatter::fdez})
        for (const double roughness : {0.1, 0.5, 1.0})
            for (const double angle : {0.0, 1.4})
                for (const double weight : {0.25, 1.0})
                    for (const double index : {1.1, 2.5})
                        for (const double thickness : {200.0, 400.0}) {
                            Surface s = mirror(roughness, angle);
                            s.metallic = 0;
                            s.dielectric_f0 = glm::dvec3(0.04);
                            s.dielectric_f90 = 1;
                            s.iridescence = weight;
                            s.iridescence_ior = index;
                            s.iridescence_thickness = thickness;
                            const Compensation by = compensationOf(s, kind);
                            const glm::dvec3 all = diffuseAlbedo(s, by) + specularAlbedo(s, by);
                            EXPECT_LE(std::max({all.r, all.g, all.b}), 1.01)
                                << roughness << " " << angle << " " << index << " " << thickness;
                        }
}

}  // namespace
}  // namespace diptych::reference
