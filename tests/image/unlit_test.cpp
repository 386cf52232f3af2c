// SPDX-License-Identifier: MIT
// KHR_materials_unlit: a pixel shows the base colour, factor x texture x COLOR_0, for any lights and other
// parameters.
#include "tests/image/square.h"

namespace diptych::tests {
namespace {

// The square, unlit, lit by a sun and a lamp, with extreme values for everything that an unlit material
// ignores.
Scene unlitSquare() {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.unlit = true;
    m.base_color = {0.5f, 0.25f, 0.125f, 1};
    m.metallic = 0.5f;
    m.roughness = 0.1f;
    m.emissive = {7, 7, 7};
    m.ior = 2;
    m.specular_color = {1, 2, 3};
    m.metallic_roughness_texture.texture = m.normal_texture.texture = m.occlusion_texture.texture =
        m.emissive_texture.texture = m.specular_texture.texture = m.specular_color_texture.texture = 0;
    Light sun;
    sun.kind = LightKind::directional;
    sun.intensity = 100;
    Light lamp;
    lamp.intensity = 50;
    lamp.position = {0.3, 0.1, 0.5};
    scene.lights = {sun, lamp};
    return scene;
}

TEST(Unlit, EmitsItsBaseColourAndReflectsNothing) {
    const glm::vec3 colour(0.5f, 0.25f, 0.125f), black(0);
    for (const Frame& frame : draw(unlitSquare()))
        for (const int x : {0, 3}) {
            EXPECT_EQ(colorAt(frame, Channel::lit, x, 1), colour) << frame.name;
            EXPECT_EQ(colorAt(frame, emission, x, 1), colour) << frame.name;
            EXPECT_EQ(colorAt(frame, albedo, x, 1), black) << frame.name;
            EXPECT_EQ(colorAt(frame, specular, x, 1), black) << frame.name;
            EXPECT_EQ(colorAt(frame, Channel::lit_diffuse, x, 1), black) << frame.name << " diffuse";
            EXPECT_EQ(colorAt(frame, Channel::lit_specular, x, 1), black) << frame.name << " specular";
            EXPECT_EQ(colorAt(frame, normals, x, 1), glm::vec3(0, 0, 1)) << frame.name;
            EXPECT_EQ(colorAt(frame, metallic, x, 1).x, 0.0f) << frame.name;
            EXPECT_EQ(colorAt(frame, roughness, x, 1).x, 1.0f) << frame.name;
            EXPECT_EQ(colorAt(frame, occlusion, x, 1).x, 1.0f) << frame.name;
        }
}

// Negative control: without the extension the same pixel differs.
TEST(Unlit, TheSameMaterialLitIsAnother) {
    Scene scene = unlitSquare();
    scene.materials[0].unlit = false;
    for (const Frame& frame : draw(scene))
        EXPECT_NE(colorAt(frame, Channel::lit, 0, 1), glm::vec3(0.5f, 0.25f, 0.125f)) << frame.name;
}

// The green texel (0, 1, 0) and the grey one, times factor and COLOR_0 (1, 0.5, 0.25).
TEST(Unlit, TextureAndVertexColourMultiply) {
    Scene scene = unlitSquare();
    scene.materials[0].base_color_texture.texture = 0;
    scene.meshes[0].primitives[0].colors.assign(4, {1, 0.5f, 0.25f, 1});
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, Channel::lit, 3, 0), {0, 0.125f, 0}, srgbTexel, frame.name);
        expectColor(colorAt(frame, Channel::lit, 3, 3), grey * glm::vec3(0.5f, 0.125f, 0.03125f), srgbTexel,
                    frame.name);
    }
}

// Alpha is used: factor 0.8 x COLOR_0 0.5 is below the cutoff of 0.41, and not below 0.39.
TEST(Unlit, MaskCutsByFactorTextureAndVertexAlpha) {
    Scene scene = unlitSquare();
    Material& m = scene.materials[0];
    m.alpha_mode = AlphaMode::mask;
    m.base_color.a = 0.8f;
    scene.meshes[0].primitives[0].colors.assign(4, {1, 1, 1, 0.5f});
    for (const auto& [cutoff, pixels] : {std::pair{0.39f, 16u}, {0.41f, 0u}}) {
        m.alpha_cutoff = cutoff;
        for (const Frame& frame : draw(scene))
            EXPECT_EQ(coveredPixels(frame), pixels) << frame.name << cutoff;
    }
}

// The back face is visible only if the material is double-sided.
TEST(Unlit, DoubleSidednessCounts) {
    Scene scene = unlitSquare();
    scene.nodes[0].parent_from_node = glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);
    for (const Frame& frame : draw(scene)) EXPECT_EQ(coveredPixels(frame), 0u) << frame.name;
    scene.materials[0].double_sided = true;
    for (const Frame& frame : draw(scene))
        EXPECT_EQ(colorAt(frame, Channel::lit, 0, 0), glm::vec3(0.5f, 0.25f, 0.125f)) << frame.name;
}

// A black unlit surface emits nothing and must also reflect nothing, although it has a specular
// attachment.
TEST(Unlit, BlackStaysBlackUnderAnyLight) {
    Scene scene = unlitSquare();
    scene.materials[0].base_color = {0, 0, 0, 1};
    for (const GBufferEncoding encoding :
         {GBufferEncoding::compact, GBufferEncoding::standard, GBufferEncoding::full}) {
        Settings settings = smallImage(encoding);
        settings.size = {4, 4};
        for (const Frame& frame : bothPaths(scene, settings))
            EXPECT_EQ(colorAt(frame, Channel::lit, 2, 2), glm::vec3(0)) << frame.name;
    }
}

// Packed encodings store the colour in the nine bits of 9.9.9.e5: 0.5, 0.25 and 0.125 are exact.
TEST(Unlit, PackedEncodingsKeepThePowersOfTwo) {
    for (const GBufferEncoding encoding : {GBufferEncoding::compact, GBufferEncoding::standard}) {
        Settings settings = smallImage(encoding);
        settings.size = {4, 4};
        for (const Frame& frame : bothPaths(unlitSquare(), settings))
            EXPECT_EQ(colorAt(frame, Channel::lit, 2, 2), glm::vec3(0.5f, 0.25f, 0.125f)) << frame.name;
    }
}

}  // namespace
}  // namespace diptych::tests
