// SPDX-License-Identifier: MIT
// Pixels computed by hand: a 2 m square that fills the image, 1 m in front of the camera, with simple
// lights and textures.
#include "tests/image/square.h"

#include <numbers>

namespace diptych::tests {
namespace {

TEST(KnownValues, TexelsLieWhereTheirCoordinatesSay) {
    Scene scene = square();
    scene.materials[0].base_color_texture.texture = 0;
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 0, 0), red, srgbTexel, frame.name + " top left");
        expectColor(colorAt(frame, albedo, 3, 0), green, srgbTexel, frame.name + " top right");
        expectColor(colorAt(frame, albedo, 1, 3), blue, srgbTexel, frame.name + " bottom left");
        expectColor(colorAt(frame, albedo, 2, 2), greys, srgbTexel, frame.name + " bottom right");
    }
}

TEST(KnownValues, TheSecondUvSetIsReadWhereAsked) {
    Scene scene = square();
    scene.materials[0].base_color_texture = {0, 1, {1, 0, 0}, {0, 1, 0}};
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 0, 0), green, srgbTexel, frame.name);
        expectColor(colorAt(frame, albedo, 3, 0), red, srgbTexel, frame.name);
    }
}

// KHR_texture_transform: offset (0.5, 0) moves red to the right half. Rotation by 90 degrees
// counter-clockwise, (u, v) -> (v, -u), moves the lower left texel to the top left.
TEST(KnownValues, TextureTransform) {
    Scene scene = square();
    scene.materials[0].base_color_texture = {0, 0, {1, 0, 0.5}, {0, 1, 0}};
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 0, 0), green, srgbTexel, frame.name + " offset");
        expectColor(colorAt(frame, albedo, 3, 0), red, srgbTexel, frame.name + " offset, wrapped");
    }
    scene.materials[0].base_color_texture = {0, 0, {0, 1, 0}, {-1, 0, 0}};
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 0, 0), blue, srgbTexel, frame.name + " quarter turn");
        expectColor(colorAt(frame, albedo, 3, 0), red, srgbTexel, frame.name + " quarter turn");
        expectColor(colorAt(frame, albedo, 0, 3), greys, srgbTexel, frame.name + " quarter turn");
    }
    scene.materials[0].base_color_texture = {0, 0, {2, 0, 0}, {0, 2, 0}};
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 0, 0), red, srgbTexel, frame.name + " scale");
        expectColor(colorAt(frame, albedo, 1, 0), green, srgbTexel, frame.name + " scale");
        expectColor(colorAt(frame, albedo, 2, 0), red, srgbTexel, frame.name + " scale, wrapped");
    }
}

// Factors, textures, KHR_materials_ior and _specular: dielectric F0 = min(((1-n)/(1+n))^2 color, 1) x
// specular, then mixed with the base colour by metallic.
TEST(KnownValues, MaterialParameters) {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.base_color = {0.8f, 0.4f, 0.2f, 1};
    m.metallic = 0.25f;
    m.roughness = 0.6f;
    m.emissive = {3, 0.5f, 0};
    m.ior = 2;
    m.specular = 0.5f;
    m.specular_color = {1, 0.5f, 1};
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 1, 1), {0.8f, 0.4f, 0.2f}, float32, "albedo");
        EXPECT_EQ(colorAt(frame, metallic, 1, 1).x, 0.25f);
        EXPECT_EQ(colorAt(frame, roughness, 1, 1).x, 0.6f);
        EXPECT_EQ(colorAt(frame, occlusion, 1, 1).x, 1.0f);
        expectColor(colorAt(frame, emission, 1, 1), {3, 0.5f, 0}, float32, "emission");
        // (1/3)^2 = 1/9; x 0.5 = 1/18 (green 1/36); mix: 3/4 of that and 1/4 of the base colour.
        expectColor(colorAt(frame, specular, 1, 1),
                    {0.75f / 18 + 0.2f, 0.75f / 36 + 0.1f, 0.75f / 18 + 0.05f}, float32, "F0");
        expectColor(colorAt(frame, normals, 1, 1), {0, 0, 1}, float32, "normal");
    }
}

