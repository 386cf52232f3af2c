// SPDX-License-Identifier: MIT
// Parts of the viewer, without a window: keys, differences, sizes, settings, watched files.
#include "compare/image/channel_image.h"
#include "compare/viewer/drawing/drawing_thread.h"
#include "compare/viewer/drawing/image_cost.h"
#include "compare/viewer/drawing/images.h"
#include "compare/viewer/interface/interface.h"
#include "compare/viewer/interface/keys.h"
#include "compare/viewer/scene_watch.h"
#include "shared/frame/debug_modes.h"
#include "tests/support/files.h"
#include "tests/support/frames.h"
#include "tests/support/sources.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <set>

namespace diptych::viewer {
namespace {

TEST(ViewerHistory, KeepsTheLastTimesOfEveryMeasurement) {
    History history;
    PathProperties properties;
    for (std::size_t i = 1; i <= History::longest + 5; ++i) {
        properties.ms = static_cast<double>(i);
        properties.passes = {{"geometry", 2 * properties.ms}};
        properties.measurement = i;
        history.add(properties);
        history.add(properties);  // the same measurement
        EXPECT_EQ(history.total.size(), std::min(i, History::longest));
    }
    EXPECT_EQ(history.total.front(), 6);
    EXPECT_EQ(history.total.back(), History::longest + 5);
    EXPECT_EQ(history.passes.at("geometry").front(), 12);
}

// ---- keys ------------------------------------------------------------------------------------------------

TEST(ViewerKeys, NoKeyDoesTwoThings) {
    std::set<std::pair<int, bool>> seen;
    for (const KeyBinding& binding : keyBindings())
        for (int key = binding.key; key <= std::max(binding.key, binding.last); ++key) {
            EXPECT_TRUE(seen.emplace(key, binding.control).second) << binding.name;
        }
}

TEST(ViewerKeys, ARowOfDigitsTellsWhichOne) {
    for (int digit = 0; digit < 10; ++digit)
        for (const int first : {GLFW_KEY_0, GLFW_KEY_KP_0}) {
            const auto press = actionOf(first + digit, false);
            ASSERT_TRUE(press) << digit;
            EXPECT_EQ(press->action, Action::channel);
            EXPECT_EQ(press->index, digit);
        }
    EXPECT_FALSE(actionOf(GLFW_KEY_F12, false));
}

// With Ctrl, only bindings that name it act; other keys do nothing.
TEST(ViewerKeys, WithControlOnlyWhatNamesItActs) {
    EXPECT_EQ(actionOf(GLFW_KEY_Q, false)->action, Action::light_debug);
    EXPECT_EQ(actionOf(GLFW_KEY_Q, true)->action, Action::quit);
    EXPECT_FALSE(actionOf(GLFW_KEY_W, true));
    EXPECT_FALSE(actionOf(GLFW_KEY_P, true));
}

TEST(ViewerKeys, TheHelpHasThemAll) {
    for (const KeyBinding& binding : keyBindings())
        EXPECT_NE(keyColumns().find(fmt::format("  {:<8}{}\n", binding.name, binding.does)),
                  std::string::npos);
}

TEST(ViewerKeys, TheReadmeHasTheTable) {
    const Files files = sources();
    EXPECT_NE(files.at("compare/viewer/README.md").find(keyTable()), std::string::npos) << keyTable();
}

// ---- images and differences ------------------------------------------------------------------------------

TEST(ViewerDifference, SignedIsRightLessLeftWhereItIsLargest) {
    const Frame left = flatFrame(Path::deferred, 2, 1, 0.5f);
    Frame right = flatFrame(Path::deferred, 2, 1, 0.5f);
    right.channels[Channel::lit].at(0, 0, 1) = 0.75f;   // + 0.25
    right.channels[Channel::lit].at(0, 0, 2) = 0.375f;  // - 0.125, smaller
    right.channels[Channel::lit].at(1, 0, 0) = 0.0f;    // - 0.5
    ViewOptions view_options;
    view_options.difference = Difference::signed_difference;
    const DifferencePanel panel = differenceOf(left, right, view_options);
    EXPECT_EQ(panel.values.at(0, 0), 0.25f);
    EXPECT_EQ(panel.values.at(1, 0), -0.5f);
    EXPECT_TRUE(panel.is_signed);
    // Blue where right is darker, orange where it is brighter.
    const std::uint8_t* const p = panel.image.data.data();
    EXPECT_GT(p[0], p[2]);
    EXPECT_LT(p[3], p[5]);
}

TEST(ViewerDifference, AbsoluteAndRelativeAreTheMetrics) {
    const Frame left = flatFrame(Path::deferred, 1, 1, 0.5f), right = flatFrame(Path::deferred, 1, 1, 0.75f);
    ViewOptions view_options;
    view_options.difference = Difference::absolute;
    EXPECT_EQ(differenceOf(left, right, view_options).values.at(0, 0), 0.25f);
    view_options.difference = Difference::relative;
    EXPECT_EQ(differenceOf(left, right, view_options).values.at(0, 0), 0.5f);
}

TEST(ViewerDifference, FlipIsOfColoursAndSaysSo) {
    Frame left = flatFrame(Path::deferred, 16, 16, 0.5f), right = flatFrame(Path::deferred, 16, 16, 0.25f);
    ViewOptions view_options;
    view_options.difference = Difference::flip;
    const DifferencePanel panel = differenceOf(left, right, view_options);
    EXPECT_TRUE(panel.missing.empty()) << panel.missing;
    EXPECT_EQ(panel.top, 1);
    EXPECT_GT(panel.values.at(8, 8), 0.05f);
    left.channels[Channel::normals] = Image(16, 16, 3, 0.5f);
    right.channels[Channel::normals] = Image(16, 16, 3, 0.5f);
    view_options.mode = Channel::normals;
    EXPECT_NE(differenceOf(left, right, view_options).missing.find("normals"), std::string::npos);
}

TEST(ViewerDifference, WhatCannotBeComparedSaysWhy) {
    ViewOptions view_options;
    view_options.difference = Difference::absolute;
    EXPECT_NE(
        differenceOf(flatFrame(Path::deferred, 2, 2, 0), flatFrame(Path::deferred, 3, 2, 0), view_options)
            .missing.find("2x2"),
        std::string::npos);
    view_options.mode = Channel::normals;
    EXPECT_NE(
        differenceOf(flatFrame(Path::deferred, 2, 2, 0), flatFrame(Path::deferred, 2, 2, 0), view_options)
            .missing.find("normals"),
        std::string::npos);
}

// The panels equal the output of `render`.
TEST(ViewerImages, AreImagesOfTheChannel) {
    Frame left = flatFrame(Path::deferred, 3, 2, 0.5f), right = flatFrame(Path::deferred, 3, 2, 0.25f);
    left.channels[Channel::material_id].at(2, 1) = -1;
    ViewOptions view_options;
    view_options.exposure = 2;
    DrawnView shown;
    const Exposure exposure = exposureOf(left, right, view_options);
    EXPECT_EQ(exposure.factor, 2);
    makeImages(left, right, view_options, exposure, shown);
    const Frame* frames[] = {&left};
    EXPECT_EQ(shown.panels[0].image.data,
              channelImage(debugMode(Channel::lit), left, scaleFor(debugMode(Channel::lit), exposure, frames))
                  .data);
    EXPECT_FALSE(shown.difference);
    view_options.mode = Channel::normals;
    makeImages(left, right, view_options, exposure, shown);
    EXPECT_FALSE(shown.panels[0].missing.empty());
    EXPECT_TRUE(shown.panels[0].image.data.empty());
}

// ---- sizes while moving ----------------------------------------------------------------------------------

Size sizeOf(int width, int height) {
    Size size;
    size.width = width;
    size.height = height;
    return size;
}

TEST(ViewerSize, AnImageThatIsQuickKeepsItsSize) {
    ImageCost cost;
    EXPECT_FALSE(cost.known());
    cost.add(640 * 360, 40);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(640, 360));
}

TEST(ViewerSize, ASlowOneShrinksUntilItsPixelsFit) {
    ImageCost cost;
    cost.add(640 * 360, 240);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(320, 180));
    cost = {};
    cost.add(640 * 360, 5000);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(80, 45)) << "no smaller than an eighth";
    EXPECT_EQ(movingSize(sizeOf(3, 2), 60, cost), sizeOf(3, 2)) << "three pixels cost nothing";
}

