// SPDX-License-Identifier: MIT
// The window on a virtual screen, driven by real events: it shows the images that other commands write.
#include "compare/files/frame_exr.h"
#include "compare/viewer/canvas.h"
#include "compare/viewer/interface.h"
#include "compare/viewer/keys.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/png.h"
#include "tests/support/campaign.h"
#include "tests/tool/display.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <regex>
#include <span>

namespace diptych {
namespace {

constexpr int windowWidth = 1280, windowHeight = 760;  // as view opens it, without a window manager at 0,0

// A window that has rendered everything requested.
class ViewTest : public testing::Test {
protected:
    void SetUp() override {
        if (!Display::isThere())
            GTEST_SKIP() << "Xvfb and xdotool are not installed: nothing is proved here of the window";
        display_.emplace(folder_);
    }

    // Starts `view` with --size 320x180, which is enlarged to fit, and waits until it is still. The first
    // panel is the deferred path's.
    void open(std::vector<std::string> words, const std::string& size = "320x180") {
        words.insert(words.begin(), {"view", "-v", "--size", size});
        start(words);
        settle();
        display_->events("mousemove 60 650");
    }

    // Its output goes to its own file, apart from other programs of the test.
    void start(const std::vector<std::string>& words) { view_.emplace(folder_, words, folder_ / "view.log"); }

    std::size_t times(const std::string& what) const {
        const std::string said = view_->err();
        std::size_t count = 0;
        for (std::size_t at = 0; (at = said.find(what, at)) != said.npos; ++at) ++count;
        return count;
    }
    // Waits until it has printed `what` more than `before` times.
    void await(const std::string& what, std::size_t before) {
        EXPECT_TRUE(soon([&] { return times(what) > before || view_->ended(); })) << what << "\n"
                                                                                  << view_->err();
        ASSERT_FALSE(view_->ended()) << view_->err();
    }
    // Waits until nothing more is rendered.
    void settle() {
        await("view: still", stills_);
        // Rendering requested just before prints it once more.
        for (std::size_t now = 0; now != times("view: still");) {
            now = stills_ = times("view: still");
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
        }
    }
    // Presses a key and waits until it is handled.
    void key(const std::string& name) {
        const std::size_t before = times("view: key ");
        display_->events("key " + name);
        await("view: key ", before);
    }
    // And until all rendering is done.
    void keyAndSettle(const std::string& name) {
        stills_ = times("view: still");
        key(name);
        settle();
    }
    std::string lastLine(const std::string& with) const {
        const std::string said = view_->err();
        const std::size_t at = said.rfind(with);
        return at == said.npos ? "" : said.substr(at, said.find('\n', at) - at);
    }
    void close() {
        display_->events("key ctrl+q");
        EXPECT_TRUE(soon([&] { return view_->ended(); }));
        const int status = view_->wait();
        EXPECT_TRUE(WIFEXITED(status)) << status << view_->err();
        EXPECT_EQ(WEXITSTATUS(status), 0) << view_->err();
    }

    // The image that render writes for `words`.
    PngPicture rendered(const std::string& words) {
        const Ran ran = runTool(folder_, "render " + words + " --runs 0 --force -o rendered.png");
        EXPECT_EQ(ran.code, 0) << ran.err;
        const std::string bytes = contentsOf(folder_ / "rendered.png");
        return readPngPicture(std::as_bytes(std::span(bytes)), "rendered.png");
    }

    // Number of image pixels that differ from the panel by more than one display level. `picture` may have
    // a strip below.
    int differing(const PngPicture& picture, std::size_t panel, const viewer::CanvasView& view,
                  bool difference = false) {
        const Screen screen = display_->screen();
        viewer::InterfaceState state;
        const viewer::CanvasRect canvas = viewer::canvasOf(state, windowWidth, windowHeight, 1);
        Size size;
        size.width = 320;
        size.height = 180;
        const double line = canvas.x + view.wipe * canvas.width;
        int count = 0, seen = 0;
        for (const viewer::PanelPlace& place : viewer::placesOf(canvas, size, view, difference)) {
            if (place.panel != panel) continue;
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const double px = place.placement.left + (x + 0.5) * place.placement.scale,
                                 py = place.placement.top + (y + 0.5) * place.placement.scale;
                    // The wipe's line and its handle.
                    if (!place.rect.contains(px, py) ||
                        (view.layout == viewer::Layout::wipe && std::abs(px - line) < 14))
                        continue;
                    ++seen;
                    const auto& shown = screen.at(static_cast<int>(px), static_cast<int>(py));
                    for (int c = 0; c < 3; ++c)
                        if (std::abs(shown[static_cast<std::size_t>(c)] - 255 * picture.image.at(x, y, c)) >
                            1.01) {
                            ++count;
                            break;
                        }
                }
        }
        EXPECT_GT(seen, 1000);
        return count;
    }

