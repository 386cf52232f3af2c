// SPDX-License-Identifier: MIT
// The window on a virtual screen, driven by real events: it shows the images that other commands write.
#include "compare/files/frame_exr.h"
#include "compare/viewer/interface/keys.h"
#include "shared/frame/debug_modes.h"
#include "tests/support/campaign.h"
#include "tests/tool/view_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <random>

namespace diptych {
namespace {

using View = ViewTest;

TEST(ViewWithoutDisplay, EndsWithTwoAndSaysHowToDoWithout) {
    const Folder folder;
    EXPECT_TRUE(
        runShell(folder, "env -u DISPLAY -u WAYLAND_DISPLAY '" DIPTYCH_PROGRAM "' view", folder.path())
            .failedOver("diptych render SCENE -o picture.png"));
}

TEST(ViewWithoutDisplay, WhatCannotBeShownIsSaidBeforeAnyWindow) {
    const Folder folder;
    EXPECT_TRUE(runTool(folder, "view a.glb b.glb").failedOver("one scene"));
    EXPECT_TRUE(runTool(folder, "view --pixel 640,0").failedOver("--pixel"));
    EXPECT_TRUE(runTool(folder, "view --report nowhere").failedOver("--report nowhere"));
    EXPECT_TRUE(runTool(folder, "view --evsm-exponent 3").failedOver("evsm"));
}

TEST_F(View, TheWipesHalvesAreWhatRenderWrites) {
    // Few bits, so that the two images differ visibly.
    open({"builtin:normals", "--exposure", "1", "--gbuffer", "compact"});
    const std::string scene = "builtin:normals --size 320x180 --exposure 1 --gbuffer compact";
    const PngImage deferred = rendered(scene + " --path deferred"),
                   forward = rendered(scene + " --path forward_plus");
    EXPECT_EQ(differing(deferred, 0, wipe()), 0);
    EXPECT_EQ(differing(forward, 1, wipe()), 0);
    EXPECT_GT(differing(forward, 0, wipe()), 100);
    EXPECT_GT(differing(deferred, 1, wipe()), 100);
    // Tab swaps them.
    keyAndSettle("Tab");
    EXPECT_EQ(differing(forward, 0, wipe()), 0);
    EXPECT_EQ(differing(deferred, 1, wipe()), 0);
    // Dragging the line to the left edge shows only the right panel.
    const viewer::CanvasRect canvas = viewer::canvasOf({}, windowWidth, windowHeight, 1);
    display_->events(fmt::format("mousemove {} 400 mousedown 1 mousemove {} 400 mousemove 0 400 mouseup 1",
                                 canvas.width / 2, canvas.width / 4));
    viewer::CanvasView view = wipe();
    view.wipe = 0;
    EXPECT_TRUE(soon([&] { return differing(deferred, 1, view) == 0; }));
    close();
}

TEST_F(View, EveryChannelIsWhatRenderWrites) {
    open({"builtin:spots", "--exposure", "1"});
    key("v");
    key("v");  // one panel
    const std::string scene = "builtin:spots --size 320x180 --exposure 1 --debug ";
    // It begins with 0. A full run presses every digit.
    const int first = 1 + static_cast<int>(campaignSeed() % 3);
    for (int digit = isCampaign() ? 1 : first; digit <= 9; digit += isCampaign() ? 1 : 3) {
        keyAndSettle(std::to_string(digit));
        EXPECT_EQ(differing(rendered(scene + std::to_string(digit)), 1, single()), 0) << digit;
    }
    keyAndSettle("e");
    EXPECT_EQ(differing(rendered(scene + "light_count"), 1, single()), 0);
    keyAndSettle("1");
    EXPECT_EQ(differing(rendered(scene + "light_count"), 1, single()), 0)
        << "the heat map takes precedence over the channel";
    keyAndSettle("e");
    EXPECT_EQ(differing(rendered(scene + "albedo"), 1, single()), 0) << "which is there without it";
    keyAndSettle("0");
    EXPECT_EQ(differing(rendered(scene + "0"), 1, single()), 0);
    // C cycles through those beyond 9.
    std::vector<std::string> beyond;
    for (const DebugMode& mode : debugModes())
        if (channelIndex(mode.channel) > 9) beyond.emplace_back(mode.name);
    keyAndSettle("c");
    EXPECT_EQ(differing(rendered(scene + beyond[0]), 1, single()), 0);
    keyAndSettle("c");
    EXPECT_EQ(differing(rendered(scene + beyond[1]), 1, single()), 0);
    keyAndSettle("shift+c");
    EXPECT_EQ(differing(rendered(scene + beyond[0]), 1, single()), 0);
    close();
}

// A field takes every key but those that leave it or the program.
TEST_F(View, EscapeAndCtrlQWorkWhileAFieldHasTheFocus) {
    open({"builtin:triangle"});
    const viewer::CanvasRect canvas = viewer::canvasOf({}, windowWidth, windowHeight, 1);
    const auto click = [&](int x, int y) {
        display_->events(fmt::format("mousemove {} {} click 1 sleep 0.3", canvas.width + x, canvas.y + y));
    };
    click(100, 18);  // the tab of Settings
    const auto type = [&](const char* keys) {
        click(60, 48);  // the filter of their names
        const std::size_t before = times("view: key ");
        display_->events(std::string("key ") + keys + " sleep 0.5");
        EXPECT_EQ(times("view: key "), before) << "typed into the field";
    };
    type("1");
    key("Escape");
    display_->events("sleep 0.5");  // Dear ImGui reports the lost focus two frames later
    key("1");
    type("2");
    close();
}

TEST_F(View, APixelsValuesAreThoseOfTheExr) {
    open({"builtin:spots"});
    const viewer::CanvasRect canvas = viewer::canvasOf({}, windowWidth, windowHeight, 1);
    Size size;
    size.width = 320;
    size.height = 180;
    const viewer::PanelRect panel_rect = viewer::panelRectsOf(canvas, size, wipe(), false).front();
    ASSERT_EQ(runTool(folder_, "render builtin:spots --size 320x180 --runs 0 --path deferred -o d.exr").code,
              0);
    ASSERT_EQ(
        runTool(folder_, "render builtin:spots --size 320x180 --runs 0 --path forward_plus -o f.exr").code,
        0);
    const Frame deferred = frameFromExr(folder_ / "d.exr"), forward = frameFromExr(folder_ / "f.exr");
    for (const auto& [x, y] : {std::pair{100, 90}, {150, 120}}) {
        const std::size_t before = times("view: pixel ");
        display_->events(
            fmt::format("mousemove {} {} click 3",
                        static_cast<int>(panel_rect.placement.left + (x + 0.5) * panel_rect.placement.scale),
                        static_cast<int>(panel_rect.placement.top + (y + 0.5) * panel_rect.placement.scale)));
        await("view: pixel ", before);
        const auto words = [&, x = x, y = y](const Frame& frame) {
            return viewer::valueText(frame.channels.at(Channel::lit), x, y);
        };
        EXPECT_EQ(lastLine("pixel "), fmt::format("pixel {},{}  deferred: {}  forward_plus: {}", x, y,
                                                  words(deferred), words(forward)));
    }
    close();
}

TEST_F(View, DifferencesAndTheReferenceStandInThePanels) {
    open({"builtin:points"});
    const Screen both = display_->screen();
    keyAndSettle("x");  // signed
    EXPECT_TRUE(both.pixels != display_->screen().pixels);
    for (int i = 0; i < 3; ++i) keyAndSettle("x");  // FLIP
    keyAndSettle("x");
    EXPECT_EQ(differing(rendered("builtin:points --size 320x180 --path deferred"), 0, wipe()), 0);
    keyAndSettle("t");
    EXPECT_EQ(differing(rendered("builtin:points --size 320x180 --path reference"), 0, wipe()), 0);
    close();
}

TEST_F(View, AScreenshotIsWhatRenderWrites) {
    open({"builtin:points"});
    key("p");
    await("view: written:", 0);
    for (const char* path : {"deferred", "forward_plus"}) {
        const std::string stem = std::string("diptych-view-0001.") + path;
        ASSERT_EQ(
            runTool(folder_,
                    fmt::format("render builtin:points --size 320x180 --runs 0 --path {} -o r.exr", path))
                .code,
            0);
        EXPECT_EQ(runTool(folder_, "diff r.exr " + stem + ".exr --metric max --tolerance 0").code, 0);
        EXPECT_EQ(
            runTool(folder_,
                    fmt::format("render builtin:points --size 320x180 --runs 0 --path {} -o r.png", path))
                .code,
            0);
        EXPECT_EQ(contentsOf(folder_ / "r.png"), contentsOf(folder_ / (stem + ".png")));
    }
    key("p");  // never overwrites
    await("view: written:", 1);
    EXPECT_TRUE(fs::exists(folder_ / "diptych-view-0002.deferred.exr"));
    close();
}

TEST_F(View, ABrokenSceneOnReadingAgainKeepsTheOldOne) {
    folder_.write("a.gltf", triangleGltf);
    open({"a.gltf", "--watch", "--exposure", "1"});
    const PngImage image = rendered("a.gltf --size 320x180 --exposure 1");
    EXPECT_EQ(differing(image, 1, wipe()), 0);
    folder_.write("a.gltf", "{");
    display_->events("key r");
    EXPECT_TRUE(soon([&] { return times("a.gltf: ") > 0; })) << view_->err();
    EXPECT_EQ(differing(image, 1, wipe()), 0) << "the old scene stays";
    stills_ = times("view: still");
    folder_.write("a.gltf", triangleGltf);  // --watch reads it by itself
    EXPECT_TRUE(soon([&] { return times("a file has changed") > 0; })) << view_->err();
    settle();
    EXPECT_EQ(differing(image, 1, wipe()), 0);
    close();
}

// At a failing channel's worst pixel, or at lit.
TEST_F(View, AReportOpensAtWhatFails) {
    folder_.write("strict.json",
                  R"({"rules": [{"channel": "albedo", "max": 0, "because": "no bit may change"}]})");
    for (const bool fails : {true, false}) {
        const Ran compared = runTool(folder_, std::string("compare builtin:spots --size 320x180 -o report ") +
                                                  (fails ? "--tolerances strict.json" : ""));
        ASSERT_EQ(compared.code, fails ? 1 : 0) << compared.out << compared.err;
        if (fails) {
            EXPECT_NE(contentsOf(folder_ / "report/index.html").find("diptych view --debug albedo"),
                      std::string::npos);
        }
        stills_ = 0;
        start({"view", "-v", "--report", "report"});
        settle();
        key("y");
        const std::string line = lastLine("copied: ");
        EXPECT_EQ(line.find("--debug albedo") != line.npos, fails) << line;
        EXPECT_EQ(line.find("--debug") != line.npos, fails) << line;
        EXPECT_NE(line.find("--size 320x180"), std::string::npos) << line;
        close();
    }
}

TEST_F(View, ImagesAreAsLargeAsTheWindowShowsThem) {
    display_.emplace(folder_, "640x400");
    start({"view", "-v", "builtin:triangle"});
    await("first picture", 0);
    const auto expectSize = [&](int width, int height, const std::string& events) {
        stills_ = times("view: still");
        display_->events(events);
        settle();
        const viewer::CanvasRect canvas = viewer::canvasOf({}, width, height, 1);
        key("y");
        const std::string line = lastLine("copied: ");
        EXPECT_NE(line.find(fmt::format("--size {}x{}", canvas.width, canvas.height)), line.npos) << line;
    };
    expectSize(500, 300, "search --name diptych windowsize 500 300");
    expectSize(640, 400, "key f");  // as large as the screen
    expectSize(500, 300, "key Escape");
    close();
}

TEST_F(View, OpensAtTheChannelThatWasAskedFor) {
    open({"builtin:triangle", "--debug", "normals"});
    key("y");
    const std::string line = lastLine("copied: ");
    EXPECT_NE(line.find("--debug normals"), std::string::npos) << line;
    key("Escape");
    key("y");
    EXPECT_EQ(lastLine("copied: "), line) << "there was nothing to leave";
    close();
}

#ifdef DIPTYCH_FAULTS
// The device that shows the window is the only one that calls vkQueueSubmit.
TEST_F(View, TheWindowsDeviceIsMadeAnewWhereItIsLost) {
    const auto lose = [&](const char* calls) {
        for (const auto& [name, value] : {std::pair{"LD_PRELOAD", DIPTYCH_FAULTS},
                                          {"FAULT_IN", "vkQueueSubmit"},
                                          {"FAULT_AT", "8"},
                                          {"FAULT_DO", "-4"},
                                          {"FAULT_FOR", calls}})
            ::setenv(name, value, 1);  // -4: VK_ERROR_DEVICE_LOST
        start({"view", "-v", "--size", "320x180", "--exposure", "1", "builtin:points"});
        for (const char* name : {"LD_PRELOAD", "FAULT_IN", "FAULT_AT", "FAULT_DO", "FAULT_FOR"})
            ::unsetenv(name);
    };
    lose("1");
    settle();
    display_->events("mousemove 60 650");
    key("i");
    EXPECT_EQ(times("was lost and is started again"), 1u) << view_->err();
    EXPECT_EQ(differing(rendered("builtin:points --size 320x180 --exposure 1"), 1, wipe()), 0);
    close();
    // If the device keeps being lost, the program reports it and ends.
    lose("100000");
    EXPECT_TRUE(soon([&] { return view_->ended(); }));
    EXPECT_EQ(WEXITSTATUS(view_->wait()), 2) << view_->err();
    EXPECT_NE(view_->err().find("was lost as it was started"), std::string::npos) << view_->err();
}
#endif

// Random keys, clicks, drags, wheel turns and sizes, with validation layers: nothing crashes or hangs, and
// the layers print nothing.
TEST_F(View, SurvivesWhateverIsDoneToIt) {
    std::mt19937 random(static_cast<unsigned>(campaignSeed()));
    const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    start({"view", "-v", "--validate", "builtin:points", "--lights", "point:3"});
    await("first picture", 0);
    std::vector<std::string> keys;
    for (const viewer::KeyBinding& binding : viewer::keyBindings()) {
        if (binding.action == viewer::Action::quit) continue;
        const std::string name(binding.name);
        keys.push_back(name == "Space"    ? "space"
                       : name == "Ctrl"   ? "Control_L"
                       : name == "Esc"    ? "Escape"
                       : name == "?"      ? "question"
                       : name == "0 to 9" ? std::to_string(upTo(10))
                       : name.size() == 1 ? std::string(1, static_cast<char>(std::tolower(name[0])))
                                          : name);
    }
    for (int i = 0; i < (isCampaign() ? 200 : 60) && !view_->ended(); ++i) {
        const int x = upTo(windowWidth), y = upTo(windowHeight);
        switch (upTo(8)) {
            case 0:
            case 1:
            case 2:
                display_->events("key " +
                                 keys[static_cast<std::size_t>(upTo(static_cast<int>(keys.size())))]);
                break;
            case 3:
                display_->events(fmt::format("mousemove {} {} click {}", x, y, 1 + upTo(5)));
                break;
            case 4:
                display_->events(fmt::format("mousemove {} {} mousedown 1 mousemove {} {} mouseup 1", x, y,
                                             upTo(windowWidth), upTo(windowHeight)));
                break;
            case 5:
                display_->events(
                    fmt::format("mousemove {} {} click {} click {}", x, y, 4 + upTo(2), 4 + upTo(2)));
                break;
            case 6:
                display_->events(
                    fmt::format("search --name Diptych windowsize {} {}", 64 + upTo(1400), 64 + upTo(900)));
                break;
            default:
                display_->events(fmt::format("keydown w sleep 0.05 keyup w"));
        }
    }
    ASSERT_FALSE(view_->ended()) << view_->err();
    display_->events("search --name Diptych windowsize 1280 760");
    close();
}

}  // namespace
}  // namespace diptych
