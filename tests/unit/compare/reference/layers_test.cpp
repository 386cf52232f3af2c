// SPDX-License-Identifier: MIT
// The reference reads, shades and limits every layer of layer_table.h.
#include "compare/reference/scattering/ambient.h"
#include "compare/reference/scattering/brdf.h"
#include "compare/reference/scattering/lobe_sampler.h"
#include "compare/reference/scattering/sheen.h"
#include "tests/support/layer_table.h"
#include "tests/support/reference_scene.h"

namespace diptych::reference {
namespace {

class ReferenceLayer : public testing::TestWithParam<TestedLayer> {
protected:
    // ---- surfaces ------------------------------------------------------------------------------------

    // A glossy surface with the layer, seen at `angle` from +Z. `roughness`: the layer's.
    static Surface layered(double angle, double weight = 1, double roughness = 0.3) {
        Surface s = lacquer(angle);
        switch (GetParam().bit) {
            case gpu::LAYER_CLEARCOAT:
                s.clearcoat = 0.8 * weight;
                s.clearcoat_roughness = roughness;
                s.clearcoat_normal = s.normal;
                break;
            case gpu::LAYER_ANISOTROPY:
                if (weight > 0) s.roughness = roughness;
                s.stretch(weight, {1, 0.5, 0});
                break;
            case gpu::LAYER_SHEEN:
                s.sheen_color = weight * glm::dvec3(0.3, 0.4, 0.2);
                s.sheen_roughness = roughness;
                break;
            case gpu::LAYER_IRIDESCENCE:
                s.iridescence = weight;
                s.iridescence_ior = 1.4;
                s.iridescence_thickness = 380;
                break;
            case gpu::LAYER_TRANSMISSION:
                s.transmission = 0.5 * weight;
                s.thickness = 0.5;
                s.attenuation_color = {0.5, 1, 0};
                s.attenuation_distance = s.dispersion = 1;
                break;
            case gpu::LAYER_DIFFUSE_TRANSMISSION:
                s.diffuse_transmission = 0.6 * weight;
                s.diffuse_transmission_color = {0.5, 0.25, 1};
                break;
            default:
                ADD_FAILURE() << "no surface of this layer";
        }
        return s;
    }
    // The lobe that the layer adds or changes.
    static Surface lobeOf(const Surface& s) {
        return s.clearcoat > 0 ? coatOf(s) : hasSheen(s) ? sheenOf(s) : s;
    }
    // Fraction of its light that the surface keeps under a coat or a sheen.
    static double keptUnder(const Surface& s) { return (1 - coatWeight(s)) * sheenAlbedoScaling(s); }
    // The layer's own part of the light; 0 for layers without one.
    static glm::dvec3 partOf(const Shading& shading) {
        switch (GetParam().bit) {
            case gpu::LAYER_CLEARCOAT:
                return shading.clearcoat;
            case gpu::LAYER_SHEEN:
                return shading.sheen;
            case gpu::LAYER_DIFFUSE_TRANSMISSION:
                return shading.from_behind;
            case gpu::LAYER_ANISOTROPY:
            case gpu::LAYER_IRIDESCENCE:
            case gpu::LAYER_TRANSMISSION:
                return glm::dvec3(0);
            default:
                ADD_FAILURE() << "is its own part known?";
                return glm::dvec3(0);
        }
    }

    // ---- images ------------------------------------------------------------------------------------

