// SPDX-License-Identifier: MIT
// The sun's shadow on blended surfaces far in front of opaque ones. Fitted maps and requested pages must
// cover the blended surfaces too.
#include "compare/frames/frame_properties.h"
#include "tests/image/shadow_scenes.h"

#include <algorithm>
#include <cmath>

namespace diptych::tests {
namespace {

// A blended pane 2 m before the camera, a wall 38 m behind it, field of view 10 degrees. Three strips out
// of view cast shadows on the pane; their shadows on the wall would fall beside it.
Scene paneUnderStrips() {
    std::vector<Primitive> standing{
        rectangle({-15, -15, -40}, {30, 0, 0}, {0, 30, 0}),
        rectangle({-0.15f, -0.1f, -2}, {0.3f, 0, 0}, {0, 0.2f, 0}, 2),
    };
    for (const float x : {1.08f, 1.18f, 1.28f})
        standing.push_back(rectangle({x, 0.8f, -0.76f}, {0.04f, 0, 0}, {0, 0.4f, 0}));
    Light sun = sunAt(45);
    sun.direction = -glm::normalize(glm::dvec3(1.2, 1, 1.24));
    Scene scene = groundUnder(sun, std::move(standing));
    scene.meshes[0].primitives.erase(scene.meshes[0].primitives.begin());  // the ground
    scene.materials[2].alpha_mode = AlphaMode::blend;
    scene.materials[2].base_color = {0.9f, 0.9f, 0.9f, 0.8f};
    scene.materials[2].metallic = 0;
    scene.materials[0].base_color = {0.2f, 0.2f, 0.2f, 1};
    scene.cameras[0].world_from_camera = glm::dmat4(1);
    scene.cameras[0].yfov = glm::radians(10.0);
    return scene;
}

// The fraction of the pane's pixels whose error exceeds half of the shadow's contrast.
double wrongFraction(const Frame& frame, const Frame& reference) {
    const Image &made = frame.channels.at(Channel::lit), &truth = reference.channels.at(Channel::lit);
    std::vector<float> seen;
    for (std::size_t i = 0; i < truth.pixels(); ++i)
        if (*reference.blended.pixel(i) > 0) seen.push_back(*truth.pixel(i));
    const auto [min, max] = std::ranges::minmax(seen);
    EXPECT_GT(max, 3 * min) << "no shadow lies on the pane";
    EXPECT_GT(seen.size(), 1000u);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.pixels(); ++i)
        if (*reference.blended.pixel(i) > 0)
            wrong += std::abs(*made.pixel(i) - *truth.pixel(i)) > (max - min) / 2;
    return static_cast<double>(wrong) / static_cast<double>(seen.size());
}

// Shadow edges are accurate to a pixel: a fiftieth of the pane. Texels of 2 cm are as wide as two of its
// pixels.
TEST(BlendedShadow, IsTheSameWithEveryFitAndWithPages) {
    const Scene scene = paneUnderStrips();
    Renderer renderer(device(), scene, pipelines());
    Settings settings = smallImage(GBufferEncoding::full);
    settings.shadows = Shadows::pcf;
    Settings truth = settings;
    truth.path = Path::reference;
    const Frame reference = renderer.draw(truth, untimed({Channel::lit}));
    Settings depth = settings, pages = settings;
    depth.shadow_fit = ShadowFit::depth;
    pages.shadows = Shadows::clipmap;
    pages.clipmap_page_size = 64;
    pages.clipmap_pages = 2048;
    for (const Settings& each : {settings, depth, pages}) {
        const std::vector<Frame> frames = bothPaths(renderer, each, {Channel::lit});
        EXPECT_EQ(differingPixels(frames[0], frames[1], Channel::lit), 0u);
        EXPECT_LE(wrongFraction(frames[0], reference), 6.0 / 77)
            << nameOf(each.shadows) << " " << nameOf(each.shadow_fit);
    }
}

}  // namespace
}  // namespace diptych::tests
