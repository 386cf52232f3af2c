// SPDX-License-Identifier: MIT
// Where the panels lie in the window, and their pixels there. Exact: a display value is that of the picture,
// whatever the zoom. No window and no device.
#pragma once

#include "compare/viewer/order.h"
#include "compare/viewer/shown.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace diptych::viewer {

enum class Layout { wipe, side_by_side, single };

struct CanvasRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const CanvasRect&) const = default;
    bool contains(double px, double py) const {
        return px >= x && py >= y && px < x + width && py < y + height;
    }
};

// How the panels are looked at.
struct CanvasView {
    Layout layout = Layout::wipe;
    double wipe = 0.5;   // share of the canvas that shows the left panel
    bool other = false;  // flicker: the panels change places; over a difference the right one is shown
    double zoom = 0;     // window pixels a pixel; 0: as large as fits
    double centre_x = 0, centre_y = 0;  // zoomed: the picture's place in the middle, pixels
    bool operator==(const CanvasView&) const = default;
};

// From the picture to the window: x at left + x * scale, y likewise.
struct Placement {
    double left = 0, top = 0, scale = 1;
};

// A panel's place in the window, `canvas` being the part that has pictures.
struct PanelPlace {
    std::size_t panel = 0;  // into Shown::panels; 2: the difference
    CanvasRect rect;        // that shows it, in the window
    Placement placement;
};

// Of pictures of `size`, which is that of the order: a smaller picture fills the same place.
std::vector<PanelPlace> placesOf(const CanvasRect& canvas, const Size& size, const CanvasView& view,
                                 bool difference);

struct PixelUnder {
    std::size_t panel = 0;
    PixelPlace pixel;  // of a picture of the order's size
};
// The pixel at a place of the window; nothing beside the pictures.
std::optional<PixelUnder> pixelUnder(const std::vector<PanelPlace>& places, const Size& size, double x,
                                     double y);

// The canvas's pixels, 4 bytes each, alpha 255, row 0 on top. Around each pixel a line from `gridFrom` on.
inline constexpr double gridFrom = 8, valuesFrom = 64;  // window pixels a pixel
std::vector<std::uint8_t> composed(const Shown& shown, const CanvasRect& canvas,
                                   const std::vector<PanelPlace>& places, bool bgr);

}  // namespace diptych::viewer
