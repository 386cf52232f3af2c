// SPDX-License-Identifier: MIT
// Triangles that --cull removes change no bit of an image, and the device does not process them.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/placed_balls.h"

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

Settings cullingSettings(Path path, Size size = {160, 90}) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = path;
    settings.size = size;
    return settings;
}

// These distinguish surfaces and their lighting.
const std::vector<Channel> fewChannels{Channel::lit, Channel::normals, Channel::depth, Channel::material_id};

void expectSameCulled(Renderer& renderer, Settings settings, const std::string& name,
                      const std::vector<Channel>& channels) {
    RenderOptions options;
    options.channels = channels;
    options.runs = 0;
    settings.cull = true;
    const Frame culled = renderer.draw(settings, options);
    settings.cull = false;
    const Frame all = renderer.draw(settings, options);
    EXPECT_GE(culled.channels.size(), 4u);
    ASSERT_EQ(culled.channels.size(), all.channels.size());
    for (const auto& [mode, image] : culled.channels)
        EXPECT_EQ(differingPixels(image, all.channels.at(mode)), 0u)
            << name << " " << nameOf(settings.path) << " " << debugMode(mode).name;
}

void expectSameInBothPaths(Renderer& renderer, const std::string& name,
                           const std::function<void(Settings&)>& change = {},
                           const std::vector<Channel>& channels = fewChannels) {
    for (const Path path : drawn_paths) {
        Settings settings = cullingSettings(path);
        if (change) change(settings);
        expectSameCulled(renderer, settings, name, channels);
    }
}

class CullingOf : public testing::TestWithParam<std::string> {};

TEST_P(CullingOf, ChangesNoBit) {
    Renderer& renderer = uploaded(GetParam()).renderer;
    expectSameInBothPaths(renderer, "plain", {}, allChannels());
    expectSameInBothPaths(renderer, "four samples", [](Settings& s) { s.msaa = 4; });
}

INSTANTIATE_TEST_SUITE_P(Builtin, CullingOf,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:coplanar",
                                         "builtin:ortho", "builtin:cutout", "builtin:glass",
                                         "builtin:mirrored", "builtin:stretched", "builtin:motion",
                                         "builtin:far_away", "builtin:deep"),
                         [](const auto& scene) { return testName(scene.param.substr(8)); });

TEST(Culling, ChangesNoBitUnderAnySetting) {
    Renderer& gallery = uploaded("builtin:gallery").renderer;
    for (const Shadows shadows : {Shadows::off, Shadows::pcf, Shadows::evsm, Shadows::clipmap})
        expectSameInBothPaths(gallery, fmt::format("shadows {}", nameOf(shadows)), [&](Settings& s) {
            s.shadows = shadows;
            s.shadow_size = 256;
        });
    expectSameInBothPaths(gallery, "fitted shadows", [](Settings& s) { s.shadow_fit = ShadowFit::depth; });
    expectSameInBothPaths(gallery, "pre-pass", [](Settings& s) { s.prepass = Switch::on; });
    expectSameInBothPaths(gallery, "tiled", [](Settings& s) { s.assign = Assignment::tiled; });
    expectSameInBothPaths(gallery, "by object", [](Settings& s) { s.assign = Assignment::per_object; });
    expectSameInBothPaths(gallery, "16 bits of depth",
                          [](Settings& s) { s.depth_format = DepthFormat::d16; });
    expectSameInBothPaths(gallery, "samples shaded", [](Settings& s) {
        s.msaa = 4;
        s.msaa_shading = MsaaShading::sample;
    });
    Renderer& motion = uploaded("builtin:motion").renderer;
    for (const Skinning skinning : {Skinning::compute, Skinning::vertex})
        for (const double time : {0.3, 1.1})
            expectSameInBothPaths(motion, fmt::format("{} {}", nameOf(skinning), time), [&](Settings& s) {
                s.skinning = skinning;
                s.time = time;
            });
    Renderer& blended = uploaded("builtin:crossed").renderer;
    for (const auto& [transparency, name] : enumNames<Transparency>())
        expectSameInBothPaths(blended, std::string(name),
                              [&, order = transparency](Settings& s) { s.transparency = order; });
}

TEST(Culling, ChangesNoBitAmongPlacedBalls) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const Scene scene = placedBalls(seed);
        Renderer renderer(device(), scene, pipelines());
        expectSameInBothPaths(renderer, fmt::format("seed {}", seed));
        expectSameInBothPaths(renderer, fmt::format("seed {}, larger", seed), [](Settings& s) {
            s.size = {400, 225};
        });
    }
}

// At most half of a ball seen from outside is drawn.
TEST(Culling, SparesADeviceWhatFacesAwayAndLiesBeyond) {
    Settings settings = cullingSettings(Path::deferred, {1280, 720});
    const auto counts = [&](bool cull) {
        settings.cull = cull;
        const Scene& scene = uploaded("builtin:spheres").scene;
        SceneViews views(scene);
        SharedResources shared(device(), scene, pipelines());
        const PreparedView view(device(), shared, views.at(viewRequest(settings)), settings);
        return drawnCounts(view.draws, shared.geometry, view.culling);
    };
    const DrawnCounts all = counts(false), culled = counts(true);
    EXPECT_EQ(all.drawn, all.in_view);
    EXPECT_EQ(culled.in_view, all.in_view);
    EXPECT_LT(100 * culled.drawn, 40 * all.drawn);
    EXPECT_LT(2 * culled.vertices, all.vertices);
}

}  // namespace
}  // namespace diptych::tests
