// SPDX-License-Identifier: MIT
// Errors of environment lighting approximations, and the light that geometry occludes, compared with
// closed forms.
#include "compare/reference/light/environment_costs.h"
#include "compare/reference/scattering/sheen.h"
#include "shared/environment/harmonics.h"
#include "shared/scene/model/luminance.h"
#include "tests/support/reference_scene.h"

#include <array>
#include <random>

namespace diptych::reference {
namespace {

Environment evenSky(float radiance, int width = 32, int height = 16) {
    return {"sky", Image(width, height, 3, radiance)};
}

EnvironmentCosts costsUnder(const Environment& sky, const Surface& s) {
    return withCosts(sky, s).costs;
}

TEST(ReferenceEnvironmentCosts, AreAddedAndScaledOneByOne) {
    const EnvironmentCosts one{{1, 2, 3}, {4, 5, 6}, 7, 8, 9};
    EnvironmentCosts sum = one;
    sum += one * 3;
    EXPECT_EQ(sum.diffuse, (std::array<double, 3>{4, 8, 12}));
    EXPECT_EQ(sum.split, (std::array<double, 3>{16, 20, 24}));
    EXPECT_EQ(sum.sampled, 28);
    EXPECT_EQ(sum.wider, 32);
    EXPECT_EQ(sum.lobe, 36);
}

TEST(ReferenceEnvironmentCosts, ItsHarmonicsAreThePaths) {
    Environment sky = evenSky(0, 16, 8);
    std::mt19937 random(4);
    for (float& v : sky.radiance.data) v = std::uniform_real_distribution<float>(0, 0.02f)(random);
    sky.radiance.at(3, 2, 1) = 300;
    const EnvironmentLight light(sky, 1);
    const EnvironmentApproximation approximation(light);
    const Harmonics harmonics = project(LatLong(sky));
    const double window = minWindow(harmonics);
    EXPECT_GT(window, 0);
    EXPECT_NEAR(approximation.window() / window, 1, 0.02);
    for (const double damped : {0.0, window}) {
        const auto polynomial = irradiancePolynomial(harmonics, damped);
        for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), {0.3, -0.8, 0.5}, {-0.2, 0.7, 0.6}, {0, 0, -1}}) {
            const glm::dvec3 n = glm::normalize(d), taken = evaluate(polynomial, n);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(approximation.irradiance(n, damped)[c], std::max(taken[c], 0.0), 5e-3) << c;
        }
    }
}

// A surface of every lobe, facing +Z, seen at `angle`.
std::vector<Surface> everyLobe(double roughness, double angle) {
    Surface metal = mirror(roughness, angle), glossy = metal;
    glossy.metallic = 0;
    glossy.dielectric_f0 = glm::dvec3(0.04);
    glossy.dielectric_f90 = 1;
    Surface stretched = metal, leaf = glossy, velvet = metal, film = metal;
    stretched.stretch(0.6, {0.6, 0.8, 0});
    leaf.diffuse_transmission = 0.5;
    leaf.diffuse_transmission_color = glm::dvec3(1);
    velvet.sheen_color = glm::dvec3(0.5);
    velvet.sheen_roughness = roughness;
    film.iridescence = 1;
    film.iridescence_ior = 1.4;
    film.iridescence_thickness = 400;
    return {metal, glossy, stretched, leaf, velvet, film};
}
glm::dvec3 radianceUnder(const Environment& sky, const Surface& s, double& uncertainty) {
    const Shading shading = Lighting({.environment = &sky})(s, {}, 5);
    uncertainty = shading.uncertainty;
    return shading.all();
}

// `costs` compares the paths' approximations with sampled light, so errors of the samples would be granted.
// Proves the samples of every lobe by quadrature, which shares no sampler with them.
TEST(ReferenceEnvironmentCosts, SampledLightIsTheLobesIntegralInAFurnace) {
    for (const double roughness : {0.3, 0.5, 0.8, 1.0})
        for (const double angle : {0.2, 0.8, 1.3})
            for (const Surface& s : everyLobe(roughness, angle)) {
                double uncertainty = 0;
                const double sampled = radianceUnder(evenSky(3), s, uncertainty).g,
                             whole = Lighting({.ambient = glm::dvec3(3)})(s, {}, 5).all().g;
                EXPECT_NEAR(sampled, whole, 1.5 * uncertainty + 2e-3 * whole) << roughness << " " << angle;
                EXPECT_LE(uncertainty, 0.011 * 3);
            }
}

