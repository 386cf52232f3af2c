// SPDX-License-Identifier: MIT
// The reference's anisotropic lobes (KHR_materials_anisotropy), compared with closed forms and sums.
#include "tests/support/layer_formulas.h"
#include "tests/support/reference_scene.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/lobe_sampler.h"
#include "compare/reference/scattering/quadrature.h"

#include <functional>

namespace diptych::reference {
namespace {

// F = 1, seen at `angle` from +Z in the plane y = 0; the lobe is stretched at `azimuth` from +X.
Surface stretchedMirror(double roughness, double strength, double angle, double azimuth) {
    Surface s = mirror(roughness, angle);
    s.stretch(strength, {std::cos(azimuth), std::sin(azimuth), 0});
    return s;
}

// KHR_materials_anisotropy: the widths along the direction and across it.
glm::dvec2 widthsBy(double roughness, double strength) {
    const double alpha = roughness * roughness;
    return {alpha * (1 - strength * strength) + strength * strength, alpha};
}

// The integral over directions with z > 0.
double overDirections(const std::function<double(const glm::dvec3&)>& f) {
    const auto integrand = [&](double u, double v) {
        return Reflected{glm::dvec3(0), glm::dvec3(f(polar(std::acos(u), 2 * pi * v)) * 2 * pi)};
    };
    const auto mustSplit = [](const Cell& cell) {
        return cell.u1 - cell.u0 > 0.04 ? Split::u : cell.v1 - cell.v0 > 0.04 ? Split::v : Split::none;
    };
    return Quadrature(integrand, mustSplit, 1e-7, nullptr)().value.specular.g;
}

TEST(ReferenceAnisotropy, TheLobeIsBurleysAndHeitzs) {
    for (const double roughness : {0.045, 0.3, 0.8})
        for (const double strength : {0.1, 0.6, 1.0})
            for (const double view : {0.0, 0.7, 1.5})
                for (const double light : {0.1, 0.7, 1.4})
                    for (const double turn : {0.2, 1.5, pi}) {
                        const Surface s = stretchedMirror(roughness, strength, view, 0);
                        const double expected =
                            stretchedLobe(widthsBy(roughness, strength), polar(light, turn), s.to_viewer);
                        EXPECT_NEAR(Brdf(s)(polar(light, turn)).specular.g, expected, 1e-9 * expected);
                    }
}

TEST(ReferenceAnisotropy, AQuarterTurnSwapsTheWidths) {
    const glm::dvec2 w = widthsBy(0.4, 0.7);
    const Surface s = stretchedMirror(0.4, 0.7, 0.6, pi / 2);
    for (const double turn : {0.0, 1.0, 2.5}) {
        const glm::dvec3 l = polar(0.5, turn);
        const double expected = stretchedLobe({w.y, w.x}, l, s.to_viewer);
        EXPECT_NEAR(Brdf(s)(l).specular.g, expected, 1e-9 * expected);
        EXPECT_GT(std::abs(expected / stretchedLobe(w, l, s.to_viewer) - 1), 0.05) << "another lobe";
    }
}

TEST(ReferenceAnisotropy, ADirectionHasNoSign) {
    const Surface s = stretchedMirror(0.3, 0.5, 0.8, 0.4), turned = stretchedMirror(0.3, 0.5, 0.8, 0.4 + pi);
    const glm::dvec3 l = polar(0.6, 2);
    EXPECT_NEAR(Brdf(s)(l).specular.g, Brdf(turned)(l).specular.g, 1e-12 * Brdf(s)(l).specular.g);
    EXPECT_NEAR(specularAlbedo(s).g, specularAlbedo(turned).g, 1e-6);
}

TEST(ReferenceAnisotropy, OnlyTheDirectionsPartInTheSurfaceCounts) {
    Surface s = mirror(0.3, 0.5);
    s.stretch(0.5, {3, 4, 7});
    EXPECT_LT(glm::length(s.anisotropy_direction - glm::dvec3(0.6, 0.8, 0)), 1e-15);
    EXPECT_EQ(s.anisotropy, 0.5);
    s.stretch(0.5, {0, 0, 2});
    EXPECT_EQ(s.anisotropy, 0) << "it vanishes";
    EXPECT_EQ(s.anisotropy_direction, glm::dvec3(0));
}

TEST(ReferenceAnisotropy, TheAlbedoIsTheBrdfsIntegral) {
    for (const double roughness : {0.3, 0.6})
        for (const double strength : {0.3, 1.0})
            for (const double angle : {0.9, 1.5})
                for (const double azimuth : {0.0, 0.5}) {
                    Surface s = stretchedMirror(roughness, strength, angle, azimuth);
                    s.metallic = 0.25;
                    s.albedo = glm::dvec3(0.9);
                    s.dielectric_f0 = glm::dvec3(0.04);
                    s.dielectric_f90 = 0.9;
                    const Brdf brdf(s);
                    EXPECT_NEAR(specularAlbedo(s).g,
                                overDirections([&](const glm::dvec3& l) { return brdf.lobe(l).g; }), 2e-5)
                        << roughness << " " << strength << " " << angle << " " << azimuth;
                }
}

// The estimator's mean is the albedo only if directions are distributed as their density says.
TEST(ReferenceAnisotropy, SamplesFollowTheirDensity) {
    for (const double roughness : {0.045, 0.4})
        for (const double angle : {0.0, 1.4}) {
            const Surface s = stretchedMirror(roughness, 0.6, angle, 0.7);
            const Brdf brdf(s);
            const LobeSampler lobe(brdf);
            constexpr int out = 1200, around = 200;  // weights grow towards the lobe's outside
            double sum = 0;
            for (int i = 0; i < out; ++i)
                for (int j = 0; j < around; ++j) {
                    const glm::dvec3 l = lobe({(i + 0.5) / out, (j + 0.5) / around});
                    const double density = lobe.density(l);
                    if (density > 0) sum += brdf.lobe(l).g / density;
                }
            EXPECT_NEAR(sum / (out * around), specularAlbedo(s).g, 5e-4) << roughness << " " << angle;
        }
}

TEST(ReferenceAnisotropy, NothingReflectsMoreThanThereIs) {
    for (const double roughness : {0.0, 0.1, 0.5})
        for (const double strength : {0.01, 0.5, 1.0})
            for (const double cosine : {-0.5, 1e-6, 0.02, 0.5, 1.0})
                for (const double azimuth : {0.0, 0.7, pi / 2}) {
                    const double white =
                        specularAlbedo(stretchedMirror(roughness, strength, std::acos(cosine), azimuth)).g;
                    EXPECT_LE(white, 1 + 2e-5);
                    EXPECT_GT(white, 0.1);
                }
}

// Steps are an eighth of the narrower width apart.
TEST(ReferenceAnisotropy, ARectangleAcrossTheLobe) {
    const double roughness = 0.2, strength = 0.5;
    for (const double azimuth : {0.0, 0.6}) {
        const Surface s = stretchedMirror(roughness, strength, 0.4, azimuth);
        Light light = lightOf(LightKind::rect, {-0.25, 0.125, 1});
        light.axis = {1, 0, 0};
        light.width = 2;
        light.height = 0.5;
        const auto turned = [&](const glm::dvec3& d) {
            const double c = std::cos(azimuth), sine = std::sin(azimuth);
            return glm::dvec3(c * d.x + sine * d.y, c * d.y - sine * d.x, d.z);
        };
        const double expected = simpson(800, 200, [&](double u, double v) {
            const glm::dvec3 position(-1.25 + 2 * u, -0.125 + 0.5 * v, 1);
            return stretchedLobe(widthsBy(roughness, strength), turned(glm::normalize(position)),
                                 turned(s.to_viewer)) /
                   std::pow(glm::dot(position, position), 1.5);
        });
        EXPECT_NEAR(reflectedBy(light, s), expected, 1e-5 * expected) << azimuth;
    }
}

TEST(ReferenceAnisotropy, ALongLightMayHideInTheNarrowWidth) {
    const Surface s = stretchedMirror(0.045, 1, 0, 0);
    Light light = lightOf(LightKind::rect, {0, 0, 1});
    light.axis = {1, 0, 0};
    light.width = 20;
    light.height = 20;
    // It fills almost all of the lobe.
    EXPECT_NEAR(reflectedBy(light, s) / specularAlbedo(s).g, 1, 0.02);
}

// ---- what the split sum costs ------------------------------------------------------------------------

// The isotropic lobe whose albedo the split sum takes.
Surface asSeen(const Surface& s) {
    return isotropic(s, widthTowards(widthsOf(s), s.to_viewer));
}

TEST(ReferenceAnisotropy, UnderAnEvenSkyTheSplitSumIsOffByTheAlbedo) {
    const Environment sky{"sky", Image(32, 16, 3, 3.0f)};
    const Surface s = stretchedMirror(0.3, 1, 0.5, 0.5);
    const double apart = 3 * std::abs(specularAlbedo(asSeen(s)).g - specularAlbedo(s).g);
    EXPECT_GT(apart, 0.3);
    EXPECT_NEAR(withCosts(sky, s).costs.split[0], apart, 0.15);
}

// The lobe is stretched in the plane of the viewer, so that the normal bends toward the viewer: the paths
// look up light on the viewer's own side.
TEST(ReferenceAnisotropy, TheSplitSumLooksAboutTheBentNormal) {
    Environment sky{"sky", Image(64, 32, 3, 0.0f)};
    const EnvironmentLight black(sky, 1);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            if (black.directionOf(x + 0.5, y + 0.5).x > 0)
                for (int c = 0; c < 3; ++c) sky.radiance.at(x, y, c) = 1;
    const Surface s = stretchedMirror(0.1, 0.5, 1, 0), across = stretchedMirror(0.1, 0.5, 1, pi / 2);
    const Shading shading = withCosts(sky, s);
    const double exact = shading.reflected.specular.g, split = shading.costs.split[0];
    EXPECT_LT(exact, 0.3);
    EXPECT_NEAR(split, specularAlbedo(asSeen(s)).g - exact, 0.05);
    EXPECT_LT(withCosts(sky, across).costs.split[0], 0.1) << "the plane's own normal";
}

// ---- reading -----------------------------------------------------------------------------------------

// A floor of an anisotropic material, with texture 0 of one pixel.
Scene brushedFloor(const std::vector<std::uint8_t>& rgb) {
    Scene scene = floorScene();
    scene.images = {{"texel", 1, 1, {rgb[0], rgb[1], rgb[2], 255}}};
    scene.textures = {{0, {}}};
    scene.materials[0].anisotropy = 0.5f;
    return scene;
}
Surface brushedAt(const Scene& scene, const glm::dvec3& eye = {0, 0, 3}) {
    const Drawn d = drawn(scene, viewFrom(eye, {0, 0, 0}, 1, 1, 0.01));
    const auto vector = [&](Channel channel) {
        return glm::dvec3(d[channel].at(0, 0, 0), d[channel].at(0, 0, 1), d[channel].at(0, 0, 2));
    };
    Surface s;
    s.anisotropy = double{d[Channel::anisotropy].at(0, 0, 0)};
    s.anisotropy_direction = vector(Channel::anisotropy_direction);
    s.normal = vector(Channel::normals);
    return s;
}
void expectAlong(const glm::dvec3& value, const glm::dvec3& expected) {
    EXPECT_NEAR(std::abs(glm::dot(value, glm::normalize(expected))), 1, 1e-6)
        << value.x << " " << value.y << " " << value.z;
}

TEST(ReferenceAnisotropy, WithoutATextureItFollowsTheTangent) {
    Scene scene = brushedFloor({0, 0, 0});
    expectAlong(brushedAt(scene).anisotropy_direction, {1, 0, 0});
    EXPECT_EQ(brushedAt(scene).anisotropy, 0.5);
    scene.materials[0].anisotropy_rotation = 0.5f;
    expectAlong(brushedAt(scene).anisotropy_direction, polar(pi / 2, 0.5));
    for (glm::vec4& t : scene.meshes[0].primitives[0].tangents) t.w = -1;
    expectAlong(brushedAt(scene).anisotropy_direction, polar(pi / 2, -0.5));
}

TEST(ReferenceAnisotropy, TheTextureHasDirectionAndStrength) {
    Scene scene = brushedFloor({204, 51, 102});
    scene.materials[0].anisotropy_texture.texture = 0;
    EXPECT_NEAR(brushedAt(scene).anisotropy, 0.5 * 0.4, 1e-7);
    expectAlong(brushedAt(scene).anisotropy_direction, {0.6, -0.6, 0});
    scene.materials[0].anisotropy_rotation = glm::radians(60.0f);
    expectAlong(brushedAt(scene).anisotropy_direction, polar(pi / 2, glm::radians(15.0)));
}

TEST(ReferenceAnisotropy, ItLiesInTheShadedSurface) {
    Scene scene = brushedFloor({204, 153, 230});
    scene.materials[0].normal_texture.texture = 0;
    const Surface s = brushedAt(scene);
    EXPECT_NEAR(glm::dot(s.normal, s.anisotropy_direction), 0, 1e-6);
    EXPECT_NEAR(glm::length(s.anisotropy_direction), 1, 1e-6);
    expectAlong(s.anisotropy_direction, glm::dvec3(1, 0, 0) - s.normal * s.normal.x);
}

TEST(ReferenceAnisotropy, ABackIsBrushedAsTheFront) {
    Scene scene = brushedFloor({0, 0, 0});
    scene.materials[0].double_sided = true;
    scene.materials[0].anisotropy_rotation = 0.5f;
    const Surface back = brushedAt(scene, {0, 0, -3});
    EXPECT_NEAR(back.normal.z, -1, 1e-6);
    expectAlong(back.anisotropy_direction, polar(pi / 2, 0.5));
}

TEST(ReferenceAnisotropy, WithoutADirectionThereIsNone) {
    Scene scene = brushedFloor({0, 0, 0});
    for (glm::vec4& t : scene.meshes[0].primitives[0].tangents) t = {0, 0, 1, 1};
    const Surface s = brushedAt(scene);
    EXPECT_EQ(s.anisotropy, 0);
    EXPECT_EQ(s.anisotropy_direction, glm::dvec3(0));
}

}  // namespace
}  // namespace diptych::reference
