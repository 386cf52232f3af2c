// SPDX-License-Identifier: MIT
// What the interface asks to be drawn.
#pragma once

#include "compare/picture/picture.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/settings.h"
#include "shared/frame/sides.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace diptych::viewer {

// What stands in the left panel.
enum class Against { paths, reference, file };
std::string_view nameOf(Against against);  // "the other path"

// How two pictures are shown as one. Values: test - baseline where it is largest; its size; the channel's
// relative error; FLIP.
enum class Difference { none, signed_difference, absolute, relative, flip };
std::string_view nameOf(Difference difference);  // "signed"

struct PixelPlace {
    int x = 0, y = 0;  // of the picture, from the top left
    bool operator==(const PixelPlace&) const = default;
};

// What is drawn. The path of the Settings is that of the right panel.
struct Subject {
    std::string scene;  // as on the command line
    int reading = 0;    // rises when the scene is to be read again
    Settings settings;
    SideSettings sides;  // what one path has on top of them
    bool operator==(const Subject&) const = default;
};

// The same whichever path is the right panel's: what both paths draw.
inline Subject ofBothPaths(Subject subject) {
    subject.settings.path = drawn_paths[0];
    return subject;
}

// What of it is shown.
struct Look {
    int mode = static_cast<int>(gpu::DEBUG_lit);
    bool heat = false;  // the light-count heat map, whichever channel is chosen
    Against against = Against::paths;
    std::filesystem::path file;  // Against::file
    Difference difference = Difference::none;
    std::optional<double> exposure{};  // PictureChoice
    std::optional<double> ev100{};
    bool tonemap = true;
    bool operator==(const Look&) const = default;
    int channel() const { return heat ? static_cast<int>(gpu::DEBUG_light_count) : mode; }  // that is shown
    PictureChoice picture() const { return {exposure, ev100, tonemap}; }
};

struct Order {
    std::uint64_t number = 0;  // rises with each
    Subject subject;
    Look look;
    bool moving = false;              // drawn smaller, and nothing else
    std::optional<PixelPlace> pixel;  // whose story is wanted
};

}  // namespace diptych::viewer
