// SPDX-License-Identifier: MIT
// Materials animated to a time: both paths match a scene with those static materials bit for bit. The
// textures are uploaded once.
#include "tests/image/square.h"
#include "tests/support/layer_table.h"

#include "shared/scene/motion/pose.h"

#include <functional>

namespace diptych::tests {
namespace {

// Keyframes at 0 s and 1 s.
void moveMaterial(Scene& scene, AnimatedPart part, std::vector<float> values, int element = 0) {
    if (scene.animations.empty()) scene.animations.emplace_back();
    Animation& a = scene.animations[0];
    const std::size_t width = values.size() / 2;
    a.channels.push_back(
        {.keyframes = static_cast<int>(a.keyframes.size()), .part = part, .object = 0, .element = element});
    a.keyframes.push_back({Interpolation::linear, {0, 1}, std::move(values), width});
}

Scene squareBeforeAnother() {
    Scene scene = square();
    scene.lights = {sunAlong(glm::normalize(glm::dvec3(0.3, 0.2, -1)))};
    // A square behind it, visible through transmission.
    scene.materials.push_back({});
    scene.materials[1].base_color = {0.1f, 0.7f, 0.3f, 1};
    scene.materials[1].metallic = 0;
    Mesh behind = scene.meshes[0];
    for (glm::vec3& p : behind.primitives[0].positions) p.z = -0.5f;
    behind.primitives[0].material = 1;
    scene.meshes.push_back(behind);
    scene.nodes.push_back({"behind", -1, glm::dmat4(1.0), 1});
    return scene;
}

struct MovingMaterial {
    const char* name;
    std::function<void(Scene&)> change;
};

const std::vector<MovingMaterial>& movingMaterials() {
    static const std::vector<MovingMaterial> all{
        {"factors",
         [](Scene& s) {
             moveMaterial(s, AnimatedPart::base_color, {1, 0, 0, 1, 0, 0.5f, 1, 1});
             moveMaterial(s, AnimatedPart::metallic, {1, 0});
             moveMaterial(s, AnimatedPart::roughness, {1, 0.25f});
             moveMaterial(s, AnimatedPart::ior, {1.5f, 2});
             moveMaterial(s, AnimatedPart::specular_color, {1, 1, 1, 0.2f, 0.4f, 0.8f});
         }},
        {"specular-glossiness",
         [](Scene& s) {
             s.materials[0].specular_glossiness = true;
             s.materials[0].metallic = s.materials[0].ior = 0;
             s.materials[0].specular_color_texture.texture = 0;
             moveMaterial(s, AnimatedPart::base_color, {1, 0, 0, 1, 0, 0.5f, 1, 1});
             moveMaterial(s, AnimatedPart::specular_f0, {1, 1, 1, 0.2f, 0.4f, 0.8f});
             moveMaterial(s, AnimatedPart::glossiness, {0.25f, 1});
         }},
        // At rest no texture of these slots is read: their factors are zero.
        {"emission begins",
         [](Scene& s) {
             s.materials[0].emissive_texture.texture = 0;
             moveMaterial(s, AnimatedPart::emissive, {0, 0, 0, 2, 2, 2});
         }},
        {"bumps and occlusion begin",
         [](Scene& s) {
             s.materials[0].normal_texture.texture = 0;
             s.materials[0].occlusion_texture.texture = 0;
             s.materials[0].normal_scale = s.materials[0].occlusion_strength = 0;
             moveMaterial(s, AnimatedPart::normal_scale, {0, 0.5f});
             moveMaterial(s, AnimatedPart::occlusion_strength, {0, 1});
         }},
        {"a texture turns",
         [](Scene& s) {
             s.materials[0].base_color_texture.texture = 0;
             moveMaterial(s, AnimatedPart::texture_rotation, {0, 1.5707964f}, 0);
             moveMaterial(s, AnimatedPart::texture_offset, {0, 0, 0.125f, 1}, 0);
         }},
        {"a mask closes",
         [](Scene& s) {
             s.materials[0].alpha_mode = AlphaMode::mask;
             s.materials[0].base_color.a = 0.5f;
             moveMaterial(s, AnimatedPart::alpha_cutoff, {0.25f, 0.75f});
         }},
        {"transmission begins",
         [](Scene& s) {
             s.materials[0].metallic = 0;
             moveMaterial(s, AnimatedPart::transmission, {0, 0.5f});
         }},
        {"layers begin",
         [](Scene& s) {
             for (const TestedLayer& layer : testedLayers(~gpu::LAYER_TRANSMISSION)) {
                 const LayerFactor& first = layer.factors[0];
                 s.materials[0] = layer.off(s.materials[0], 0);
                 std::vector<float> keys(2 * first.width(), 0);
                 for (std::size_t i = 0; i < first.width(); ++i)
                     keys[first.width() + i] = first.typical[static_cast<int>(i)];
                 moveMaterial(s, first.part, keys);
             }
         }},
    };
    return all;
}

// Radiance and its inputs only: fewer channels need fewer pipelines.
const std::vector<Channel> shownChannels{Channel::lit, albedo, normals, emission, occlusion};

TEST(AnimatedMaterials, AreDrawnAsAtRest) {
    for (const MovingMaterial& c : movingMaterials()) {
        Scene moving = squareBeforeAnother();
        c.change(moving);
        Renderer renderer(device(), moving, pipelines());
        for (const double seconds : {0.5, 1.0}) {
            Scene still = moving;
            still.materials = poseAt(moving, seconds).materials;
            still.animations.clear();
            ASSERT_EQ(still.materials.size(), 2u);
            Settings settings = smallImage(GBufferEncoding::full);
            settings.size = {8, 8};
            const std::vector<Frame> expected = bothPaths(still, settings, shownChannels);
            settings.time = seconds;
            const std::vector<Frame> got = bothPaths(renderer, settings, shownChannels);
            for (std::size_t path = 0; path < 2; ++path) {
                SCOPED_TRACE(std::string(c.name) + " " + got[path].name + " at " + std::to_string(seconds));
                expectSameChannels(expected[path], got[path], shownChannels.size());
            }
            SCOPED_TRACE(c.name);
            expectSameChannels(got[0], got[1], shownChannels.size());
        }
    }
}

// Control: an image with the materials of 0 s differs.
TEST(AnimatedMaterials, MotionChangesTheImage) {
    for (const MovingMaterial& c : movingMaterials()) {
        Scene moving = squareBeforeAnother();
        c.change(moving);
        Renderer renderer(device(), moving, pipelines());
        Settings settings = smallImage(GBufferEncoding::full);
        settings.size = {8, 8};
        const std::vector<Frame> start = bothPaths(renderer, settings, {Channel::lit});
        settings.time = 1;
        const std::vector<Frame> end = bothPaths(renderer, settings, {Channel::lit});
        for (std::size_t path = 0; path < 2; ++path)
            EXPECT_GT(differingPixels(start[path], end[path], Channel::lit, true), 30u)
                << c.name << " " << start[path].name;
    }
}

}  // namespace
}  // namespace diptych::tests
