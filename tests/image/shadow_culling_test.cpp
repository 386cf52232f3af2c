// SPDX-License-Identifier: MIT
// Culling shadow casters changes no bit of a shadow map that is sampled.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/shadow_scenes.h"

#include <fmt/format.h>

#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace diptych::tests {
namespace {

Settings shadowedBy(Shadows shadows, int size, int kernel) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.shadows = shadows;
    settings.shadow_size = size;
    settings.shadow_kernel = kernel;
    return settings;
}

// Compares culled casters with all casters.
void expectSame(Renderer& forNeeded, Renderer& forAll, Settings settings, const std::string& name) {
    const RenderOptions options =
        untimed({Channel::lit, Channel::shadow_visibility, Channel::local_visibility});
    const Frame needed = forNeeded.draw(settings, options);
    settings.shadow_casters = ShadowCasters::all;
    const Frame all = forAll.draw(settings, options);
    for (const Channel channel : options.channels)
        EXPECT_EQ(differingPixels(needed, all, channel), 0u) << name << " " << debugMode(channel).name;
}
// With separate renderers: clipmap pages are cached.
void expectSame(const Scene& scene, const Settings& settings, const std::string& name) {
    Renderer needed(device(), scene, pipelines()), all(device(), scene, pipelines());
    expectSame(needed, all, settings, name);
}

// Small boards all over the ground and beyond, in one primitive of many meshlets.
Primitive manyBoards(int material, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(-1, 1);
    Primitive boards;
    for (int i = 0; i < 1500; ++i) {
        const glm::vec3 at(9 * part(random), 0.6f + 0.6f * part(random), 9 * part(random));
        const Primitive one =
            rectangle(at, {0.15f, 0.1f * part(random), 0}, {0, 0.1f * part(random), -0.15f});
        const auto first = static_cast<std::uint32_t>(boards.positions.size());
        boards.positions.insert(boards.positions.end(), one.positions.begin(), one.positions.end());
        boards.normals.insert(boards.normals.end(), one.normals.begin(), one.normals.end());
        boards.tangents.insert(boards.tangents.end(), one.tangents.begin(), one.tangents.end());
        boards.texcoords[0].insert(boards.texcoords[0].end(), one.texcoords[0].begin(),
                                   one.texcoords[0].end());
        for (const std::uint32_t index : one.indices) boards.indices.push_back(first + index);
    }
    boards.material = material;
    return boards;
}

// Some boards cast at every border of the sampled part of a map.
Scene boardsUnder(const Light& sun, std::uint32_t seed) {
    Scene scene = groundUnder(sun, {manyBoards(1, seed), manyBoards(2, seed + 100)});
    // Low, so that part of the ground is out of view.
    scene.cameras.front().world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(2, 1.2, 3), glm::dvec3(-1, 0.4, -1), {0, 1, 0}));
    return scene;
}

TEST(ShadowCulling, ChangesNoBitAmongManyCasters) {
    std::uint32_t seed = 1;
    for (const double degrees : {8.0, 35.0, 80.0})
        for (const auto& [shadows, size, kernel] : {std::tuple{Shadows::pcf, 1024, 3},
                                                    {Shadows::pcf, 128, 7},
                                                    {Shadows::pcss, 256, 3},
                                                    {Shadows::evsm, 256, 5},
                                                    {Shadows::evsm4, 256, 7},
                                                    {Shadows::msm4, 256, 3},
                                                    {Shadows::clipmap, 512, 3}}) {
            Light sun = sunAt(degrees);
            sun.angle = shadows == Shadows::pcss ? 0.02f : 0.0f;
            expectSame(boardsUnder(sun, seed++), shadowedBy(shadows, size, kernel),
                       fmt::format("{} {} {}", degrees, nameOf(shadows), size));
        }
}

TEST(ShadowCulling, ChangesNoBitOfLocalShadows) {
    Scene scene = boardsUnder(sunAt(30), 99);
    scene.lights.clear();
    for (const double x : {-1.5, 0.5}) {
        Light lamp;
        lamp.position = {x, 1.5, 0.3};
        lamp.range = 3;
        lamp.intensity = 20;
        scene.lights.push_back(lamp);
    }
    Settings settings = shadowedBy(Shadows::pcf, 512, 3);
    settings.shadow_lights = 2;
    expectSame(scene, settings, "lamps");
}

class ShadowCullingOf : public testing::TestWithParam<std::string> {};

TEST_P(ShadowCullingOf, ChangesNoBit) {
    Renderer& renderer = uploaded(GetParam()).renderer;
    for (const Shadows shadows : {Shadows::pcf, Shadows::evsm})
        expectSame(renderer, renderer, shadowedBy(shadows, 512, 3), std::string(nameOf(shadows)));
    Settings fitted = shadowedBy(Shadows::pcf, 512, 3);
    fitted.shadow_fit = ShadowFit::depth;
    expectSame(renderer, renderer, fitted, "fitted");
}

INSTANTIATE_TEST_SUITE_P(Builtin, ShadowCullingOf,
                         testing::Values("builtin:gallery", "builtin:suns", "builtin:ortho", "builtin:cutout",
                                         "builtin:deep", "builtin:far_away"),
                         sceneName);

// Fewer triangles are drawn into the shadow maps.
TEST(ShadowCulling, LeavesOutMostOfWhatIsNotSeen) {
    const auto triangles = [](Settings settings) {
        const Scene scene = boardsUnder(sunAt(60), 5);
        SceneViews views(scene);
        SharedResources shared(device(), scene, pipelines());
        const PreparedFrame frame(device(), shared, views.at(viewRequest(settings)), settings);
        std::uint64_t sum = 0;
        for (const std::uint64_t count : frame.view.shadow.sun.triangles()) sum += count;
        return sum;
    };
    Settings settings = shadowedBy(Shadows::pcf, 512, 3);
    const std::uint64_t needed = triangles(settings);
    settings.shadow_casters = ShadowCasters::all;
    EXPECT_GT(needed, 0u);
    EXPECT_LT(2 * needed, triangles(settings));
}

}  // namespace
}  // namespace diptych::tests
