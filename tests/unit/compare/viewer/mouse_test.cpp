// SPDX-License-Identifier: MIT
#include "compare/viewer/window/mouse.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace diptych::viewer {
namespace {

constexpr CanvasRect canvas{0, 0, 400, 300};

struct Hand {
    InterfaceState state;
    Contents contents;
    FlyCamera camera;
    Mouse mouse{state, contents, camera, {[] {}, [](const std::string&) {}, [](const std::string&) {}}};

    void move(double x, double y) { handle(x, y, {}); }
    void button(bool down, double x, double y) { handle(x, y, {{GLFW_MOUSE_BUTTON_LEFT, down, x, y}}); }

private:
    void handle(double x, double y, std::vector<Input::Button> buttons) {
        Input input;
        input.buttons = std::move(buttons);
        input.x = x;
        input.y = y;
        mouse.handle(input, canvas, 1, false);
    }
};

// The cursor may jump before the button goes down (touchpads): the jump drags nothing.
TEST(Mouse, AnImageIsDraggedFromWhereTheButtonWentDown) {
    Hand hand;
    hand.state.view_options.difference = Difference::absolute;
    hand.state.canvas.zoom = 2;
    hand.state.canvas.centre_x = hand.state.canvas.centre_y = 50;
    hand.move(10, 10);
    hand.button(true, 100, 80);
    hand.move(120, 90);
    EXPECT_EQ(hand.state.canvas.centre_x, 50 - 20 / 2);
    EXPECT_EQ(hand.state.canvas.centre_y, 50 - 10 / 2);
    hand.button(false, 124, 94);  // moves there, then ends
    hand.move(200, 200);
    EXPECT_EQ(hand.state.canvas.centre_x, 50 - 24 / 2);
    EXPECT_EQ(hand.state.canvas.centre_y, 50 - 14 / 2);
}

TEST(Mouse, KnowsThePixelUnderTheCursor) {
    Hand hand;
    hand.state.canvas.layout = Layout::single;
    hand.state.subject.settings.size = {400, 300};
    hand.move(350.5, 100.5);
    ASSERT_TRUE(hand.contents.under);
    EXPECT_EQ(hand.contents.under->pixel.x, 350);
    EXPECT_EQ(hand.contents.under->pixel.y, 100);
    hand.move(350.5, 300.5);
    EXPECT_FALSE(hand.contents.under) << "below the canvas";
}

TEST(Mouse, TheWipeFollowsTheCursorWithinTheCanvas) {
    Hand hand;
    hand.state.canvas.layout = Layout::wipe;
    hand.state.canvas.wipe = 0.5;
    hand.button(true, 201, 80);
    hand.move(300, 10);
    EXPECT_EQ(hand.state.canvas.wipe, 0.75);
    hand.move(500, 10);
    EXPECT_EQ(hand.state.canvas.wipe, 1);
}

}  // namespace
}  // namespace diptych::viewer
