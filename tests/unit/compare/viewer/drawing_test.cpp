// SPDX-License-Identifier: MIT
// Parts of the drawing thread that need no device.
#include "compare/frames/frame_properties.h"
#include "compare/render/reference_frame.h"
#include "compare/viewer/drawing/mailbox.h"
#include "compare/viewer/drawing/pair_renderer.h"
#include "compare/viewer/drawing/properties.h"
#include "compare/viewer/drawing/reference_thread.h"
#include "tests/support/frames.h"
#include "tests/support/plain_builtin.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::viewer {
namespace {

// ---- settings of an image --------------------------------------------------------------------------------

TEST(ViewerDrawing, EachPathHasItsSettingsAtTheSizeOfTheImage) {
    Subject subject;
    subject.settings.size = {640, 360};
    subject.settings.path = Path::forward_plus;
    subject.settings.time = 1.5;
    subject.sides.words = {{{{"assign", "tiled"}}, {{"assign", "clustered"}}}};
    for (const Path path : drawn_paths) {
        Settings expected = subject.sides.of(subject.settings, path);
        EXPECT_EQ(settingsOf(subject, path, subject.settings.size), expected);
        EXPECT_EQ(expected.valueOf("assign"), path == Path::deferred ? "tiled" : "clustered");
        EXPECT_EQ(expected.path, path);
    }
    subject.sides = {};
    subject.settings.msaa = 3;
    EXPECT_THROW(settingsOf(subject, Path::deferred, {64, 36}), std::runtime_error);
}

// Shadow maps shrink with the image, down to 256 texels; a smaller one stays.
TEST(ViewerDrawing, ShadowMapsShrinkWithTheImage) {
    const struct {
        int shadow_size, width, expected;
    } rows[] = {{2048, 640, 2048}, {2048, 320, 1024}, {2048, 160, 512}, {2048, 40, 256},
                {256, 320, 256},   {128, 640, 128},   {128, 320, 128}};
    for (const auto& [shadow_size, width, expected] : rows) {
        Subject subject;
        subject.settings.size = {640, 360};
        subject.settings.shadow_size = shadow_size;
        const Settings settings = settingsOf(subject, Path::deferred, {width, 9});
        EXPECT_EQ(settings.shadow_size, expected) << shadow_size << " at " << width;
        EXPECT_EQ(settings.size, (Size{width, 9}));
    }
}

TEST(ViewerDrawing, ChannelsComeWithThoseThatImagesNeed) {
    using Channels = std::vector<Channel>;
    EXPECT_EQ(channelOptions({Channel::normals}).channels,
              (Channels{Channel::normals, Channel::lit, Channel::material_id, Channel::depth}));
    EXPECT_EQ(channelOptions({Channel::depth, Channel::lit}).channels,
              (Channels{Channel::depth, Channel::lit, Channel::material_id}));
    EXPECT_EQ(channelOptions({}).runs, 0) << "times are measured apart";
    EXPECT_EQ(channelOptions(everyChannel()).channels, everyChannel());
}

// ---- messages of the validation layers -------------------------------------------------------------------

TEST(ViewerMailbox, KeepsTheFirstMessageAndTheLastCount) {
    Mailbox box([] {});
    box.count(0, "");
    EXPECT_EQ(box.first_validation_message, "");
    box.count(2, "first");
    box.count(5, "of another device");
    EXPECT_EQ(box.first_validation_message, "first");
    EXPECT_EQ(box.validation_messages, 5u);
}

// ---- properties ------------------------------------------------------------------------------------------

TEST(ViewerProperties, LightsOfAPixelAreThoseOfCoveredPixels) {
    Frame frame = flatFrame(Path::deferred, 2, 2);
    frame.time.median = 3;
    frame.passes = {{"geometry", 2}};
    frame.notes = {"a note"};
    frame.counters.lights = 7;
    frame.bytes.images = 5;
    PathProperties properties;
    properties.mean_lights = properties.max_lights = 9;
    takeProperties(frame, false, properties);
    EXPECT_EQ(properties.name, "deferred");
    EXPECT_EQ(properties.notes, frame.notes);
    EXPECT_EQ(properties.counters.lights, 7u);
    EXPECT_EQ(properties.bytes.images, 5u);
    EXPECT_EQ(properties.ms, 0);
    EXPECT_EQ(properties.measurement, 0u);
    EXPECT_EQ(properties.mean_lights, std::nullopt);
    EXPECT_EQ(properties.max_lights, std::nullopt);
    Image& lights = frame.channels[Channel::light_count] = Image(2, 2, 1, 1);
    lights.at(1, 0) = 3;
    lights.at(1, 1) = 8;
    frame.channels[Channel::material_id].at(1, 1) = -1;  // background
    takeProperties(frame, true, properties);
    EXPECT_EQ(properties.ms, 3);
    ASSERT_EQ(properties.passes.size(), 1u);
    EXPECT_EQ(properties.measurement, 1u);
    EXPECT_DOUBLE_EQ(properties.mean_lights.value_or(0), 5.0 / 3);
    EXPECT_EQ(properties.max_lights, 3);
    frame.channels[Channel::material_id] = Image(2, 2, 1, -1);
    takeProperties(frame, true, properties);
    EXPECT_EQ(properties.measurement, 2u);
    EXPECT_EQ(properties.mean_lights, 0);
}

TEST(ViewerProperties, AScenesDurationIsThatOfItsLongestAnimation) {
    Scene scene;
    scene.name = "A scene";
    scene.notes = {"a note"};
    for (const double end : {1.0, 2.5, 2.0}) {
        Animation& animation = scene.animations.emplace_back();
        animation.name = std::to_string(end).substr(0, 3);
        animation.keyframes.emplace_back();
        animation.keyframes.emplace_back().times = {0, static_cast<float>(end)};
    }
    const SceneProperties properties = propertiesOf(scene, "a.glb");
    EXPECT_EQ(properties.scene, "a.glb");
    EXPECT_EQ(properties.name, "A scene");
    EXPECT_EQ(properties.duration, 2.5);
    EXPECT_EQ(properties.animations, (std::vector<std::string>{"1.0", "2.5", "2.0"}));
    EXPECT_EQ(properties.notes, scene.notes);
}

// ---- the reference ---------------------------------------------------------------------------------------

TEST(ViewerReference, IsTheImageOfTheCommandsAndStopsWithoutAnyRest) {
    const auto scene = std::make_shared<const Scene>(plainBuiltin("triangle"));
    Settings settings;
    settings.size = {16, 9};
    settings.reference_mode = ReferenceMode::scene;
    settings = referenceSettings(settings);
    std::mutex mutex;
    std::condition_variable more;
    int wakes = 0;
    ReferenceThread thread([&] {
        const std::lock_guard lock(mutex);
        ++wakes;
        more.notify_all();
    });
    EXPECT_EQ(thread.done(), 0);
    EXPECT_EQ(thread.settings(), std::nullopt);
    thread.begin(scene, settings, {});
    {
        std::unique_lock lock(mutex);
        ASSERT_TRUE(more.wait_for(lock, std::chrono::minutes(1), [&] { return thread.done() == 1; }));
        EXPECT_GT(wakes, 1) << "for the tile and for the end";
    }
    EXPECT_EQ(thread.error(), "");
    const auto frame = thread.frame({}, nullptr);
    RenderOptions options;
    options.runs = 0;
    options.channels = {Channel::lit};
    const std::vector<Frame> expected = drawWithoutDevice(*scene, {settings}, options);
    EXPECT_EQ(frame->channels.at(Channel::lit).data, expected[0].channels.at(Channel::lit).data);
    EXPECT_EQ(frame->name, "reference");
    thread.stop();
    EXPECT_EQ(thread.settings(), settings) << "a finished image stays";
    EXPECT_EQ(thread.frame({}, nullptr), frame);

    settings.size = {64, 64};
    thread.begin(scene, settings, {});
    EXPECT_EQ(thread.settings(), settings);
    thread.stop();
    EXPECT_EQ(thread.settings(), std::nullopt) << "nothing of an unfinished one";
    EXPECT_LT(thread.done(), 1);
}

}  // namespace
}  // namespace diptych::viewer
