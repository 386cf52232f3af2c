// SPDX-License-Identifier: MIT
// Optimisations that skip work on the device (gathered uniforms, unread inputs, triangle normals) change
// no bit of the image.
#include "compare/experiment/prepared_pool.h"
#include "compare/experiment/references.h"
#include "compare/frames/frame_properties.h"
#include "shared/scene/load.h"
#include "tests/image/changed_view.h"
#include "tests/image/scenes.h"

#include <array>
#include <functional>

namespace diptych::tests {
namespace {

Settings smallFrame(Path path) {
    Settings settings = smallImage(GBufferEncoding::standard);
    settings.path = path;
    settings.lights = "point:40,spot:20";
    return settings;
}

void expectSame(const std::string& name, const Settings& settings,
                const std::function<void(PreparedView&)>& change) {
    const Scene scene = loadScene(name);
    const Image reduced = litWith(scene, settings, [](PreparedView&) {}),
                plain = litWith(scene, settings, change);
    EXPECT_EQ(differingPixels(reduced, plain, true), 0u) << name << ", " << nameOf(settings.path);
    if (name == "builtin:empty" || name == "builtin:background") return;
    EXPECT_GT(*std::max_element(reduced.data.begin(), reduced.data.end()), 0.0f) << name;
}

TEST(SkippedWork, TheViewIsTheSameFromEverySource) {
    const auto uniform = [](PreparedView& view) {
        EXPECT_EQ(view.inputs.variant.get(gpu::FEATURE_view_source) != gpu::VIEW_UNIFORM,
                  device().profile().gathers_uniforms);
        view.inputs.variant.set(gpu::FEATURE_view_source, gpu::VIEW_UNIFORM);
    };
    for (const Path path : {Path::deferred, Path::forward_plus})
        for (const Assignment assign : {Assignment::clustered, Assignment::tiled, Assignment::every}) {
            Settings settings = smallFrame(path);
            settings.assign = assign;
            for (const char* scene : {"builtin:gallery", "builtin:ortho"})
                expectSame(scene, settings, uniform);
            settings.size = {117, 63};
            expectSame("builtin:gallery", settings, uniform);
        }
}

// A texture transform needs all inputs; without a texture it has no effect.
TEST(SkippedWork, FewerInputsBringTheSameImageAsAll) {
    std::size_t scene = 0;
    for (const std::string& name : slice(builtinScenes(), 3))
        expectSame(name, smallFrame(scene++ % 2 == 0 ? Path::deferred : Path::forward_plus),
                   [](PreparedView& view) {
                       for (DrawItem& item : view.draws.items)
                           item.variant.set(gpu::FEATURE_texture_transform);
                   });
}

// The timed frame computes no triangle normals; a frame with captured normals is rendered again.
TEST(SkippedWork, WhatIsCapturedChangesNoOtherChannel) {
    const Scene scene = loadScene("builtin:gallery");
    for (const Path path : {Path::deferred, Path::forward_plus})
        for (const GBufferEncoding encoding :
             {GBufferEncoding::standard, GBufferEncoding::compact, GBufferEncoding::full}) {
            Settings settings = smallFrame(path);
            settings.gbuffer = encoding;
            RenderOptions lit, all;
            lit.channels = {Channel::lit};
            all.channels = allChannels();
            const Frame one = drawAll(scene, {settings}, lit).front(),
                        every = drawAll(scene, {settings}, all).front();
            EXPECT_EQ(differingPixels(one, every, Channel::lit, true), 0u)
                << nameOf(path) << ", " << nameOf(encoding);
        }
}

// Rows of an experiment take lit from the timed frame and make no pipelines that capture it.
TEST(SkippedWork, ARowOfAnExperimentDrawsLightOnce) {
    const Scene scene = loadScene("builtin:gallery");
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        Renderer renderer(device(), scene);
        RenderOptions options = experiment::litOptions({}, true);
        options.runs = 0;
        const Frame row = renderer.draw(smallFrame(path), options);
        const std::size_t made = renderer.pipelines();
        options.recheck = true;
        const Frame checked = renderer.draw(smallFrame(path), options);
        EXPECT_GT(renderer.pipelines(), made) << nameOf(path);
        for (const Channel channel : {Channel::lit, Channel::shadow_visibility})
            EXPECT_EQ(differingPixels(row, checked, channel, true), 0u)
                << nameOf(path) << " " << debugMode(channel).name;
    }
}

TEST(SkippedWork, AnExperimentReadsTheImageThatItTimes) {
    const Scene scene = loadScene("builtin:gallery");
    Renderer renderer(device(), scene);
    experiment::PreparedPool pool(renderer);
    const std::array frames{smallFrame(Path::deferred), smallFrame(Path::forward_plus)};
    const std::vector<double> ms = pool.time(frames, std::array<std::size_t, 4>{0, 1, 1, 0});
    EXPECT_EQ(ms.size(), 4u);
    EXPECT_TRUE(std::ranges::all_of(ms, [](double each) { return each > 0; }));
    RenderOptions options = experiment::litOptions({}, false);
    options.runs = 0;
    for (const Settings& settings : frames) {
        const Frame frame = renderer.draw(settings, options);
        const experiment::Shot& shot = pool.shot(settings);
        EXPECT_EQ(shot.settings, settings);
        EXPECT_EQ(differingPixels(shot.lit, frame.channels.at(Channel::lit), true), 0u)
            << nameOf(settings.path);
        EXPECT_EQ(shot.bytes.images + shot.bytes.buffers, frame.bytes.images + frame.bytes.buffers);
    }
}

// Overdraw is counted in a small image and scaled to the whole.
TEST(SkippedWork, OverdrawIsThatOfEverySize) {
    const Scene scene = loadScene("builtin:triangle");
    for (const Size size : {Size{160, 90}, Size{640, 360}, Size{1280, 720}}) {
        Settings settings = smallFrame(Path::forward_plus);
        settings.prepass = Switch::automatic;
        settings.size = size;
        RenderOptions options = untimed({Channel::lit});
        std::vector<std::string> said;
        options.on_step = [&](const std::string& step) { said.push_back(step); };
        const Frame frame = drawAll(scene, {settings}, options).front();
        const auto isOverdraw = [](const std::string& line) {
            return line.find(" 1.00 fragments per covered pixel") != line.npos;
        };
        EXPECT_TRUE(std::ranges::any_of(said, isOverdraw)) << size.width;
        EXPECT_FALSE(std::ranges::any_of(frame.notes, isOverdraw)) << "any scene has it: no note";
    }
}

// Objects are drawn front to back: hidden fragments then fail the depth test before shading. This also
// holds for an orthographic camera, whose w is always 1.
TEST(SkippedWork, DrawsGoFromNearToFar) {
    for (const char* name : {"builtin:spheres", "builtin:ortho"}) {
        const Scene scene = loadScene(name);
        SharedResources shared(device(), scene);
        const Settings settings = smallFrame(Path::forward_plus);
        const SceneView seen = makeSceneView(scene, viewRequest(settings));
        const PreparedView view(device(), shared, seen, settings);
        const std::vector<DrawItem>& items = view.draws.items;
        ASSERT_GT(items.size(), 1u) << name;
        EXPECT_TRUE(std::ranges::is_sorted(items, {}, &DrawItem::distance)) << name;
        EXPECT_LT(items.front().distance, items.back().distance) << name;
        // The ground of builtin:spheres encloses all spheres, so it is drawn last.
        if (name == std::string_view("builtin:spheres")) {
            EXPECT_EQ(items.back().range.index_count, 6u);
        }
    }
}

}  // namespace
}  // namespace diptych::tests