// KHR_materials_pbrSpecularGlossiness: albedo is diffuse (1 - largest component of F0). Seen and lit along
// the normal, with alpha = 1, the lobe is F0 / (4 pi); the base reflects albedo / pi times 1 less F0's
// largest component, or 1 less each component as the extension does.
TEST(KnownValues, SpecularGlossiness) {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.specular_glossiness = true;
    m.base_color = {0.8f, 0.4f, 0.2f, 1};
    m.specular_color = {0.25f, 0.5f, 0};
    m.metallic = m.ior = 0;
    scene.lights = {sunAlong({0, 0, -1}, std::numbers::pi_v<float>)};
    for (const BaseLayer base : {BaseLayer::max, BaseLayer::component}) {
        Settings settings = smallImage(GBufferEncoding::full);
        settings.size = {1, 1};
        settings.base_layer = base;
        const glm::vec3 left = base == BaseLayer::max ? glm::vec3(0.5f) : glm::vec3(0.75f, 0.5f, 1);
        for (const Frame& frame : bothPaths(scene, settings)) {
            expectColor(colorAt(frame, albedo, 0, 0), {0.4f, 0.2f, 0.1f}, float32, frame.name + " albedo");
            expectColor(colorAt(frame, Channel::dielectric_f0, 0, 0), m.specular_color, float32,
                        frame.name + " F0");
            EXPECT_EQ(colorAt(frame, Channel::dielectric_f90, 0, 0).x, 1.0f);
            EXPECT_EQ(colorAt(frame, metallic, 0, 0).x, 0.0f);
            EXPECT_EQ(colorAt(frame, roughness, 0, 0).x, 1.0f);
            expectColor(colorAt(frame, Channel::lit, 0, 0),
                        glm::vec3(0.4f, 0.2f, 0.1f) * left + m.specular_color / 4.0f, 5e-6f,
                        frame.name + " lit");
        }
    }
    // F0 of the grey texel is a fifth, red 1; all texels are fully glossy.
    m.specular_color = {1, 1, 1};
    m.roughness = 0.25f;
    m.specular_color_texture.texture = 0;
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, albedo, 3, 3), glm::vec3(0.8f, 0.4f, 0.2f) * (1 - grey), srgbTexel,
                    "grey");
        expectColor(colorAt(frame, albedo, 0, 0), glm::vec3(0), srgbTexel, "red");
        EXPECT_NEAR(colorAt(frame, roughness, 3, 3).x, 0.25f, float32) << "opaque texels: all of the factor";
    }
    for (std::size_t i = 3; i < scene.images[0].rgba.size(); i += 4) scene.images[0].rgba[i] = 51;
    for (const Frame& frame : draw(scene))
        EXPECT_NEAR(colorAt(frame, roughness, 3, 3).x, 1 - 0.75f * 0.2f, float32) << "linear alpha";
}

TEST(KnownValues, MetallicRoughnessAndOcclusionTextures) {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.metallic_roughness_texture.texture = m.occlusion_texture.texture = 0;
    m.roughness = 0.5f;
    m.occlusion_strength = 0.5f;
    for (const Frame& frame : draw(scene)) {
        EXPECT_EQ(colorAt(frame, roughness, 3, 0).x, 0.5f) << "green texel: roughness 1 x 0.5";
        EXPECT_EQ(colorAt(frame, metallic, 3, 0).x, 0.0f);
        EXPECT_EQ(colorAt(frame, metallic, 0, 3).x, 1.0f) << "blue texel";
        EXPECT_EQ(colorAt(frame, occlusion, 0, 0).x, 1.0f) << "red texel: open";
        EXPECT_EQ(colorAt(frame, occlusion, 3, 0).x, 0.5f) << "1 + strength (0 - 1)";
        EXPECT_NEAR(colorAt(frame, roughness, 3, 3).x, 0.5f * 128 / 255, float32) << "linear, not sRGB";
    }
}

