// SPDX-License-Identifier: MIT
#include "shared/scene/requirements.h"

#include "compare/render/omitted_lights.h"
#include "shared/contract/material.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <functional>

using namespace diptych;

namespace {

// One triangle with material 0; no triangle uses material 1.
Scene plainScene() {
    Scene scene;
    scene.materials.resize(2);
    scene.textures.push_back({0, {}});
    scene.images.push_back({"white", 1, 1, {255, 255, 255, 255}});
    scene.meshes.push_back({"triangle", {triangleOfAMetre()}});
    Node node;
    node.mesh = 0;
    scene.nodes = {node, node};
    return scene;
}

Requirements of(const Scene& scene) {
    return requirements(scene, poseAt(scene, 0));
}

const Requirements::Line& line(const std::vector<Requirements::Line>& lines, const std::string& what) {
    for (const auto& l : lines)
        if (l.what == what) return l;
    throw std::out_of_range(what);
}

// One of several suns has a shadow map; the others are named.
TEST(Requirements, SunsWithoutAShadowAreNamed) {
    std::vector<Light> lights(4);
    for (const std::size_t i : {0u, 1u, 3u}) lights[i].kind = LightKind::directional;
    lights[1].name = "noon";
    lights[1].intensity = 5;
    lights[3].name = "dusk";
    Settings settings;
    settings.shadows = Shadows::evsm;
    EXPECT_EQ(
        omittedShadows(lights, settings),
        std::vector<std::string>{
            "only the brightest of 3 directional lights, noon, casts a shadow; these do not: light 0, dusk"});
    settings.shadows = Shadows::off;
    EXPECT_TRUE(omittedShadows(lights, settings).empty());
    settings.shadows = Shadows::pcf;
    EXPECT_TRUE(omittedShadows({lights[1], lights[2]}, settings).empty());
}

}  // namespace

TEST(Requirements, PlainSceneNeedsNothing) {
    const Requirements r = of(plainScene());
    EXPECT_FALSE(r.normal_maps || r.alpha_mask || r.alpha_blend || r.double_sided || r.vertex_colors ||
                 r.second_texcoord || r.texture_transform || r.occlusion || r.emission ||
                 r.dielectric_specular || r.specular_glossiness);
    EXPECT_EQ(r.materials, 2u) << "ids name every material of the scene";
    EXPECT_EQ(r.textures, 0u);
    EXPECT_EQ(r.draws, 2u);
    EXPECT_EQ(r.triangles, 2u);
    EXPECT_EQ(r.vertices, 6u);
}

// Each feature alone sets its own requirement, and only if its material is drawn.
TEST(Requirements, EachFeatureAsksForItself) {
    struct Case {
        const char* name;
        std::function<void(Material&)> change;
        bool Requirements::*needed;
    };
    const Case cases[] = {
        {"normal", [](Material& m) { m.normal_texture.texture = 0; }, &Requirements::normal_maps},
        {"mask", [](Material& m) { m.alpha_mode = AlphaMode::mask; }, &Requirements::alpha_mask},
        {"blend", [](Material& m) { m.alpha_mode = AlphaMode::blend; }, &Requirements::alpha_blend},
        {"transmission", [](Material& m) { m.transmission = 0.5f; }, &Requirements::rough_glass},
        {"two sides", [](Material& m) { m.double_sided = true; }, &Requirements::double_sided},
        {"uv set", [](Material& m) { m.base_color_texture.texture = 0, m.base_color_texture.texcoord = 1; },
         &Requirements::second_texcoord},
        {"transform", [](Material& m) { m.base_color_texture.texture = 0, m.base_color_texture.u.x = 2; },
         &Requirements::texture_transform},
        {"occlusion", [](Material& m) { m.occlusion_texture.texture = 0; }, &Requirements::occlusion},
        {"emission", [](Material& m) { m.emissive.b = 2; }, &Requirements::emission},
        {"ior", [](Material& m) { m.ior = 1.3f; }, &Requirements::dielectric_specular},
        {"specular", [](Material& m) { m.specular = 0.5f; }, &Requirements::dielectric_specular},
        {"specular colour", [](Material& m) { m.specular_color.g = 0.5f; },
         &Requirements::dielectric_specular},
    };
    for (const Case& c : cases) {
        Scene scene = plainScene();
        c.change(scene.materials[1]);
        EXPECT_FALSE(of(scene).*c.needed) << c.name << " of an unused material";
        c.change(scene.materials[0]);
        EXPECT_TRUE(of(scene).*c.needed) << c.name;
        for (const Case& other : cases)
            if (other.needed != c.needed) {
                EXPECT_FALSE(of(scene).*other.needed) << c.name << " asks for " << other.name;
            }
    }
}

