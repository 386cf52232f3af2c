// SPDX-License-Identifier: MIT
#include "compare/viewer/window/zoom_flight.h"

#include <algorithm>
#include <cmath>

namespace diptych::viewer {

namespace {

constexpr double flightTime = 0.3;  // s

}  // namespace

void ZoomFlight::begin(double now, const CanvasView& view, const CanvasRect& canvas, const Size& size,
                       const PixelPosition& pixel, double zoom) {
    const double fits = std::min(double(canvas.width) / size.width, double(canvas.height) / size.height);
    const bool zoomed = view.zoom > 0;
    flight_ = Flight{now,
                     zoomed ? view.zoom : fits,
                     zoomed ? view.centre_x : 0.5 * size.width,
                     zoomed ? view.centre_y : 0.5 * size.height,
                     std::max(zoom, view.zoom),
                     pixel.x + 0.5,
                     pixel.y + 0.5};
}

void ZoomFlight::move(double now, CanvasView& view) {
    if (!flight_) return;
    const double t = std::clamp((now - flight_->begun) / flightTime, 0.0, 1.0), eased = t * t * (3 - 2 * t);
    view.zoom = flight_->from_zoom * std::pow(flight_->to_zoom / flight_->from_zoom, eased);
    // The position moves with the inverse zoom, so that the target approaches the centre evenly.
    const double fraction =
        flight_->to_zoom == flight_->from_zoom
            ? eased
            : (1 / flight_->from_zoom - 1 / view.zoom) / (1 / flight_->from_zoom - 1 / flight_->to_zoom);
    view.centre_x = std::lerp(flight_->from_x, flight_->to_x, fraction);
    view.centre_y = std::lerp(flight_->from_y, flight_->to_y, fraction);
    if (t >= 1) flight_.reset();
}

}  // namespace diptych::viewer
