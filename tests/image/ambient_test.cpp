// SPDX-License-Identifier: MIT
// Ambient light in both paths: compared with values computed by hand and with the reference.
#include "shared/contract/debug_mode.h"
#include "shared/environment/directional_albedo.h"
#include "shared/scene/load.h"
#include "tests/image/square.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace diptych::tests {
namespace {

std::vector<Frame> drawIn(const Scene& scene, const Rgb& ambient, Size size = {4, 4}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = size;
    settings.ambient = ambient;
    return bothPaths(scene, settings, {Channel::lit, Channel::lit_ambient, Channel::material_id});
}

// A base without a specular layer reflects its colour. The texture's green texel is fully occluded.
TEST(Ambient, OfALambertianSurfaceUnderOcclusion) {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.metallic = 0;
    m.specular = 0;
    m.base_color = {0.8f, 0.4f, 0.2f, 1};
    m.occlusion_texture.texture = 0;
    m.occlusion_strength = 0.75f;
    for (const Frame& frame : drawIn(scene, {1, 2, 4})) {
        expectColor(colorAt(frame, Channel::lit_ambient, 0, 0), {0.8f, 0.8f, 0.8f}, float32,
                    frame.name + " open");
        expectColor(colorAt(frame, Channel::lit_ambient, 3, 0), {0.2f, 0.2f, 0.2f}, float32,
                    frame.name + " a quarter");
    }
}

// At normal incidence and roughness 1 the integral of the lobe is 1 - ln 2
// (tests/unit/compare/reference/ambient_test.cpp).
TEST(Ambient, OfARoughMetalSeenStraightOn) {
    Scene scene = square();
    Material& m = scene.materials[0];
    m.metallic = m.roughness = 1;
    m.base_color = {1, 1, 1, 1};
    scene.lights.emplace_back().intensity = 0;  // instead of the default sun
    for (const Frame& frame : drawIn(scene, {1, 1, 1}, {33, 33})) {
        const glm::vec3 centre = colorAt(frame, Channel::lit_ambient, 16, 16);
        expectColor(centre, glm::vec3(1 - std::numbers::ln2_v<float>), 5e-5f, frame.name);
        EXPECT_EQ(colorAt(frame, Channel::lit, 16, 16), centre) << "nothing else shines";
    }
}

// The cubic through four samples of the table, two on each side, errs by at most 6.2e-6 at these angles. A
// cubic through samples shifted by one step errs by 1.5e-5.
TEST(Ambient, OfAMetalIsTheIntegralAtEveryAngle) {
    for (const double degrees : {0.5, 9.0, 31.0, 47.0, 66.0, 80.0})
        for (const float roughness : {0.1f, 0.35f, 0.6f, 0.85f}) {
            Scene scene = square();
            scene.nodes[0].parent_from_node =
                glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(1, 0, 0));
            Material& m = scene.materials[0];
            m.metallic = 1;
            m.roughness = roughness;
            m.base_color = {1, 1, 1, 1};
            scene.lights.emplace_back().intensity = 0;  // instead of the default sun
            const glm::dvec2 lobe =
                specularAlbedo(std::cos(glm::radians(degrees)), double{roughness} * double{roughness});
            for (const Frame& frame : drawIn(scene, {1, 1, 1}, {33, 33}))
                EXPECT_NEAR(double{colorAt(frame, Channel::lit_ambient, 16, 16).x}, lobe.x + lobe.y, 1e-5)
                    << frame.name << " " << degrees << " " << roughness;
        }
}

