// SPDX-License-Identifier: MIT
// If everything in view is blended, deferred has no G-buffer and its image equals that of forward+.
#include "compare/render/path_plan.h"
#include "tests/image/square.h"

#include <algorithm>

namespace diptych::tests {
namespace {

// A pane before the background, lit by a sun and a lamp; optionally with a wall behind it.
Scene blendedPane(bool wall) {
    Scene scene = square();
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].base_color = {0.8f, 0.4f, 0.2f, 0.5f};
    if (wall) {
        scene.materials.push_back({});
        scene.meshes.push_back(scene.meshes[0]);
        scene.meshes[1].primitives[0].material = 1;
        scene.nodes.push_back({"wall", -1, glm::translate(glm::dmat4(1), {0.3, 0, -1}), 1});
    }
    const Light sun = sunAlong({0, -0.6, -0.8});
    Light lamp;
    lamp.position = {0.5, 0.5, 0.5};
    lamp.intensity = 3;
    scene.lights = {sun, lamp};
    return scene;
}

std::vector<std::string> deferredPasses(const Scene& scene, const Settings& settings) {
    SceneViews views(scene);
    return planPaths(device(), views, {settings}).front().passes;
}

TEST(BlendedAlone, HasNoGBufferAndTheSameImage) {
    for (const bool wall : {false, true}) {
        const Scene scene = blendedPane(wall);
        for (const char* change : {"", "msaa=4", "lighting=compute", "assign=tiled", "haze=on"}) {
            Settings settings = smallImage(GBufferEncoding::full);
            settings.size = {48, 27};
            const std::string text = change;
            if (!text.empty()) settings.set(text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
            settings.path = Path::deferred;
            const std::vector<std::string> passes = deferredPasses(scene, settings);
            EXPECT_EQ(std::ranges::count(passes, "G-buffer"), wall ? 1 : 0) << text;
            Settings forward = settings;
            forward.path = Path::forward_plus;
            const RenderOptions options = untimed(
                {Channel::lit, Channel::material_id, albedo, Channel::depth, Channel::geometric_normal});
            const std::vector<Frame> frames = drawAll(scene, {settings, forward}, options);
            for (const Channel channel : options.channels)
                EXPECT_EQ(differingPixels(frames[0], frames[1], channel), 0u)
                    << text << " " << debugMode(channel).name << (wall ? ", with a wall" : "");
            const Image& image = frames[0].channels.at(Channel::lit);
            EXPECT_GT(*image.pixel(image.pixels() / 2), 0) << "the pane is seen";
            EXPECT_EQ(frames[0].counters.unreproduced_pixels, 0u);
        }
    }
}

}  // namespace
}  // namespace diptych::tests
