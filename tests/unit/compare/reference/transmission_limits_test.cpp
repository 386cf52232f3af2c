// SPDX-License-Identifier: MIT
// Transmission and diffuse transmission in the reference: energy under every layer, reciprocity, and the ends
// of their ranges.
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/multiscatter.h"
#include "compare/reference/scattering/sheen.h"
#include "compare/reference/scattering/transmission.h"
#include "shared/scene/builtin/shapes.h"
#include "tests/support/layer_formulas.h"
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

// A glossy white dielectric facing +Z, seen at `angle`.
Surface whitePane(double angle) {
    Surface s = lambertian();
    s.to_viewer = {std::sin(angle), 0, std::cos(angle)};
    s.roughness = 0.5;
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    s.diffuse_transmission_color = glm::dvec3(1);
    return s;
}
constexpr double almostEdgeOn = (90 - 0.01) * pi / 180;

// ---- energy ------------------------------------------------------------------------------------------

// Radiance to the viewer under radiance 1 from everywhere, that from straight behind included.
double furnaceOf(const Surface& s) {
    const Lighting light({.ambient = glm::dvec3(1), .multiscatter = Multiscatter::energy});
    return light(s, {}, 1).all().g + transmitted(s).g;
}

// A compensated white surface reflects and diffusely transmits all light. What deviates: transmission admits
// by Fresnel's term of the view, and not of the lobe; a clear coat is not compensated.
double expectedInFurnace(const Surface& s) {
    Surface dielectric = underSheen(s);
    dielectric.metallic = 0;
    const double layer = specularAlbedo(dielectric, compensationOf(dielectric, Multiscatter::energy)).g,
                 facing = schlick(s.to_viewer.z);
    double sum = 1 + s.transmission * (1 - s.metallic) * (layer - facing);
    if (hasSheen(s)) sum = specularAlbedo(sheenOf(s)).g + sheenAlbedoScaling(s) * sum;
    const double coat = coatWeight(s);
    return coat > 0 ? coat * specularAlbedo(coatOf(s)).g + (1 - coat) * sum : sum;
}

TEST(ReferenceTransmissionLimits, AWhiteFurnaceUnderEveryLayerLosesWhatTheModelLoses) {
    for (const double angle : {0.2, 1.2})
        for (const double weight : {0.0, 0.5, 1.0})
            for (const double transmission : {0.0, 0.5, 1.0})
                for (const double metallic : {0.0, 0.5})
                    for (const int layers : {0, 1, 2, 3}) {
                        Surface s = whitePane(angle);
                        s.diffuse_transmission = weight;
                        s.transmission = transmission;
                        s.metallic = metallic;
                        if ((layers & 1) != 0) {
                            s.sheen_color = glm::dvec3(0.5);
                            s.sheen_roughness = 0.6;
                        }
                        if ((layers & 2) != 0) {
                            s.clearcoat = 0.7;
                            s.clearcoat_roughness = 0.4;
                            s.clearcoat_normal = s.normal;
                        }
                        EXPECT_NEAR(furnaceOf(s), expectedInFurnace(s), 2e-4)
                            << angle << " " << weight << " " << transmission << " " << metallic << " "
                            << layers;
                        if (transmission == 0) {
                            EXPECT_LE(furnaceOf(s), 1 + 2e-4) << "nothing gains light";
                        }
                    }
}

// ---- reciprocity -------------------------------------------------------------------------------------

// f(l, v) of light from behind is f(v, l) of the surface seen from its other side.
TEST(ReferenceTransmissionLimits, DiffuseTransmissionIsReciprocal) {
    for (const double view : {0.1, 0.8, 1.5})
        for (const double light : {0.2, 1.1})
            for (const double film : {0.0, 1.0}) {
                Surface s = whitePane(view);
                s.diffuse_transmission = 0.6;
                s.iridescence = film;
                s.iridescence_ior = 1.4;
                s.iridescence_thickness = 350;
                const glm::dvec3 l(std::sin(light) * std::cos(2.0), std::sin(light) * std::sin(2.0),
                                   -std::cos(light));
                Surface other = s;
                other.normal = other.geometric_normal = -s.normal;
                other.to_viewer = l;
                const glm::dvec3 there = Brdf(s)(l).transmitted / std::cos(light),
                                 back = Brdf(other)(s.to_viewer).transmitted / std::cos(view);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 1e-12) << view << " " << light;
            }
}

// ---- grazing views -----------------------------------------------------------------------------------

