// SPDX-License-Identifier: MIT
// The window's drawing thread produces the same results as the other commands, and it survives errors.
#include "compare/explain/pixel_breakdown.h"
#include "compare/frames/frame_properties.h"
#include "compare/image/channel_image.h"
#include "compare/output/writers.h"
#include "compare/render/renderer.h"
#include "compare/viewer/drawing/drawing_thread.h"
#include "compare/viewer/drawing/drawing_work.h"
#include "compare/viewer/drawing/mailbox.h"
#include "compare/viewer/window/fly_camera.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/load.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>

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
    EXPECT_EQ(losses, 996) << "a try and three more";
    EXPECT_EQ(drawing.status().error, "Vulkan: vkQueueSubmit: the device was lost");
    losses = 0;
    request.subject.settings.gbuffer = GBufferEncoding::full;
    ASSERT_TRUE(isDrawn(drawing, request)) << drawing.status().error;
}

// The drawing thread's work, and what it publishes in order: "smaller", "whole" or "moving" images, "pixel",
// "times" and "verdict".
class DrawingSteps {
public:
    explicit DrawingSteps(std::function<void()> before_image = {}) {
        options_.before_image = std::move(before_image);
    }
    ~DrawingSteps() {
        box.request([&] { box.stopping = true; });
        thread_.join();
    }

    Mailbox box{[this] { take(); }};
    std::function<void(const std::string&)> on_image;  // called by the drawing thread

    std::uint64_t ask(DrawRequest request) {
        box.request([&] {
            request.id = ++id_;
            box.wanted = request;
            box.waiting = false;
        });
        return request.id;
    }
    // The steps until the request is complete.
    std::vector<std::string> stepsOf(const DrawRequest& request) {
        steps_.clear();
        ask(request);
        EXPECT_TRUE(soon([&] { return box.get(&Mailbox::waiting); })) << box.get(&Mailbox::status).doing;
        return steps_;
    }

private:
    void take() {
        if (box.shown &&
            (!shown_ || box.shown->request.id != shown_->request.id || box.shown->size != shown_->size)) {
            const DrawRequest& request = box.shown->request;
            steps_.emplace_back(request.moving                                     ? "moving"
                                : box.shown->size == request.subject.settings.size ? "whole"
                                                                                   : "smaller");
            shown_ = box.shown;
            if (on_image) on_image(steps_.back());
        }
        if (box.breakdown != breakdown_) steps_.emplace_back("pixel");
        if (box.shown && box.shown->request.id == shown_->request.id &&
            box.shown->paths[0].measurement > shown_->paths[0].measurement)
            steps_.emplace_back("times");
        if (box.evaluated != evaluated_) steps_.emplace_back("verdict");
        shown_ = box.shown;
        breakdown_ = box.breakdown;
        evaluated_ = box.evaluated;
    }

    DrawingOptions options_ = validated();
    std::uint64_t id_ = 0;
    std::vector<std::string> steps_;
    std::shared_ptr<const DrawnView> shown_;
    std::shared_ptr<const Breakdown> breakdown_;
    std::shared_ptr<const EvaluatedPair> evaluated_;
    std::thread thread_{[this] { runDrawing(options_, box); }};
};
using Steps = std::vector<std::string>;

