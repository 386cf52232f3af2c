// SPDX-License-Identifier: MIT
// Animated scenes: both paths render the current pose. Bits are equal wherever it is computed and whatever
// was rendered before, with every light assignment, shadows and haze. Positions match the reference's.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/scene/motion/animation.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <array>

namespace diptych::tests {
namespace {

// Everything that motion may affect: light lists, a shadowed sun, haze.
Settings movingImage(double time, const std::string& animation = {}) {
    Settings settings;
    settings.gbuffer = GBufferEncoding::full;
    settings.size = {128, 72};
    settings.lights = "point:12,spot:4";
    settings.shadow_size = 512;
    settings.shadow_cascades = 2;
    settings.shadow_lights = 1;
    settings.haze = true;
    settings.time = time;
    settings.animation = animation;
    return settings;
}

Frame drawnOnce(Renderer& renderer, Settings settings, Path path, const std::vector<Channel>& channels) {
    settings.path = path;
    return renderer.draw(settings, untimed(channels));
}

void expectSame(const Frame& a, const Frame& b, const std::string& what) {
    ASSERT_EQ(a.channels.size(), b.channels.size()) << what;
    for (const auto& [mode, image] : a.channels)
        EXPECT_EQ(differingPixels(image, b.channels.at(mode)), 0u)
            << what << ", channel " << debugMode(mode).name;
}

double lengthOf(const Animation& animation) {
    float last = 0;
    for (const Keyframes& keys : animation.keyframes) last = std::max(last, keys.times.back());
    return double{last};
}

// ---- parity ------------------------------------------------------------------------------------------

const std::vector<std::string> movingScenes{"builtin:motion", "builtin:tangents", "cesium_man/CesiumMan.gltf",
                                            "morph_stress_test/morph_stress_test.glb",
                                            "features/interpolation_test/InterpolationTest.gltf"};

class MovingParity : public SceneTest {};

// At the start, middle and end of each animation: all assignments in both paths, and both places of
// skinning.
TEST_P(MovingParity, PathsAndAssignmentsDrawTheSameBits) {
    UploadedScene& moving = uploaded(name());
    const std::vector<Channel> channels{Channel::lit, Channel::material_id, Channel::depth,
                                        Channel::shadow_visibility};
    std::size_t drawn = 0;
    for (std::size_t a = 0; a < moving.scene.animations.size(); ++a)
        for (const double part : {0.0, 0.5, 1.0}) {
            Settings settings = movingImage(part * lengthOf(moving.scene.animations[a]), std::to_string(a));
            // Lights beyond the per-pixel limit are evaluated per vertex, which `every` does not do.
            settings.pixel_lights = 64;
            settings.assign = Assignment::every;
            const Frame every = drawnOnce(moving.renderer, settings, Path::forward_plus, channels);
            drawn += coveredPixels(every);
            const auto same = [&](Path path) {
                expectSame(drawnOnce(moving.renderer, settings, path, channels), every,
                           fmt::format("animation {} at {} s, {}, {}, {}", a, settings.time,
                                       settings.valueOf("assign"), settings.valueOf("skinning"),
                                       path == Path::deferred ? "deferred" : "forward+"));
            };
            same(Path::deferred);
            for (const Assignment assign :
                 {Assignment::clustered, Assignment::tiled, Assignment::per_object}) {
                settings.assign = assign;
                same(Path::forward_plus);
                // A G-buffer does not store which object a pixel belongs to.
                if (assign != Assignment::per_object) same(Path::deferred);
            }
            settings.skinning = Skinning::vertex;
            same(Path::forward_plus);
            settings.assign = Assignment::clustered;
            same(Path::deferred);
        }
    EXPECT_GT(drawn, 100u);
}

TEST_P(MovingParity, KernelsAndVertexShadersPoseTheSameBits) {
    UploadedScene& moving = uploaded(name());
    Settings settings = movingImage(0.7);
    // Each vertex attribute affects one of them.
    const std::vector<Channel> channels{
        Channel::lit,   Channel::albedo,           Channel::normals, Channel::material_id, Channel::texcoords,
        Channel::depth, Channel::geometric_normal, Channel::tangent, Channel::handedness};
    const Frame forward = drawnOnce(moving.renderer, settings, Path::forward_plus, channels),
                deferred = drawnOnce(moving.renderer, settings, Path::deferred,
                                     {Channel::lit, Channel::material_id, Channel::depth});
    expectSameChannels(deferred, forward, 3);
    settings.skinning = Skinning::vertex;
    expectSameChannels(deferred,
                       drawnOnce(moving.renderer, settings, Path::deferred,
                                 {Channel::lit, Channel::material_id, Channel::depth}),
                       3);
    // A pre-pass computes the same depth as the shading draws.
    for (const Switch prepass : {Switch::on, Switch::off}) {
        settings.prepass = prepass;
        expectSameChannels(forward, drawnOnce(moving.renderer, settings, Path::forward_plus, channels),
                           channels.size());
    }
}

INSTANTIATE_TEST_SUITE_P(Scene, MovingParity, testing::ValuesIn(movingScenes), sceneName);

// Equal weights for a joint at rest and one scaled by 1/2 in x, computed by hand. The normal (1, 0, 1)
// becomes (1.5, 0, 1) with each joint's inverse transpose, and (4, 0, 3) with that of their mean.
TEST(Moving, NormalsOfSkinsGoByEachJointOrByTheirMean) {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.resize(1);
    Primitive& square = scene.meshes[0].primitives.emplace_back();
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.normals.assign(4, glm::normalize(glm::vec3(1, 0, 1)));
    square.tangents.assign(4, {0, 1, 0, 1});
    square.indices = {0, 1, 2, 0, 2, 3};
    square.joint_sets = {
        {std::vector<glm::u16vec4>(4, {0, 1, 0, 0}), std::vector<glm::vec4>(4, {0.5f, 0.5f, 0, 0})}};
    scene.skins = {{"", {1, 2}, {glm::mat4(1), glm::mat4(1)}, -1}};
    scene.nodes.resize(3);
    scene.nodes[0].mesh = scene.nodes[0].skin = 0;
    scene.nodes[2].parent_from_node[0].x = 0.5;
    scene.cameras.resize(1);
    scene.cameras[0].world_from_camera[3].z = 2;
    Renderer renderer(device(), scene, pipelines());
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {8, 8};
    for (const auto& [normals, expected] :
         {std::pair{SkinNormals::joints, glm::vec3(1.5f, 0, 1)}, {SkinNormals::blended, glm::vec3(4, 0, 3)}})
        for (const Skinning skinning : {Skinning::compute, Skinning::vertex}) {
            settings.skin_normals = normals;
            settings.skinning = skinning;
            for (const Frame& frame : bothPaths(renderer, settings, {Channel::normals})) {
                const float* const n = frame.channels.at(Channel::normals).pixel(4 * 8 + 4);
                EXPECT_LT(glm::distance(glm::vec3(n[0], n[1], n[2]), glm::normalize(expected)), 1e-6f)
                    << frame.name << ", " << nameOf(normals) << ", " << nameOf(skinning);
            }
        }
}

// ---- time --------------------------------------------------------------------------------------------

// Prepared frames of several times, in any order: none shows another's pose or shadows.
TEST(Moving, FramesOfSeveralTimesStayApart) {
    const Scene scene = loadScene("builtin:motion");
    using enum Shadows;
    for (const auto& [shadows, skinning] :
         {std::pair(pcf, Skinning::compute), {clipmap, Skinning::compute}, {pcf, Skinning::vertex}}) {
        std::vector<Settings> times;
        for (const double time : {0.0, 0.6, 1.7}) {
            times.push_back(movingImage(time));
            times.back().size = {96, 54};
            times.back().shadows = shadows;
            times.back().skinning = skinning;
        }
        std::vector<Image> alone;
        for (const Settings& settings : times) {
            Renderer renderer(device(), scene, pipelines());
            alone.push_back(
                drawnOnce(renderer, settings, Path::forward_plus, {Channel::lit}).channels.at(Channel::lit));
        }
        EXPECT_GT(differingPixels(alone[0], alone[1]), 100u);
        EXPECT_GT(differingPixels(alone[1], alone[2]), 100u);
        Renderer renderer(device(), scene, pipelines());
        for (Settings& settings : times) settings.path = Path::forward_plus;
        PreparedFrames frames = renderer.prepare(times);
        for (const std::size_t i : {0u, 2u, 1u, 2u, 0u}) {
            frames.draw(i);
            EXPECT_EQ(differingPixels(frames.lit(i), alone[i]), 0u)
                << times[i].time << " s, " << times[i].valueOf("shadows") << ", "
                << times[i].valueOf("skinning");
        }
    }
}

// The clipmap caches pages between images, except those that a moving caster touches.
TEST(Moving, ShadowsThatAreKeptFollowTheirCaster) {
    const Scene scene = loadScene("builtin:motion");
    Settings before = with(movingImage(0.2), "shadows clipmap clipmap-page-size 32");
    Settings after = before;
    after.time = 0.9;
    Renderer kept(device(), scene, pipelines()), fresh(device(), scene, pipelines());
    const Frame first = drawnOnce(kept, before, Path::deferred, {Channel::lit, Channel::shadow_visibility}),
                second = drawnOnce(kept, after, Path::deferred, {Channel::lit, Channel::shadow_visibility});
    expectSame(second, drawnOnce(fresh, after, Path::deferred, {Channel::lit, Channel::shadow_visibility}),
               "pages that were kept");
    EXPECT_GT(differingPixels(first, second, Channel::shadow_visibility), 10u);
    EXPECT_LT(second.counters.shadow_pages.drawn, second.counters.shadow_pages.resident);
}

// A masked square above a floor: its cutoff rises above its alpha, so its shadow vanishes. Behind it an
// opaque square becomes transmissive and stops casting a shadow as well.
Scene vanishingCasters() {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[0].alpha_mode = AlphaMode::mask;
    scene.materials[0].base_color.a = 0.5f;
    scene.materials[0].alpha_cutoff = 0.25f;
    scene.meshes.resize(3);
    scene.nodes.resize(3);
    for (std::size_t m = 0; m < 3; ++m) {
        const float half = m == 2 ? 8.0f : 0.8f, x = m == 0 ? -1.2f : m == 1 ? 1.2f : 0.0f;
        Primitive& square = scene.meshes[m].primitives.emplace_back();
        square.positions = {
            {x - half, 0, half}, {x + half, 0, half}, {x + half, 0, -half}, {x - half, 0, -half}};
        square.normals.assign(4, {0, 1, 0});
        square.tangents.assign(4, {1, 0, 0, 1});
        square.indices = {0, 1, 2, 0, 2, 3};
        square.material = static_cast<int>(m);
        scene.nodes[m].mesh = static_cast<int>(m);
        if (m < 2) scene.nodes[m].parent_from_node[3].y = 1.5;
    }
    Animation& animation = scene.animations.emplace_back();
    animation.keyframes = {{Interpolation::step, {0, 1}, {0.25f, 0.75f}, 1},
                           {Interpolation::step, {0, 1}, {0, 0.5f}, 1}};
    for (const AnimatedPart part : {AnimatedPart::alpha_cutoff, AnimatedPart::transmission}) {
        const int n = static_cast<int>(animation.channels.size());
        animation.channels.push_back({.keyframes = n, .part = part, .object = n});
    }
    scene.lights.push_back(sunAlong({0, -1, 0}, 3));
    scene.cameras.resize(1);
    scene.cameras[0].world_from_camera =
        glm::inverse(glm::lookAt(glm::dvec3(0, 6, 6), glm::dvec3(0), glm::dvec3(0, 1, 0)));
    return scene;
}

TEST(Moving, ShadowsThatAreKeptFollowTheirCastersMaterial) {
    const Scene scene = vanishingCasters();
    Settings before = movingImage(0.5);
    before.haze = false;
    before.lights = "";
    before.shadows = Shadows::clipmap;
    before.clipmap_page_size = 32;
    Settings after = before;
    after.time = 1.5;
    Renderer kept(device(), scene, pipelines()), fresh(device(), scene, pipelines());
    const Frame first = drawnOnce(kept, before, Path::deferred, {Channel::lit, Channel::shadow_visibility}),
                second = drawnOnce(kept, after, Path::deferred, {Channel::lit, Channel::shadow_visibility});
    expectSame(second, drawnOnce(fresh, after, Path::deferred, {Channel::lit, Channel::shadow_visibility}),
               "pages that were kept");
    EXPECT_GT(differingPixels(first, second, Channel::shadow_visibility), 100u);
}

// Another time of the same scene uploads only a pose and compiles nothing.
TEST(Moving, ASecondTimeCompilesNothing) {
    const Scene scene = loadScene("builtin:motion");
    Renderer renderer(device(), scene);
    drawnOnce(renderer, movingImage(0.7), Path::deferred, {});
    const std::size_t compiled = renderer.pipelines();
    drawnOnce(renderer, movingImage(1.3), Path::deferred, {});
    EXPECT_EQ(renderer.pipelines(), compiled);
}

// The skinning pass runs only if something is deformed at the image's time.
TEST(Moving, NothingIsPosedWhereNothingDeforms) {
    const auto passesOf = [](const std::string& name, Skinning skinning) {
        const Scene scene = loadScene(name);
        SharedResources shared(device(), scene, pipelines());
        SceneViews views(scene);
        Settings settings = movingImage(0.7);
        settings.skinning = skinning;
        const PreparedFrame frame(device(), shared, views.at(viewRequest(settings)), settings);
        return frame.passes.names();
    };
    const auto poses = [](const std::vector<std::string>& names) {
        return std::ranges::count(names, "pose");
    };
    EXPECT_EQ(poses(passesOf("builtin:triangle", Skinning::compute)), 0);
    EXPECT_EQ(poses(passesOf("builtin:motion", Skinning::compute)), 1);
    // Recomputed tangents depend on neighbours, so compute shaders make them in any case.
    EXPECT_EQ(poses(passesOf("builtin:motion", Skinning::vertex)), 1);
}

// ---- order and culling -------------------------------------------------------------------------------

// Two blended squares, each on its own joint. The second moves from behind the first to the front, then
// out of view.
Scene blendedSquares() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].base_color.a = 0.5f;
    scene.materials[0].double_sided = true;
    scene.meshes.resize(1);
    Primitive& square = scene.meshes[0].primitives.emplace_back();
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.normals.assign(4, {0, 0, 1});
    square.tangents.assign(4, {1, 0, 0, 1});
    square.indices = {0, 1, 2, 0, 2, 3};
    square.joint_sets = {
        {std::vector<glm::u16vec4>(4, {0, 0, 0, 0}), std::vector<glm::vec4>(4, {1, 0, 0, 0})}};
    scene.nodes.resize(4);
    for (std::size_t i = 0; i < 2; ++i) {
        scene.nodes[i].mesh = 0;
        scene.nodes[i].skin = static_cast<int>(i);
        scene.nodes[2 + i].transform = static_cast<int>(i);
        scene.transforms.emplace_back();
        scene.skins.push_back({"", {static_cast<int>(2 + i)}, {glm::mat4(1)}, -1});
    }
    Animation& animation = scene.animations.emplace_back();
    animation.keyframes = {{Interpolation::linear, {0, 1, 2}, {0, 0, -1, 0, 0, 1, 90, 0, 1}, 3}};
    animation.channels.resize(1);
    animation.channels[0].node = 3;
    animation.channels[0].keyframes = 0;
    animation.channels[0].part = AnimatedPart::translation;
    scene.cameras.resize(1);
    scene.cameras[0].world_from_camera[3] = {0, 0, 8, 1};
    return scene;
}

