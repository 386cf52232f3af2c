// SPDX-License-Identifier: MIT
#include "compare/viewer/window/window.h"

#include <vulkan/vulkan_core.h>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace diptych::viewer {
namespace {

// GLFW's last error; it calls back on the thread that made the call.
std::string& lastError() {
    thread_local std::string text;
    return text;
}

[[noreturn]] void failWindow(const std::string& what) {
    throw std::runtime_error(fmt::format(
        "view: {}{}; diptych render SCENE -o picture.png draws without a window, and compare writes a page",
        what, lastError().empty() ? "" : " (" + lastError() + ")"));
}

Input& inputOf(GLFWwindow* window);

}  // namespace

Window::Window(int width, int height, const std::string& title) : title_(title) {
    glfwSetErrorCallback([](int, const char* text) { lastError() = text; });
    if (glfwInit() == GLFW_FALSE) failWindow("there is no display to open a window on");
    if (glfwVulkanSupported() == GLFW_FALSE) {
        glfwTerminate();
        failWindow("this display does not support Vulkan");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) {
        glfwTerminate();
        failWindow("no window can be opened");
    }
    glfwSetWindowSizeLimits(window_, 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwSetWindowUserPointer(window_, &input_);
    listen();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

// Dear ImGui receives every event first; its WantCapture flags decide who handles it.
void Window::listen() {
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
        // Tab swaps the paths; in a text field it moves the focus.
        if (key != GLFW_KEY_TAB || ImGui::GetIO().WantTextInput)
            ImGui_ImplGlfw_KeyCallback(w, key, scancode, action, mods);
        Input& input = inputOf(w);
        input.any = true;
        if (action == GLFW_PRESS)
            input.keys.push_back({key, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
        ImGui_ImplGlfw_CharCallback(w, character);
        inputOf(w).any = true;
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
        ImGui_ImplGlfw_MouseButtonCallback(w, button, action, mods);
        // The cursor's position at the event: in a quick drag it has moved since.
        Input& input = inputOf(w);
        input.any = true;
        input.buttons.push_back({button, action == GLFW_PRESS, input.x, input.y});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
        ImGui_ImplGlfw_ScrollCallback(w, x, y);
        Input& input = inputOf(w);
        input.any = true;
        input.wheel += y;
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        Input& input = inputOf(w);
        input.any = true;
        input.x = x;
        input.y = y;
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
        ImGui_ImplGlfw_CursorEnterCallback(w, entered);
        inputOf(w).any = true;
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
        ImGui_ImplGlfw_WindowFocusCallback(w, focused);
        inputOf(w).any = true;
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { inputOf(w).any = true; });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { inputOf(w).any = true; });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) { inputOf(w).any = true; });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** names) {
        Input& input = inputOf(w);
        input.any = true;
        for (int i = 0; i < count; ++i) input.dropped.emplace_back(names[i]);
    });
}

namespace {

Input& inputOf(GLFWwindow* window) {
    return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

}  // namespace

Input Window::poll(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    const double scale = pixelsPerUnit();
    input_.closed = glfwWindowShouldClose(window_) == GLFW_TRUE;
    Input input = std::exchange(input_, {});
    input_.x = input.x;  // in window coordinates, until the cursor moves
    input_.y = input.y;
    input.x *= scale;
    input.y *= scale;
    for (Input::Button& button : input.buttons) {
        button.x *= scale;
        button.y *= scale;
    }
    return input;
}

bool Window::isDown(int key) const {
    return glfwGetKey(window_, key) == GLFW_PRESS;
}
void Window::size(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) width = height = 0;
}

double Window::pixelsPerUnit() const {
    int pixels = 0, units = 0, other = 0;
    glfwGetFramebufferSize(window_, &pixels, &other);
    glfwGetWindowSize(window_, &units, &other);
    return units > 0 && pixels > 0 ? double(pixels) / units : 1;
}

double Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::clamp(double{x}, 0.5, 8.0);
}

void Window::setTitle(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::toggleFullScreen() {
    full_screen_ = !full_screen_;
    if (!full_screen_) {
        glfwSetWindowMonitor(window_, nullptr, restored_[0], restored_[1], restored_[2], restored_[3],
                             GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(window_, &restored_[0], &restored_[1]);
    glfwGetWindowSize(window_, &restored_[2], &restored_[3]);
    // The monitor that contains the window's centre.
    const int x = restored_[0] + restored_[2] / 2, y = restored_[1] + restored_[3] / 2;
    int count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    GLFWmonitor* chosen = glfwGetPrimaryMonitor();
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfwGetMonitorPos(monitors[i], &left, &top);
        const GLFWvidmode* const mode = glfwGetVideoMode(monitors[i]);
        if (mode && x >= left && y >= top && x < left + mode->width && y < top + mode->height)
            chosen = monitors[i];
    }
    const GLFWvidmode* const mode = chosen ? glfwGetVideoMode(chosen) : nullptr;
    if (!mode) {
        full_screen_ = false;
        return;
    }
    glfwSetWindowMonitor(window_, chosen, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::copy(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

void Window::wake() {
    glfwPostEmptyEvent();
}

}  // namespace diptych::viewer
