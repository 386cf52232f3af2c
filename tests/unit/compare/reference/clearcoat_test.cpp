// SPDX-License-Identifier: MIT
// The reference's clear coats (KHR_materials_clearcoat), compared with closed forms.
#include "tests/support/reference_scene.h"

#include "compare/reference/ambient.h"
#include "compare/reference/brdf.h"
#include "shared/frame/debug_modes.h"

namespace diptych::reference {
namespace {

Surface coated(Surface s, double clearcoat, double roughness) {
    s.clearcoat = clearcoat;
    s.clearcoat_roughness = roughness;
    s.clearcoat_normal = s.normal;
    return s;
}

// The extension's text: Schlick's Fresnel of F0 = 0.04.
double coatsFresnel(double cosine) {
    return 0.04 + (1 - 0.04) * std::pow(1 - std::abs(cosine), 5);
}

// A glossy dielectric of a third of white, seen at `angle` from +Z.
Surface lacquer(double angle) {
    Surface s = mirror(0.5, angle);
    s.metallic = 0;
    s.albedo = glm::dvec3(1.0 / 3);
    s.dielectric_f0 = glm::dvec3(0.04);
    s.dielectric_f90 = 1;
    return s;
}

const Environment& whiteSky() {
    static const Environment sky{"sky", Image(8, 4, 3, 1.0f)};
    return sky;
}

// Every kind of light at once; the environment's costs and surroundings too.
Shading underEverything(const Surface& s, Multiscatter multiscatter = Multiscatter::off) {
    Light point = lightOf(LightKind::point, {0.5, 0, 2}), rect = lightOf(LightKind::rect, {-1, 0, 1});
    rect.width = rect.height = 1;
    const std::vector<Light> lights{point, rect};
    Lighting lighting({.lights = lights,
                       .environment = &whiteSky(),
                       .ambient = glm::dvec3(0.5),
                       .multiscatter = multiscatter});
    lighting.takeCosts();
    lighting.takeSurroundings();
    return lighting(
        s, [](const glm::dvec3& l, double) { return l.x > 0; }, 7);
}

TEST(ReferenceClearcoat, AFactorOfZeroIsTheBaseBitForBit) {
    const Surface plain = lacquer(0.7), none = coated(plain, 0, 0.3);
    const Shading a = underEverything(plain), b = underEverything(none);
    EXPECT_EQ(a.reflected.diffuse, b.reflected.diffuse);
    EXPECT_EQ(a.reflected.specular, b.reflected.specular);
    EXPECT_EQ(a.ambient, b.ambient);
    EXPECT_EQ(a.uncertainty, b.uncertainty);
    EXPECT_EQ(a.environment.specular, b.environment.specular);
    EXPECT_EQ(a.costs.split, b.costs.split);
    EXPECT_EQ(a.surroundings.hidden, b.surroundings.hidden);
    EXPECT_EQ(b.clearcoat, glm::dvec3(0));
    EXPECT_EQ(transmitted(plain), transmitted(none));
}

TEST(ReferenceClearcoat, ItsWeightIsSchlicks) {
    EXPECT_NEAR(coatWeight(coated(lacquer(0), 1, 0)), 0.04, 1e-15);
    EXPECT_NEAR(coatWeight(coated(lacquer(0), 0.25, 0)), 0.01, 1e-15);
    EXPECT_NEAR(coatWeight(coated(lacquer(1), 1, 0)), coatsFresnel(std::cos(1)), 1e-15);
    EXPECT_NEAR(coatWeight(coated(lacquer(pi / 2), 1, 0)), 1, 1e-12);
    EXPECT_NEAR(coatWeight(coated(lacquer(pi - 1), 1, 0)), coatsFresnel(std::cos(1)), 1e-15)
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
                const double w = clearcoat * coatsFresnel(std::cos(angle)),
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
    const Reflected factor = Lighting({}).reflectance(s, {0, 0, 1});
    EXPECT_NEAR(factor.diffuse.g, shading.reflected.diffuse.g, 1e-15);
    EXPECT_NEAR(factor.specular.g, shading.reflected.specular.g, 1e-12);
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
    const double cosine = std::sqrt(0.5), w = coatsFresnel(cosine);
    // D = 1 / (pi alpha^2); G2 / (4 n.v) at n.l = n.v.
    const double a2 = std::pow(0.1, 4), g1 = std::sqrt(cosine * cosine * (1 - a2) + a2);
    const double expected = w / (pi * a2) * 0.5 / (2 * cosine * g1) * cosine;
    const Shading shading = shadedBy(std::span(&sun, 1), s);
    EXPECT_NEAR(shading.reflected.specular.g, expected, 1e-6 * expected);
    EXPECT_EQ(shading.reflected.diffuse.g, 0);
}

TEST(ReferenceClearcoat, EveryPartIsWeightedAlike) {
    const Surface base = lacquer(0.9), s = coated(base, 0.8, 0.3);
    Surface coat = mirror(0.3, 0.9);
    const double w = coatWeight(s);
    const Shading all = underEverything(s), under = underEverything(base), over = underEverything(coat);
    const double noise = 3 * (under.uncertainty + over.uncertainty);
    EXPECT_NEAR(all.ambient.g, (1 - w) * under.ambient.g + w * over.ambient.g, 1e-12);
    EXPECT_NEAR(all.reflected.diffuse.g, (1 - w) * under.reflected.diffuse.g, 1e-12);
    EXPECT_NEAR(all.reflected.specular.g,
                (1 - w) * under.reflected.specular.g + w * over.reflected.specular.g, noise);
    EXPECT_NEAR(all.environment.specular.g,
                (1 - w) * under.environment.specular.g + w * over.environment.specular.g, noise);
    EXPECT_NEAR(all.clearcoat.g, w * (over.reflected.specular.g + over.ambient.g), noise);
    EXPECT_NEAR(all.costs.diffuse[0], (1 - w) * under.costs.diffuse[0], 1e-12);
    EXPECT_NEAR(all.costs.lobe, (1 - w) * under.costs.lobe + w * over.costs.lobe, noise);
    EXPECT_GT(all.uncertainty, (1 - w) * under.uncertainty);
    EXPECT_NEAR(all.surroundings.all, (1 - w) * under.surroundings.all + w * over.surroundings.all,
                0.1 * all.surroundings.all);
}

TEST(ReferenceClearcoat, AnEvenSkyIsAmbientLight) {
    const Surface s = coated(lacquer(1.2), 1, 0.2);
    const Shading sky = Lighting({.environment = &whiteSky()})(s, {}, 3),
                  ambient = Lighting({.ambient = glm::dvec3(1)})(s, {}, 3);
    EXPECT_NEAR(sky.all().g, ambient.all().g, 0.02 * ambient.all().g);
    EXPECT_NEAR(sky.clearcoat.g, ambient.clearcoat.g, 0.02 * ambient.clearcoat.g);
}

TEST(ReferenceClearcoat, OcclusionDimsItsAmbientLight) {
    Surface s = coated(lacquer(0.5), 1, 0.2);
    const Lighting lighting({.ambient = glm::dvec3(1)});
    const double open = lighting(s, {}, 1).clearcoat.g;
    s.occlusion = 0.25;
    EXPECT_NEAR(lighting(s, {}, 1).clearcoat.g, open / 4, 1e-12);
}

// A lightmap lights the base only.
TEST(ReferenceClearcoat, ALightmapIsUnderIt) {
    Surface s = coated(lambertian(), 1, 0.2);
    s.lightmap = glm::dvec3(3);
    s.lightmapped = true;
    const Shading shading = Lighting({})(s, {}, 1);
    EXPECT_NEAR(shading.ambient.g, 3 * 0.96, 1e-9);
    EXPECT_EQ(shading.clearcoat.g, 0);
}

TEST(ReferenceClearcoat, OnlyTheBaseIsCompensated) {
    Surface s = mirror(0.8, 0.5);
    const double w = 0.5 * coatsFresnel(std::cos(0.5)), rough = specularAlbedo(mirror(0.9, 0.5)).g;
    const Lighting lighting({.ambient = glm::dvec3(1), .multiscatter = Multiscatter::energy});
    EXPECT_NEAR(lighting(coated(s, 0.5, 0.9), {}, 1).ambient.g, 1 - w + w * rough, 1e-6);
}

TEST(ReferenceClearcoat, ThinTransmissionPassesThroughIt) {
    Surface s = lacquer(0.6);
    s.transmission = 0.5;
    const double w = coatsFresnel(std::cos(0.6));
    EXPECT_NEAR(transmitted(coated(s, 1, 0)).g, (1 - w) * transmitted(s).g, 1e-15);
}

TEST(ReferenceClearcoat, GrazingAnglesAreFinite) {
    for (const double angle : {glm::radians(89.99), glm::radians(90.01)}) {
        const Shading shading = underEverything(coated(lacquer(angle), 1, 0));
        EXPECT_TRUE(std::isfinite(shading.all().g));
        EXPECT_TRUE(std::isfinite(shading.clearcoat.g));
    }
}

// ---- pictures and reading ----------------------------------------------------------------------------

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
glm::dvec3 onlyPixel(const Image& image) {
    glm::dvec3 value(0);
    for (int c = 0; c < image.components; ++c) value[c] = double{image.at(0, 0, c)};
    return value;
}

TEST(ReferenceClearcoat, EmissionIsUnderIt) {
    Scene scene = lacquered({0, 0, 0});
    scene.materials[0].emissive = {2, 1, 4};
    const Drawn d = lacquerBelow(scene);
    EXPECT_NEAR(onlyPixel(d[Channel::lit]).b, 4 * (1 - 0.5 * 0.04), 1e-6);
    EXPECT_EQ(onlyPixel(d[Channel::emission]).b, 4) << "the material's";
}

TEST(ReferenceClearcoat, LitIsTheSumOfItsParts) {
    Scene scene = lacquered({0, 0, 0});
    scene.materials[0].emissive = {0.5f, 0.5f, 0.5f};
    scene.lights = {lightOf(LightKind::point, {0, 0, 2})};
    const Drawn d = lacquerBelow(scene);
    EXPECT_GT(onlyPixel(d[Channel::lit_clearcoat]).g, 0.1);
    EXPECT_EQ(onlyPixel(d[Channel::lit_clearcoat]), onlyPixel(d[Channel::lit_specular]))
        << "a Lambertian base";
    EXPECT_NEAR(onlyPixel(d[Channel::lit]).g,
                onlyPixel(d[Channel::lit_diffuse]).g + onlyPixel(d[Channel::lit_specular]).g + 0.5 * 0.98,
                1e-6);
}

TEST(ReferenceClearcoat, FactorsAndTextures) {
    Scene scene = lacquered({51, 102, 204});
    EXPECT_EQ(onlyPixel(lacquerBelow(scene)[Channel::clearcoat]).r, 0.5);
    EXPECT_EQ(onlyPixel(lacquerBelow(scene)[Channel::clearcoat_roughness]).r, 0.25);
    scene.materials[0].clearcoat_texture.texture = 0;
    scene.materials[0].clearcoat_roughness_texture.texture = 0;
    const Drawn d = lacquerBelow(scene);
    EXPECT_NEAR(onlyPixel(d[Channel::clearcoat]).r, 0.5 * 0.2, 1e-7) << "red";
    EXPECT_NEAR(onlyPixel(d[Channel::clearcoat_roughness]).r, 0.25 * 0.4, 1e-7) << "green";
}

TEST(ReferenceClearcoat, TheBasesNormalMapIsNotTheCoats) {
    Scene scene = lacquered({204, 153, 230});
    scene.materials[0].normal_texture.texture = 0;
    const Drawn base = lacquerBelow(scene);
    EXPECT_LT(onlyPixel(base[Channel::normals]).z, 0.9);
    EXPECT_EQ(onlyPixel(base[Channel::clearcoat_normal]), glm::dvec3(0, 0, 1));
    scene.materials[0].normal_texture.texture = -1;
    scene.materials[0].clearcoat_normal_texture.texture = 0;
    for (const float scale : {1.0f, 0.5f, 0.0f}) {
        scene.materials[0].clearcoat_normal_scale = scale;
        const Drawn coat = lacquerBelow(scene);
        const glm::dvec3 expected = glm::normalize(
            glm::dvec3((2 * 204 / 255.0 - 1) * scale, (2 * 153 / 255.0 - 1) * scale, 2 * 230 / 255.0 - 1));
        EXPECT_EQ(onlyPixel(coat[Channel::normals]), glm::dvec3(0, 0, 1));
        EXPECT_LT(glm::length(onlyPixel(coat[Channel::clearcoat_normal]) - expected), 1e-6) << scale;
    }
}

TEST(ReferenceClearcoat, ItFacesTheViewerOnABack) {
    Scene scene = lacquered({0, 0, 0});
    scene.materials[0].double_sided = true;
    EXPECT_NEAR(onlyPixel(lacquerBelow(scene, {0, 0, -3})[Channel::clearcoat_normal]).z, -1, 1e-6);
}

TEST(ReferenceClearcoat, WithoutOneItsChannelsAreZero) {
    Scene texture = lacquered({0, 0, 0}), factor = texture, unlit = texture;
    texture.materials[0].clearcoat_texture.texture = 0;  // black
    factor.materials[0].clearcoat = 0;
    unlit.materials[0].unlit = true;
    for (const Scene& scene : {texture, factor, unlit}) {
        const Drawn d = lacquerBelow(scene);
        for (const Channel mode :
             {Channel::clearcoat, Channel::clearcoat_roughness, Channel::clearcoat_normal})
            EXPECT_EQ(onlyPixel(d[mode]), glm::dvec3(0));
    }
}

// ---- mode surface ------------------------------------------------------------------------------------

TEST(ReferenceClearcoat, CapturedLayersAreShadedAgain) {
    Scene scene = lacquered({0, 0, 0});
    scene.materials[0].specular = 1;
    scene.materials[0].roughness = 0.4f;
    scene.materials[0].anisotropy = 0.6f;
    scene.lights = {lightOf(LightKind::point, {0.5, 0.2, 2})};
    const View view = viewFrom({1, 0, 3}, {0, 0, 0}, 2, 2, 0.05);
    const Drawn traced = drawn(scene, view);
    const auto shaded = [&](const std::map<Channel, Image>& surfaces) {
        return draw({.scene = scene,
                     .pose = traced.pose,
                     .view = view,
                     .lights = traced.pose.lights,
                     .mode = ReferenceMode::surface,
                     .surfaces = &surfaces});
    };
    const Picture again = shaded(traced.picture.channels);
    const double expected = double{traced[Channel::lit].at(0, 0, 1)};
    EXPECT_NEAR(double{again.channels.at(Channel::lit).at(0, 0, 1)}, expected, 1e-4 * expected);
    // A capture of a scene without layers lacks their channels.
    std::map<Channel, Image> plain = traced.picture.channels;
    std::erase_if(plain, [](const auto& channel) { return layerOf(channel.first) != 0; });
    const Picture without = shaded(plain);
    EXPECT_GT(std::abs(double{without.channels.at(Channel::lit).at(0, 0, 1)} - expected), 0.01 * expected);
    EXPECT_EQ(without.channels.at(Channel::clearcoat).at(0, 0), 0);
}

TEST(ReferenceClearcoat, SurfacesNeedTheChannelsOfTheirLayers) {
    const std::vector<Channel> none = surfaceChannels(0), all = surfaceChannels(~0u);
    const auto has = [](const std::vector<Channel>& modes, Channel mode) {
        return std::ranges::count(modes, mode) == 1;
    };
    for (const Channel mode : {Channel::clearcoat, Channel::clearcoat_roughness, Channel::clearcoat_normal,
                               Channel::anisotropy, Channel::anisotropy_direction}) {
        EXPECT_FALSE(has(none, mode));
        EXPECT_TRUE(has(all, mode));
    }
    EXPECT_TRUE(has(none, Channel::normals));
    EXPECT_FALSE(has(all, Channel::lit_clearcoat)) << "shaded, not captured";
}

}  // namespace
}  // namespace diptych::reference