TEST(Moving, BlendedDrawsAreSortedAndCulledByTheLivePose) {
    const Scene scene = blendedSquares();
    SharedResources shared(device(), scene, pipelines());
    SceneViews views(scene);
    const auto drawnAt = [&](double time) {
        Settings settings = movingImage(time);
        settings.lights = "";
        const SceneView& view = views.at(viewRequest(settings));
        const DrawList draws =
            makeDrawList(view.pose, shared.geometry, shared.materials(TexturePrecision::device), view.view);
        std::vector<std::uint32_t> order;
        for (const DrawItem& item : draws.blended())
            if (order.empty() || order.back() != item.instance) order.push_back(item.instance);
        return order;
    };
    EXPECT_EQ(drawnAt(0), (std::vector<std::uint32_t>{1, 0}));
    EXPECT_EQ(drawnAt(1), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(drawnAt(2), (std::vector<std::uint32_t>{0}));
}

// Triangles sorted on the host match fragments sorted on the device.
TEST(Moving, TrianglesOfTheLivePoseAreBlendedInTheirOrder) {
    UploadedScene& moving = uploaded("builtin:motion");
    Settings settings = movingImage(0.7);
    settings.transparency = Transparency::triangles;
    const Frame triangles = drawnOnce(moving.renderer, settings, Path::forward_plus, {Channel::lit});
    settings.transparency = Transparency::list;
    const Frame fragments = drawnOnce(moving.renderer, settings, Path::forward_plus, {Channel::lit});
    settings.transparency = Transparency::off;
    const Frame without = drawnOnce(moving.renderer, settings, Path::forward_plus, {Channel::lit});
    const Image &a = triangles.channels.at(Channel::lit), &b = fragments.channels.at(Channel::lit);
    EXPECT_GT(differingPixels(a, without.channels.at(Channel::lit)), 50u);
    // Both blend float32 back to front; a list rounds each fragment's contribution once more.
    for (std::size_t i = 0; i < a.data.size(); ++i)
        ASSERT_NEAR(a.data[i], b.data[i], 1e-5f * std::max(1.0f, std::abs(b.data[i]))) << i;
}

// ---- positions of the reference ----------------------------------------------------------------------

// Silhouettes in float32 and in double differ only where an edge passes a pixel's centre.
TEST_P(MovingParity, SilhouettesAreTheReferences) {
    UploadedScene& moving = uploaded(name());
    for (const double time : {0.3, 0.7}) {
        Settings settings = movingImage(time);
        settings.haze = false;
        settings.lights = "";
        settings.shadow_lights = 0;
        const Frame drawn = drawnOnce(moving.renderer, settings, Path::forward_plus,
                                      {Channel::lit, Channel::material_id, Channel::depth});
        Settings asked = settings;
        asked.reference_mode = ReferenceMode::scene;
        const Frame truth = drawnOnce(moving.renderer, asked, Path::reference,
                                      {Channel::lit, Channel::material_id, Channel::depth});
        EXPECT_LE(differingPixels(drawn, truth, Channel::material_id, true), 3u) << time;
        EXPECT_GT(coveredPixels(drawn), 100u);
        const Image &a = drawn.channels.at(Channel::depth), &b = truth.channels.at(Channel::depth);
        std::size_t apart = 0;
        for (std::size_t i = 0; i < a.data.size(); ++i)
            apart += std::abs(a.data[i] - b.data[i]) > 1e-4f * std::abs(b.data[i]);
        EXPECT_LE(apart, 3u) << time;
        // Control: a stale pose is far off.
        settings.time = 0;
        const Frame stale = drawnOnce(moving.renderer, settings, Path::forward_plus, {Channel::lit});
        EXPECT_GT(differingPixels(stale, drawn, Channel::lit), 20u) << time;
    }
}

}  // namespace
}  // namespace diptych::tests
