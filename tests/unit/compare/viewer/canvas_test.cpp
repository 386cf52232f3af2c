// SPDX-License-Identifier: MIT
// Positions and pixels of the panels in the window.
#include "compare/viewer/drawing/canvas.h"
#include "compare/viewer/interface/interface_state.h"

#include <gtest/gtest.h>

namespace diptych::viewer {
namespace {

Image8 colored(int width, int height, std::uint8_t base) {
    Image8 image{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.data.push_back(static_cast<std::uint8_t>(base + 7 * x + 3 * y + c));
    return image;
}

DrawnView shownOf(int width, int height) {
    DrawnView shown;
    shown.request.subject.settings.size.width = width;
    shown.request.subject.settings.size.height = height;
    shown.size = shown.request.subject.settings.size;
    shown.panels[0].image = colored(width, height, 0);
    shown.panels[1].image = colored(width, height, 100);
    return shown;
}

struct Rgb8Pixel {
    int r, g, b;
    bool operator==(const Rgb8Pixel&) const = default;
};
Rgb8Pixel inCanvas(const std::vector<std::uint8_t>& pixels, int width, int x, int y) {
    const std::uint8_t* const p = pixels.data() + 4 * (y * width + x);
    return {p[0], p[1], p[2]};
}
Rgb8Pixel inImage(const Image8& image, int x, int y) {
    const std::uint8_t* const p = image.data.data() + 3 * (y * image.width + x);
    return {p[0], p[1], p[2]};
}

TEST(ViewerCanvas, TheWipesHalvesAreTheImagesPixels) {
    const DrawnView shown = shownOf(12, 8);
    const CanvasRect canvas{0, 30, 12, 8};
    CanvasView view;
    view.wipe = 5.0 / 12;
    const auto panel_rects = panelRectsOf(canvas, shown.size, view, false);
    const auto pixels = composed(shown, canvas, panel_rects, false);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 12; ++x) {
            EXPECT_EQ(inCanvas(pixels, 12, x, y), inImage(shown.panels[x < 5 ? 0 : 1].image, x, y))
                << x << "," << y;
        }
    view.other = true;  // flicker
    const auto swapped = composed(shown, canvas, panelRectsOf(canvas, shown.size, view, false), false);
    EXPECT_EQ(inCanvas(swapped, 12, 0, 0), inImage(shown.panels[1].image, 0, 0));
    EXPECT_EQ(inCanvas(swapped, 12, 11, 0), inImage(shown.panels[0].image, 11, 0));
}

TEST(ViewerCanvas, BlueComesFirstWhereTheWindowHasItSo) {
    const DrawnView shown = shownOf(2, 2);
    const CanvasRect canvas{0, 0, 2, 2};
    CanvasView view;
    view.layout = Layout::single;
    const auto pixels = composed(shown, canvas, panelRectsOf(canvas, shown.size, view, false), true);
    const Rgb8Pixel bgr = inCanvas(pixels, 2, 1, 1), rgb = inImage(shown.panels[1].image, 1, 1);
    EXPECT_EQ(bgr, (Rgb8Pixel{rgb.b, rgb.g, rgb.r}));
}

// As wide or as high as its panel, whichever comes first, with the canvas's grey beside it.
TEST(ViewerCanvas, AnImageFillsItsPanel) {
    const DrawnView shown = shownOf(10, 5);
    const CanvasRect canvas{0, 0, 37, 20};
    CanvasView view;
    view.layout = Layout::single;
    const auto panel_rects = panelRectsOf(canvas, shown.size, view, false);
    ASSERT_EQ(panel_rects.size(), 1u);
    EXPECT_DOUBLE_EQ(panel_rects[0].placement.scale, 3.7);
    const auto pixels = composed(shown, canvas, panel_rects, false);
    const int left = static_cast<int>(panel_rects[0].placement.left),
              top = static_cast<int>(panel_rects[0].placement.top);
    EXPECT_EQ(left, 0);
    EXPECT_EQ(top, 1);
    EXPECT_EQ(inCanvas(pixels, 37, 0, 1), inImage(shown.panels[1].image, 0, 0));
    EXPECT_EQ(inCanvas(pixels, 37, 3, 4), inImage(shown.panels[1].image, 0, 0));
    EXPECT_EQ(inCanvas(pixels, 37, 4, 1), inImage(shown.panels[1].image, 1, 0));
    EXPECT_EQ(inCanvas(pixels, 37, 36, 18), inImage(shown.panels[1].image, 9, 4));
    EXPECT_EQ(inCanvas(pixels, 37, 0, 0), (Rgb8Pixel{26, 26, 28}));
    const auto under = pixelUnder(panel_rects, shown.size, 4.5, 1.5);
    ASSERT_TRUE(under);
    EXPECT_EQ(under->pixel, (PixelPosition{1, 0}));
    EXPECT_FALSE(pixelUnder(panel_rects, shown.size, 4.5, 0.5));
    // With the larger of the two factors, part of the image would be outside.
    EXPECT_DOUBLE_EQ(panelRectsOf({0, 0, 37, 10}, shown.size, view, false)[0].placement.scale, 2);
}

TEST(ViewerCanvas, OverADifferenceTheRightPanelIsShownWhileThereIsAnother) {
    const CanvasRect canvas{0, 0, 40, 20};
    CanvasView view;
    ASSERT_EQ(panelRectsOf(canvas, {10, 5}, view, true).size(), 1u);
    EXPECT_EQ(panelRectsOf(canvas, {10, 5}, view, true)[0].panel, 2u);
    view.other = true;
    ASSERT_EQ(panelRectsOf(canvas, {10, 5}, view, true).size(), 1u);
    EXPECT_EQ(panelRectsOf(canvas, {10, 5}, view, true)[0].panel, 1u);
}

TEST(ViewerBar, ANarrowOneHasMoreRows) {
    for (const double scale : {1.0, 1.5, 2.0})
        for (const int width : {1, 100, 300, 640, 900, 1280, 4000}) {
            const auto rows = barRows(width, scale);
            double x = 0;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const bool new_row = i == 0 || rows[i] != rows[i - 1];
                x = (new_row ? barEdge : x + barGap) + barWidths[i];
                // Each fits, or is alone in its row.
                EXPECT_TRUE(x * scale <= width || new_row) << width << " " << scale << " " << i;
                if (i > 0) {
                    EXPECT_TRUE(rows[i] == rows[i - 1] || rows[i] == rows[i - 1] + 1);
                }
            }
            InterfaceState state;
            const CanvasRect canvas = canvasOf(state, width, 600, scale);
            EXPECT_EQ(canvas.y, static_cast<int>((barHeight + barRow * rows.back()) * scale));
        }
    EXPECT_EQ(barRows(1280, 1).back(), 0);
}

TEST(ViewerCanvas, ASmallerImageFillsTheSamePlace) {
    DrawnView shown = shownOf(8, 8);
    shown.panels[1].image = colored(4, 4, 100);
    shown.size.width = shown.size.height = 4;
    const CanvasRect canvas{0, 0, 8, 8};
    CanvasView view;
    view.layout = Layout::single;
    const auto pixels = composed(
        shown, canvas, panelRectsOf(canvas, shown.request.subject.settings.size, view, false), false);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            EXPECT_EQ(inCanvas(pixels, 8, x, y), inImage(shown.panels[1].image, x / 2, y / 2));
        }
}