// The same by a dense sum, under a sky that differs by direction: 1 + d.y in red, 1 + d.z in green.
TEST(ReferenceEnvironmentCosts, SampledLightIsADenseSumUnderAGradient) {
    Environment sky = evenSky(0, 64, 32);
    const EnvironmentLight map(sky, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 d = map.directionOf(x + 0.5, y + 0.5);
            sky.radiance.at(x, y, 0) = static_cast<float>(1 + d.y);
            sky.radiance.at(x, y, 1) = static_cast<float>(1 + d.z);
        }
    constexpr int rows = 400, columns = 200;
    for (const double roughness : {0.5, 1.0})
        for (const double angle : {0.2, 1.2})
            for (const Surface& s : everyLobe(roughness, angle)) {
                if (hasSheen(s)) continue;  // of two layers
                const Brdf brdf(s);
                glm::dvec3 sum(0);
                for (int i = 0; i < rows; ++i)
                    for (int j = 0; j < columns; ++j) {
                        const double z = 2 * (i + 0.5) / rows - 1, out = std::sqrt(1 - z * z),
                                     turn = 2 * pi * (j + 0.5) / columns;
                        const glm::dvec3 l(out * std::cos(turn), out * std::sin(turn), z);
                        sum += brdf(l).sum() * glm::dvec3(1 + l.y, 1 + l.z, 0);
                    }
                sum *= 4 * pi / (double{rows} * columns);
                double uncertainty = 0;
                const glm::dvec3 sampled = radianceUnder(sky, s, uncertainty);
                for (int c = 0; c < 2; ++c)
                    EXPECT_NEAR(sampled[c], sum[c], 1.5 * uncertainty + 5e-3 * sum[c])
                        << roughness << " " << angle << " " << c;
            }
}

// Under a constant sky every approximation is right, so a term that is not small is an error of the
// reference. The bounds only cover sampling noise; a film adds the waves that its mean lacks.
TEST(ReferenceEnvironmentCosts, AConstantSkyCostsNothing) {
    for (const auto& [roughness, angle] : {std::pair{0.5, 1.3}, {1.0, 0.2}})
        for (const Surface& s : everyLobe(roughness, angle)) {
            const EnvironmentCosts costs = costsUnder(evenSky(3), s);
            const double waves = s.iridescence > 0 ? 0.2 : 0;
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_LE(costs.diffuse[i], 3 * 0.09) << roughness << " " << angle << " " << i;
                EXPECT_LE(costs.split[i], 3 * (0.07 + waves)) << roughness << " " << angle << " " << i;
            }
            EXPECT_LE(costs.wider, 3 * 0.05);
            EXPECT_LE(costs.sampled, 3 * 0.05);
            EXPECT_LE(costs.lobe, 3 * 1.2);
        }
    const double glossy = costsUnder(evenSky(3), everyLobe(0.5, 0.7)[1]).lobe;
    EXPECT_GT(glossy, 3 * 0.03);
    EXPECT_LE(glossy, 3 * 0.2);
}

// A sun at the zenith gives a Lambertian plane E / pi = L / pi. Order 2 gives (1 + 2 + 5 / 4) / 4 pi of
// it. On the opposite side it gives (1 - 2 + 5 / 4) / 4 pi, where it should be 0.
TEST(ReferenceEnvironmentCosts, ASunsHarmonicsAreOffByAClampedCosines) {
    Environment sky = evenSky(0, 128, 64);
    for (int c = 0; c < 3; ++c) sky.radiance.at(31, 31, c) = 1000;
    const double azimuth = 2 * pi * 31.5 / 128 - pi, down = pi * 31.5 / 64;
    const glm::dvec3 sun(std::sin(down) * std::sin(azimuth), std::cos(down),
                         -std::sin(down) * std::cos(azimuth));
    const double flux = 1000 * (2 * pi / 128) * (pi / 64);
    const EnvironmentCosts facing = costsUnder(sky, lambertian(sun)),
                           turned = costsUnder(sky, lambertian(-sun));
    EXPECT_NEAR(facing.diffuse[0] / (flux * (4.25 / 4 - 1) / pi), 1, 0.2) << "to 1 % of all, which is known";
    EXPECT_NEAR(turned.diffuse[0] / (flux * 0.25 / 4 / pi), 1, 0.02);
    EXPECT_LE(turned.diffuse[2], 0.03 * flux / pi) << "a map has nothing there but what its nodes mix";
    EXPECT_EQ(turned.lobe, 0);
}

