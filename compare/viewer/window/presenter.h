// SPDX-License-Identifier: MIT
// Shows pixels and Dear ImGui's draw data in a window, on its own Vulkan device, so that the paths' device
// never delays it.
#pragma once

#include "shared/vulkan/instance/instance.h"

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
    std::uint64_t version = 0;  // increases with every change of the above
};

class Presenter {
public:
    // `log`, for validation, must outlive this. Throws std::runtime_error, one line, if no device can
    // present to the window.
    Presenter(GLFWwindow* window, ValidationLog* log);
    ~Presenter();
    Presenter(const Presenter&) = delete;
    Presenter& operator=(const Presenter&) = delete;

    // Whether pixels are BGRA; otherwise RGBA.
    bool isBgr() const;
    // Begins a frame of Dear ImGui's renderer. Uses the font atlas of construction time.
    void beginFrame();
    // Shows the pixels, and over them Dear ImGui's draw data. Does nothing in a window without area.
    // Returns false if the device is lost; this must then be recreated.
    bool show(const WindowPixels& pixels, ImDrawData* drawing);

    std::string device() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diptych::viewer