// A smaller image does not reduce the cost of shadow maps and triangles.
TEST(ViewerSize, WhatDoesNotShrinkIsToldApart) {
    ImageCost cost;
    cost.add(640 * 360, 100 + 64);
    cost.add(320 * 180, 100 + 16);
    EXPECT_NEAR(cost.fixed(), 100, 1e-9);
    EXPECT_NEAR(cost.of(640 * 360), 164, 1e-9);
    EXPECT_EQ(movingSize(sizeOf(640, 360), 60, cost), sizeOf(320, 180));
}

TEST(ViewerSize, ABusyMomentIsForgotten) {
    ImageCost cost;
    for (int i = 0; i < 3; ++i) cost.add(1000, 10);
    cost.add(1000, 1000);
    EXPECT_LT(cost.of(1000), 12);
    for (int i = 0; i < 60; ++i) cost.add(1000, 100);
    EXPECT_NEAR(cost.of(1000), 100, 1e-9) << "and one that stays is learned";
}

// ---- settings --------------------------------------------------------------------------------------------

TEST(ViewerSettings, ACombinationWithoutMeaningIsShownAndNotDrawn) {
    InterfaceState state;
    state.edited = state.subject.settings;
    setOption(state, "gbuffer", "compact");
    EXPECT_EQ(state.subject.settings.gbuffer, GBufferEncoding::compact);
    EXPECT_TRUE(state.problem.empty());
    setOption(state, "evsm-exponent", "3");  // has no effect without --shadows evsm
    EXPECT_NE(state.problem.find("evsm"), std::string::npos);
    EXPECT_EQ(state.subject.settings.evsm_exponent, 0);
    EXPECT_EQ(state.edited.evsm_exponent, 3);
    setOption(state, "shadows", "evsm");
    EXPECT_TRUE(state.problem.empty()) << state.problem;
    EXPECT_EQ(state.subject.settings.evsm_exponent, 3);
    setOption(state, "msaa", "many");
    EXPECT_NE(state.problem.find("msaa"), std::string::npos);
    EXPECT_EQ(state.subject.settings.msaa, 1);
}