// Light that fills half a lobe gives the split sum a large error, smaller when seen from straight above.
TEST(ReferenceEnvironmentCosts, TheSplitSumCostsMoreAtGrazingAngles) {
    Environment sky = evenSky(0.1f, 64, 32);
    for (int x = 0; x < 64; ++x)
        for (int y = 0; y < 12; ++y)
            for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = 5;
    Surface above = mirror(0.6, 0), grazing = mirror(0.6, 1.4);
    for (Surface* s : {&above, &grazing}) {
        // Rotates from +Z up to +Y up.
        s->normal = {0, 1, 0};
        s->to_viewer = {s->to_viewer.x, s->to_viewer.z, 0};
    }
    const EnvironmentCosts a = costsUnder(sky, above), b = costsUnder(sky, grazing);
    EXPECT_LE(a.split[0] / a.lobe, 0.1);
    EXPECT_GE(b.split[0] / b.lobe, 0.2);
}

// ---- occlusion by geometry ---------------------------------------------------------------------------

// Mean occluded fraction of light on a floor, seen from above around (0.05, 0, 0).
double hiddenFraction(const Scene& scene, const glm::dvec3& ambient) {
    const Pose pose = poseAt(scene, 0);
    const View view = viewFrom({0.05, 0.01, 2}, {0.05, 0, 0}, 12, 12, glm::radians(1.0));
    const ReferenceImage image = draw({.scene = scene,
                                       .pose = pose,
                                       .view = view,
                                       .lights = pose.lights,
                                       .ambient = ambient,
                                       .surroundings = true,
                                       .mode = ReferenceMode::scene,
                                       .surfaces = nullptr});
    double all = 0, hidden = 0;
    for (std::size_t i = 0; i < image.surroundings.pixels(); ++i) {
        all += double{image.surroundings.pixel(i)[0]};
        hidden += double{image.surroundings.pixel(i)[1]};
        EXPECT_NEAR(double{image.channels.at(Channel::lit).pixel(i)[0]}, 1, 0.02) << "lit has all of it";
    }
    EXPECT_NEAR(all / static_cast<double>(image.surroundings.pixels()), 1, 0.03) << "radiance 1, white";
    return hidden / all;
}

TEST(ReferenceSurroundings, AWallHidesHalf) {
    Scene scene = floorScene();
    scene.environment = evenSky(1);
    EXPECT_EQ(hiddenFraction(scene, glm::dvec3(0)), 0);
    // Occluded by a wall of height H at distance x: (1 - x / sqrt(x^2 + H^2)) / 2.
    add(scene, quad({0, -1000, 0}, {0, 2000, 0}, {0, 0, 1000}));
    EXPECT_NEAR(hiddenFraction(scene, glm::dvec3(0)), 0.5, 0.01);
    scene.environment->radiance = Image(2, 1, 3, 0.25f);
    EXPECT_NEAR(hiddenFraction(scene, glm::dvec3(0.75)), 0.5, 0.01) << "of the environment and ambient light";
    scene.environment.reset();
    EXPECT_NEAR(hiddenFraction(scene, glm::dvec3(1)), 0.5, 0.01) << "of ambient light alone";
}

// The mean over many surfaces of the light around them is its integral, also of light from behind.
TEST(ReferenceSurroundings, AllOfIt) {
    const Environment sky = evenSky(3);
    const EnvironmentLight light(sky, 1);
    const Visibility open = [](const glm::dvec3&, double) { return true; };
    for (const double roughness : {0.5, 1.0})
        for (const double angle : {0.2, 1.2})
            for (const Surface& s : everyLobe(roughness, angle)) {
                if (hasSheen(s)) continue;  // of two layers
                double all = 0;
                constexpr int seeds = 200;
                for (std::uint64_t seed = 0; seed < seeds; ++seed)
                    all +=
                        surroundingsOf(Brdf(s), &light, false, glm::dvec3(0), open, seed * 7919).all / seeds;
                const double whole = luminance(Lighting({.ambient = glm::dvec3(3)})(s, {}, 5).all());
                EXPECT_NEAR(all, whole, 0.01 * whole) << roughness << " " << angle;
            }
}

TEST(ReferenceSurroundings, ALowWallHidesWhatItSubtends) {
    Scene scene = floorScene();
    scene.environment = evenSky(1);
    add(scene, quad({0, -1000, 0}, {0, 2000, 0}, {0, 0, 0.05f}));
    EXPECT_NEAR(hiddenFraction(scene, glm::dvec3(0)), (1 - std::sqrt(0.5)) / 2, 0.02);
}

}  // namespace
}  // namespace diptych::reference
