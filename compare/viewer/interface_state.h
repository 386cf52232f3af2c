// SPDX-License-Identifier: MIT
// What the person at the window has chosen, and what there is to show.
#pragma once

#include "compare/viewer/canvas.h"
#include "compare/viewer/drawing_thread.h"
#include "compare/viewer/order.h"
#include "compare/viewer/shown.h"

#include <array>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace diptych::viewer {

// Of the last pictures, the newest last; times in ms.
struct History {
    static constexpr std::size_t longest = 120;
    std::uint64_t measurement = 0;  // that was added last
    std::deque<float> total;
    std::map<std::string, std::deque<float>> passes;
    void add(const PathFacts& facts);
};

enum class Tab { verdict, settings, scene, pixel, cost };

struct InterfaceState {
    Subject subject;
    std::string
        loaded;  // the scene that is drawn: not the subject's while that is read, or where it cannot be
    Look look;
    std::filesystem::path stored;  // that T can put in the left panel; empty: none
    CanvasView canvas;
    bool follow = true;  // the picture is as large as the canvas
    bool panels = true, information = true, help = false, light_debug = false, orbiting = false,
         playing = false;
    std::optional<PixelPlace> pixel;  // that is looked into
    std::string rig;                  // --lights while it is switched off
    double speed = 1;                 // m/s as a share of the distance to the camera's first target
    Settings edited;  // as the settings' panel shows them: of no meaning where `problem` is not empty
    std::string problem;
    std::vector<std::string> counted;  // options of the command line that decide the verdict, for commands
    std::array<char, 64> filter{};     // of settings' names
    std::map<std::string, std::string> typed;  // options whose text is being edited
    std::optional<Tab> open;                   // a tab to be brought to the front
    std::string message;                       // at the foot, of what was done last
    double message_until = 0;                  // s, of the interface's clock

    // What panels ask of the window.
    struct Requests {
        std::string copy;  // to the clipboard
        bool reload = false;
        std::optional<std::pair<int, PixelPlace>> worst;  // channel and pixel to fly to
        std::optional<std::string> camera;                // to take, in the words of --camera
    } requests;
};

// What there is to show.
struct Contents {
    std::shared_ptr<const Shown> shown;
    std::shared_ptr<const Judged> judged;
    std::shared_ptr<const Story> story;
    std::shared_ptr<const SceneFacts> facts;
    Status status;
    std::string drawn_by, shown_by;   // names of the devices
    std::optional<PixelUnder> under;  // the cursor
    double interface_ms = 0;          // 99th percentile of the interface's own frames
    const std::array<History, 2>* history = nullptr;
    bool idle = false;
};

// Pixels of the window at scale 1. A bar that is too narrow for all it holds has more rows.
// `timesWidth`: of the times alone, without the panels at the side.
inline constexpr double barHeight = 34, barRow = 26, footHeight = 26, sideWidth = 545, timesWidth = 330;
// What the bar holds, in order: channel, heat map, panels, against, difference, exposure, keys; and between
// two of them.
inline constexpr std::array<double, 7> barWidths{242, 94, 168, 193, 170, 160, 64};
inline constexpr double barGap = 14, barEdge = 8;
// In which row of the bar each of them stands.
std::array<int, barWidths.size()> barRows(int width, double scale);

// The part of a window of this size that has pictures, with the interface `scale` times as large as usual.
CanvasRect canvasOf(const InterfaceState& state, int width, int height, double scale);

// The scene that is drawn, as on the command line.
const std::string& sceneOf(const InterfaceState& state);

// "diptych render ..." of the view, and "diptych compare ...".
std::string renderCommand(const InterfaceState& state);
std::string compareCommand(const InterfaceState& state);

// Puts the word into the option of the edited Settings; these are drawn where both paths can.
void setOption(InterfaceState& state, const std::string& option, const std::string& word);

// The values of the pixel under the cursor in both panels and their difference: "12,7  deferred: 0.1 0.2 0.3
// ...".
std::string underWords(const Contents& contents);

// "0.123 0.456 0.789": as many digits as tell a float from all others.
std::string valueWords(const Image& image, int x, int y);

}  // namespace diptych::viewer
