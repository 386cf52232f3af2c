// SPDX-License-Identifier: MIT
// The window: both paths live. It draws nothing that another command does not: pictures, verdicts and a
// pixel's story are made by the libraries of `render`, `compare` and `compare --pixel`.
#pragma once

#include "compare/verdict/comparison.h"
#include "compare/viewer/order.h"
#include "shared/vulkan/device.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace diptych::viewer {

struct ViewerOptions {
    Subject subject;  // what is shown first
    Look look;
    bool size_given = false;          // else pictures are as large as the window has room for
    std::optional<PixelPlace> pixel;  // whose story is told, and that is zoomed to
    bool watch = false;               // reads a scene again when its files change on disk
    std::filesystem::path out;        // folder of screenshots; empty: the current one
    DeviceOptions device;
    CompareOptions compare;  // what counts for the verdict
    // Told in a line each what was done and how long it took; empty: nobody is.
    std::function<void(const std::string&)> say;
};

// Shows the window until it is closed. Returns the number of messages of the validation layers, 0 without
// them, and the first one. Throws std::runtime_error, one line, where there is no display.
struct ViewerResult {
    std::uint64_t validation_messages = 0;
    std::string first_validation_message;
};
ViewerResult runViewer(const ViewerOptions& options);

}  // namespace diptych::viewer