TEST(ReferenceTransmissionLimits, AlmostEdgeOnAllIsFinite) {
    for (const double ior : {0.0, 1.0, 1.5})
        for (const double thickness : {0.0, 0.5})
            for (const double roughness : {0.0, 0.5, 1.0}) {
                Surface s = whitePane(almostEdgeOn);
                s.ior = ior;
                s.thickness = thickness;
                s.roughness = roughness;
                s.transmission = s.diffuse_transmission = 0.5;
                EXPECT_GE(transmitted(s).g, 0);
                EXPECT_LT(transmitted(s).g, 0.01) << "Fresnel's term is almost 1";
                EXPECT_NEAR(glm::length(slabShift(s, 1)), thickness, 1e-12);
                const TransmittedLobe lobe(s);
                for (std::uint64_t i = 0; i < 200; ++i) {
                    const auto [direction, weight] = lobe(evenly(i, {0.3, 0.6}));
                    EXPECT_TRUE(std::isfinite(weight) && weight >= 0) << roughness;
                    EXPECT_NEAR(glm::length(direction), 1, 1e-9);
                    EXPECT_LE(direction.z, 0) << "on the far side";
                }
                for (const double light : {0.3, almostEdgeOn}) {
                    const double f = Brdf(s)({std::sin(light), 0, -std::cos(light)}).transmitted.g;
                    EXPECT_TRUE(std::isfinite(f) && f >= 0);
                    EXPECT_LE(f, 0.25 / pi * std::cos(light) * (1 + 1e-12));
                }
            }
}

// ---- slabs -------------------------------------------------------------------------------------------

Material clearGlassOf(float thickness) {
    Material m = matte();
    m.transmission = 1;
    m.roughness = 0;
    m.thickness = thickness;
    return m;
}
// A white floor at z = -3, lit by a point at (0, 0, -1.5).
Scene litFloor(const Material& glass) {
    Scene scene = floorScene();
    for (glm::vec3& p : scene.meshes[0].primitives[0].positions) p.z = -3;
    scene.materials.push_back(glass);
    scene.lights = {lightOf(LightKind::point, {0, 0, -1.5})};
    return scene;
}
double litFloorAt(double x) {
    return 1.5 / std::pow(x * x + 2.25, 1.5) / pi;
}
// Looks down at `angle` from the vertical, at the origin's right where z is `height`.
View slanted(double angle, double height) {
    const glm::dvec3 target(0, 0, height);
    return viewFrom(target + glm::dvec3(-std::sin(angle), 0, std::cos(angle)) * 6.0, target, 1, 1, 1e-4);
}

// Mode surface: the light is that straight behind, and a colour without green keeps none.
TEST(ReferenceTransmissionLimits, ASlabOfIndexOneMovesNothingAndABlackComponentPassesNothing) {
    Material m = clearGlassOf(0.5f);
    m.ior = 1;
    m.roughness = 1;
    m.attenuation_color = {1, 0, 0.25f};
    m.attenuation_distance = 1;
    Scene scene = litFloor(m);
    add(scene, quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 1));
    const View view = slanted(0.6, 0);
    const Drawn traced = drawn(scene, view);
    const Image lit = shadedAgain(scene, view, traced, traced.image.channels).channels.at(Channel::lit);
    const double straight = litFloorAt(3 * std::tan(0.6));
    EXPECT_NEAR(double{lit.at(0, 0, 0)}, straight, 1e-5 * straight);
    EXPECT_EQ(lit.at(0, 0, 1), 0);
    EXPECT_NEAR(double{lit.at(0, 0, 2)}, std::pow(0.25, 0.5) * straight, 1e-5 * straight);
}

// Mode scene: a box with parallel faces. The ray leaves its lower face after an odd number of ways through
// it, and between them both faces reflect by Fresnel's equations.
TEST(ReferenceTransmissionLimits, ABoxIsASlabByItsOwnWays) {
    for (const double angle : {0.0, 0.6}) {
        Material m = clearGlassOf(1);
        m.attenuation_color = {0.5f, 1, 0.25f};
        m.attenuation_distance = 1;
        Scene scene = litFloor(m);
        Primitive glass = box({8, 8, 1});
        glass.material = 1;
        add(scene, glass);
        const Drawn d = drawn(scene, slanted(angle, 0.5));
        const Image& interval = d.image.uncertainty;
        const double uncertain = interval.data.empty() ? 0 : double{interval.at(0, 0)};
        const double inside = std::asin(std::sin(angle) / 1.5), once = 1 / std::cos(inside),
                     reflected = reflectedInside(std::cos(inside), 1.5);
        for (int c = 0; c < 3; ++c) {
            const double absorbed = std::pow(double{m.attenuation_color[c]}, once);
            double expected = 0;
            for (int ways = 1; ways < 8; ways += 2)
                expected += (1 - reflected) * std::pow(reflected, ways - 1) * std::pow(absorbed, ways) *
                            litFloorAt(ways * std::tan(inside) + 2.5 * std::tan(angle));
            EXPECT_NEAR(double{d[Channel::lit].at(0, 0, c)}, expected, 2 * uncertain + 5e-3 * expected)
                << angle << " " << c;
        }
    }
}

}  // namespace
}  // namespace diptych::reference
