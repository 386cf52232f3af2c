// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych::viewer {
namespace {

Placement placementIn(const CanvasRect& rect, const Size& size, const CanvasView& view) {
    Placement placement;
    const double fits = std::min(double(rect.width) / size.width, double(rect.height) / size.height);
    placement.scale = view.zoom > 0 ? view.zoom : fits;
    const double x = view.zoom > 0 ? view.centre_x : 0.5 * size.width;
    const double y = view.zoom > 0 ? view.centre_y : 0.5 * size.height;
    // Snaps to window pixels, so that an integer zoom makes all image pixels equally large.
    placement.left = std::round(rect.x + 0.5 * rect.width - x * placement.scale);
    placement.top = std::round(rect.y + 0.5 * rect.height - y * placement.scale);
    return placement;
}

// Content of a window row or column: an image pixel, or -1 outside, and whether a grid line is there.
struct Sample {
    int pixel = -1;
    bool line = false;
};
std::vector<Sample> samplesOf(int from, int count, double origin, double scale, int full, int pixels) {
    std::vector<Sample> samples(static_cast<std::size_t>(count));
    int before = -2;
    for (int i = 0; i < count; ++i) {
        const double at = (from + i + 0.5 - origin) / scale;
        Sample& sample = samples[static_cast<std::size_t>(i)];
        if (at < 0 || at >= full) {
            before = -2;
            continue;
        }
        sample.pixel = std::min(pixels - 1, static_cast<int>(at * pixels / full));
        const int whole = static_cast<int>(at);
        sample.line = scale >= gridFrom && before != -2 && whole != before;
        before = whole;
    }
    return samples;
}

}  // namespace

std::vector<PanelRect> panelRectsOf(const CanvasRect& canvas, const Size& size, const CanvasView& view,
                                    bool difference) {
    const std::size_t first = view.other ? 1 : 0, second = 1 - first;
    std::vector<PanelRect> panel_rects;
    const auto add = [&](std::size_t panel, const CanvasRect& rect, const CanvasRect& within) {
        if (rect.width > 0 && rect.height > 0)
            panel_rects.push_back({panel, rect, placementIn(within, size, view)});
    };
    if (difference) {
        add(view.other ? 1 : 2, canvas, canvas);
    } else if (view.layout == Layout::single) {
        add(second, canvas, canvas);
    } else if (view.layout == Layout::wipe) {
        const int left = static_cast<int>(std::lround(std::clamp(view.wipe, 0.0, 1.0) * canvas.width));
        add(first, {canvas.x, canvas.y, left, canvas.height}, canvas);
        add(second, {canvas.x + left, canvas.y, canvas.width - left, canvas.height}, canvas);
    } else {
        constexpr int gap = 2;
        const int half = (canvas.width - gap) / 2;
        const CanvasRect left{canvas.x, canvas.y, half, canvas.height},
            right{canvas.x + canvas.width - half, canvas.y, half, canvas.height};
        add(first, left, left);
        add(second, right, right);
    }
    return panel_rects;
}

std::optional<PixelUnder> pixelUnder(const std::vector<PanelRect>& panel_rects, const Size& size, double x,
                                     double y) {
    for (const PanelRect& panel_rect : panel_rects) {
        if (!panel_rect.rect.contains(x, y)) continue;
        const double px = (x - panel_rect.placement.left) / panel_rect.placement.scale,
                     py = (y - panel_rect.placement.top) / panel_rect.placement.scale;
        if (px < 0 || py < 0 || px >= size.width || py >= size.height) return std::nullopt;
        return PixelUnder{panel_rect.panel, {static_cast<int>(px), static_cast<int>(py)}};
    }
    return std::nullopt;
}

std::vector<std::uint8_t> composed(const DrawnView& shown, const CanvasRect& canvas,
                                   const std::vector<PanelRect>& panel_rects, bool bgr) {
    constexpr std::array<std::uint8_t, 4> empty{26, 26, 28, 255};
    constexpr int lineLevel = 70;
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(canvas.width) *
                                     static_cast<std::size_t>(canvas.height));
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = empty[i % 4];
    const Size& full = shown.request.subject.settings.size;
    for (const PanelRect& panel_rect : panel_rects) {
        if (panel_rect.panel == 2 && !shown.difference) continue;
        const Image8& image =
            panel_rect.panel == 2 ? shown.difference->image : shown.panels.at(panel_rect.panel).image;
        if (image.data.empty()) continue;
        const std::vector<Sample> columns =
            samplesOf(panel_rect.rect.x, panel_rect.rect.width, panel_rect.placement.left,
                      panel_rect.placement.scale, full.width, image.width);
        const std::vector<Sample> rows =
            samplesOf(panel_rect.rect.y, panel_rect.rect.height, panel_rect.placement.top,
                      panel_rect.placement.scale, full.height, image.height);
        for (int y = 0; y < panel_rect.rect.height; ++y) {
            const Sample& row = rows[static_cast<std::size_t>(y)];
            if (row.pixel < 0) continue;
            std::uint8_t* to =
                pixels.data() + 4 * (static_cast<std::size_t>(panel_rect.rect.y - canvas.y + y) *
                                         static_cast<std::size_t>(canvas.width) +
                                     static_cast<std::size_t>(panel_rect.rect.x - canvas.x));
            const std::uint8_t* const line = image.data.data() + 3 * static_cast<std::size_t>(row.pixel) *
                                                                     static_cast<std::size_t>(image.width);
            for (const Sample& column : columns) {
                if (column.pixel >= 0) {
                    const std::uint8_t* const from = line + 3 * column.pixel;
                    const bool grid = row.line || column.line;
                    to[0] = grid ? lineLevel : from[bgr ? 2 : 0];
                    to[1] = grid ? lineLevel : from[1];
                    to[2] = grid ? lineLevel : from[bgr ? 0 : 2];
                }
                to += 4;
            }
        }
    }
    return pixels;
}

}  // namespace diptych::viewer
