// SPDX-License-Identifier: MIT
// The interactive window. It shows only results of the libraries of `render`, `compare` and `compare
// --pixel`: images, verdicts and pixel breakdowns.
#pragma once

#include "compare/verdict/comparison.h"
#include "compare/viewer/drawing/request.h"
#include "shared/vulkan/device/device.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace diptych::viewer {

struct ViewerOptions {
    Subject subject;  // shown first
    ViewOptions view_options;
    bool size_requested = false;         // false: images fill the window
    std::optional<PixelPosition> pixel;  // the pixel to break down and zoom to
    bool watch = false;                  // reload a scene when its files change
    std::filesystem::path out;           // folder for screenshots; empty: the current one
    DeviceOptions device;
    CompareOptions compare;  // rules of the verdict
    // Receives a line for each action and its duration; may be empty.
    std::function<void(const std::string&)> log;
};

// Shows the window until it is closed. Returns the number of validation-layer messages (0 without layers)
// and the first one. Throws std::runtime_error, one line, if there is no display.
struct ViewerResult {
    std::uint64_t validation_messages = 0;
    std::string first_validation_message;
};
ViewerResult runViewer(const ViewerOptions& options);

}  // namespace diptych::viewer
