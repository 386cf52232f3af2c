// SPDX-License-Identifier: MIT
// Instances of one small mesh are drawn together, and look as if each were a mesh of its own.
#include "compare/render/prepared_view.h"
#include "shared/contract/debug_mode.h"
#include "tests/image/shadow_scenes.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace diptych::tests {
namespace {

constexpr int flagCount = 90;

// Randomly rotated flags on a ground, some mirrored. `apart`: each has its own copy of the mesh.
Scene flags(bool apart, std::uint32_t seed, const std::function<void(Scene&)>& change = {}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1);
    Scene scene = groundUnder(sunAt(40));
    scene.materials[1].double_sided = false;
    const Mesh flag{"flag", {rectangle({-0.3, 0, 0}, {0.6, 0, 0}, {0, 0.5, 0.2}, 1)}};
    for (int i = 0; i < flagCount; ++i) {
        const glm::dvec3 at(3 * part(random), 0.1, 3 * part(random));
        const double turned = 3.1 * part(random), size = 0.5 + 0.2 * part(random);
        if (apart || i == 0) scene.meshes.push_back(flag);
        scene.nodes.push_back(
            {"flag", -1,
             glm::scale(glm::rotate(glm::translate(glm::dmat4(1), at), turned, glm::dvec3(0, 1, 0)),
                        glm::dvec3(i % 5 == 3 ? -size : size, size, size)),
             static_cast<int>(scene.meshes.size()) - 1});
    }
    for (int i = 0; i < 12; ++i) {
        Light lamp;
        lamp.kind = LightKind::point;
        lamp.position = {3 * part(random), 0.6, 3 * part(random)};
        lamp.intensity = 4;
        lamp.range = 1.5;
        scene.lights.push_back(lamp);
    }
    if (change) change(scene);
    return scene;
}

Settings instanceSettings(Path path) {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.path = path;
    settings.size = {200, 120};
    return settings;
}

DrawnCounts countsOf(const Scene& scene, const Settings& settings) {
    SceneViews views(scene);
    SharedResources shared(device(), scene, pipelines());
    const PreparedView view(device(), shared, views.at(viewRequest(settings)), settings);
    return drawnCounts(view.draws, shared.geometry, view.culling);
}

void expectTheSame(const std::string& name, const std::function<void(Scene&)>& changeScene = {},
                   const std::function<void(Settings&)>& change = {}) {
    SCOPED_TRACE(name);
    const Scene together = flags(false, 7, changeScene), apart = flags(true, 7, changeScene);
    Renderer ofTogether(device(), together, pipelines()), ofApart(device(), apart, pipelines());
    const RenderOptions options =
        untimed({Channel::lit, Channel::normals, Channel::depth, Channel::material_id});
    for (const Path path : drawn_paths) {
        Settings settings = instanceSettings(path);
        if (change) change(settings);
        for (const bool cull : {true, false}) {
            settings.cull = cull;
            const Frame a = ofTogether.draw(settings, options), b = ofApart.draw(settings, options);
            ASSERT_EQ(a.channels.size(), b.channels.size());
            for (const auto& [mode, image] : a.channels)
                EXPECT_EQ(differingPixels(image, b.channels.at(mode)), 0u)
                    << nameOf(path) << " " << debugMode(mode).name << " cull " << cull;
            EXPECT_EQ(a.counters.unreproduced_pixels, 0u);
        }
    }
}

TEST(Instances, LookAsIfEachWereAMeshOfItsOwn) {
    expectTheSame("one-sided");
    expectTheSame("double-sided", [](Scene& s) { s.materials[1].double_sided = true; });
    expectTheSame("masked", [](Scene& s) {
        s.materials[1].alpha_mode = AlphaMode::mask;
        s.materials[1].alpha_cutoff = 0.3f;
    });
    expectTheSame("blended", [](Scene& s) {
        s.materials[1].alpha_mode = AlphaMode::blend;
        s.materials[1].base_color.a = 0.6f;
    });
    expectTheSame("shadows", {}, [](Settings& s) { s.shadows = Shadows::pcf; });
    expectTheSame("clipmap", {}, [](Settings& s) { s.shadows = Shadows::clipmap; });
    expectTheSame("lights by object", {}, [](Settings& s) { s.assign = Assignment::per_object; });
    expectTheSame("samples", {}, [](Settings& s) { s.msaa = 4; });
    expectTheSame("pre-pass", {}, [](Settings& s) { s.prepass = Switch::on; });
    EXPECT_EQ(device().validationMessages(), 0u) << device().firstValidationMessage();
}

// One draw for the ground and, for each handedness, one for each distance step.
TEST(Instances, TakeFewerDraws) {
    for (const bool cull : {true, false}) {
        Settings settings = instanceSettings(Path::deferred);
        settings.cull = cull;
        const DrawnCounts together = countsOf(flags(false, 7), settings),
                          apart = countsOf(flags(true, 7), settings);
        EXPECT_LT(2 * together.draws, apart.draws) << cull;
        EXPECT_EQ(apart.draws, apart.instances) << cull;
        EXPECT_GE(together.instances, apart.instances) << "gaps are drawn";
        if (!cull) {
            EXPECT_EQ(together.instances, std::uint64_t{flagCount + 1});
        }
        EXPECT_EQ(together.in_view, apart.in_view);
    }
}

// If few are visible, long gaps between them are not drawn.
TEST(Instances, ThatCannotShowAreLeftOut) {
    const auto facingAway = [](Scene& scene) {
        for (std::size_t i = 1; i < scene.nodes.size(); ++i)
            scene.nodes[i].parent_from_node =
                glm::translate(glm::dmat4(1), glm::dvec3(0.01 * static_cast<double>(i), 0.2, 0)) *
                glm::rotate(glm::dmat4(1), i % 80 == 1 ? 0.0 : 3.14, glm::dvec3(0, 1, 0));
    };
    Settings settings = instanceSettings(Path::deferred);
    const DrawnCounts counts = countsOf(flags(false, 7, facingAway), settings);
    EXPECT_LT(counts.instances, std::uint64_t{flagCount / 2});
    EXPECT_GE(counts.instances, 2u);
}

}  // namespace
}  // namespace diptych::tests
