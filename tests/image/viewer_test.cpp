// SPDX-License-Identifier: MIT
// The window's drawing thread produces the same results as the other commands, and it survives errors.
#include "compare/explain/pixel_breakdown.h"
#include "compare/frames/frame_properties.h"
#include "compare/image/channel_image.h"
#include "compare/output/writers.h"
#include "compare/render/renderer.h"
#include "compare/viewer/drawing/drawing_thread.h"
#include "compare/viewer/window/fly_camera.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/load.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace diptych::viewer {
namespace {

DrawingOptions validated() {
    DrawingOptions options;
    options.device.validate = true;
    options.wake = [] {};
    return options;
}

DrawRequest requestOf(const std::string& scene, int width = 64, int height = 36) {
    DrawRequest request;
    request.subject.scene = scene;
    request.subject.settings.size.width = width;
    request.subject.settings.size.height = height;
    return request;
}

// Waits for it; only a thread that hangs exceeds the limit.
template <class Condition>
bool soon(const Condition& condition) {
    for (const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
         std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(std::chrono::milliseconds(5)))
        if (condition()) return true;
    return false;
}

// Sends a request and waits for its complete result.
bool isDrawn(DrawingThread& drawing, const DrawRequest& request) {
    const std::uint64_t id = drawing.ask(request);
    return soon([&] {
        const auto shown = drawing.shown();
        return drawing.idle() && shown && shown->request.id == id;
    });
}

Frame drawn(Device& device, const Scene& scene, const Settings& settings,
            const std::vector<Channel>& channels) {
    RenderOptions options;
    options.channels = channels;
    options.runs = 0;
    return Renderer(device, scene).draw(settings, options);
}

TEST(DrawingThread, ItsPanelsAreTheImagesOfBothPaths) {
    DrawingThread drawing(validated());
    DrawRequest request = requestOf("builtin:points");
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
    const auto shown = drawing.shown();
    const Scene scene = loadScene("builtin:points");
    Device device({});
    std::array<Frame, 2> frames;
    for (std::size_t i = 0; i < 2; ++i) {
        Settings settings = request.subject.settings;
        settings.path = drawn_paths.at(i);
        frames.at(i) = drawn(device, scene, settings, {Channel::lit, Channel::material_id});
    }
    const Exposure exposure =
        exposureFor({}, &frames[0].channels.at(Channel::lit), coverage(frames[0], frames[0]));
    const Frame* both[] = {&frames[0], &frames[1]};
    const ImageScale scale = scaleFor(debugMode(Channel::lit), exposure, both);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(shown->panels.at(i).name, nameOf(drawn_paths.at(i)));
        EXPECT_EQ(shown->panels.at(i).values.data, frames.at(i).channels.at(Channel::lit).data);
        EXPECT_EQ(shown->panels.at(i).image.data,
                  channelImage(debugMode(Channel::lit), frames.at(i), scale).data);
        EXPECT_FALSE(shown->paths.at(i).passes.empty());
        EXPECT_GT(shown->paths.at(i).ms, 0);
    }
    // There is also a verdict on every channel: both paths agree.
    const auto evaluated = drawing.evaluated();
    ASSERT_TRUE(evaluated);
    EXPECT_TRUE(evaluated->report.passed());
    // Without shaded_samples, which needs MSAA.
    EXPECT_EQ(evaluated->report.comparisons.at(0).channels.size(), debugModes().size() - 1);
    EXPECT_FALSE(shown->plan.empty());
    // The drag pivot is known with the image: from depth, equal to the position channel.
    const Image& position = evaluated->report.frames.at(0).channels.at(Channel::position);
    std::size_t seen = 0;
    for (int y = 0; y < position.height; y += 3)
        for (int x = 0; x < position.width; x += 3) {
            const std::optional<glm::dvec3> at = seenAt(shown->view, shown->depth, {x, y});
            if (!at) continue;
            ++seen;
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR((*at - shown->view.eye())[c], double{position.at(x, y, c)},
                            1e-5 * double{shown->depth.at(x, y)})
                    << x << "," << y;
            }
        }
    EXPECT_GT(seen, 0u);
    EXPECT_EQ(drawing.validationMessages(), 0u) << drawing.firstValidationMessage();
}

TEST(DrawingThread, TheReferenceComesTileByTileToWhatTheOtherCommandsDraw) {
    DrawingThread drawing(validated());
    DrawRequest request = requestOf("builtin:points");
    request.view_options.against = Against::reference;
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
    ASSERT_TRUE(soon([&] { return drawing.shown()->reference_done >= 1 && drawing.idle(); }));
    const auto shown = drawing.shown();
    EXPECT_EQ(shown->panels[0].name, "reference");
    const Scene scene = loadScene("builtin:points");
    Device device({});
    const Frame reference = drawn(device, scene, referenceSettings(request.subject.settings), {Channel::lit});
    EXPECT_EQ(shown->panels[0].values.data, reference.channels.at(Channel::lit).data);
    // Both paths are compared with it and with each other.
    ASSERT_TRUE(
        soon([&] { return drawing.evaluated() && drawing.evaluated()->report.comparisons.size() == 3; }));
    EXPECT_TRUE(drawing.evaluated()->report.passed());
}

