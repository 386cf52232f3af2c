// SPDX-License-Identifier: MIT
// Triangles that --cull removes change no bit of an image, and the device does not process them.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/placed_balls.h"

#include <fmt/format.h>

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
    const RenderOptions options = untimed(channels);
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

// With options (with()) beyond cullingSettings().
void expectSameInBothPaths(Renderer& renderer, const std::string& options = "",
                           const std::vector<Channel>& channels = fewChannels) {
    for (const Path path : drawn_paths)
        expectSameCulled(renderer, with(cullingSettings(path), options), options, channels);
}

class CullingOf : public testing::TestWithParam<std::string> {};

TEST_P(CullingOf, ChangesNoBit) {
    Renderer& renderer = uploaded(GetParam()).renderer;
    expectSameInBothPaths(renderer, "", allChannels());
    expectSameInBothPaths(renderer, "msaa 4");
}

INSTANTIATE_TEST_SUITE_P(Builtin, CullingOf,
                         testing::Values("builtin:gallery", "builtin:spheres", "builtin:coplanar",
                                         "builtin:ortho", "builtin:cutout", "builtin:glass",
                                         "builtin:mirrored", "builtin:stretched", "builtin:motion",
                                         "builtin:far_away", "builtin:deep"),
                         sceneName);

TEST(Culling, ChangesNoBitUnderAnySetting) {
    Renderer& cutout = uploaded("builtin:cutout").renderer;
    for (const char* options :
         {"shadows off shadow-size 256", "shadows pcf shadow-size 256", "shadows evsm shadow-size 256",
          "shadows clipmap shadow-size 256", "shadow-fit depth", "prepass on", "assign tiled",
          "assign per_object", "depth-format d16", "msaa 4 msaa-shading sample"})
        expectSameInBothPaths(cutout, options);
    Renderer& motion = uploaded("builtin:motion").renderer;
    for (const char* skinning : {"compute", "vertex"})
        for (const char* time : {"0.3", "1.1"})
            expectSameInBothPaths(motion, fmt::format("skinning {} time {}", skinning, time));
    Renderer& blended = uploaded("builtin:crossed").renderer;
    for (const auto& [transparency, name] : enumNames<Transparency>())
        expectSameInBothPaths(blended, fmt::format("transparency {}", name));
}

TEST(Culling, ChangesNoBitAmongPlacedBalls) {
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const Scene scene = placedBalls(seed);
        Renderer renderer(device(), scene, pipelines());
        for (const char* options : {"", "size 400x225"}) {
            SCOPED_TRACE(seed);
            expectSameInBothPaths(renderer, options);
        }
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
