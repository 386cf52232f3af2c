// SPDX-License-Identifier: MIT
// The reference's sheens (KHR_materials_sheen), compared with the paper's formulas, closed forms and sums.
#include "compare/reference/sheen.h"

#include "tests/support/reference_scene.h"

#include "compare/reference/ambient.h"
#include "compare/reference/brdf.h"
#include "compare/reference/lobe_sampler.h"
#include "shared/frame/debug_modes.h"

namespace diptych::reference {
namespace {

glm::dvec3 aroundPole(double angle, double azimuth) {
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

// A white Lambertian surface with a sheen, seen at `angle` from +Z.
Surface velvet(const glm::dvec3& color, double roughness, double angle) {
    Surface s = lambertian();
    s.to_viewer = aroundPole(angle, 0);
    s.sheen_color = color;
    s.sheen_roughness = roughness;
    return s;
}
// A glossy dielectric under it.
Surface satin(double angle) {
    Surface s = velvet({0.3, 0.4, 0.2}, 0.4, angle);
    s.albedo = glm::dvec3(0.5);
    s.roughness = 0.5;
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    return s;
}
Surface bare(Surface s) {
    s.sheen_color = glm::dvec3(0);
    return s;
}

// D V n.l: Estevez and Kulla 2017, equations 2 and 3 and table 1.
double estevezKulla(double roughness, double n_dot_l, double n_dot_v, double n_dot_h) {
    const double used = std::max(roughness, 0.045), alpha = used * used, smooth = std::pow(1 - alpha, 2);
    constexpr std::array rough{21.5473, 3.82987, 0.19823, -1.97760, -4.32054},
        fine{25.3245, 3.32435, 0.16801, -1.27393, -4.85967};
    std::array<double, 5> p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = (1 - smooth) * rough[i] + smooth * fine[i];
    const auto fit = [&](double x) { return p[0] / (1 + p[1] * std::pow(x, p[2])) + p[3] * x + p[4]; };
    const auto lambda = [&](double x) {
        return x < 0.5 ? std::exp(fit(x)) : std::exp(2 * fit(0.5) - fit(1 - x));
    };
    const double sine = std::sqrt(std::max(1 - n_dot_h * n_dot_h, 0.0));
    return (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * pi) /
           ((1 + lambda(n_dot_v) + lambda(n_dot_l)) * 4 * n_dot_v);
}

// The same integral as a dense sum, by the angle from the direction opposite the viewer's.
double denseSheenAlbedo(double roughness, double n_dot_v) {
    constexpr int steps = 300;
    double sum = 0;
    const auto add = [&](double z, double weight) {
        for (int j = 0; j < steps; ++j) {
            const double w = (j + 0.5) / steps, phi = pi * (1 - w * w * w);
            const double cosine =
                z * n_dot_v + std::sqrt((1 - z * z) * (1 - n_dot_v * n_dot_v)) * std::cos(phi);
            sum += estevezKulla(roughness, z, n_dot_v, (z + n_dot_v) / std::sqrt(2 + 2 * cosine)) * weight *
                   6 * pi * w * w / steps;
        }
    };
    for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        add(0.5 * std::pow(u, 5), 2.5 * std::pow(u, 4) / steps);
        add(1 - 0.5 * u * u, u / steps);
    }
    return sum;
}

const Environment& evenCloud() {
    static const Environment sky{"sky", Image(8, 4, 3, 1.0f)};
    return sky;
}

Shading underAllLights(const Surface& s, Multiscatter multiscatter = Multiscatter::off) {
    Light point = lightOf(LightKind::point, {0.5, 0, 2}), rect = lightOf(LightKind::rect, {-1, 0, 1});
    rect.width = rect.height = 1;
    const std::vector<Light> lights{point, rect};
    Lighting lighting({.lights = lights,
                       .environment = &evenCloud(),
                       .ambient = glm::dvec3(0.5),
                       .multiscatter = multiscatter});
    lighting.takeCosts();
    lighting.takeSurroundings();
    return lighting(
        s, [](const glm::dvec3& l, double) { return l.x > 0; }, 7);
}
Shading underAmbient(const Surface& s, Multiscatter multiscatter = Multiscatter::off) {
    return Lighting({.ambient = glm::dvec3(1), .multiscatter = multiscatter})(s, {}, 1);
}

// ---- the lobe ----------------------------------------------------------------------------------------

TEST(ReferenceSheen, TheLobeIsEstevezAndKullas) {
    for (const double roughness : {0.0, 0.3, 1.0})
        for (const double view : {0.0, 0.7, 1.5})
            for (const double light : {0.1, 0.9, 1.4})
                for (const double turn : {0.2, 1.5, pi}) {
                    const Surface s = sheenOf(velvet({0.5, 1, 0.25}, roughness, view));
                    const glm::dvec3 l = aroundPole(light, turn), h = glm::normalize(l + s.to_viewer);
                    const double expected = estevezKulla(roughness, std::cos(light), std::cos(view), h.z);
                    const Reflected f = Brdf(s)(l);
                    EXPECT_EQ(f.diffuse, glm::dvec3(0));
                    EXPECT_NEAR(f.specular.g, expected, 1e-9 * expected + 1e-300);
                    EXPECT_NEAR(f.specular.r, 0.5 * expected, 1e-9 * expected + 1e-300);
                }
}

TEST(ReferenceSheen, FibresCoverTheSurfaceOnce) {
    for (const double roughness : {0.045, 0.3, 1.0}) {
        const SheenLobe lobe(roughness, 1);
        constexpr int steps = 2000;
        double sum = 0;  // of D n.h over the squared sine
        for (int i = 0; i < steps; ++i) {
            const double u = (i + 0.5) / steps;  // denser at the horizon
            sum += lobe.distribution(1 - u * u) * pi * 2 * u / steps;
        }
        EXPECT_NEAR(sum, 1, 1e-3) << roughness;
    }
}

TEST(ReferenceSheen, LightAndViewerMayChangePlaces) {
    for (const double roughness : {0.1, 0.5})
        for (const double turn : {0.3, 2.5}) {
            Surface there = sheenOf(velvet(glm::dvec3(1), roughness, 0.4)), back = there;
            back.to_viewer = aroundPole(1.1, turn);
            const double value = Brdf(there)(back.to_viewer).specular.g / std::cos(1.1);
            EXPECT_GT(value, 0);
            EXPECT_NEAR(Brdf(back)(there.to_viewer).specular.g / std::cos(0.4), value, 1e-9 * value);
        }
}

TEST(ReferenceSheen, TheAlbedoIsADenseSum) {
    for (const double roughness : {0.045, 0.1, 0.3, 0.6, 1.0})
        for (const double cosine : {1e-4, 0.01, 0.2, 0.7, 1.0})
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

// ---- layers ------------------------------------------------------------------------------------------

TEST(ReferenceSheen, BlackIsTheBaseBitForBit) {
    Surface none = bare(satin(0.7)), plain = none;
    none.sheen_roughness = 0.5;
    plain.sheen_roughness = 0;
    const Shading a = underAllLights(plain), b = underAllLights(none);
    EXPECT_EQ(a.reflected.diffuse, b.reflected.diffuse);
    EXPECT_EQ(a.reflected.specular, b.reflected.specular);
    EXPECT_EQ(a.ambient, b.ambient);
    EXPECT_EQ(a.uncertainty, b.uncertainty);
    EXPECT_EQ(a.environment.specular, b.environment.specular);
    EXPECT_EQ(a.costs.split, b.costs.split);
    EXPECT_EQ(b.sheen, glm::dvec3(0));
    EXPECT_EQ(keptUnderSheen(none), 1);
    EXPECT_EQ(transmitted(plain), transmitted(none));
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
    EXPECT_EQ(keptUnderSheen(shining), 0);
    EXPECT_NEAR(underAmbient(shining).ambient.g, sheenAlbedo(0.1, 0.01), 1e-12) << "above 1";
}

TEST(ReferenceSheen, TheBaseIsScaledByTheViewAlone) {
    const Surface s = satin(1.2);
    const double kept = 1 - 0.4 * denseSheenAlbedo(0.4, std::cos(1.2));
    EXPECT_LT(kept, 0.95);
    EXPECT_NEAR(keptUnderSheen(s), kept, 1e-5);
    const Shading all = underAllLights(s), under = underAllLights(bare(s)), over = underAllLights(sheenOf(s));
    const double noise = 3 * (under.uncertainty + over.uncertainty);
    EXPECT_NEAR(all.reflected.diffuse.g, kept * under.reflected.diffuse.g, 1e-4);
    EXPECT_NEAR(all.ambient.g, kept * under.ambient.g + over.ambient.g, 1e-4);
    EXPECT_NEAR(all.reflected.specular.g, kept * under.reflected.specular.g + over.reflected.specular.g,
                noise);
    EXPECT_NEAR(all.environment.specular.g, kept * under.environment.specular.g + over.environment.specular.g,
                noise);
    EXPECT_NEAR(all.sheen.g, over.reflected.specular.g + over.ambient.g, noise);
    EXPECT_NEAR(all.costs.diffuse[0], kept * under.costs.diffuse[0], 1e-4);
    EXPECT_NEAR(all.surroundings.all, kept * under.surroundings.all + over.surroundings.all,
                0.1 * all.surroundings.all);
}

// f n.l of every layer.
TEST(ReferenceSheen, TheReflectanceOfASun) {
    const Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0.6, 0, -0.8});
    const Surface s = velvet({0.5, 1, 0.25}, 0.6, 0.5);
    const glm::dvec3 l(-0.6, 0, 0.8), h = glm::normalize(l + s.to_viewer);
    const double lobe = estevezKulla(0.6, 0.8, std::cos(0.5), h.z),
                 kept = 1 - denseSheenAlbedo(0.6, std::cos(0.5));
    const Shading shading = shadedBy(std::span(&sun, 1), s);
    EXPECT_NEAR(shading.reflected.specular.r, lobe / 2, 1e-9);
    EXPECT_NEAR(shading.sheen.b, lobe / 4, 1e-9);
    EXPECT_NEAR(shading.reflected.diffuse.g, kept * 0.8 / pi, 1e-5);
    const Reflected factor = Lighting({}).reflectance(s, l);
    EXPECT_NEAR(factor.specular.r, shading.reflected.specular.r, 1e-12);
    EXPECT_NEAR(factor.diffuse.g, shading.reflected.diffuse.g, 1e-12);
}

TEST(ReferenceSheen, ACoatLiesOverIt) {
    Surface s = satin(0.8);
    const Shading under = underAmbient(s);
    s.clearcoat = 0.75;
    s.clearcoat_roughness = 0.3;
    s.clearcoat_normal = s.normal;
    const double w = coatWeight(s), coat = specularAlbedo(mirror(0.3, 0.8)).g;
    const Shading all = underAmbient(s);
    EXPECT_NEAR(all.sheen.g, (1 - w) * under.sheen.g, 1e-12);
    EXPECT_NEAR(all.clearcoat.g, w * coat, 1e-12);
    EXPECT_NEAR(all.ambient.g, w * coat + (1 - w) * under.ambient.g, 1e-12);
    const Lighting lighting({});
    const glm::dvec3 l = aroundPole(0.5, 1);
    EXPECT_NEAR(lighting.reflectance(s, l).diffuse.g,
                (1 - w) * keptUnderSheen(s) * Brdf(bare(s))(l).diffuse.g, 1e-12);
}

TEST(ReferenceSheen, OnlyTheBaseIsCompensated) {
    Surface s = mirror(0.8, 0.5);
    s.sheen_color = glm::dvec3(0.5);
    s.sheen_roughness = 0.7;
    EXPECT_NEAR(underAmbient(s, Multiscatter::energy).ambient.g, 1, 1e-5);
    EXPECT_NEAR(underAmbient(s, Multiscatter::energy).sheen.g, 0.5 * sheenAlbedo(0.7, std::cos(0.5)), 1e-12);
}

TEST(ReferenceSheen, ThinTransmissionPassesThroughIt) {
    Surface s = satin(1.2);
    s.transmission = 0.5;
    EXPECT_NEAR(transmitted(s).g, keptUnderSheen(s) * transmitted(bare(s)).g, 1e-15);
    EXPECT_LT(transmitted(s).g, 0.98 * transmitted(bare(s)).g);
}

TEST(ReferenceSheen, ALightmapIsUnderItAndOcclusionDimsIt) {
    Surface s = velvet(glm::dvec3(1), 0.5, 0.7);
    const double open = underAmbient(s).sheen.g;
    s.occlusion = 0.25;
    EXPECT_NEAR(underAmbient(s).sheen.g, open / 4, 1e-12);
    s.occlusion = 1;
    s.lightmap = glm::dvec3(3);
    s.lightmapped = true;
    const Shading shading = Lighting({})(s, {}, 1);
    EXPECT_NEAR(shading.ambient.g, 3 * keptUnderSheen(s), 1e-9);
    EXPECT_EQ(shading.sheen.g, 0);
    EXPECT_GT(Lighting({.environment = &evenCloud()})(s, {}, 1).sheen.g, 0.9 * open)
        << "the environment reaches it";
}

TEST(ReferenceSheen, GrazingAnglesAreFinite) {
    for (const double angle : {glm::radians(89.99), glm::radians(90.01)})
        for (const double roughness : {0.0, 1.0}) {
            Surface s = satin(angle);
            s.sheen_color = glm::dvec3(1);
            s.sheen_roughness = roughness;
            const Shading shading = underAllLights(s);
            EXPECT_TRUE(std::isfinite(shading.all().g));
            EXPECT_TRUE(std::isfinite(shading.sheen.g));
            EXPECT_GE(keptUnderSheen(s), 0);
            EXPECT_TRUE(std::isfinite(Brdf(sheenOf(s))(aroundPole(glm::radians(89.99), pi)).specular.g));
        }
}

// ---- large lights ------------------------------------------------------------------------------------

TEST(ReferenceSheen, AnEvenSkyIsAmbientLight) {
    for (const double roughness : {0.1, 0.3, 1.0})
        for (const double angle : {0.3, 1.5}) {
            const Surface s = sheenOf(velvet(glm::dvec3(1), roughness, angle));
            const double expected = sheenAlbedo(roughness, std::cos(angle));
            const Shading sky = Lighting({.environment = &evenCloud()})(s, {}, 3);
            EXPECT_NEAR(sky.sheen.g, expected, 2 * samplingError * expected) << roughness << " " << angle;
            EXPECT_LE(sky.uncertainty, 1.5 * samplingError * expected);
            EXPECT_EQ(sky.sheen, sky.environment.specular);
        }
}

// By Simpson's rule; the light stands on the side of the viewer, where fibres show their sides.
TEST(ReferenceSheen, ARectangleNearTheHorizon) {
    for (const double roughness : {0.1, 0.5}) {
        const Surface s = sheenOf(velvet(glm::dvec3(1), roughness, 1.4));
        Light light = lightOf(LightKind::rect, {2, 0, 1}, {-1, 0, 0});
        light.axis = {0, 1, 0};
        light.width = 2;
        light.height = 1;
        constexpr int across = 200, rows = 400;
        double expected = 0;
        for (int i = 0; i <= across; ++i)
            for (int j = 0; j <= rows; ++j) {
                const glm::dvec3 point(2, -1 + 2.0 * i / across, 0.5 + 1.0 * j / rows),
                    l = glm::normalize(point);
                const double weight = (i == 0 || i == across ? 1
                                       : i % 2               ? 4
                                                             : 2) *
                                      (j == 0 || j == rows ? 1
                                       : j % 2             ? 4
                                                           : 2) /
                                      9.0;
                const double n_dot_h = glm::normalize(l + s.to_viewer).z;
                expected += weight * estevezKulla(roughness, l.z, std::cos(1.4), n_dot_h) * l.x /
                            glm::dot(point, point);
            }
        expected *= 2.0 / across * 1.0 / rows;
        EXPECT_NEAR(reflectedBy(light, s), expected, 1e-5 * expected) << roughness;
    }
}

// ---- costs of approximations -------------------------------------------------------------------------

EnvironmentCosts costsOf(const Environment& sky, const Surface& s, double& integral) {
    Lighting lighting({.environment = &sky});
    lighting.takeCosts();
    const Shading shading = lighting(s, {}, 5);
    integral = shading.environment.specular.g;
    return shading.costs;
}

TEST(ReferenceSheen, AnEvenSkyCostsNothing) {
    const Environment sky{"sky", Image(32, 16, 3, 1.0f)};
    double integral = 0;
    const EnvironmentCosts costs = costsOf(sky, sheenOf(velvet(glm::dvec3(1), 0.5, 1)), integral);
    for (const double cost : costs.split) EXPECT_LE(cost, 0.1 * integral);
    EXPECT_LE(costs.sampled, 0.1 * integral);
}

// The paths spread the sheen's light over the hemisphere, but it is lit from the viewer's side.
TEST(ReferenceSheen, LightFromOneSideCostsTheDifference) {
    Environment sky{"sky", Image(64, 32, 3, 0.0f)};
    double irradiance = 0;  // over pi
    const glm::dvec3 normal(0, 0, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 d = EnvironmentLight(sky, 1).directionOf(x + 0.5, y + 0.5);
            if (d.x < 0.3) continue;
            for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = 1;
            irradiance += std::max(glm::dot(d, normal), 0.0) * (2 * pi / 64) *
                          (std::cos(pi * y / 32) - std::cos(pi * (y + 1) / 32)) / pi;
        }
    const Surface s = sheenOf(velvet(glm::dvec3(1), 0.3, 1.4));
    double integral = 0;
    const EnvironmentCosts costs = costsOf(sky, s, integral);
    const double taken = sheenAlbedo(0.3, std::cos(1.4)) * irradiance;
    EXPECT_GT(std::abs(taken - integral), 0.1 * integral);
    EXPECT_NEAR(costs.split[2], std::abs(taken - integral), 0.1 * integral + 0.03 * taken);
    for (const double cost : costs.split) EXPECT_GE(costs.sampled, cost) << "not sampled";
    EXPECT_EQ(costs.diffuse[0], 0);
    EXPECT_EQ(costs.wider, 0);
    EXPECT_EQ(costs.lobe, 0);
}

// ---- pictures and reading ----------------------------------------------------------------------------

// A floor with a sheen, with texture 0 of one pixel.
Scene carpet(const std::array<std::uint8_t, 4>& rgba) {
    Scene scene = floorScene();
    scene.images = {{"texel", 1, 1, {rgba[0], rgba[1], rgba[2], rgba[3]}}};
    scene.textures = {{0, {}}};
    scene.materials[0].sheen_color = {0.5f, 0.25f, 1};
    scene.materials[0].sheen_roughness = 0.5f;
    return scene;
}
Drawn carpetBelow(const Scene& scene) {
    return drawn(scene, viewFrom({2, 0, 2}, {0, 0, 0}, 1, 1, 0.01));
}
glm::dvec3 soleValue(const Image& image) {
    glm::dvec3 value(0);
    for (int c = 0; c < image.components; ++c) value[c] = double{image.at(0, 0, c)};
    return value;
}

TEST(ReferenceSheen, EmissionIsNotDimmed) {
    Scene scene = carpet({0, 0, 0, 0});
    scene.materials[0].emissive = {2, 1, 4};
    EXPECT_NEAR(soleValue(carpetBelow(scene)[Channel::lit]).b, 4, 1e-6);
}

TEST(ReferenceSheen, LitIsTheSumOfItsParts) {
    Scene scene = carpet({0, 0, 0, 0});
    scene.lights = {lightOf(LightKind::point, {2, 0, 2})};
    const Drawn d = carpetBelow(scene);
    EXPECT_GT(soleValue(d[Channel::lit_sheen]).b, 1e-3);
    EXPECT_EQ(soleValue(d[Channel::lit_sheen]), soleValue(d[Channel::lit_specular])) << "a Lambertian base";
    EXPECT_NEAR(soleValue(d[Channel::lit]).g,
                soleValue(d[Channel::lit_diffuse]).g + soleValue(d[Channel::lit_specular]).g, 1e-6);
}

TEST(ReferenceSheen, FactorsAndTextures) {
    Scene scene = carpet({188, 255, 51, 102});
    EXPECT_EQ(soleValue(carpetBelow(scene)[Channel::sheen_color]), glm::dvec3(0.5, 0.25, 1));
    EXPECT_EQ(soleValue(carpetBelow(scene)[Channel::sheen_roughness]).r, 0.5);
    scene.materials[0].sheen_color_texture.texture = 0;
    scene.materials[0].sheen_roughness_texture.texture = 0;
    const auto linear = [](double byte) { return std::pow((byte / 255 + 0.055) / 1.055, 2.4); };
    const Drawn d = carpetBelow(scene);
    const glm::dvec3 color = soleValue(d[Channel::sheen_color]);
    EXPECT_NEAR(color.r, 0.5 * linear(188), 1e-6) << "sRGB";
    EXPECT_NEAR(color.g, 0.25, 1e-6);
    EXPECT_NEAR(color.b, linear(51), 1e-6);
    EXPECT_NEAR(soleValue(d[Channel::sheen_roughness]).r, 0.5 * 0.4, 1e-7) << "alpha, linear";
}

TEST(ReferenceSheen, WithoutOneItsChannelsAreZero) {
    Scene texture = carpet({0, 0, 0, 255}), factor = texture, unlit = texture;
    texture.materials[0].sheen_color_texture.texture = 0;  // black
    factor.materials[0].sheen_color = {0, 0, 0};
    unlit.materials[0].unlit = true;
    for (const Scene& scene : {texture, factor, unlit}) {
        const Drawn d = carpetBelow(scene);
        EXPECT_EQ(soleValue(d[Channel::sheen_color]), glm::dvec3(0));
        EXPECT_EQ(soleValue(d[Channel::sheen_roughness]), glm::dvec3(0));
    }
}

TEST(ReferenceSheen, CapturedSheensAreShadedAgain) {
    Scene scene = carpet({0, 0, 0, 0});
    scene.lights = {lightOf(LightKind::point, {2.5, 0.2, 1})};
    const View view = viewFrom({2, 0, 0.6}, {0, 0, 0}, 2, 2, 0.05);
    const Drawn traced = drawn(scene, view);
    const auto shaded = [&](const std::map<Channel, Image>& surfaces) {
        return draw({.scene = scene,
                     .pose = traced.pose,
                     .view = view,
                     .lights = traced.pose.lights,
                     .mode = ReferenceMode::surface,
                     .surfaces = &surfaces});
    };
    const double expected = double{traced[Channel::lit_sheen].at(0, 0, 1)};
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(double{shaded(traced.picture.channels).channels.at(Channel::lit_sheen).at(0, 0, 1)}, expected,
                1e-4 * expected);
    // A capture of a scene without layers lacks their channels.
    std::map<Channel, Image> plain = traced.picture.channels;
    std::erase_if(plain, [](const auto& channel) { return layerOf(channel.first) != 0; });
    EXPECT_EQ(shaded(plain).channels.at(Channel::lit_sheen).at(0, 0, 1), 0);
}

}  // namespace
}  // namespace diptych::reference
