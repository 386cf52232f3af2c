// SPDX-License-Identifier: MIT
// The reference's clear coats (KHR_materials_clearcoat), compared with closed forms.
#include "tests/support/layer_formulas.h"
#include "tests/support/reference_scene.h"

#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"

namespace diptych::reference {
namespace {

Surface coated(Surface s, double clearcoat, double roughness) {
    s.clearcoat = clearcoat;
    s.clearcoat_roughness = roughness;
    s.clearcoat_normal = s.normal;
    return s;
}

TEST(ReferenceClearcoat, ItsWeightIsSchlicks) {
    EXPECT_NEAR(coatWeight(coated(lacquer(0), 1, 0)), 0.04, 1e-15);
    EXPECT_NEAR(coatWeight(coated(lacquer(0), 0.25, 0)), 0.01, 1e-15);
    EXPECT_NEAR(coatWeight(coated(lacquer(1), 1, 0)), schlick(std::cos(1)), 1e-15);
    EXPECT_NEAR(coatWeight(coated(lacquer(pi / 2), 1, 0)), 1, 1e-12);
    EXPECT_NEAR(coatWeight(coated(lacquer(pi - 1), 1, 0)), schlick(std::cos(1)), 1e-15)
        << "a normal that faces away";
    EXPECT_EQ(coatWeight(lacquer(1)), 0);
}

// White under a white coat: the coat reflects w E, E its albedo, and the base the rest.
TEST(ReferenceClearcoat, TheWhiteFurnace) {
    for (const double angle : {0.0, 0.8, 1.3, 1.55})
        for (const double roughness : {0.0, 0.3, 1.0})
            for (const double clearcoat : {0.5, 1.0}) {
                Surface s = lambertian();
                s.to_viewer = {std::sin(angle), 0, std::cos(angle)};
                const double w = clearcoat * schlick(std::cos(angle)),
                             albedo = specularAlbedo(mirror(roughness, angle)).g;
                const Shading shading =
                    Lighting({.ambient = glm::dvec3(1)})(coated(s, clearcoat, roughness), {}, 1);
                EXPECT_NEAR(shading.ambient.g, 1 - w + w * albedo, 1e-9) << angle << " " << roughness;
                EXPECT_LE(shading.ambient.g, 1 + 1e-5);
                EXPECT_NEAR(shading.clearcoat.g, w * albedo, 1e-12);
            }
}

// At normal incidence under a light in the direction of the viewer: D = 1 / (pi alpha^2), V = 1 / 4.
TEST(ReferenceClearcoat, TheHighlightOfASun) {
    const Light sun = lightOf(LightKind::directional, {0, 0, 0});
    const Surface base = lambertian(), s = coated(base, 0.5, 0.4);
    const double w = 0.5 * 0.04, highlight = 1 / (4 * pi * std::pow(0.4, 4));
    const Shading shading = shadedBy(std::span(&sun, 1), s);
    EXPECT_NEAR(shading.reflected.diffuse.g, (1 - w) / pi, 1e-12);
    EXPECT_NEAR(shading.reflected.specular.g, w * highlight, 1e-9);
    EXPECT_NEAR(shading.clearcoat.g, w * highlight, 1e-9);
}

TEST(ReferenceClearcoat, ItIsAsRoughAsTheModelsSmoothest) {
    const Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0.02, 0, -1});
    const auto seen = [&](double roughness) {
        return shadedBy(std::span(&sun, 1), coated(lambertian(), 1, roughness)).clearcoat.g;
    };
    EXPECT_EQ(seen(0), seen(0.045));
    EXPECT_NE(seen(0.05), seen(0.045));
}

TEST(ReferenceClearcoat, ItHasANormalOfItsOwn) {
    // Light from the side is mirrored to the viewer by the coat's normal only.
    const Light sun = lightOf(LightKind::directional, {0, 0, 0}, {-1, 0, 0});
    Surface s = coated(lambertian(), 1, 0.1);
    EXPECT_EQ(shadedBy(std::span(&sun, 1), s).reflected.specular.g, 0) << "on the horizon";
    s.clearcoat_normal = glm::normalize(glm::dvec3(1, 0, 1));
    const double cosine = std::sqrt(0.5), w = schlick(cosine);
    // D = 1 / (pi alpha^2); G2 / (4 n.v) at n.l = n.v.
    const double a2 = std::pow(0.1, 4), g1 = std::sqrt(cosine * cosine * (1 - a2) + a2);
    const double expected = w / (pi * a2) * 0.5 / (2 * cosine * g1) * cosine;
    const Shading shading = shadedBy(std::span(&sun, 1), s);
    EXPECT_NEAR(shading.reflected.specular.g, expected, 1e-6 * expected);
    EXPECT_EQ(shading.reflected.diffuse.g, 0);
}

// ---- images and reading ----------------------------------------------------------------------------

// A floor with a coat, with texture 0 of one pixel.
Scene lacquered(const std::vector<std::uint8_t>& rgb) {
    Scene scene = floorScene();
    scene.images = {{"texel", 1, 1, {rgb[0], rgb[1], rgb[2], 255}}};
    scene.textures = {{0, {}}};
    scene.materials[0].clearcoat = 0.5f;
    scene.materials[0].clearcoat_roughness = 0.25f;
    return scene;
}
Drawn lacquerBelow(const Scene& scene, const glm::dvec3& eye = {0, 0, 3}) {
    return drawn(scene, viewFrom(eye, {0, 0, 0}, 1, 1, 0.01));
}

TEST(ReferenceClearcoat, EmissionIsUnderIt) {
    Scene scene = lacquered({0, 0, 0});
    scene.materials[0].emissive = {2, 1, 4};
    const Drawn d = lacquerBelow(scene);
    EXPECT_NEAR(pixelOf(d[Channel::lit]).b, 4 * (1 - 0.5 * 0.04), 1e-6);
    EXPECT_EQ(pixelOf(d[Channel::emission]).b, 4) << "the material's";
}

TEST(ReferenceClearcoat, TheBasesNormalMapIsNotTheCoats) {
    Scene scene = lacquered({204, 153, 230});
    scene.materials[0].normal_texture.texture = 0;
    const Drawn base = lacquerBelow(scene);
    EXPECT_LT(pixelOf(base[Channel::normals]).z, 0.9);
    EXPECT_EQ(pixelOf(base[Channel::clearcoat_normal]), glm::dvec3(0, 0, 1));
    scene.materials[0].normal_texture.texture = -1;
    scene.materials[0].clearcoat_normal_texture.texture = 0;
    for (const float scale : {1.0f, 0.5f, 0.0f}) {
        scene.materials[0].clearcoat_normal_scale = scale;
        const Drawn coat = lacquerBelow(scene);
        const glm::dvec3 expected = glm::normalize(
            glm::dvec3((2 * 204 / 255.0 - 1) * scale, (2 * 153 / 255.0 - 1) * scale, 2 * 230 / 255.0 - 1));
        EXPECT_EQ(pixelOf(coat[Channel::normals]), glm::dvec3(0, 0, 1));
        EXPECT_LT(glm::length(pixelOf(coat[Channel::clearcoat_normal]) - expected), 1e-6) << scale;
    }
}

TEST(ReferenceClearcoat, ItFacesTheViewerOnABack) {
    Scene scene = lacquered({0, 0, 0});
    scene.materials[0].double_sided = true;
    EXPECT_NEAR(pixelOf(lacquerBelow(scene, {0, 0, -3})[Channel::clearcoat_normal]).z, -1, 1e-6);
}

}  // namespace
}  // namespace diptych::reference
