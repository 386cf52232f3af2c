// SPDX-License-Identifier: MIT
// Places the panels in the window and composes their pixels. Exact: display values equal the image's at
// any zoom. Needs no window or device.
#pragma once

#include "compare/viewer/drawing/request.h"
#include "compare/viewer/drawing/result.h"

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

// View of the panels.
struct CanvasView {
    Layout layout = Layout::wipe;
    double wipe = 0.5;  // fraction of the canvas for the left panel
    // Flicker: the panels are swapped; instead of a difference, the right one is shown.
    bool other = false;
    double zoom = 0;                    // window pixels per image pixel; 0: as large as fits
    double centre_x = 0, centre_y = 0;  // zoomed: the image position at the panel's centre, pixels
    bool operator==(const CanvasView&) const = default;
};

// Maps image to window: x to left + x * scale, y likewise.
struct Placement {
    double left = 0, top = 0, scale = 1;
};

// A panel's position in the window; `canvas` is the part of the window for images.
struct PanelRect {
    std::size_t panel = 0;  // index into DrawnView::panels; 2: the difference
    CanvasRect rect;        // visible part of the panel, in the window
    Placement placement;
};

// For images of the requested `size`; a smaller image is scaled to the same rectangle.
std::vector<PanelRect> panelRectsOf(const CanvasRect& canvas, const Size& size, const CanvasView& view,
                                    bool difference);

struct PixelUnder {
    std::size_t panel = 0;
    PixelPosition pixel;  // of an image of the requested size
};
// The pixel at a window position; empty outside the images.
std::optional<PixelUnder> pixelUnder(const std::vector<PanelRect>& panel_rects, const Size& size, double x,
                                     double y);

// The canvas's pixels, 4 bytes each, alpha 255, row 0 on top. From `gridFrom` on, lines separate image
// pixels.
inline constexpr double gridFrom = 8, valuesFrom = 64;  // window pixels per image pixel
std::vector<std::uint8_t> composed(const DrawnView& shown, const CanvasRect& canvas,
                                   const std::vector<PanelRect>& panel_rects, bool bgr);

}  // namespace diptych::viewer
