// SPDX-License-Identifier: MIT
// Drags, clicks and the wheel over the images.
#pragma once

#include "compare/viewer/interface/interface_state.h"
#include "compare/viewer/window/fly_camera.h"
#include "compare/viewer/window/window.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::viewer {

class Mouse {
public:
    // Changes `state`, the pixel under the cursor in `contents`, and `camera`, after which it calls
    // `moved`. `log` receives a line for the log, `tell` one also for the user.
    struct Calls {
        std::function<void()> moved;
        std::function<void(const std::string&)> log, tell;
    };
    Mouse(InterfaceState& state, Contents& contents, FlyCamera& camera, Calls calls)
        : state_(state), contents_(contents), camera_(camera), calls_(std::move(calls)) {}

    // `taken`: the interface uses the mouse.
    void handle(const Input& input, const CanvasRect& canvas, double scale, bool taken);

private:
    enum class Drag { none, look, wipe, image };

    double wipePosition(const CanvasRect& canvas) const;
    // The cursor moved.
    void drag(const CanvasRect& canvas, const std::vector<PanelRect>& panel_rects, double x, double y);
    void dragged(const CanvasRect& canvas, const std::vector<PanelRect>& panel_rects, double dx, double dy);
    void wheel(const Input& input, const std::vector<PanelRect>& panel_rects);
    glm::dvec3 pivotAt(const std::vector<PanelRect>& panel_rects, double x, double y) const;

    InterfaceState& state_;
    Contents& contents_;
    FlyCamera& camera_;
    const Calls calls_;
    Drag drag_ = Drag::none;
    glm::dvec3 pivot_{0};
    double cursor_x_ = 0, cursor_y_ = 0;
};

}  // namespace diptych::viewer