// Each layer alone, and only of a lit material that is drawn.
TEST(Requirements, LayersOfDrawnLitMaterialsAreSummed) {
    Scene scene = plainScene();
    EXPECT_EQ(of(scene).layers, 0u);
    EXPECT_FALSE(line(of(scene).lines(), "clear coats").modelled);
    for (const char* name : {"anisotropy", "sheen", "iridescence"})
        EXPECT_FALSE(line(of(scene).lines(), name).modelled) << name;
    scene.materials[1].clearcoat = scene.materials[1].anisotropy = scene.materials[1].iridescence = 1;
    scene.materials[1].sheen_color = {1, 1, 1};
    EXPECT_EQ(of(scene).layers, 0u) << "of an unused material";
    scene.materials[0].clearcoat = 0.5f;
    EXPECT_EQ(of(scene).layers, gpu::LAYER_CLEARCOAT);
    EXPECT_TRUE(line(of(scene).lines(), "clear coats").modelled);
    scene.materials[0].anisotropy = 0.5f;
    EXPECT_EQ(of(scene).layers, gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY);
    EXPECT_TRUE(line(of(scene).lines(), "anisotropy").modelled);
    scene.materials[0].sheen_color = {0, 0, 0.5f};
    EXPECT_EQ(of(scene).layers, gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY | gpu::LAYER_SHEEN);
    EXPECT_TRUE(line(of(scene).lines(), "sheen").modelled);
    EXPECT_FALSE(line(of(scene).lines(), "iridescence").modelled);
    scene.materials[0].iridescence = 0.5f;
    EXPECT_EQ(of(scene).layers,
              gpu::LAYER_CLEARCOAT | gpu::LAYER_ANISOTROPY | gpu::LAYER_SHEEN | gpu::LAYER_IRIDESCENCE);
    EXPECT_TRUE(line(of(scene).lines(), "iridescence").modelled);
    scene.materials[0].unlit = true;
    EXPECT_EQ(of(scene).layers, 0u);
}

// Thickness and dispersion count only where light passes.
TEST(Requirements, VolumesOfTransmittingMaterials) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.thickness = m.dispersion = 0.5f;
    EXPECT_FALSE(of(scene).volume || of(scene).dispersion);
    for (const char* name : {"transmission", "volumes", "dispersion", "diffuse transmission"})
        EXPECT_FALSE(line(of(scene).lines(), name).modelled) << name;
    m.transmission = 0.5f;
    EXPECT_EQ(of(scene).layers, gpu::LAYER_TRANSMISSION);
    EXPECT_TRUE(of(scene).rough_glass);
    EXPECT_FALSE(of(scene).alpha_blend || line(of(scene).lines(), "alpha blending").modelled);
    m.roughness = 0;
    EXPECT_FALSE(of(scene).rough_glass);
    EXPECT_EQ(of(scene).surface_layers, 0u) << "the G-buffer stores none of it";
    for (const char* name : {"transmission", "volumes", "dispersion"})
        EXPECT_TRUE(line(of(scene).lines(), name).modelled) << name;
    m.diffuse_transmission = 0.5f;
    EXPECT_EQ(of(scene).layers, gpu::LAYER_TRANSMISSION | gpu::LAYER_DIFFUSE_TRANSMISSION);
    EXPECT_TRUE(line(of(scene).lines(), "diffuse transmission").modelled);
    m.thickness = 0;
    EXPECT_FALSE(of(scene).volume || of(scene).dispersion);
    m.thickness = 1;
    m.unlit = true;
    EXPECT_FALSE(of(scene).volume || of(scene).dispersion);
    EXPECT_EQ(of(scene).layers, 0u);
}

