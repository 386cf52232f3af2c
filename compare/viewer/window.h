// SPDX-License-Identifier: MIT
// One GLFW window, and what people did in it since it was asked last.
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

// Since the last poll(); positions in framebuffer pixels.
struct Input {
    std::vector<KeyDown> keys;
    double wheel = 0;  // notches, up positive
    struct Button {
        int button = 0;  // GLFW_MOUSE_BUTTON_*
        bool down = false;
        double x = 0, y = 0;
    };
    std::vector<Button> buttons;
    double x = 0, y = 0;                         // of the cursor
    std::vector<std::filesystem::path> dropped;  // files
    bool closed = false;
    bool any = false;  // whether anything happened at all
};

class Window {
public:
    // Throws std::runtime_error, one line that says how to do without, where there is no display or no Vulkan
    // for it.
    Window(int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    // Waits for something to happen, at most `seconds`.
    Input poll(double seconds);
    bool isDown(int key) const;
    bool isButtonDown(int button) const;
    void size(int& width, int& height) const;  // framebuffer, pixels; 0 while it is minimised
    double pixelsPerUnit() const;              // framebuffer pixels per unit of window coordinates
    double contentScale() const;               // how much larger than usual text should be, of its monitor
    void setTitle(const std::string& title);
    void toggleFullScreen();
    bool isFullScreen() const { return full_screen_; }
    void copy(const std::string& text);  // to the clipboard

    static void wake();  // ends a poll() from any thread

private:
    void listen();

    GLFWwindow* window_ = nullptr;
    Input input_;
    std::string title_;
    bool full_screen_ = false;
    int restored_[4] = {0, 0, 0, 0};  // x, y, width, height before full screen
};

}  // namespace diptych::viewer
