// SPDX-License-Identifier: MIT
// The user's choices and the results to show.
#pragma once

#include "compare/viewer/drawing/canvas.h"
#include "compare/viewer/drawing/drawing_thread.h"
#include "compare/viewer/drawing/request.h"
#include "compare/viewer/drawing/result.h"

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

// Times of the last images, ms, newest last.
struct History {
    static constexpr std::size_t longest = 120;
    std::uint64_t measurement = 0;  // the last one added
    std::deque<float> total;
    std::map<std::string, std::deque<float>> passes;
    void add(const PathProperties& properties);
};

// Window pixels per image pixel, at scale 1: of a pixel among its neighbours; with its values in digits.
inline constexpr double surroundingsZoom = 32, digitsZoom = 80;

// A pixel to fly to.
struct PixelFlight {
    PixelPosition pixel;
    double zoom = surroundingsZoom;
    bool operator==(const PixelFlight&) const = default;
};

enum class Tab { verdict, settings, scene, pixel, cost };

struct InterfaceState {
    Subject subject;
    std::string
        loaded;  // the rendered scene; differs from the subject's while that is read or cannot be read
    ViewOptions view_options;
    std::filesystem::path stored;  // file that T shows in the left panel; empty: none
    CanvasView canvas;
    bool follow = true;  // images are as large as the canvas
    bool panels = true, information = true, help = false, light_debug = false, orbiting = false,
         playing = false;
    std::optional<PixelPosition> pixel;  // the inspected one
    std::string rig;                     // value of --lights while the lights are off
    double speed = 1;                    // m/s as a fraction of the distance to the camera's first target
    Settings edited;                     // of the settings panel; invalid if `problem` is not empty
    std::string problem;
    std::vector<std::string> counted;          // verdict options of the command line, for commands
    std::array<char, 64> filter{};             // of the settings' names
    std::map<std::string, std::string> typed;  // options whose text is being edited
    std::optional<Tab> open;                   // a tab to open
    std::string message;                       // result of the last action, in the footer
    double message_until = 0;                  // s, on the interface's clock

    // Requests from panels and keys to the window.
    struct Requests {
        std::string copy;  // to the clipboard
        bool reload = false;
        std::optional<PixelFlight> flight;
        std::optional<std::string> camera;  // to use, as --camera text
    } requests;
};

// The results to show.
struct Contents {
    std::shared_ptr<const DrawnView> shown;
    std::shared_ptr<const EvaluatedPair> evaluated;
    std::shared_ptr<const Breakdown> breakdown;
    std::shared_ptr<const SceneProperties> properties;
    Status status;
    std::string drawn_by, shown_by;   // names of the devices
    std::optional<PixelUnder> under;  // under the cursor
    double interface_ms = 0;          // 99th percentile of the interface's own frames
    const std::array<History, 2>* history = nullptr;
    bool idle = false;
};

// Sizes in window pixels at scale 1. A bar that does not fit into one row has more. `timesWidth`: only the
// times are visible, not the side panels.
inline constexpr double barHeight = 34, barRow = 26, footHeight = 26, sideWidth = 545, timesWidth = 330;
// Widths of the bar's items, in order: channel, heat map, panels, against, difference, exposure, keys.
// barGap is between two of them.
inline constexpr std::array<double, 7> barWidths{242, 94, 168, 193, 170, 160, 64};
inline constexpr double barGap = 14, barEdge = 8;
// The row of each item of the bar.
std::array<int, barWidths.size()> barRows(int width, double scale);

// The part of a window of this size for images; `scale` enlarges the interface.
CanvasRect canvasOf(const InterfaceState& state, int width, int height, double scale);
// The panels in that part.
std::vector<PanelRect> panelRectsOf(const CanvasRect& canvas, const InterfaceState& state);

// The rendered scene, as on the command line.
const std::string& sceneOf(const InterfaceState& state);

// "Diptych - box - normals", for the window.
std::string titleOf(const InterfaceState& state, const Contents& contents);

// "diptych render ..." and "diptych compare ..." for the view.
std::string renderCommand(const InterfaceState& state);
std::string compareCommand(const InterfaceState& state);

// Sets an option of the edited Settings, which are rendered if both paths support them.
void setOption(InterfaceState& state, const std::string& option, const std::string& word);

// The values of the pixel under the cursor in both panels and their difference: "12,7  deferred: 0.1 0.2
// 0.3 ...".
std::string belowText(const Contents& contents);

// "0.123 0.456 0.789": the shortest digits that identify each float.
std::string valueText(const Image& image, int x, int y);

}  // namespace diptych::viewer