// The second UV set is mirrored left to right: the green texel is at the top left. A lightmap is
// irradiance over pi: a Lambertian base multiplies it by its colour, a metal reflects none of it.
TEST(Ambient, OfALightmap) {
    Scene scene = square();
    scene.lights.emplace_back().intensity = 0;
    scene.images.push_back({"light", 2, 2, {}});
    scene.images.back().rgba32 = {8, 0, 0, 1, 0, 4, 0, 1, 0, 0, 2, 1, 1, 1, 1, 1};
    scene.images.back().largest = 8;
    scene.textures.push_back({1, scene.textures[0].sampler});
    Material& m = scene.materials[0];
    m.metallic = 0;
    m.specular = 0;
    m.base_color = {0.5f, 0.5f, 0.5f, 1};
    m.lightmap_texture = {1, 1, {1, 0, 0}, {0, 1, 0}};
    m.lightmap_intensity = 3;
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, Channel::lit_ambient, 0, 0), {0, 6, 0}, 1e-5f, frame.name + " second set");
        expectColor(colorAt(frame, Channel::lit_ambient, 3, 0), {12, 0, 0}, 1e-5f, frame.name);
        expectColor(colorAt(frame, Channel::lightmap, 3, 3), {0, 0, 6}, 1e-6f, frame.name);
        EXPECT_EQ(colorAt(frame, Channel::lit, 0, 0), colorAt(frame, Channel::lit_ambient, 0, 0));
    }
    m.metallic = 1;
    for (const Frame& frame : draw(scene))
        EXPECT_EQ(colorAt(frame, Channel::lit_ambient, 0, 0), glm::vec3(0)) << "a metal has no base";
    m.metallic = 0;
    // Red: unoccluded at the top left of the first set, occluded at the right.
    m.occlusion_texture.texture = 0;
    for (const Frame& frame : draw(scene)) {
        expectColor(colorAt(frame, Channel::lit_ambient, 0, 0), {0, 6, 0}, 1e-5f, frame.name + " open");
        expectColor(colorAt(frame, Channel::lit_ambient, 3, 0), {0, 0, 0}, 1e-6f, frame.name + " occluded");
    }
    // An 8 bit lightmap is sRGB.
    m.occlusion_texture.texture = -1;
    m.lightmap_texture.texture = 0;
    for (const Frame& frame : draw(scene))
        expectColor(colorAt(frame, Channel::lightmap, 0, 3), 3.0f * greys, 3 * srgbTexel,
                    frame.name + " 8 bits");
}

TEST(Ambient, IsExactlyNothingWhereNoneIsAskedFor) {
    for (const Frame& frame : drawIn(loadScene("builtin:gallery"), {}, {96, 54}))
        for (const float value : frame.channels.at(Channel::lit_ambient).data)
            ASSERT_EQ(value, 0.0f) << frame.name;
}

// The table's error is at most 6e-5; float32 adds far less. 1e-4 is the tolerance of every light.
class AmbientReference : public testing::TestWithParam<std::string> {};

TEST_P(AmbientReference, BothPathsAreTheIntegral) {
    const Scene scene = loadScene(GetParam());
    const Size size{160, 90};
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = Path::reference;
    settings.size = size;
    settings.ambient = {0.3f, 0.4f, 0.5f};
    const Frame referenceFrame =
        drawAll(scene, {settings}, untimed({Channel::lit_ambient, Channel::material_id})).front();
    for (const Frame& path : drawIn(scene, settings.ambient, size)) {
        const Coverage covered = coverage(referenceFrame, path);
        const DebugMode& mode = debugMode(Channel::lit_ambient);
        const ChannelStats stats =
            channelStats(mode.error_kind, mode.kind, referenceFrame.channels.at(Channel::lit_ambient),
                         path.channels.at(Channel::lit_ambient), covered);
        RecordProperty(path.name, std::to_string(stats.max));
        EXPECT_LE(stats.max, 1e-4) << path.name;
        EXPECT_GT(stats.max, 0) << path.name << ": a table of 2048 samples cannot be the integral itself";
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, AmbientReference,
                         testing::Values("builtin:furnace", "builtin:gallery", "builtin:dielectrics",
                                         "builtin:normals", "builtin:lightmaps"),
                         sceneName);

}  // namespace
}  // namespace diptych::tests
