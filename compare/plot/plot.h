// SPDX-License-Identifier: MIT
// The one kind of plot: panels of series, bars and limits over two axes, as SVG. A command describes its
// data; colours, marks, dashes, ticks, labels and the legend are the same in all plots.
#pragma once

#include "compare/plot/plot_axis.h"
#include "shared/frame/setting_values.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

extern const char* const plotStyle;  // plot.css, for files; page::style contains it too

// A plot in its own file contains its style and title; in a page, the page has both.
enum class PlotTarget { file, page };

// Nothing if both are equal.
struct PlotRange {
    double low = 0, high = 0;
};

struct PlotPoint {
    double x = 0, y = 0;
    std::string text{};        // tooltip
    PlotRange across{}, up{};  // intervals
    std::size_t row = 0;       // data-row; in a page, the point can have the focus. 0: none
    bool best = false;         // filled and larger, on top
    std::string label{};       // beside it
};

// A path has a colour and a mark; its series differ in dashes, and its marks are filled or hollow by turns.
struct PlotSeries {
    std::string name;            // in the legend; series of several panels may share it
    std::optional<Path> path{};  // none: the text's colour, and a stroke as mark
    bool line = true;            // joins the points
    std::vector<PlotPoint> points{};
};

struct PlotBar {
    PlotRange across, up;
    std::size_t part;  // its colour, below maxParts
    std::string text;
    bool beyond = false;  // in a limit's colour instead
};
inline constexpr std::size_t maxParts = 8;  // the last colour is grey

// The extent upwards of a bar of a category, below its name.
constexpr PlotRange barAt(double index) {
    return {index - 0.04, index + 0.35};
}

// A line across the panel, at a value of one axis.
struct PlotLimit {
    std::optional<double> x{}, y{};
    std::string name;
    bool strict = true;  // else only for orientation
};

struct PlotPanel {
    PlotAxis across{}, up{};
    std::vector<PlotSeries> series{};  // the first is on top
    std::vector<PlotBar> bars{};
    std::vector<PlotLimit> limits{};
    std::vector<std::pair<double, double>> front{};  // points (x, y): the least y within an x, as a step line

    // The points of the series with this name, which is added if it is new.
    std::vector<PlotPoint>& pointsOf(const std::string& name, std::optional<Path> path, bool line = true);
};

struct Plot {
    std::string title{};
    std::vector<PlotPanel> panels{};
    std::size_t columns = 1;
    double height = 420;               // of a panel without categories upwards
    std::vector<std::string> parts{};  // names of bars' colours
    std::string interval{};            // what intervals of points are; empty: not in the legend
    bool chooses = false;              // in a page, points are buttons
};

std::string svgOf(const Plot& plot, PlotTarget target);

// For a plot's file of another machine: throws std::runtime_error unless svgOf() may write it
// (compare/page/emitted.h).
void checkPlot(std::string svg);

}  // namespace diptych