    Folder folder_;
    std::optional<Display> display_;
    std::optional<Running> view_;
    std::size_t stills_ = 0;
};

using View = ViewTest;

viewer::CanvasView wipe() {
    return {};
}
viewer::CanvasView single() {
    viewer::CanvasView view;
    view.layout = viewer::Layout::single;
    return view;
}

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
    EXPECT_TRUE(runTool(folder, "view nowhere.glb").failedOver("nowhere.glb"));
    EXPECT_TRUE(runTool(folder, "view --device nosuch").failedOver("--device nosuch"));
}

TEST_F(View, TheWipesHalvesAreWhatRenderWrites) {
    // Few bits, so that the two images differ visibly.
    open({"builtin:normals", "--exposure", "1", "--gbuffer", "compact"});
    const std::string scene = "builtin:normals --size 320x180 --exposure 1 --gbuffer compact";
    const PngPicture deferred = rendered(scene + " --path deferred"),
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
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    viewer::CanvasView view = wipe();
    view.wipe = 0;
    EXPECT_EQ(differing(deferred, 1, view), 0);
    close();
}

TEST_F(View, EveryChannelIsWhatRenderWrites) {
    open({"builtin:spots", "--exposure", "1"});
    key("v");
    key("v");  // one panel
    const std::string scene = "builtin:spots --size 320x180 --exposure 1 --debug ";
    for (int digit : {1, 2, 3, 4, 5, 6, 7, 8, 9, 0}) {  // it begins with 0
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
    // C cycles through those beyond 9.
    std::vector<std::string> beyond;
    for (const DebugMode& mode : debugModes())
        if (mode.number > 9) beyond.emplace_back(mode.name);
    keyAndSettle("c");
    EXPECT_EQ(differing(rendered(scene + beyond[0]), 1, single()), 0);
    keyAndSettle("c");
    EXPECT_EQ(differing(rendered(scene + beyond[1]), 1, single()), 0);
    keyAndSettle("shift+c");
    EXPECT_EQ(differing(rendered(scene + beyond[0]), 1, single()), 0);
    close();
}

// The command that Y copies, and its camera's position.
struct Copied {
    std::string command;
    std::array<double, 3> eye{};
};

class ViewCamera : public ViewTest {
protected:
    Copied copied() {
        key("y");
        Copied result;
        const std::string line = lastLine("copied: diptych render");
        result.command = line.substr(line.find("render"));
        std::smatch found;
        if (std::regex_search(line, found, std::regex("eye=([^,]+),([^,]+),([^ ]+)")))
            for (std::size_t i = 0; i < 3; ++i) result.eye[i] = std::stod(found[i + 1]);
        return result;
    }
    // Presses a key for a moment; the view moves and comes to rest.
    void hold(const std::string& name) {
        stills_ = times("view: still");
        display_->events("keydown " + name + " sleep 0.3 keyup " + name);
        settle();
    }
};

TEST_F(ViewCamera, KeysMoveItAndTheCopiedCommandDrawsWhatIsOnTheScreen) {
    open({"builtin:spots", "--exposure", "1", "--camera", "eye=0,1,6 target=0,1,0 fov=45"});
    key("v");
    key("v");
    // Along -Z, so that forward, right and up are axes.
    const struct {
        const char* key;
        std::size_t axis;
        double sign;
    } moves[] = {{"w", 2, -1}, {"s", 2, 1}, {"d", 0, 1}, {"a", 0, -1}, {"space", 1, 1}, {"Control_L", 1, -1}};
    Copied before = copied();
    before.eye = {0, 1, 6};
    for (const auto& [name, axis, sign] : moves) {
        hold(name);
        const Copied after = copied();
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == axis)
                EXPECT_GT(sign * (after.eye[i] - before.eye[i]), 0.05) << name;
            else
                EXPECT_NEAR(after.eye[i], before.eye[i], 1e-6) << name;
        }
        before = after;
    }
    // The mouse looks around: the copied command then renders the image on the screen.
    stills_ = times("view: still");
    display_->events("mousemove 400 400 mousedown 1 mousemove 440 410 mousemove 460 420 mouseup 1");
    settle();
    display_->events("mousemove 60 650");  // the cursor is on the screen too
    const std::string command = copied().command;
    EXPECT_EQ(differing(rendered(command.substr(command.find(' ') + 1)), 1, single()), 0) << command;
    close();
}