// The G-buffer stores layers of opaque surfaces alone.
TEST(Requirements, LayersOfSurfacesThatAreSeenThroughAreNotStored) {
    for (const bool first : {false, true}) {
        Scene scene = plainScene();
        scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
        scene.meshes[0].primitives[1].material = 1;
        Material &glass = scene.materials[first ? 0 : 1], &solid = scene.materials[first ? 1 : 0];
        glass.transmission = glass.clearcoat = 1;
        solid.diffuse_transmission = 1;
        constexpr gpu::uint both = gpu::LAYER_CLEARCOAT | gpu::LAYER_DIFFUSE_TRANSMISSION;
        EXPECT_EQ(of(scene).layers, both | gpu::LAYER_TRANSMISSION);
        EXPECT_EQ(of(scene).surface_layers, gpu::LAYER_DIFFUSE_TRANSMISSION);
        glass.transmission = 0;
        EXPECT_EQ(of(scene).surface_layers, both);
        glass.alpha_mode = AlphaMode::blend;
        EXPECT_EQ(of(scene).surface_layers, gpu::LAYER_DIFFUSE_TRANSMISSION);
        solid.clearcoat = 1;
        EXPECT_EQ(of(scene).surface_layers, both) << "an opaque surface has one, too";
    }
}

TEST(Requirements, TexturesOfALayerAreReadWhereItIs) {
    Scene scene = plainScene();
    scene.textures.resize(2);
    Material& m = scene.materials[0];
    m.sheen_roughness_texture.texture = 0;
    m.iridescence_thickness_texture.texture = 1;
    EXPECT_EQ(of(scene).textures, 0u);
    m.sheen_color = {1, 0, 0};
    EXPECT_EQ(of(scene).textures, 1u);
    m.iridescence = 1;
    EXPECT_EQ(of(scene).textures, 2u);
}

TEST(Requirements, OcclusionOfStrengthZeroIsNone) {
    Scene scene = plainScene();
    scene.materials[0].occlusion_texture.texture = 0;
    scene.materials[0].occlusion_strength = 0;
    EXPECT_FALSE(of(scene).occlusion);
}

// An unlit surface emits its base colour and has neither F0 nor F90: even a black one needs the channel
// for F90. Ignored properties require nothing.
// The largest step of any material whose texture chooses a thickness.
TEST(Requirements, AThicknessTextureChoosesInARange) {
    Scene scene = plainScene();
    for (Material& m : scene.materials) {
        m.iridescence = 1;
        m.iridescence_thickness_min = 500;
        m.iridescence_thickness_max = 200;
    }
    scene.materials[1].iridescence_thickness_texture.texture = 0;
    EXPECT_EQ(of(scene).film_thickness_range, 0) << "of an unused material";
    scene.materials[0].iridescence_thickness_texture.texture = 0;
    EXPECT_EQ(of(scene).film_thickness_range, 300);
    scene.materials[0].iridescence = 0;
    EXPECT_EQ(of(scene).film_thickness_range, 0) << "without a film";
}

// In world units: the largest node counts.
TEST(Requirements, AVolumesTextureScalesItsThickness) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.transmission = 1;
    m.thickness = 0.5f;
    EXPECT_EQ(of(scene).volume_thickness_range, 0) << "without a texture";
    m.thickness_texture.texture = 0;
    EXPECT_EQ(of(scene).volume_thickness_range, 0.5f);
    scene.nodes[1].parent_from_node = glm::scale(glm::dmat4(1), glm::dvec3(-8, 1, 1));
    EXPECT_NEAR(of(scene).volume_thickness_range, 1, 1e-6);
    m.transmission = 0;
    EXPECT_EQ(of(scene).volume_thickness_range, 0);
}

TEST(Requirements, UnlitAsksForEmissionAndSpecularAlone) {
    Scene scene = plainScene();
    Material& m = scene.materials[0];
    m.unlit = true;
    m.base_color = {0.25f, 0.5f, 0, 1};
    m.emissive = {9, 9, 9};
    m.normal_texture = {0, 1};
    m.occlusion_texture = {0, 0, {2, 0, 0}};
    Requirements r = of(scene);
    EXPECT_TRUE(r.unlit && r.emission && r.dielectric_specular);
    EXPECT_FALSE(r.normal_maps || r.occlusion || r.second_texcoord || r.texture_transform);
    EXPECT_EQ(r.textures, 0u);
    EXPECT_EQ(r.min_emission, 0.5f);
    EXPECT_EQ(r.max_emission, 0.5f);
    m.base_color = {0, 0, 0, 1};
    r = of(scene);
    EXPECT_TRUE(r.unlit && r.dielectric_specular);
    EXPECT_FALSE(r.emission);
}