TEST(DrawingThread, APixelsStoryIsThatOfTheCommand) {
    DrawingThread drawing(validated());
    DrawRequest request = requestOf("builtin:points");
    request.pixel = PixelPosition{30, 20};
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
    const auto breakdown = drawing.breakdown();
    ASSERT_TRUE(breakdown);
    const Scene scene = loadScene("builtin:points");
    Device device({});
    SceneViews views(scene);
    Renderer renderer(device, views);
    Settings deferred = request.subject.settings, forward = request.subject.settings;
    deferred.path = Path::deferred;
    forward.path = Path::forward_plus;
    const PixelBreakdown same = pixelBreakdown(renderer, views,
                                               {.x = 30,
                                                .y = 20,
                                                .baseline = deferred,
                                                .test = forward,
                                                .reference = referenceSettings(request.subject.settings),
                                                .device = reportDevice(device)});
    EXPECT_EQ(breakdown->text, inText(blocksOf(same)));
}

TEST(DrawingThread, WhatMovesIsDrawnAndThenWhatStandsStill) {
    DrawingThread drawing(validated());
    DrawRequest request = requestOf("builtin:points", 320, 180);
    request.moving = true;
    for (int i = 0; i < 20; ++i) {
        request.subject.settings.camera = "eye=0," + std::to_string(1 + 0.1 * i) + ",8 target=0,0,0";
        drawing.ask(request);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    // Requests faster than images do not starve them.
    ASSERT_TRUE(soon([&] { return drawing.shown() != nullptr; }));
    request.moving = false;
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
    EXPECT_EQ(drawing.shown()->size, request.subject.settings.size);
    EXPECT_EQ(drawing.shown()->camera.eye[2], 8);
    EXPECT_EQ(drawing.validationMessages(), 0u) << drawing.firstValidationMessage();
}

TEST(DrawingThread, ASceneThatCannotBeReadLeavesTheOldOne) {
    DrawingThread drawing(validated());
    DrawRequest request = requestOf("builtin:points");
    ASSERT_TRUE(isDrawn(drawing, request));
    const auto before = drawing.shown();
    DrawRequest broken = request;
    broken.subject.scene = "nowhere.glb";
    drawing.ask(broken);
    ASSERT_TRUE(soon([&] { return !drawing.status().error.empty(); }));
    EXPECT_NE(drawing.status().error.find("nowhere.glb"), std::string::npos);
    EXPECT_EQ(drawing.shown()->panels[0].values.data, before->panels[0].values.data);
    ASSERT_TRUE(isDrawn(drawing, request));
    EXPECT_TRUE(drawing.status().error.empty()) << drawing.status().error;
}

// A lost device is recreated and the image rendered after all. If it is lost repeatedly, the request is
// given up; the next request tries again.
TEST(DrawingThread, ALostDeviceIsMadeAnew) {
    std::atomic<int> losses{1};
    DrawingOptions options = validated();
    options.before_image = [&losses] {
        if (losses > 0) {
            --losses;
            throw std::runtime_error("Vulkan: vkQueueSubmit: the device was lost");
        }
    };
    DrawingThread drawing(std::move(options));
    DrawRequest request = requestOf("builtin:points");
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
    EXPECT_EQ(losses, 0);
    EXPECT_TRUE(drawing.status().error.empty());
    losses = 1000;
    request.subject.settings.gbuffer = GBufferEncoding::compact;
    drawing.ask(request);
    ASSERT_TRUE(soon([&] { return losses <= 996 && drawing.idle(); }));
    EXPECT_NE(drawing.status().error.find("lost"), std::string::npos);
    losses = 0;
    request.subject.settings.gbuffer = GBufferEncoding::full;
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
}

TEST(DrawingThread, EveryChannelOfBothPathsIsThereOrSaysWhyNot) {
    DrawingThread drawing(validated());
    DrawRequest request = requestOf("builtin:points", 32, 18);
    for (const DebugMode& mode : debugModes()) {
        request.view_options.mode = mode.channel;
        request.view_options.difference = Difference::absolute;
        ASSERT_TRUE(isDrawn(drawing, request)) << mode.name << drawing.status().error;
        for (const Panel& panel : drawing.shown()->panels) {
            EXPECT_EQ(panel.image.data.empty(), !panel.missing.empty()) << mode.name;
        }
        EXPECT_TRUE(drawing.shown()->difference) << mode.name;
    }
}

}  // namespace
}  // namespace diptych::viewer