// The part of the screen with images and their overlays.
std::vector<std::array<std::uint8_t, 3>> canvasOf(const Screen& screen) {
    const viewer::CanvasRect canvas = viewer::canvasOf({}, windowWidth, windowHeight, 1);
    std::vector<std::array<std::uint8_t, 3>> pixels;
    for (int y = canvas.y; y < canvas.y + canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) pixels.push_back(screen.at(x, y));
    return pixels;
}

// The first press shows an overlay, the second removes it.
TEST_F(ViewCamera, KeysThatShowSomethingTakeItAwayAgain) {
    open({"builtin:points", "--exposure", "1"});
    const auto look = [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        return canvasOf(display_->screen());
    };
    const auto plain = look();
    for (const char* name : {"q", "h", "question"}) {
        key(name);
        EXPECT_TRUE(look() != plain) << name;
        key(name);
        EXPECT_TRUE(look() == plain) << name;
    }
    key("h");
    key("Escape");
    EXPECT_TRUE(look() == plain) << "Esc closes the help";
    // Times are shown beside the images.
    const auto side = [&] {
        const Screen screen = display_->screen();
        std::vector<std::array<std::uint8_t, 3>> pixels;
        for (int y = windowHeight - 160; y < windowHeight - 40; ++y)
            for (int x = windowWidth - static_cast<int>(viewer::sideWidth) + 10; x < windowWidth; ++x)
                pixels.push_back(screen.at(x, y));
        return pixels;
    };
    const auto timed = side();
    key("i");
    EXPECT_TRUE(look() == plain) << "no picture is covered";
    EXPECT_TRUE(side() != timed);
    key("i");
    // While pressed, it swaps the panels.
    const PngPicture deferred = rendered("builtin:points --size 320x180 --exposure 1 --path deferred");
    display_->events("keydown b");
    viewer::CanvasView other;
    other.other = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(differing(deferred, 0, other), 0);
    display_->events("keyup b");
    EXPECT_TRUE(look() == plain);
    // Hiding the side panels enlarges the images.
    stills_ = times("view: still");
    key("u");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const Screen wide = display_->screen();
    key("u");
    EXPECT_TRUE(look() == plain);
    EXPECT_TRUE(canvasOf(wide) != plain);
    // The pixel under the cursor becomes a large one, with a line around it.
    display_->events("mousemove 405 383");
    key("z");
    std::this_thread::sleep_for(std::chrono::milliseconds(800));
    const Screen zoomed = display_->screen();
    std::size_t lines = 0;
    const int canvas_width = viewer::canvasOf({}, windowWidth, windowHeight, 1).width;
    for (int x = 0; x < canvas_width; ++x)
        lines += zoomed.at(x, 200) == std::array<std::uint8_t, 3>{70, 70, 70};
    EXPECT_GT(lines, 5u);
    EXPECT_LT(lines, 40u);
    key("Escape");
    display_->events("mousemove 60 650");
    EXPECT_TRUE(look() == plain);
    close();
}