// A white metal seen and lit along its normal: F D V cos = 1 x 1/(pi a^2) x 1/4 with a = roughness^2.
TEST(KnownValues, GgxPeak) {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.roughness = 0.5f;
    scene.lights = {sunAlong({0, 0, -1})};
    const float expected = 1 / (std::numbers::pi_v<float> * 0.0625f) / 4;
    for (const Frame& frame : draw(scene, 1))
        expectColor(colorAt(frame, Channel::lit, 0, 0), glm::vec3(expected), 5e-6f, frame.name);
}

// Occlusion applies only to ambient light; direct light is unaffected with or without ambient light.
TEST(KnownValues, OcclusionLeavesDirectLightAlone) {
    Scene scene = square();
    scene.lights = {sunAlong({0, 0, -1})};
    const glm::vec3 open = colorAt(draw(scene)[0], Channel::lit, 3, 0);
    scene.materials[0].occlusion_texture.texture = 0;
    Renderer renderer(device(), scene, pipelines());
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {4, 4};
    for (const float ambient : {0.0f, 0.5f}) {
        settings.ambient = {ambient, ambient, ambient};
        for (const Frame& frame : bothPaths(renderer, settings)) {
            EXPECT_EQ(colorAt(frame, occlusion, 3, 0).x, 0.0f);
            EXPECT_EQ(colorAt(frame, Channel::lit, 3, 0), open) << frame.name << ambient;
            EXPECT_EQ(colorAt(frame, occlusion, 0, 0).x, 1.0f);
            EXPECT_GE(colorAt(frame, Channel::lit, 0, 0).x, open.x + 0.3f * ambient)
                << frame.name << ": the control, which light from everywhere reaches";
        }
    }
}

// The normal map's texel (0.5 + 0.5 sin 30, 0.5, 0.5 + 0.5 cos 30) tilts the normal by 30 degrees to +u.
// Mirrored transforms and back faces follow glTF's rules.
TEST(KnownValues, NormalMapsFollowTangentsMirrorsAndBackFaces) {
    Scene scene = square();
    scene.images[0] = {"tilt", 1, 1, {191, 128, 238, 255}};
    scene.materials[0].normal_texture.texture = 0;
    scene.materials[0].double_sided = true;
    // 191/255 x 2 - 1 = 0.49804, 0.00392, 0.86667; normalised
    const glm::vec3 t(0.498039f, 0.003922f, 0.866667f);
    const glm::vec3 n = t / std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
    for (const Frame& frame : draw(scene))
        expectColor(colorAt(frame, normals, 1, 1), n, 5 * float32, frame.name);

    Scene mirrored = scene;
    mirrored.nodes[0].parent_from_node[0] = {-1, 0, 0, 0};
    for (const Frame& frame : draw(mirrored))
        expectColor(colorAt(frame, normals, 1, 1), {-n.x, n.y, n.z}, 5 * float32,
                    frame.name + " mirrored in x");

    Scene turned = scene;  // rotated by 180 degrees about y: back face visible, normal flipped
    turned.nodes[0].parent_from_node = glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);
    for (const Frame& frame : draw(turned))
        expectColor(colorAt(frame, normals, 1, 1), {n.x, -n.y, n.z}, 5 * float32,
                    frame.name + " from behind");
}

// Depth and position: the pixel's ray meets the square at view depth 1.
TEST(KnownValues, DepthAndPosition) {
    for (const Frame& frame : draw(square())) {
        EXPECT_NEAR(frame.channels.at(Channel::depth).at(3, 0), 1.0f, float32);
        expectColor(colorAt(frame, Channel::position, 3, 0), {0.75f, 0.75f, -1}, float32, frame.name);
        expectColor(colorAt(frame, Channel::geometric_normal, 3, 0), {0, 0, 1}, float32, frame.name);
    }
}

// Extreme inputs that once made paths differ or gave NaN.

void expectSound(const std::vector<Frame>& frames) {
    expectSameChannels(frames[0], frames[1]);
    for (const Frame& frame : frames) {
        EXPECT_EQ(frame.counters.nonfinite_pixels, 0u) << frame.name;
        EXPECT_TRUE(frame.repaired.empty()) << frame.name;
        EXPECT_EQ(coveredPixels(frame), frame.channels.at(Channel::lit).pixels()) << frame.name;
        for (const Channel channel : {normals, Channel::geometric_normal})
            for (const float value : frame.channels.at(channel).data)
                ASSERT_TRUE(std::isfinite(value)) << frame.name << " " << debugMode(channel).name;
    }
}

