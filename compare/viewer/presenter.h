// SPDX-License-Identifier: MIT
// Puts pixels and Dear ImGui's drawing into a window, by a Vulkan device of its own: what the paths' device
// is busy with never delays it.
#pragma once

#include "shared/vulkan/instance.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;
struct ImDrawData;

namespace diptych::viewer {

// Pixels for a part of the window, 4 bytes each in the order of Presenter::isBgr(), row 0 on top.
struct WindowPixels {
    int x = 0, y = 0, width = 0, height = 0;  // framebuffer pixels
    std::vector<std::uint8_t> data;
    std::uint64_t version = 0;  // rises whenever anything above changes
};

class Presenter {
public:
    // `log`, where validation is wanted, outlives this. Throws std::runtime_error, one line, where no device
    // shows anything in the window.
    Presenter(GLFWwindow* window, ValidationLog* log);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Whether pixels are stored blue, green, red, alpha; else red first.
    bool isBgr() const;
    // Begins a frame of Dear ImGui's renderer. The text is that of the atlas when this was made.
    void beginFrame();
    // Shows the pixels and, over them, Dear ImGui's drawing. In a window without area it does nothing. False
    // where the device is lost: this must be made anew.
    bool show(const WindowPixels& pixels, ImDrawData* drawing);

    std::string device() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych::viewer