TEST_F(ViewCamera, KeysThatChangeTheViewChangeItsCommand) {
    open({"builtin:motion", "--exposure", "1", "--lights", "point:2"});
    EXPECT_EQ(copied().command.find("--scene-lights"), std::string::npos);
    keyAndSettle("l");
    EXPECT_NE(copied().command.find("--scene-lights off"), std::string::npos);
    EXPECT_EQ(
        differing(rendered("builtin:motion --size 320x180 --exposure 1 --lights point:2 --scene-lights off"),
                  1, wipe()),
        0);
    keyAndSettle("j");
    EXPECT_EQ(copied().command.find("--lights"), std::string::npos);
    keyAndSettle("j");
    EXPECT_NE(copied().command.find("--lights point:2"), std::string::npos);
    keyAndSettle("l");
    EXPECT_EQ(copied().command.find("--scene-lights"), std::string::npos);
    // K plays, and stops.
    EXPECT_EQ(copied().command.find("--time"), std::string::npos);
    key("k");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    keyAndSettle("k");
    EXPECT_NE(copied().command.find("--time"), std::string::npos);
    // N goes to the scene's cameras.
    display_->events("key n");
    EXPECT_TRUE(soon([&] { return times("view: camera ") > 0; })) << view_->err();
    // O changes dragging: the eye orbits a point ahead.
    const std::array<double, 3> still = [&] {
        hold("w");
        return copied().eye;
    }();
    stills_ = times("view: still");
    display_->events("mousemove 250 400 mousedown 1 mousemove 290 400 mouseup 1");
    settle();
    EXPECT_EQ(copied().eye, still) << "looking around leaves the eye where it is";
    key("o");
    stills_ = times("view: still");
    display_->events("mousemove 250 400 mousedown 1 mousemove 290 400 mouseup 1");
    settle();
    EXPECT_NE(copied().eye, still);
    // G goes to a differing pixel, if any; F toggles full screen.
    key("g");
    key("f");
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
    const viewer::PanelPlace place = viewer::placesOf(canvas, size, wipe(), false).front();
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
                        static_cast<int>(place.placement.left + (x + 0.5) * place.placement.scale),
                        static_cast<int>(place.placement.top + (y + 0.5) * place.placement.scale)));
        await("view: pixel ", before);
        const auto words = [&, x = x, y = y](const Frame& frame) {
            return viewer::valueWords(frame.channels.at(static_cast<int>(gpu::DEBUG_lit)), x, y);
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
    // One triangle, its vertices in the file.
    const std::string scene =
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
"min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36,
"uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    folder_.write("a.gltf", scene);
    open({"a.gltf", "--watch", "--exposure", "1"});
    const PngPicture picture = rendered("a.gltf --size 320x180 --exposure 1");
    EXPECT_EQ(differing(picture, 1, wipe()), 0);
    folder_.write("a.gltf", "{");
    display_->events("key r");
    EXPECT_TRUE(soon([&] { return times("a.gltf: ") > 0; })) << view_->err();
    EXPECT_EQ(differing(picture, 1, wipe()), 0) << "the old scene stays";
    stills_ = times("view: still");
    folder_.write("a.gltf", scene);  // --watch reads it by itself
    EXPECT_TRUE(soon([&] { return times("a file has changed") > 0; })) << view_->err();
    settle();
    EXPECT_EQ(differing(picture, 1, wipe()), 0);
    close();
}

TEST_F(View, AReportOpensAtItsFailingChannelsWorstPixel) {
    folder_.write("strict.json",
                  R"({"rules": [{"channel": "albedo", "max": 0, "because": "no bit may change"}]})");
    const Ran compared =
        runTool(folder_, "compare builtin:spots --size 320x180 --tolerances strict.json -o report");
    ASSERT_EQ(compared.code, 1) << compared.out << compared.err;
    EXPECT_NE(contentsOf(folder_ / "report/index.html").find("diptych view --debug albedo"),
              std::string::npos);
    start({"view", "-v", "--report", "report"});
    settle();
    key("y");
    const std::string line = lastLine("copied: ");
    EXPECT_NE(line.find("--debug albedo"), std::string::npos) << line;
    EXPECT_NE(line.find("--size 320x180"), std::string::npos) << line;
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
    for (int i = 0; i < 200 && !view_->ended(); ++i) {
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
