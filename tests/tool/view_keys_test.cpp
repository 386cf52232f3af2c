// SPDX-License-Identifier: MIT
// Keys and the mouse change the view: the copied command draws what is on the screen.
#include "tests/tool/view_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <regex>

namespace diptych {
namespace {

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

// The part with the times.
std::vector<std::array<std::uint8_t, 3>> timesOf(const Screen& screen) {
    std::vector<std::array<std::uint8_t, 3>> pixels;
    for (int y = windowHeight - 160; y < windowHeight - 40; ++y)
        for (int x = windowWidth - static_cast<int>(viewer::sideWidth) + 10; x < windowWidth; ++x)
            pixels.push_back(screen.at(x, y));
    return pixels;
}

// The first press shows an overlay, the second removes it.
TEST_F(ViewCamera, KeysThatShowSomethingTakeItAwayAgain) {
    open({"builtin:points", "--exposure", "1"});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const auto plain = canvasOf(display_->screen());
    // Waits for a frame that shows it: a busy machine takes its time.
    const auto isPlain = [&](bool wanted) {
        return soon([&] { return (canvasOf(display_->screen()) == plain) == wanted; });
    };
    for (const char* name : {"q", "h", "question"}) {
        key(name);
        EXPECT_TRUE(isPlain(false)) << name;
        key(name);
        EXPECT_TRUE(isPlain(true)) << name;
    }
    key("h");
    EXPECT_TRUE(isPlain(false));
    key("Escape");
    EXPECT_TRUE(isPlain(true)) << "Esc closes the help";
    // Times are shown beside the images.
    const auto side = [&] { return timesOf(display_->screen()); };
    const auto timed = side();
    key("i");
    EXPECT_TRUE(soon([&] { return side() != timed; }));
    EXPECT_TRUE(isPlain(true)) << "no picture is covered";
    key("i");
    // While pressed, it swaps the panels.
    const PngImage deferred = rendered("builtin:points --size 320x180 --exposure 1 --path deferred");
    display_->events("keydown b");
    viewer::CanvasView other;
    other.other = true;
    EXPECT_TRUE(soon([&] { return differing(deferred, 0, other) == 0; }));
    display_->events("keyup b");
    EXPECT_TRUE(isPlain(true));
    // Hiding the side panels enlarges the images.
    key("u");
    EXPECT_TRUE(isPlain(false));
    key("u");
    EXPECT_TRUE(isPlain(true));
    // The pixel under the cursor becomes a large one, with a line around it.
    display_->events("mousemove 405 383");
    key("z");
    const int canvas_width = viewer::canvasOf({}, windowWidth, windowHeight, 1).width;
    std::size_t lines = 0;
    EXPECT_TRUE(soon([&] {
        const Screen zoomed = display_->screen();
        lines = 0;
        for (int x = 0; x < canvas_width; ++x)
            lines += zoomed.at(x, 200) == std::array<std::uint8_t, 3>{70, 70, 70};
        return lines > 5 && lines < 40;
    })) << lines;
    key("Escape");
    display_->events("mousemove 60 650");
    EXPECT_TRUE(isPlain(true));
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
    const Screen still = display_->screen();
    key("k");
    EXPECT_TRUE(soon([&] { return canvasOf(display_->screen()) != canvasOf(still); }));
    keyAndSettle("k");
    EXPECT_NE(copied().command.find("--time"), std::string::npos);
    // N goes to the scene's cameras.
    display_->events("key n");
    EXPECT_TRUE(soon([&] { return times("view: camera ") > 0; })) << view_->err();
    // O changes dragging: the eye orbits a point ahead.
    hold("w");
    const std::array<double, 3> eye = copied().eye;
    stills_ = times("view: still");
    display_->events("mousemove 250 400 mousedown 1 mousemove 290 400 mouseup 1");
    settle();
    EXPECT_EQ(copied().eye, eye) << "looking around leaves the eye where it is";
    key("o");
    stills_ = times("view: still");
    display_->events("mousemove 250 400 mousedown 1 mousemove 290 400 mouseup 1");
    settle();
    EXPECT_NE(copied().eye, eye);
    // G goes to a differing pixel, if any; F toggles full screen.
    key("g");
    key("f");
    close();
}

}  // namespace
}  // namespace diptych
