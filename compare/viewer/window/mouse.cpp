// SPDX-License-Identifier: MIT
#include "compare/viewer/window/mouse.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

namespace diptych::viewer {
namespace {

constexpr double min_zoom = 1, max_zoom = 128;  // window pixels per image pixel
constexpr double wipeReach = 7;  // window pixels around the wipe's line where the cursor grabs it

}  // namespace

double Mouse::wipePosition(const CanvasRect& canvas) const {
    return canvas.x + static_cast<double>(std::lround(state_.canvas.wipe * canvas.width));
}

void Mouse::handle(const Input& input, const CanvasRect& canvas, double scale, bool taken) {
    const std::vector<PanelRect> panel_rects = panelRectsOf(canvas, state_);
    for (const Input::Button& button : input.buttons) {
        if (!button.down) {
            if (button.button != GLFW_MOUSE_BUTTON_LEFT) continue;
            // A quick drag begins and ends between two frames.
            drag(canvas, panel_rects, button.x, button.y);
            drag_ = Drag::none;
            continue;
        }
        if (taken || !canvas.contains(button.x, button.y)) continue;
        if (button.button == GLFW_MOUSE_BUTTON_RIGHT) {
            if (const auto under =
                    pixelUnder(panel_rects, state_.subject.settings.size, button.x, button.y)) {
                state_.pixel = under->pixel;
                state_.open = Tab::pixel;
                contents_.under = under;
                calls_.log("pixel " + belowText(contents_));
            }
        } else if (button.button == GLFW_MOUSE_BUTTON_LEFT) {
            const bool wipes = state_.canvas.layout == Layout::wipe &&
                               state_.view_options.difference == Difference::none &&
                               std::abs(button.x - wipePosition(canvas)) <= wipeReach * scale;
            drag_ = wipes ? Drag::wipe : state_.canvas.zoom > 0 ? Drag::image : Drag::look;
            pivot_ = pivotAt(panel_rects, button.x, button.y);
            cursor_x_ = button.x;
            cursor_y_ = button.y;
        }
    }
    drag(canvas, panel_rects, input.x, input.y);
    if (input.wheel != 0 && !taken && canvas.contains(input.x, input.y)) wheel(input, panel_rects);
    contents_.under = canvas.contains(input.x, input.y) && !taken
                          ? pixelUnder(panel_rects, state_.subject.settings.size, input.x, input.y)
                          : std::nullopt;
}

void Mouse::drag(const CanvasRect& canvas, const std::vector<PanelRect>& panel_rects, double x, double y) {
    const double dx = x - cursor_x_, dy = y - cursor_y_;
    cursor_x_ = x;
    cursor_y_ = y;
    if (drag_ != Drag::none && (dx != 0 || dy != 0)) dragged(canvas, panel_rects, dx, dy);
}

void Mouse::dragged(const CanvasRect& canvas, const std::vector<PanelRect>& panel_rects, double dx,
                    double dy) {
    switch (drag_) {
        case Drag::none:
            return;
        case Drag::wipe:
            state_.canvas.wipe = std::clamp((cursor_x_ - canvas.x) / canvas.width, 0.0, 1.0);
            return;
        case Drag::image:
            state_.canvas.centre_x -= dx / state_.canvas.zoom;
            state_.canvas.centre_y -= dy / state_.canvas.zoom;
            return;
        case Drag::look: {
            if (!camera_.canMove() || !contents_.shown || panel_rects.empty()) return;
            // As if the image were dragged: its height is the field of view.
            const double tall = state_.subject.settings.size.height * panel_rects.front().placement.scale;
            const double angle =
                contents_.shown->camera.fov_degrees * std::numbers::pi / 180 / std::max(tall, 1.0);
            if (state_.orbiting)
                camera_.orbit(pivot_, 2 * dx * angle, -2 * dy * angle);
            else
                camera_.look(dx * angle, -dy * angle);
            calls_.moved();
            return;
        }
    }
}

void Mouse::wheel(const Input& input, const std::vector<PanelRect>& panel_rects) {
    if (state_.canvas.zoom > 0) {
        const auto under = pixelUnder(panel_rects, state_.subject.settings.size, input.x, input.y);
        const double before = state_.canvas.zoom;
        state_.canvas.zoom =
            std::clamp(std::round(before * std::exp2(0.5 * input.wheel)), min_zoom, max_zoom);
        if (state_.canvas.zoom == before && input.wheel > 0)
            state_.canvas.zoom = std::min(before + 1, max_zoom);
        if (!under || panel_rects.empty()) return;
        // The point under the cursor stays there.
        const double x = under->pixel.x + 0.5, y = under->pixel.y + 0.5, ratio = before / state_.canvas.zoom;
        state_.canvas.centre_x = x + (state_.canvas.centre_x - x) * ratio;
        state_.canvas.centre_y = y + (state_.canvas.centre_y - y) * ratio;
        return;
    }
    state_.speed = std::clamp(state_.speed * std::exp2(0.5 * input.wheel), 1e-4, 1e4);
    calls_.tell(fmt::format("speed {:.3g} m/s", state_.speed * camera_.targetDistance()));
}

// The world position of the pixel, once this view is rendered at full size; else the camera's target.
glm::dvec3 Mouse::pivotAt(const std::vector<PanelRect>& panel_rects, double x, double y) const {
    const glm::dvec3 ahead = camera_.eye() + camera_.forward() * camera_.targetDistance();
    const auto under = pixelUnder(panel_rects, state_.subject.settings.size, x, y);
    const std::shared_ptr<const DrawnView>& shown = contents_.shown;
    if (!under || !shown || shown->depth.empty() ||
        ofBothPaths(shown->request.subject) != ofBothPaths(state_.subject))
        return ahead;
    return seenAt(shown->view, shown->depth, under->pixel).value_or(ahead);
}

}  // namespace diptych::viewer
