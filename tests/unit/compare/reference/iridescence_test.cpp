// SPDX-License-Identifier: MIT
// The reference's thin films (KHR_materials_iridescence), compared with Airy's sum and with integrals.
#include "compare/reference/scattering/thin_film.h"

#include "tests/support/layer_formulas.h"
#include "tests/support/reference_scene.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/microsurface.h"
#include "compare/reference/scattering/multiscatter.h"

#include <complex>

namespace diptych::reference {
namespace {

Surface filmed(Surface s, double weight, double ior = 1.4, double thickness = 380) {
    s.iridescence = weight;
    s.iridescence_ior = ior;
    s.iridescence_thickness = thickness;
    return s;
}
// A dielectric mixed with a metal, seen at `angle` from +Z.
Surface beetle(double metallic, double angle, double roughness = 0.4) {
    Surface s = mirror(roughness, angle);
    s.metallic = metallic;
    s.albedo = {0.8, 0.5, 0.2};
    s.dielectric_f0 = {0.04, 0.05, 0.06};
    s.dielectric_f90 = 0.9;
    return s;
}

double largestOf(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}
// Fourier coefficients, up to the second, of the reflectance of a film by its phase: |r|^2 with Fresnel's
// amplitudes at normal incidence (Airy 1833).
std::array<double, 3> airys(double film, double base) {
    constexpr int steps = 4096;
    const double top = (1 - film) / (1 + film), bottom = (film - base) / (film + base);
    std::array<double, 3> result{};
    for (int i = 0; i < steps; ++i) {
        const double phase = 2 * pi * i / steps;
        const std::complex<double> turned = std::polar(bottom, phase);
        const double all = std::norm((top + turned) / (1.0 + top * turned));
        for (int m = 0; m < 3; ++m)
            result[static_cast<std::size_t>(m)] += all * std::cos(m * phase) * (m > 0 ? 2 : 1) / steps;
    }
    return result;
}

// ---- the film ----------------------------------------------------------------------------------------

TEST(ReferenceIridescence, AtNormalIncidenceItIsAirysSum) {
    for (const double ior : {1.0, 1.3, 1.8})
        for (const double thickness : {100.0, 250.0, 370.0, 800.0})
            for (const double f0 : {0.02, 0.08, 0.5}) {
                const double base = (1 + std::sqrt(f0)) / (1 - std::sqrt(f0));
                const std::array<double, 3> order = airys(ior, base);
                glm::dvec3 expected(order[0]);
                for (const std::size_t m : {std::size_t{1}, std::size_t{2}})
                    expected += order[m] * spectralSum(static_cast<double>(m) * 2 * ior * thickness * 1e-9);
                expectColor(ThinFilm{1, ior, thickness}.reflected(1, glm::dvec3(f0)),
                            glm::max(expected, glm::dvec3(0)), 1e-9);
            }
}

// No interference is left: reflectances add, at any angle.
TEST(ReferenceIridescence, AThickFilmIsATwoFacedPlate) {
    for (const double cosine : {1.0, 0.7, 0.3, 0.05}) {
        const double ior = 1.5, inner = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
        const double top = schlick(cosine);
        const double base = (1 + std::sqrt(0.3)) / (1 - std::sqrt(0.3)),
                     normal = std::pow((base - ior) / (base + ior), 2), bottom = schlick(inner, normal);
        expectColor(ThinFilm{1, ior, 1e5}.reflected(cosine, glm::dvec3(0.3)),
                    glm::dvec3(top + (1 - top) * (1 - top) * bottom / (1 - top * bottom)), 1e-9);
    }
}

TEST(ReferenceIridescence, WithoutThicknessItIsTheBase) {
    for (const double f0 : {0.0, 0.04, 0.3, 0.9}) {
        for (const double cosine : {0.0, 0.3, 0.7, 1.0})
            expectColor(ThinFilm{1, 1.8, 0}.reflected(cosine, glm::dvec3(f0)),
                        glm::dvec3(schlick(cosine, f0)), 1e-12);
        expectColor(ThinFilm{1, 1, 400}.reflected(1, glm::dvec3(f0)), glm::dvec3(f0), 1e-12);
    }
}

// A film whose index lies between those of air and a base of 1.5^2 reflects no light of 550 nm if it is a
// quarter of a wavelength thick, and the most if it is half.
TEST(ReferenceIridescence, AQuarterOfAWavelengthReflectsLeast) {
    const double ior = 1.5, f0 = std::pow((2.25 - 1) / (2.25 + 1), 2);
    const auto green = [&](double waves) {
        return ThinFilm{1, ior, waves * 550 / ior}.reflected(1, glm::dvec3(f0)).g;
    };
    EXPECT_LT(green(0.25), 0.02);
    EXPECT_GT(green(0.5), 0.12);
    EXPECT_LT(green(0.75), 0.03);
}

TEST(ReferenceIridescence, ItIsFiniteAndBounded) {
    for (const double cosine : {0.0, 1e-4, 0.08, 0.5, 1.0, 1 + 1e-15})
        for (const double f0 : {0.0, 0.001, 0.04, 0.8, 1.0})
            for (const double ior : {1.0, 1.1, 1.5, 3.0, 100.0})
                for (const double thickness : {0.0, 1e-3, 0.02, 100.0, 330.0, 780.0, 1e6, 1e30}) {
                    const glm::dvec3 f = ThinFilm{1, ior, thickness}.reflected(cosine, glm::dvec3(f0));
                    for (int c = 0; c < 3; ++c) {
                        EXPECT_GE(f[c], 0) << cosine << " " << f0 << " " << ior << " " << thickness;
                        EXPECT_LE(f[c], 1.5) << cosine << " " << f0 << " " << ior << " " << thickness;
                    }
                }
}

// ---- the BRDF ----------------------------------------------------------------------------------------

// By v.h, for the dielectric and the metal apart; the base below the dielectric loses the largest component.
TEST(ReferenceIridescence, ItReplacesFresnelByItsWeight) {
    for (const double metallic : {0.0, 0.4, 1.0})
        for (const double weight : {0.3, 1.0}) {
            const Surface s = filmed(beetle(metallic, 0.8), weight);
            const glm::dvec3 l = glm::normalize(glm::dvec3(-0.2, 0.6, 0.7));
            const double cosine = glm::dot(s.to_viewer, glm::normalize(l + s.to_viewer)),
                         lobe = Brdf(mirror(0.4, 0.8)).lobe(l).g;
            const auto f = [&](const glm::dvec3& f0, double f90) {
                return glm::mix(glm::mix(f0, glm::dvec3(f90), schlick(cosine, 0)),
                                ThinFilm{1, 1.4, 380}.reflected(cosine, f0), weight);
            };
            const glm::dvec3 layer = f(s.dielectric_f0, 0.9), metal = f(s.albedo, 1);
            expectColor(Brdf(s)(l).specular, lobe * glm::mix(layer, metal, metallic), 1e-12);
            expectColor(Brdf(s)(l).diffuse, s.albedo * ((1 - largestOf(layer)) * (1 - metallic) * l.z / pi),
                        1e-12);
        }
}

TEST(ReferenceIridescence, TheBaseNeverEmits) {
    Surface s = filmed(beetle(0, 1.5), 1, 1.5, 330);
    s.dielectric_f0 = glm::dvec3(0.8);
    for (double x = -0.999; x < 1; x += 0.01)
        EXPECT_GE(largestOf(Brdf(s)({x, 0, std::sqrt(1 - x * x)}).diffuse), 0);
    EXPECT_GE(largestOf(diffuseAlbedo(s)), 0);
}

TEST(ReferenceIridescence, ThinTransmissionLosesWhatItReflectsToTheViewer) {
    Surface s = filmed(beetle(0, 0.6), 1);
    s.transmission = 0.5;
    const glm::dvec3 f = ThinFilm{1, 1.4, 380}.reflected(std::cos(0.6), s.dielectric_f0);
    expectColor(transmitted(s), s.albedo * (0.5 * (1 - largestOf(f))), 1e-12);
}

// Midpoint sums over half vectors around the normal and over directions.
TEST(ReferenceIridescence, AlbedosAreTheBrdfsIntegrals) {
    for (const double angle : {0.0, 0.9, 1.4})
        for (const double thickness : {250.0, 800.0}) {
            const Surface s = filmed(beetle(0.5, angle, 0.6), 0.8, 1.3, thickness);
            const Brdf brdf(s);
            constexpr int rows = 300, around = 300;
            Reflected sum;
            for (int i = 0; i < rows; ++i)
                for (int j = 0; j < around; ++j) {
                    const double z = (i + 0.5) / rows, phi = pi * (j + 0.5) / around,
                                 sine = std::sqrt(1 - z * z);
                    sum += brdf({sine * std::cos(phi), sine * std::sin(phi), z}) * (2 * pi / rows / around);
                }
            expectColor(specularAlbedo(s), sum.specular, 3e-4);
            expectColor(diffuseAlbedo(s), sum.diffuse, 3e-4);
        }
}

// ---- multiple scattering -----------------------------------------------------------------------------

TEST(ReferenceIridescence, CompensationsAreThoseOfTheSurfaceWithoutIt) {
    const Surface plain = beetle(0.4, 0.9, 0.8), s = filmed(plain, 1);
    for (const Multiscatter each : {Multiscatter::energy, Multiscatter::fdez}) {
        const Compensation a = compensationOf(plain, each), b = compensationOf(s, each);
        EXPECT_EQ(a.dielectric, b.dielectric);
        EXPECT_EQ(a.metal, b.metal);
        EXPECT_EQ(a.between, b.between);
        // The base gets no more than the film leaves.
        for (int c = 0; c < 3; ++c) EXPECT_LE(b.base.value()[c], a.base.value()[c]);
    }
    // The factor multiplies the film's reflectance.
    const Surface metal = filmed(beetle(1, 0.9, 0.8), 1);
    const Compensation energy = compensationOf(metal, Multiscatter::energy);
    const glm::dvec3 l(0, 0, 1);
    EXPECT_GT(energy.metal.r, 1.1);
    expectColor(Brdf(metal, energy).lobe(l), energy.metal * Brdf(metal).lobe(l), 1e-12);
    EXPECT_EQ(Between(s).fraction(), Between(plain).fraction());
}

// ---- one cosine in its place ---------------------------------------------------------------------------

// The paths take the film at the angle where Schlick's weight is its mean over the lobe.
TEST(ReferenceIridescence, UnderAnEvenSkyTheSplitSumIsOffByItsCosine) {
    const Environment sky{"sky", Image(32, 16, 3, 3.0f)};
    const Surface s = filmed(beetle(1, 1.3, 0.6), 1, 1.3, 600);
    Surface dark = withoutFilm(s), bright = dark;
    dark.albedo = glm::dvec3(0);
    bright.albedo = glm::dvec3(1);
    const double all = specularAlbedo(bright).r, cosine = 1 - std::pow(specularAlbedo(dark).r / all, 0.2);
    const Shading shading = withCosts(sky, s);
    const glm::dvec3 integral = 3.0 * specularAlbedo(s),
                     taken = 3.0 * all * ThinFilm{1, 1.3, 600}.reflected(cosine, s.albedo);
    expectColor(shading.environment.specular, integral, 2 * samplingError * largestOf(integral));
    EXPECT_NEAR(shading.costs.split[0], largestOf(glm::abs(taken - integral)), 0.06 * largestOf(integral));
}

}  // namespace
}  // namespace diptych::reference