TEST(DrawingThread, AStillViewIsDrawnTimedAndJudgedOnce) {
    DrawingSteps drawing;
    DrawRequest request = requestOf("builtin:points");
    request.pixel = PixelPosition{30, 20};
    EXPECT_EQ(drawing.stepsOf(request), (Steps{"smaller", "whole", "pixel", "times", "verdict"}));
    // The other path on the right, another exposure and every channel need no other images.
    request.subject.settings.path = drawn_paths[0];
    request.view_options.exposure = 2;
    EXPECT_EQ(drawing.stepsOf(request), Steps{"whole"});
    EXPECT_EQ(drawing.box.shown->panels[1].name, nameOf(drawn_paths[0]));
    request.view_options.mode = Channel::normals;
    EXPECT_EQ(drawing.stepsOf(request), Steps{"whole"});
    request.pixel->x = 31;
    EXPECT_EQ(drawing.stepsOf(request), (Steps{"whole", "pixel"}));
    EXPECT_EQ(drawing.box.breakdown->pixel, (PixelPosition{31, 20}));
    // A moving view has images and nothing else.
    request.subject.settings.camera = "eye=0,1,8 target=0,0,0";
    request.moving = true;
    EXPECT_EQ(drawing.stepsOf(request), Steps{"moving"});
    EXPECT_TRUE(drawing.box.shown->depth.empty());
    request.moving = false;
    Steps steps = drawing.stepsOf(request);
    std::erase(steps, "smaller");  // on a busy machine
    EXPECT_EQ(steps, (Steps{"whole", "pixel", "times", "verdict"}));
    EXPECT_EQ(drawing.box.shown->depth.width, 64);
    EXPECT_EQ(drawing.box.evaluated->subject, ofBothPaths(request.subject));
}

// A request that comes between two steps: what it shares with the earlier one is not drawn again, and the
// rest of the earlier one is not drawn at all.
TEST(DrawingThread, ALaterRequestGoesOnFromTheEarlierOne) {
    DrawingSteps drawing;
    const DrawRequest first = requestOf("builtin:points");
    DrawRequest other = first, brighter = first;
    other.subject.settings.gbuffer = brighter.subject.settings.gbuffer = GBufferEncoding::compact;
    brighter.view_options.exposure = 2;
    std::map<std::uint64_t, Steps> images;  // by request
    drawing.on_image = [&](const std::string& image) {
        const std::uint64_t id = drawing.box.shown->request.id;
        images[id].push_back(image);
        if (id == 1) drawing.ask(other);
        if (id == 2 && image == "whole") drawing.ask(brighter);
    };
    drawing.ask(first);
    ASSERT_TRUE(soon([&] { return drawing.box.get(&Mailbox::waiting); }));
    std::erase(images[2], "smaller");
    EXPECT_EQ(images, (std::map<std::uint64_t, Steps>{{1, {"smaller"}}, {2, {"whole"}}, {3, {"whole"}}}));
    EXPECT_EQ(drawing.box.shown->panels[0].image.data.size(), 3u * 64 * 36);
    EXPECT_EQ(drawing.box.evaluated->subject, ofBothPaths(brighter.subject));
}

// The request is given up, and the next one tries again.
TEST(DrawingThread, AnErrorIsSaidUntilTheNextImage) {
    std::function<void()> fail;
    DrawingSteps drawing([&] {
        if (fail) fail();
    });
    const DrawRequest request = requestOf("builtin:points", 16, 9);
    const std::pair<std::function<void()>, const char*> errors[] = {
        {[] { throw std::bad_alloc(); }, "out of memory; try a smaller size"},
        {[] { throw std::runtime_error("no luck"); }, "no luck"}};
    for (const auto& [error, message] : errors) {
        fail = error;
        EXPECT_EQ(drawing.stepsOf(request), Steps()) << message;
        const Status status = drawing.box.get(&Mailbox::status);
        EXPECT_EQ(status.error, message);
        EXPECT_EQ(status.doing, "");
        EXPECT_FALSE(status.loading);
    }
    DrawRequest missing = request;
    missing.subject.scene = "nowhere.glb";
    EXPECT_EQ(drawing.stepsOf(missing), Steps());
    EXPECT_FALSE(drawing.box.get(&Mailbox::status).loading);
    EXPECT_NE(drawing.box.get(&Mailbox::status).error, "");
    drawing.box.request([&] { drawing.box.save_to = "/dev/null/folder"; });
    ASSERT_TRUE(soon([&] { return !drawing.box.get(&Mailbox::saved).empty(); }));
    EXPECT_EQ(drawing.box.get(&Mailbox::saved).find("not written: "), 0u) << drawing.box.saved;
    fail = {};
    EXPECT_EQ(drawing.stepsOf(request).back(), "verdict");
    EXPECT_EQ(drawing.box.get(&Mailbox::status).error, "");
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