// The settings panel is generated from the rows: each can be set to its own text.
TEST(ViewerSettings, EveryRowCanBeSetToWhatItSays) {
    InterfaceState state;
    for (const Field& field : settingFields()) {
        const std::string option(field.option);
        setOption(state, option, state.edited.valueOf(option));
        EXPECT_TRUE(state.problem.empty()) << option << ": " << state.problem;
    }
    EXPECT_EQ(state.subject.settings, Settings());
}

TEST(ViewerSettings, SizeStopsFollowingTheWindow) {
    InterfaceState state;
    setOption(state, "size", "320x180");
    EXPECT_FALSE(state.follow);
    EXPECT_EQ(state.subject.settings.size, sizeOf(320, 180));
}

// As in the original projects: the heat map replaces the channel, which returns without it.
TEST(ViewerLook, TheHeatMapTakesPrecedenceOverTheChannel) {
    ViewOptions view_options;
    for (const DebugMode& mode : debugModes()) {
        view_options.mode = mode.channel;
        view_options.heat = true;
        EXPECT_EQ(view_options.channel(), Channel::light_count) << mode.name;
        view_options.heat = false;
        EXPECT_EQ(view_options.channel(), mode.channel);
    }
}

TEST(ViewerCommands, SayTheWholeView) {
    InterfaceState state;
    state.subject.scene = "a b.glb";
    state.subject.settings.camera = "eye=1,2,3 target=0,0,0";
    state.view_options.mode = Channel::normals;
    EXPECT_EQ(renderCommand(state),
              "diptych render --debug normals --camera 'eye=1,2,3 target=0,0,0' 'a b.glb'");
    state.view_options.mode = Channel::lit;
    state.view_options.exposure = 0.5;
    state.view_options.tonemap = false;
    EXPECT_EQ(renderCommand(state),
              "diptych render --no-tonemap --exposure 0.5 --camera 'eye=1,2,3 target=0,0,0' 'a b.glb'");
    state.view_options.against = Against::reference;
    EXPECT_EQ(compareCommand(state),
              "diptych compare --baseline reference --camera 'eye=1,2,3 target=0,0,0' 'a b.glb'");
}