// Reversed depth is 0 at the far plane, which is also the clear value of the background.
TEST(Extremes, ASurfaceOnTheFarPlaneIsInBothImages) {
    Scene scene = square();
    for (const double near : {0.1, 0.013, 0.5}) {
        scene.cameras[0].near = near;
        scene.cameras[0].far = 1;
        expectSound(draw(scene, 8));
    }
    scene.cameras[0].orthographic = true;
    scene.cameras[0].ymag = 0.9;
    expectSound(draw(scene, 8));
}

// With light and viewer in opposite directions there is no half vector.
TEST(Extremes, ALightThatShinesAtTheViewerGivesNothing) {
    Scene scene = square();
    scene.cameras[0].orthographic = true;
    scene.cameras[0].ymag = 0.9;
    scene.cameras[0].far = 10;
    scene.lights = {sunAlong({0, 0, 1})};
    const auto frames = draw(scene, 8);
    expectSound(frames);
    for (const float value : frames[1].channels.at(Channel::lit).data) EXPECT_EQ(value, 0.0f);
}

TEST(Extremes, AFlattenedNodeKeepsItsNormals) {
    Scene scene = square();
    scene.nodes[0].parent_from_node[2] = {0, 0, 0, 0};
    expectSound(draw(scene, 8));
    // In the plane of the square: its scale flattens them to 0.
    for (glm::vec3& n : scene.meshes[0].primitives[0].normals) n = {1, 0, 0};
    const auto frames = draw(scene, 8);
    expectSound(frames);
    expectColor(colorAt(frames[1], normals, 4, 4), {0, 0, 1}, float32, "the triangle's normal stands in");
}

// With an orthographic camera, normals face against the view direction, not towards the camera's position.
// Far to the side, a steep triangle's normal points away from that position.
TEST(KnownValues, GeometricNormalsFaceAnOrthographicViewer) {
    Scene scene = square();
    scene.cameras[0].orthographic = true;
    scene.cameras[0].ymag = 4;
    scene.cameras[0].far = 100;
    const double angle = 80 * std::numbers::pi / 180, sine = std::sin(angle), cosine = std::cos(angle);
    glm::dmat4& transform = scene.nodes[0].parent_from_node;
    transform[0] = {cosine, 0, -sine, 0};
    transform[2] = {sine, 0, cosine, 0};
    transform[3] = {2.5, 0, -2, 1};
    const auto frames = draw(scene, 64);
    for (const Frame& frame : frames) {
        const glm::vec3 normal = colorAt(frame, Channel::geometric_normal, 52, 32);
        EXPECT_NEAR(double{normal.x}, sine, 1e-5) << frame.name;
        EXPECT_NEAR(double{normal.z}, cosine, 1e-5) << frame.name;
    }
}

// The image is scale-invariant: lengths scaled by s, intensities by s^2.
TEST(Extremes, ScaleDoesNotChangeTheImage) {
    Scene scene = square();
    Light lamp;
    lamp.intensity = 10;
    lamp.position = {0.5, 0, 2};
    scene.lights = {lamp};
    const glm::vec3 expected = colorAt(draw(scene, 8)[1], Channel::lit, 5, 4);
    for (const double scale : {1e-9, 1e-5, 1e5, 1e9}) {
        Scene scaled = scene;
        for (int i = 0; i < 3; ++i) scaled.nodes[0].parent_from_node[i][i] = scale;
        scaled.cameras[0].world_from_camera[3] = {0, 0, scale, 1};
        scaled.cameras[0].near *= scale;
        scaled.lights[0].position *= scale;
        scaled.lights[0].intensity *= static_cast<float>(scale * scale);
        const auto frames = draw(scaled, 8);
        expectSound(frames);
        expectColor(colorAt(frames[1], Channel::lit, 5, 4), expected, 1e-5f * expected.x,
                    std::to_string(scale));
    }
}

}  // namespace
}  // namespace diptych::tests