// Its F0 is stored.
TEST(Requirements, SpecularGlossinessAsksForSpecular) {
    Scene scene = plainScene();
    scene.materials[1].specular_glossiness = true;
    EXPECT_FALSE(of(scene).specular_glossiness) << "of an unused material";
    const auto before = of(scene).lines();
    scene.materials[0].specular_glossiness = true;
    const Requirements r = of(scene);
    EXPECT_TRUE(r.specular_glossiness && r.dielectric_specular);
    for (const char* what : {"specular-glossiness materials", "dielectric specular"}) {
        EXPECT_FALSE(line(before, what).modelled) << what;
        EXPECT_TRUE(line(r.lines(), what).modelled) << what;
    }
}

TEST(Requirements, EmissionRangesOverTheMaterialsInUse) {
    Scene scene = plainScene();
    scene.materials.resize(5);
    scene.materials[0].emissive = {0.25f, 3, 0};
    scene.materials[1].emissive = {100, 0, 0};  // unused
    scene.materials[2].emissive = {0, 0, 0.5f};
    scene.materials[3].emissive = {0, 0, 0};
    scene.materials[4].emissive = {0, 1, 0};
    for (const int material : {2, 3, 4}) {
        Primitive p = scene.meshes[0].primitives[0];
        p.material = material;
        scene.meshes[0].primitives.push_back(p);
    }
    EXPECT_EQ(of(scene).max_emission, 3);
    EXPECT_EQ(of(scene).min_emission, 0.5f);
}

TEST(Requirements, LightsAreCountedByKind) {
    Scene scene = plainScene();
    for (const LightKind kind :
         {LightKind::spot, LightKind::directional, LightKind::point, LightKind::spot}) {
        Light light;
        light.kind = kind;
        scene.lights.push_back(light);
    }
    const Requirements r = of(scene);
    EXPECT_EQ(r.lights(LightKind::directional), 1u);
    EXPECT_EQ(r.lights(LightKind::point), 1u);
    EXPECT_EQ(r.lights(LightKind::spot), 2u);
    EXPECT_EQ(r.areaLights(), 0u);
    EXPECT_EQ(r.sun_discs, 0u);
    EXPECT_EQ(r.lights(), 4u);
}

// No path draws sun discs yet: they are listed as unsupported, and no other line changes.
TEST(Requirements, AreaLightsAndEnvironmentsAreModelledDiscsOfSunsLeftOut) {
    Scene scene = plainScene();
    const auto before = of(scene).lines();
    EXPECT_FALSE(line(before, "area lights").modelled);
    for (const char* what : {"area lights", "sun discs", "environment"})
        EXPECT_EQ(line(before, what).why.find("only the reference"), std::string::npos) << what;
    for (const LightKind kind : {LightKind::tube, LightKind::rect, LightKind::tube, LightKind::disc}) {
        scene.lights.emplace_back().kind = kind;
    }
    scene.lights.emplace_back().kind = LightKind::directional;
    scene.lights.back().angle = 0.01f;
    scene.environment = Environment{"sky.exr", Image(2, 1, 3)};
    const Requirements r = of(scene);
    EXPECT_EQ(r.lights(LightKind::rect), 1u);
    EXPECT_EQ(r.lights(LightKind::disc), 1u);
    EXPECT_EQ(r.lights(LightKind::tube), 2u);
    EXPECT_EQ(r.sun_discs, 1u);
    EXPECT_EQ(r.lights(), 5u);
    EXPECT_EQ(r.areaLightsText(), "4 area lights (1 rect, 1 disc, 2 tube)");
    const auto after = r.lines();
    EXPECT_TRUE(line(after, "area lights").modelled);
    EXPECT_FALSE(line(after, "sun discs").modelled);
    EXPECT_NE(line(after, "sun discs").why.find("only the reference"), std::string::npos);
    EXPECT_TRUE(line(after, "environment").modelled);
    EXPECT_NE(line(after, "environment").why.find("sky.exr"), std::string::npos);
    EXPECT_TRUE(line(after, "directional lights").modelled);
}

