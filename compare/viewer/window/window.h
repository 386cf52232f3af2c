// SPDX-License-Identifier: MIT
// A GLFW window and its input events.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

struct GLFWwindow;

namespace diptych::viewer {

struct KeyDown {
    int key = 0;  // GLFW_KEY_*
    bool control = false, shift = false;
};

// Events since the last poll(); positions in framebuffer pixels.
struct Input {
    std::vector<KeyDown> keys;
    double wheel = 0;  // notches, up is positive
    struct Button {
        int button = 0;  // GLFW_MOUSE_BUTTON_*
        bool down = false;
        double x = 0, y = 0;
    };
    std::vector<Button> buttons;
    double x = 0, y = 0;                         // cursor
    std::vector<std::filesystem::path> dropped;  // files
    bool closed = false;
    bool any = false;  // whether there was any event
};

class Window {
public:
    // Throws std::runtime_error, one line with a workaround, if there is no display or no Vulkan for it.
    Window(int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    // Waits for an event, at most `seconds`.
    Input poll(double seconds);
    bool isDown(int key) const;
    void size(int& width, int& height) const;  // framebuffer, pixels; 0 while minimised
    double pixelsPerUnit() const;              // framebuffer pixels per unit of window coordinates
    double contentScale() const;               // text scale of its monitor
    void setTitle(const std::string& title);
    void toggleFullScreen();
    bool isFullScreen() const { return full_screen_; }
    void copy(const std::string& text);  // to the clipboard

    static void wake();  // ends a poll(); callable from any thread

private:
    void listen();

    GLFWwindow* window_ = nullptr;
    Input input_;
    std::string title_;
    bool full_screen_ = false;
    int restored_[4] = {0, 0, 0, 0};  // x, y, width, height before full screen
};

}  // namespace diptych::viewer