TEST(ViewerCanvas, LargePixelsHaveALineBetweenThem) {
    const DrawnView shown = shownOf(4, 4);
    const CanvasRect canvas{0, 0, 40, 40};
    CanvasView view;
    view.layout = Layout::single;
    view.zoom = 10;
    view.centre_x = view.centre_y = 2;
    const auto pixels = composed(shown, canvas, panelRectsOf(canvas, shown.size, view, false), false);
    EXPECT_EQ(inCanvas(pixels, 40, 5, 5), inImage(shown.panels[1].image, 0, 0));
    EXPECT_EQ(inCanvas(pixels, 40, 10, 5), (Rgb8Pixel{70, 70, 70}));
    EXPECT_EQ(inCanvas(pixels, 40, 11, 5), inImage(shown.panels[1].image, 1, 0));
}

TEST(ViewerCanvas, NoSizeIsTooSmall) {
    const DrawnView shown = shownOf(4, 4);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {3, 2}})
        for (const Layout layout : {Layout::wipe, Layout::side_by_side, Layout::single})
            for (const bool difference : {false, true}) {
                const CanvasRect canvas{0, 0, width, height};
                CanvasView view;
                view.layout = layout;
                const auto panel_rects = panelRectsOf(canvas, shown.size, view, difference);
                EXPECT_EQ(composed(shown, canvas, panel_rects, false).size(),
                          4u * static_cast<unsigned>(width * height));
            }
}

// Without side panels the times have their own column; without both the images have all the width.
TEST(ViewerCanvas, TimesStandBesideTheImages) {
    InterfaceState state;
    EXPECT_EQ(canvasOf(state, 1280, 760, 1).width, 1280 - static_cast<int>(sideWidth));
    state.panels = false;
    EXPECT_EQ(canvasOf(state, 1280, 760, 1).width, 1280 - static_cast<int>(timesWidth));
    state.information = false;
    EXPECT_EQ(canvasOf(state, 1280, 760, 1).width, 1280);
}

}  // namespace
}  // namespace diptych::viewer