TEST(Requirements, APathSaysWhatLightItLeavesOut) {
    Requirements needs;
    EXPECT_TRUE(omittedLights(Path::deferred, needs).empty());
    needs.light_counts.fill(1);
    needs.sun_discs = 1;
    needs.environment = "sky.exr";
    const std::vector<std::string> expected{"1 sun disc: not rendered by deferred yet; the reference has it"};
    EXPECT_EQ(omittedLights(Path::deferred, needs), expected);
    EXPECT_EQ(omittedLights(Path::forward_plus, needs).size(), 1u);
    EXPECT_TRUE(omittedLights(Path::reference, needs).empty()) << "it draws all";
}

// Counted once per mesh, whatever its number of primitives. A target with weight 0 has no effect.
TEST(Requirements, SkinsMorphTargetsAndAnimations) {
    Scene scene = plainScene();
    const auto before = of(scene).lines();
    for (const char* what : {"animation", "skins and morph targets"})
        EXPECT_FALSE(line(before, what).modelled);
    EXPECT_EQ(line(before, "skins and morph targets").why, "no mesh is skinned or morphed: no deformation");
    EXPECT_EQ(of(scene).deformedText(), "");

    const std::size_t corners = scene.meshes[0].primitives[0].positions.size();
    scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
    for (Primitive& p : scene.meshes[0].primitives) {
        p.joint_sets = {{std::vector<glm::u16vec4>(corners, {0, 0, 0, 0}),
                         std::vector<glm::vec4>(corners, {1, 0, 0, 0})}};
        p.targets.resize(1);
    }
    scene.meshes[0].weights = {0};
    scene.skins = {{"", {0, 1}, {glm::mat4(1), glm::mat4(1)}, -1}, {"unused", {0}, {glm::mat4(1)}, -1}};
    scene.nodes[0].skin = scene.nodes[1].skin = 0;
    EXPECT_EQ(of(scene).skinned, 2u);
    EXPECT_EQ(of(scene).morphed, 0u);
    EXPECT_EQ(of(scene).deformedText(), "2 skinned meshes: 12 vertices by 2 joints");
    scene.weights = {{0.5f}};
    scene.nodes[1].weights = 0;
    scene.nodes[1].skin = -1;
    // One of three animations moves nothing in the scene.
    scene.animations.resize(3);
    for (const std::size_t moving : {0u, 2u}) {
        scene.animations[moving].keyframes = {{Interpolation::step, {0}, {0.5f}, 1}};
        scene.animations[moving].channels = {{1, 0, AnimatedPart::weights}};
    }
    const Requirements r = of(scene);
    EXPECT_EQ(r.deformedText(), "1 skinned mesh, 1 morphed: 12 vertices by 2 joints");
    EXPECT_EQ(r.animations, 2u);
    const auto after = r.lines();
    EXPECT_TRUE(line(after, "animation").modelled);
    EXPECT_TRUE(line(after, "skins and morph targets").modelled);
    EXPECT_EQ(line(after, "skins and morph targets").why, r.deformedText());
    scene.nodes[0].skin = -1;
    EXPECT_EQ(of(scene).deformedText(), "1 morphed mesh: 6 vertices");
}

TEST(Requirements, LinesSayWhy) {
    Scene scene = plainScene();
    scene.materials[0].alpha_mode = AlphaMode::blend;
    const auto without = of(scene).lines();
    EXPECT_FALSE(line(without, "emission").modelled);
    EXPECT_EQ(line(without, "emission").why, "no material emits: no emission attachment");
    EXPECT_TRUE(line(without, "alpha blending").modelled);
    EXPECT_NE(line(without, "alpha blending").why.find("BLEND"), std::string::npos);
    scene.materials[0].emissive = {7, 0, 0};
    const auto with = of(scene).lines();
    EXPECT_TRUE(line(with, "emission").modelled);
    EXPECT_NE(line(with, "emission").why.find('7'), std::string::npos);
    ASSERT_EQ(with.size(), without.size());
    for (const auto& l : with) EXPECT_FALSE(l.why.empty()) << l.what;
}
