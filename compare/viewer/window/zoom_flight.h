// SPDX-License-Identifier: MIT
// An animated zoom to a pixel.
#pragma once

#include "compare/viewer/drawing/canvas.h"

#include <optional>

namespace diptych::viewer {

class ZoomFlight {
public:
    // Animates from `view` to at least `zoom` window pixels per image pixel, with `pixel` at the centre.
    // `now`: s.
    void begin(double now, const CanvasView& view, const CanvasRect& canvas, const Size& size,
               const PixelPosition& pixel, double zoom);
    void stop() { flight_.reset(); }
    bool isFlying() const { return flight_.has_value(); }
    // Updates `view` for time `now`.
    void move(double now, CanvasView& view);

private:
    struct Flight {
        double begun = 0, from_zoom = 1, from_x = 0, from_y = 0, to_zoom = 1, to_x = 0, to_y = 0;
    };
    std::optional<Flight> flight_;
};

}  // namespace diptych::viewer
