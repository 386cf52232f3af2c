// SPDX-License-Identifier: MIT
// Transmission through a surface: Snell's law, absorption, the lobe.
#include "compare/reference/scattering/transmission.h"

#include "tests/support/layer_formulas.h"
#include "tests/support/reference_scene.h"

#include <utility>

namespace diptych::reference {
namespace {

glm::dvec3 downwards(double angle) {
    return {std::sin(angle), 0, -std::cos(angle)};
}

// A surface facing +Z that transmits all light and reflects none, seen at `angle`.
Surface glassPane(double angle, double thickness = 0) {
    Surface s = lambertian();
    s.to_viewer = -downwards(angle);
    s.transmission = 1;
    s.roughness = 0;
    s.thickness = thickness;
    return s;
}

// ---- refraction --------------------------------------------------------------------------------------

TEST(ReferenceTransmission, RefractionIsSnells) {
    const glm::dvec3 n(0, 0, 1);
    for (const double index : {1.0, 1.33, 1.5, 2.4})
        for (const double angle : {0.0, 0.3, 1.0, 1.5}) {
            const glm::dvec3 in = refractedInto(downwards(angle), n, index);
            EXPECT_NEAR(glm::length(in), 1, 1e-14);
            EXPECT_NEAR(in.x, std::sin(angle) / index, 1e-14);
            EXPECT_EQ(in.y, 0);
            EXPECT_LT(in.z, 0);
            const std::optional<glm::dvec3> out = refractedOut(in, n, index);
            ASSERT_TRUE(out);
            EXPECT_LT(glm::distance(*out, downwards(angle)), 1e-7) << "there and back";
        }
}

TEST(ReferenceTransmission, BeyondTheCriticalAngleAllIsReflected) {
    const double critical = std::asin(1 / 1.5);
    EXPECT_FALSE(refractedOut(downwards(critical + 1e-6), {0, 0, 1}, 1.5));
    EXPECT_TRUE(refractedOut(downwards(critical - 1e-6), {0, 0, 1}, 1.5));
    EXPECT_EQ(reflectedInside(std::cos(critical + 1e-6), 1.5), 1);
    EXPECT_LT(reflectedInside(std::cos(critical - 0.01), 1.5), 1);
}

// Fresnel's equations in their form of sines and tangents; at Brewster's angle one polarization is not
// reflected.
TEST(ReferenceTransmission, InnerReflectionIsFresnels) {
    EXPECT_NEAR(reflectedInside(1, 1.5), 0.04, 1e-15);
    for (const double index : {1.2, 1.5, 2.0})
        for (const double inside : {0.1, 0.3, 0.45}) {
            const double outside = std::asin(index * std::sin(inside));
            const double across = std::pow(std::sin(outside - inside) / std::sin(outside + inside), 2),
                         along = std::pow(std::tan(outside - inside) / std::tan(outside + inside), 2);
            EXPECT_NEAR(reflectedInside(std::cos(inside), index), (across + along) / 2, 1e-12);
        }
    const double brewster = std::atan(1 / 1.5), outside = pi / 2 - brewster;
    EXPECT_NEAR(reflectedInside(std::cos(brewster), 1.5), std::pow(std::sin(outside - brewster), 2) / 2,
                1e-12);
    EXPECT_NEAR(reflectedInside(0.3, 1), 0, 1e-30) << "no boundary";
}

// The ray that leaves is beside the straight one by d sin(angle - refracted).
TEST(ReferenceTransmission, ASlabShiftsTheRay) {
    for (const double angle : {0.0, 0.4, 1.2}) {
        const Surface s = glassPane(angle, 0.25);
        const glm::dvec3 shift = slabShift(s, 1);
        EXPECT_NEAR(glm::length(shift), 0.25, 1e-14) << "along the refracted ray";
        const double refracted = std::asin(std::sin(angle) / 1.5);
        EXPECT_NEAR(glm::length(glm::cross(shift, s.to_viewer)), 0.25 * std::sin(angle - refracted), 1e-14);
    }
    EXPECT_EQ(slabShift(glassPane(0.4), 1), glm::dvec3(0)) << "a thin wall";
}

TEST(ReferenceTransmission, AnIndexOfOneBendsAndBlursNothing) {
    Surface s = glassPane(0.7, 0.5);
    s.ior = 1;
    s.roughness = 1;
    EXPECT_LT(glm::length(glm::cross(slabShift(s, 1), s.to_viewer)), 1e-15);
    EXPECT_TRUE(TransmittedLobe(s).isOneRay());
    s.thickness = 0;
    EXPECT_TRUE(TransmittedLobe(s).isOneRay()) << "facets of a thin wall do not refract either";
}

TEST(ReferenceTransmission, AnInfiniteIndexRefractsToTheNormal) {
    Surface s = glassPane(0.7, 0.5);
    s.ior = 0;
    s.dispersion = 1;
    for (int c = 0; c < 3; ++c) EXPECT_LT(glm::distance(slabShift(s, c), glm::dvec3(0, 0, -0.5)), 1e-15) << c;
}

// KHR_materials_dispersion: 20 / Abbe number, so 1 is glass with V = 20.
TEST(ReferenceTransmission, DispersionSpreadsTheIndices) {
    Surface s = glassPane(0.5, 1);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(indexOf(s, c), 1.5);
    s.dispersion = 1;
    EXPECT_NEAR(indexOf(s, 0), 1.4875, 1e-15);
    EXPECT_EQ(indexOf(s, 1), 1.5);
    EXPECT_NEAR(indexOf(s, 2), 1.5125, 1e-15);
    EXPECT_LT(glm::length(glm::cross(slabShift(s, 0), s.to_viewer)),
              glm::length(glm::cross(slabShift(s, 2), s.to_viewer)))
        << "red is bent least";
    s.dispersion = 100;
    EXPECT_EQ(indexOf(s, 0), 1) << "at least 1";
}

// ---- absorption --------------------------------------------------------------------------------------

TEST(ReferenceTransmission, AbsorptionIsBeersAndLamberts) {
    Surface s = glassPane(0, 1);
    s.attenuation_color = {0.5, 1, 0};
    EXPECT_EQ(attenuationOf(s, 3), glm::dvec3(1)) << "an infinite distance";
    s.attenuation_distance = 2;
    for (const double distance : {0.1, 2.0, 6.0}) {
        const glm::dvec3 unabsorbed = attenuationOf(s, distance);
        EXPECT_NEAR(unabsorbed.r, std::exp(std::log(0.5) * distance / 2), 1e-15);
        EXPECT_EQ(unabsorbed.g, 1);
        EXPECT_EQ(unabsorbed.b, 0);
    }
    EXPECT_EQ(attenuationOf(s, 0), glm::dvec3(1));
    s.attenuation_distance = 1e-12;
    EXPECT_EQ(attenuationOf(s, 1e12), glm::dvec3(0, 1, 0)) << "finite at the ends of the ranges";
}

// ---- the lobe ----------------------------------------------------------------------------------------

// The mean of a power of the cosine to the straight direction over the mirrored lobe, as a dense sum.
std::pair<double, double> lobeMoments(double alpha, const glm::dvec3& v) {
    constexpr int steps = 800;
    double whole = 0, first = 0, second = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = (i + 0.5) / steps, phi = 2 * pi * (j + 0.5) / steps, r = std::sqrt(1 - z * z);
            const glm::dvec3 l(r * std::cos(phi), r * std::sin(phi), z);
            const double f = stretchedLobe(glm::dvec2(alpha), l, v);
            const double cosine = -glm::dot(v, glm::dvec3(l.x, l.y, -l.z));
            whole += f;
            first += f * cosine;
            second += f * cosine * cosine;
        }
    return {first / whole, second / whole};
}

TEST(ReferenceTransmission, TheLobeIsTheReflectedOneMirrored) {
    for (const double roughness : {0.4, 0.7, 1.0})
        for (const double angle : {0.2, 1.1}) {
            Surface s = glassPane(angle);
            s.roughness = roughness;
            const TransmittedLobe lobe(s);
            constexpr int count = 20000;
            double weights = 0, first = 0, second = 0;
            for (std::uint64_t i = 0; i < count; ++i) {
                const auto [direction, weight] = lobe(evenly(i, {0.3, 0.6}));
                if (!(weight > 0)) continue;
                EXPECT_LE(glm::dot(direction, s.normal), 0) << "on the far side";
                const double cosine = -glm::dot(direction, s.to_viewer);
                weights += weight / count;
                first += weight * cosine / count;
                second += weight * cosine * cosine / count;
            }
            const auto [mean, square] = lobeMoments(roughness * roughness, s.to_viewer);
            EXPECT_NEAR(weights, 1, 5e-3) << roughness << " " << angle;
            EXPECT_NEAR(first, mean, 5e-3) << roughness << " " << angle;
            EXPECT_NEAR(second, square, 5e-3) << roughness << " " << angle;
        }
}

// An index of 1.25 makes half as wide a lobe as 1.5 and above.
TEST(ReferenceTransmission, TheLobeFollowsTheIndex) {
    Surface slab = glassPane(0.5, 1), thin = glassPane(0.5);
    slab.roughness = 0.8;
    slab.ior = 1.25;
    Surface wall = slab;
    wall.thickness = 0;
    thin.roughness = std::sqrt(0.5) * 0.8;
    for (const Surface& of : {slab, wall}) {
        const TransmittedLobe a(of), b(thin);
        for (const glm::dvec2& u : {glm::dvec2(0.2, 0.7), glm::dvec2(0.9, 0.1)}) {
            EXPECT_LT(glm::distance(a(u).direction, b(u).direction), 1e-12);
            EXPECT_NEAR(a(u).weight, b(u).weight, 1e-9);
        }
    }
    slab.ior = 1.8;
    thin.roughness = 0.8;
    EXPECT_LT(glm::distance(TransmittedLobe(slab)({0.2, 0.7}).direction,
                            TransmittedLobe(thin)({0.2, 0.7}).direction),
              1e-12);
    for (const double smooth : {0.0, 0.04}) {
        thin.roughness = smooth;
        EXPECT_TRUE(TransmittedLobe(thin).isOneRay()) << smooth;
    }
}

}  // namespace
}  // namespace diptych::reference