    static constexpr glm::dvec4 texel{0.2, 0.4, 0.8, 0.6};
    // A floor of the material, with texture 0 of one texel, above a white one.
    static Scene floorOf(const Material& material,
                         const std::vector<std::uint8_t>& rgba = {51, 102, 204, 153}) {
        Scene scene = floorScene();
        scene.materials = {material, matte()};
        add(scene, quad({-10, -10, -2}, {20, 0, 0}, {0, 20, 0}, 1));
        scene.images = {{"texel", 1, 1, rgba}};
        scene.textures = {{0, {}}};
        return scene;
    }
    static View above() { return viewFrom({1, 0, 3}, {0, 0, 0}, 1, 1, 0.01); }
    // Glossy, half a metal.
    static Material base() {
        Material m = matte();
        m.specular = 1;
        m.metallic = 0.5f;
        m.roughness = 0.4f;
        m.base_color = {0.5f, 0.25f, 0.75f, 1};
        return m;
    }
    // The layer with all its textures.
    static Material textured(Material m) {
        m = GetParam().typical(m);
        for (const LayerTexture& t : GetParam().textures) t.of(m).texture = 0;
        return m;
    }
};

// Layers that paths draw as opaque surfaces.
class OpaqueReferenceLayer : public ReferenceLayer {};
// Coats and sheens.
class ReferenceLayerAbove : public ReferenceLayer {};

// ---- reading -----------------------------------------------------------------------------------------

TEST_P(ReferenceLayer, FactorsAndTextures) {
    const TestedLayer& layer = GetParam();
    const Drawn factors = drawn(floorOf(layer.typical(matte())), above()),
                textures = drawn(floorOf(textured(matte())), above());
    for (const LayerFactor& f : layer.factors)
        if (f.channel) expectColor(pixelOf(factors[*f.channel]), f.typical, 0);
    for (const LayerTexture& t : layer.textures) {
        if (t.components.empty()) continue;
        SCOPED_TRACE(t.key);
        const glm::dvec3 plain = layer.shown(t, layer.typical(), glm::dvec4(1));
        expectColor(pixelOf(factors[t.channel]), plain, 1e-6 * plain.x);
        expectColor(pixelOf(textures[t.channel]), layer.shown(t, layer.typical(), texel), 1e-6 * plain.x);
    }
}

TEST_P(ReferenceLayer, WithoutItItsChannelsAreZero) {
    const Material typical = GetParam().typical(base());
    Material unlit = typical, dark = typical;
    unlit.unlit = true;
    GetParam().textures[0].of(dark).texture = 0;
    for (const Scene& scene :
         {floorOf(GetParam().off(base(), 0)), floorOf(unlit), floorOf(dark, {0, 0, 0, 0})}) {
        const Drawn d = drawn(scene, above());
        for (const Channel mode : GetParam().channels())
            EXPECT_EQ(pixelOf(d[mode]), glm::dvec3(0)) << debugMode(mode).name;
    }
}

// Whatever its other factors and textures say.
TEST_P(ReferenceLayer, AFactorOfZeroIsTheBaseToTheBit) {
    const auto lit = [&](const Material& m) {
        Scene scene = floorOf(m);
        scene.materials[0].emissive = {0.1f, 0.2f, 0.3f};
        scene.lights = {lightOf(LightKind::point, {0.3, 0, 1}), lightOf(LightKind::rect, {0.5, 0.5, 2})};
        scene.environment = whiteSky();
        return drawn(scene, above());
    };
    static const Drawn without = lit(base());
    const Drawn with = lit(GetParam().off(base(), 0));
    for (const auto& [mode, image] : without.image.channels)
        EXPECT_EQ(with[mode].data, image.data) << debugMode(mode).name;

    static const Shading a = underAllLights(lacquer(0.7));
    const Shading b = underAllLights(layered(0.7, 0));
    EXPECT_EQ(a.reflected.diffuse, b.reflected.diffuse);
    EXPECT_EQ(a.reflected.specular, b.reflected.specular);
    EXPECT_EQ(a.ambient, b.ambient);
    EXPECT_EQ(a.uncertainty, b.uncertainty);
    EXPECT_EQ(a.environment.specular, b.environment.specular);
    EXPECT_EQ(a.costs.split, b.costs.split);
    EXPECT_EQ(a.surroundings.hidden, b.surroundings.hidden);
    EXPECT_EQ(partOf(b), glm::dvec3(0));
    EXPECT_EQ(keptUnder(layered(0.7, 0)), 1);
    EXPECT_EQ(transmitted(lacquer(0.7)), transmitted(layered(0.7, 0)));
}

TEST_P(OpaqueReferenceLayer, ATexelOfZeroIsTheBaseToTheBit) {
    const auto lit = [&](const Material& m) {
        Scene scene = floorOf(m, {0, 0, 0, 0});
        scene.lights = {lightOf(LightKind::point, {0.3, 0, 1})};
        return drawn(scene, above());
    };
    EXPECT_EQ(lit(textured(base()))[Channel::lit].data, lit(base())[Channel::lit].data);
}

// ---- mode surface ------------------------------------------------------------------------------------

TEST_P(OpaqueReferenceLayer, CapturedSurfacesAreShadedAgain) {
    Scene scene = floorOf(GetParam().typical(base()));
    scene.lights = {lightOf(LightKind::point, {0.5, 0.2, 2})};
    const Drawn traced = drawn(scene, above());
    const ReferenceImage again = shadedAgain(scene, above(), traced, traced.image.channels);
    for (const Channel mode : {Channel::lit, Channel::lit_clearcoat, Channel::lit_sheen}) {
        const glm::dvec3 expected = pixelOf(traced[mode]);
        expectColor(pixelOf(again.channels.at(mode)), expected, 1e-4 * expected.g);
    }
    // A capture of a scene without layers lacks their channels.
    std::map<Channel, Image> plain = traced.image.channels;
    std::erase_if(plain, [](const auto& channel) { return layerOf(channel.first) != 0; });
    const ReferenceImage without = shadedAgain(scene, above(), traced, plain);
    const glm::dvec3 lit = pixelOf(traced[Channel::lit]);
    EXPECT_GT(glm::length(pixelOf(without.channels.at(Channel::lit)) - lit), 1e-3 * lit.g);
    for (const Channel mode : GetParam().channels())
        EXPECT_EQ(pixelOf(without.channels.at(mode)), glm::dvec3(0)) << debugMode(mode).name;
}

TEST_P(OpaqueReferenceLayer, SurfacesNeedItsChannels) {
    const std::vector<Channel> needed = surfaceChannels(GetParam().bit),
                               others = surfaceChannels(~GetParam().bit);
    for (const Channel mode : GetParam().channels()) {
        EXPECT_EQ(std::ranges::count(needed, mode), 1) << debugMode(mode).name;
        EXPECT_EQ(std::ranges::count(others, mode), 0) << debugMode(mode).name;
    }
    EXPECT_EQ(std::ranges::count(needed, Channel::normals), 1);
    for (const Channel mode : needed) EXPECT_FALSE(isLit(mode)) << "shaded, not captured";
}

// ---- light -------------------------------------------------------------------------------------------

TEST_P(ReferenceLayer, LightAndViewerMayChangePlaces) {
    for (const double roughness : {0.1, 0.5})
        for (const double turn : {0.3, 2.5}) {
            Surface there = lobeOf(layered(0.4, 1, roughness)), back = there;
            back.to_viewer = polar(1.1, turn);
            const glm::dvec3 value = Brdf(there)(back.to_viewer).sum() / std::cos(1.1);
            EXPECT_GT(value.g, 0);
            expectColor(Brdf(back)(there.to_viewer).sum() / std::cos(0.4), value, 1e-9 * value.g);
        }
}

TEST_P(ReferenceLayer, ReflectanceIsThatOfASunAlsoUnderACoat) {
    const Light sun = lightOf(LightKind::directional, {0, 0, 0}, {0.6, 0, -0.8});
    Surface s = layered(0.5);
    for (const double coat : {s.clearcoat, 0.75}) {
        s.clearcoat = coat;
        s.clearcoat_normal = s.normal;
        const Shading shading = shadedBy(std::span(&sun, 1), s);
        const Reflected factor = Lighting({}).reflectance(s, {-0.6, 0, 0.8});
        expectColor(factor.diffuse, shading.reflected.diffuse, 1e-9);
        expectColor(factor.specular, shading.reflected.specular, 1e-9);
    }
}

TEST_P(ReferenceLayer, AnEvenSkyIsAmbientLight) {
    for (const double angle : {0.3, 1.2}) {
        const Surface s = layered(angle);
        const Shading sky = Lighting({.environment = &whiteSky()})(s, {}, 3), ambient = underAmbient(s);
        // A coat and a sheen are sampled apart from what lies under them.
        const double all = ambient.all().g, own = keptUnder(s) < 1 ? partOf(ambient).g : all;
        EXPECT_NEAR(sky.all().g, all, 2 * samplingError * all) << angle;
        EXPECT_NEAR(partOf(sky).g, partOf(ambient).g, 2 * samplingError * own) << angle;
    }
}

TEST_P(ReferenceLayer, OcclusionDimsItsAmbientLightAndLightmapsAreUnderIt) {
    Surface s = layered(0.5);
    const double open = partOf(underAmbient(s)).g;
    s.occlusion = 0.25;
    EXPECT_NEAR(partOf(underAmbient(s)).g, open / 4, 1e-5 * open);
    s.occlusion = 1;
    s.lightmap = glm::dvec3(3);
    s.lightmapped = true;
    const Shading lit = Lighting({})(s, {}, 1);
    EXPECT_EQ(partOf(lit), glm::dvec3(0));
    EXPECT_NEAR(lit.ambient.g, 3 * keptUnder(s) * diffuseAlbedo(underSheen(s)).g, 1e-9);
}

TEST_P(ReferenceLayer, GrazingAnglesAreFinite) {
    const double grazing = glm::radians(89.99);
    for (const auto& [angle, roughness] : {std::pair(grazing, 1.0), {pi - grazing, 0.0}}) {
        const Surface s = layered(angle, 1, roughness), own = lobeOf(s);
        const Shading shading = underAllLights(s);
        EXPECT_TRUE(std::isfinite(shading.all().g));
        EXPECT_TRUE(std::isfinite(partOf(shading).g));
        EXPECT_GE(keptUnder(s), 0);
        EXPECT_GE(transmitted(s).g, 0);
        const LobeSampler lobe{Brdf(own)};
        for (const double turn : {0.0, 0.7, 2.0, pi}) {
            const glm::dvec3 l = polar(grazing, turn);
            EXPECT_TRUE(std::isfinite(Brdf(own)(l).size()));
            EXPECT_TRUE(std::isfinite(lobe.density(l)));
            EXPECT_NEAR(glm::length(lobe({0.999999, turn / 7})), 1, 1e-12);
        }
    }
}

TEST_P(ReferenceLayerAbove, UnderItEveryPartKeepsTheSameFraction) {
    const Surface s = layered(0.9, 1, 0.6), base = lacquer(0.9);
    const double weight = s.clearcoat > 0 ? coatWeight(s) : 1, kept = keptUnder(s);
    EXPECT_LT(kept, 0.97);
    const Shading all = underAllLights(s), under = underAllLights(base), over = underAllLights(lobeOf(s));
    const double noise = 3 * (under.uncertainty + over.uncertainty);
    const auto mixed = [&](double below, double above) { return kept * below + weight * above; };
    EXPECT_NEAR(all.ambient.g, mixed(under.ambient.g, over.ambient.g), 1e-9);
    EXPECT_NEAR(all.reflected.diffuse.g, kept * under.reflected.diffuse.g, 1e-9);
    EXPECT_NEAR(all.reflected.specular.g, mixed(under.reflected.specular.g, over.reflected.specular.g),
                noise);
    EXPECT_NEAR(all.environment.specular.g, mixed(under.environment.specular.g, over.environment.specular.g),
                noise);
    EXPECT_NEAR(partOf(all).g, weight * (over.reflected.specular.g + over.ambient.g), noise);
    EXPECT_NEAR(all.costs.diffuse[0], kept * under.costs.diffuse[0], 1e-9);
    EXPECT_NEAR(all.costs.lobe, mixed(under.costs.lobe, over.costs.lobe), noise);
    EXPECT_GT(all.uncertainty, kept * under.uncertainty);
    EXPECT_NEAR(all.surroundings.all, mixed(under.surroundings.all, over.surroundings.all),
                0.1 * all.surroundings.all);
    Surface thin = s, bare = base;
    thin.transmission = bare.transmission = 0.5;
    EXPECT_NEAR(transmitted(thin).g, kept * transmitted(bare).g, 1e-15);
    thin.lightmapped = true;
    EXPECT_GT(partOf(Lighting({.environment = &whiteSky()})(thin, {}, 1)).g, 0.9 * partOf(underAmbient(s)).g)
        << "under a lightmap, the environment reaches it";
}

TEST_P(ReferenceLayerAbove, OnlyTheBaseIsCompensated) {
    Surface s = layered(0.5);
    s.metallic = 1;
    s.albedo = glm::dvec3(1);
    s.roughness = 0.8;
    const Shading all = underAmbient(s, Multiscatter::energy);
    EXPECT_NEAR(partOf(all).g, partOf(underAmbient(s)).g, 1e-12);
    EXPECT_NEAR(all.ambient.g, partOf(all).g + keptUnder(s), 1e-5) << "a white metal reflects all";
}

TEST_P(OpaqueReferenceLayer, LitIsTheSumOfItsParts) {
    Scene scene = floorOf(GetParam().typical(matte()));
    scene.lights = {lightOf(LightKind::point, {1, 0, 2})};
    const Drawn d = drawn(scene, above());
    const auto light = [&](Channel mode) { return pixelOf(d[mode]); };
    expectColor(light(Channel::lit), light(Channel::lit_diffuse) + light(Channel::lit_specular), 1e-6);
    // The base reflects nothing, unless it has a film.
    if (GetParam().bit != gpu::LAYER_IRIDESCENCE)
        expectColor(light(Channel::lit_specular), light(Channel::lit_clearcoat) + light(Channel::lit_sheen),
                    1e-7);
    EXPECT_EQ(light(Channel::lit_clearcoat).g > 1e-5, GetParam().bit == gpu::LAYER_CLEARCOAT);
    EXPECT_EQ(light(Channel::lit_sheen).g > 1e-5, GetParam().bit == gpu::LAYER_SHEEN);
}

INSTANTIATE_TEST_SUITE_P(Layers, ReferenceLayer, testing::ValuesIn(testedLayers()), layerName);
INSTANTIATE_TEST_SUITE_P(Layers, OpaqueReferenceLayer,
                         testing::ValuesIn(testedLayers(~gpu::LAYER_TRANSMISSION)), layerName);
INSTANTIATE_TEST_SUITE_P(Layers, ReferenceLayerAbove,
                         testing::ValuesIn(testedLayers(gpu::LAYER_CLEARCOAT | gpu::LAYER_SHEEN)), layerName);

}  // namespace
}  // namespace diptych::reference