TEST(ViewerCommands, NameTheSceneThatIsDrawnAndNotOneThatCannotBeRead) {
    InterfaceState state;
    state.subject.scene = "broken.glb";
    state.loaded = "good.glb";
    EXPECT_EQ(renderCommand(state), "diptych render good.glb");
    EXPECT_EQ(compareCommand(state), "diptych compare good.glb");
}

TEST(ViewerValues, AreToldToTheLastDigit) {
    Image image(2, 1, 3);
    image.at(1, 0, 0) = 0.1f;
    image.at(1, 0, 1) = std::nextafter(0.1f, 1.0f);
    image.at(1, 0, 2) = 1e-30f;
    const std::string sentence = valueText(image, 1, 0);
    std::istringstream stream(sentence);
    for (int c = 0; c < 3; ++c) {
        float value = 0;
        stream >> value;
        EXPECT_EQ(value, image.at(1, 0, c)) << sentence;
    }
    EXPECT_EQ(valueText(image, 0, 0), "0 0 0");
    EXPECT_EQ(valueText(image, 2, 0), "");
}

// ---- watched files ---------------------------------------------------------------------------------------

TEST(ViewerWatch, TellsOnceThatAFileHasSettledAfterAChange) {
    const std::filesystem::path here = folder();
    const auto write = [&](const char* name, const char* text) {
        std::ofstream(here / name) << text;
        return here / name;
    };
    const auto later = [](const std::filesystem::path& file, int seconds) {
        std::filesystem::last_write_time(
            file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(seconds));
    };
    const auto scene = write("a.gltf", R"({"buffers": [{"uri": "a.bin"}], "images": [{"uri": "data:x"}]})");
    const auto buffer = write("a.bin", "x");
    SceneWatch watch;
    watch.watch(scene.string(), {});
    EXPECT_EQ(watch.files(), (std::vector{scene, buffer}));
    EXPECT_FALSE(watch.changed());
    later(buffer, 10);
    EXPECT_FALSE(watch.changed()) << "it may still be written";
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
    std::filesystem::remove(scene);  // like programs that write a new file and rename it
    EXPECT_FALSE(watch.changed());
    Settings settings;
    for (const char* none : {"none", "scene"}) {
        settings.env = none;
        watch.watch("builtin:gallery", settings);
        EXPECT_TRUE(watch.files().empty()) << none;
        EXPECT_FALSE(watch.changed());
    }
    settings.env = "sky.hdr";
    settings.lights = "lamps.json";
    watch.watch(scene.string(), settings);
    EXPECT_EQ(watch.files(), (std::vector<std::filesystem::path>{scene, "sky.hdr", "lamps.json"}))
        << "the scene has gone, and with it the names in it";
    settings.lights = "point:8";
    watch.watch("builtin:gallery", settings);
    EXPECT_EQ(watch.files(), (std::vector<std::filesystem::path>{"sky.hdr"}));
}

}  // namespace
}  // namespace diptych::viewer
