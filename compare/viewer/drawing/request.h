// SPDX-License-Identifier: MIT
// The interface's requests.
#pragma once

#include "compare/image/channel_image.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/settings.h"
#include "shared/frame/sides.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace diptych::viewer {

// Content of the left panel.
enum class Against { paths, reference, file };
std::string_view nameOf(Against against);  // "the other path"

// How to compare two images: test - baseline of the component where it is largest; its magnitude; the
// channel's relative error; FLIP.
enum class Difference { none, signed_difference, absolute, relative, flip };
std::string_view nameOf(Difference difference);  // "signed"

struct PixelPosition {
    int x = 0, y = 0;  // in the image, from the top left
    bool operator==(const PixelPosition&) const = default;
};

// Rendering input. The Settings' path is the right panel's.
struct Subject {
    std::string scene;  // as on the command line
    int reading = 0;    // incremented to read the scene again
    Settings settings;
    SideSettings sides;  // settings of one path only
    bool operator==(const Subject&) const = default;
};

// Normalises the path of the right panel: the input of both paths.
inline Subject ofBothPaths(Subject subject) {
    subject.settings.path = drawn_paths[0];
    return subject;
}

// View options.
struct ViewOptions {
    Channel mode = Channel::lit;
    bool heat = false;  // light-count heat map instead of the chosen channel
    Against against = Against::paths;
    std::filesystem::path file;  // Against::file
    Difference difference = Difference::none;
    std::optional<double> exposure{};  // ImageChoice
    std::optional<double> ev100{};
    bool tonemap = true;
    bool operator==(const ViewOptions&) const = default;
    // The visible one.
    Channel channel() const { return heat ? Channel::light_count : mode; }
    ImageChoice image() const { return {exposure, ev100, tonemap}; }
};

struct DrawRequest {
    std::uint64_t id = 0;  // increases
    Subject subject;
    ViewOptions view_options;
    bool moving = false;                 // smaller images, and nothing else
    std::optional<PixelPosition> pixel;  // the pixel to break down
};

}  // namespace diptych::viewer
