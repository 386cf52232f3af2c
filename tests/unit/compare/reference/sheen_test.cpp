// SPDX-License-Identifier: MIT
// The reference's sheens (KHR_materials_sheen), compared with the paper's formulas, closed forms and sums.
#include "compare/reference/scattering/sheen.h"

#include "tests/support/layer_formulas.h"
#include "tests/support/reference_scene.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/lobe_sampler.h"

namespace diptych::reference {
namespace {

// A white Lambertian surface with a sheen, seen at `angle` from +Z.
Surface velvet(const glm::dvec3& color, double roughness, double angle) {
    Surface s = lambertian();
    s.to_viewer = polar(angle, 0);
    s.sheen_color = color;
    s.sheen_roughness = roughness;
    return s;
}
// ---- the lobe ----------------------------------------------------------------------------------------

TEST(ReferenceSheen, TheLobeIsEstevezAndKullas) {
    for (const double roughness : {0.0, 0.3, 1.0})
        for (const double view : {0.0, 0.7, 1.5})
            for (const double light : {0.1, 0.9, 1.4})
                for (const double turn : {0.2, 1.5, pi}) {
                    const Surface s = sheenOf(velvet({0.5, 1, 0.25}, roughness, view));
                    const glm::dvec3 l = polar(light, turn), h = glm::normalize(l + s.to_viewer);
                    const double expected = estevezKulla(roughness, std::cos(light), std::cos(view), h.z);
                    const Reflected f = Brdf(s)(l);
                    EXPECT_EQ(f.diffuse, glm::dvec3(0));
                    EXPECT_NEAR(f.specular.g, expected, 1e-9 * expected + 1e-300);
                    EXPECT_NEAR(f.specular.r, 0.5 * expected, 1e-9 * expected + 1e-300);
                }
}

TEST(ReferenceSheen, TheAlbedoIsADenseSum) {
    for (const double roughness : {0.045, 0.3, 1.0})
        for (const double cosine : {1e-4, 0.2, 1.0})
            EXPECT_NEAR(sheenAlbedo(roughness, cosine), denseSheenAlbedo(roughness, cosine), 2e-5)
                << roughness << " " << cosine;
    EXPECT_EQ(sheenAlbedo(0, 0.1), sheenAlbedo(0.045, 0.1));
    EXPECT_EQ(sheenAlbedo(0.5, -1), sheenAlbedo(0.5, 1e-4));
    EXPECT_GT(sheenAlbedo(0, 0.01), 3) << "the model's gain at grazing views";
}

// The estimator's mean is the albedo only if directions are distributed as their density says.
TEST(ReferenceSheen, SamplesFollowTheirDensity) {
    for (const double roughness : {0.1, 0.5, 1.0})
        for (const double angle : {0.0, 1.4}) {
            const Brdf brdf(sheenOf(velvet(glm::dvec3(1), roughness, angle)));
            const LobeSampler lobe(brdf);
            constexpr int rows = 1000, around = 200;
            double sum = 0;
            for (int i = 0; i < rows; ++i)
                for (int j = 0; j < around; ++j) {
                    const glm::dvec3 l = lobe({(i + 0.5) / rows, (j + 0.5) / around});
                    sum += brdf.lobe(l).g / lobe.density(l);
                }
            EXPECT_NEAR(sum / (rows * around), sheenAlbedo(roughness, std::cos(angle)), 2e-4)
                << roughness << " " << angle;
            EXPECT_EQ(lobe.density({0.6, 0, -0.8}), 0);
        }
}

// Under a white sheen a white base reflects the rest, unless the sheen alone exceeds 1.
TEST(ReferenceSheen, TheWhiteFurnace) {
    for (const double angle : {0.0, 0.8, 1.3, 1.55})
        for (const double roughness : {0.3, 0.5, 1.0}) {
            const double albedo = sheenAlbedo(roughness, std::cos(angle));
            const Shading white = underAmbient(velvet(glm::dvec3(1), roughness, angle)),
                          red = underAmbient(velvet({1, 0.5, 0}, roughness, angle));
            EXPECT_NEAR(white.ambient.g, 1, 1e-6) << angle << " " << roughness;
            EXPECT_NEAR(red.ambient.r, 1, 1e-6);
            EXPECT_NEAR(red.ambient.g, 1 - albedo / 2, 1e-6) << "the largest component dims all";
            EXPECT_NEAR(red.ambient.b, 1 - albedo, 1e-6);
            EXPECT_NEAR(red.sheen.g, albedo / 2, 1e-12);
        }
    const Surface shining = velvet(glm::dvec3(1), 0.1, std::acos(0.01));
    EXPECT_EQ(sheenAlbedoScaling(shining), 0);
    EXPECT_NEAR(underAmbient(shining).ambient.g, sheenAlbedo(0.1, 0.01), 1e-12) << "above 1";
}

// ---- large lights ------------------------------------------------------------------------------------

// The light stands on the side of the viewer, where fibres show their sides.
TEST(ReferenceSheen, ARectangleNearTheHorizon) {
    for (const double roughness : {0.1, 0.5}) {
        const Surface s = sheenOf(velvet(glm::dvec3(1), roughness, 1.4));
        Light light = lightOf(LightKind::rect, {2, 0, 1}, {-1, 0, 0});
        light.axis = {0, 1, 0};
        light.width = 2;
        light.height = 1;
        const double expected =
            2 * simpson(200, 400, [&](double u, double v) {
                const glm::dvec3 point(2, -1 + 2 * u, 0.5 + v), l = glm::normalize(point);
                const double n_dot_h = glm::normalize(l + s.to_viewer).z;
                return estevezKulla(roughness, l.z, std::cos(1.4), n_dot_h) * l.x / glm::dot(point, point);
            });
        EXPECT_NEAR(reflectedBy(light, s), expected, 1e-5 * expected) << roughness;
    }
}

// ---- costs of approximations -------------------------------------------------------------------------

TEST(ReferenceSheen, AnEvenSkyCostsNothing) {
    const Environment sky{"sky", Image(32, 16, 3, 1.0f)};
    const Shading shading = withCosts(sky, sheenOf(velvet(glm::dvec3(1), 0.5, 1)));
    const EnvironmentCosts& costs = shading.costs;
    const double integral = shading.environment.specular.g;
    for (const double cost : costs.split) EXPECT_LE(cost, 0.1 * integral);
    EXPECT_LE(costs.sampled, 0.1 * integral);
}

// The paths spread the sheen's light over the hemisphere, but it is lit from the viewer's side.
TEST(ReferenceSheen, LightFromOneSideCostsTheDifference) {
    Environment sky{"sky", Image(64, 32, 3, 0.0f)};
    const EnvironmentLight black(sky, 1);
    double irradiance = 0;  // over pi
    const glm::dvec3 normal(0, 0, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 d = black.directionOf(x + 0.5, y + 0.5);
            if (d.x < 0.3) continue;
            for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = 1;
            irradiance += std::max(glm::dot(d, normal), 0.0) * (2 * pi / 64) *
                          (std::cos(pi * y / 32) - std::cos(pi * (y + 1) / 32)) / pi;
        }
    const Surface s = sheenOf(velvet(glm::dvec3(1), 0.3, 1.4));
    const Shading shading = withCosts(sky, s);
    const EnvironmentCosts& costs = shading.costs;
    const double integral = shading.environment.specular.g;
    const double taken = sheenAlbedo(0.3, std::cos(1.4)) * irradiance;
    EXPECT_GT(std::abs(taken - integral), 0.1 * integral);
    EXPECT_NEAR(costs.split[2], std::abs(taken - integral), 0.1 * integral + 0.03 * taken);
    for (const double cost : costs.split) EXPECT_GE(costs.sampled, cost) << "not sampled";
    EXPECT_EQ(costs.diffuse[0], 0);
    EXPECT_EQ(costs.wider, 0);
    EXPECT_EQ(costs.lobe, 0);
}

// ---- images ----------------------------------------------------------------------------------------

TEST(ReferenceSheen, EmissionIsNotDimmed) {
    Scene scene = floorScene();
    scene.materials[0].sheen_color = {0.5f, 0.25f, 1};
    scene.materials[0].sheen_roughness = 0.5f;
    scene.materials[0].emissive = {2, 1, 4};
    EXPECT_NEAR(pixelOf(drawn(scene, viewFrom({2, 0, 2}, {0, 0, 0}, 1, 1, 0.01))[Channel::lit]).b, 4, 1e-6);
}

}  // namespace
}  // namespace diptych::reference
