// SPDX-License-Identifier: MIT
// Parts that all plots share, as SVG with the classes of plot.css. Lengths are in the drawing's own units.
#pragma once

#include "compare/plot/log_axis.h"

#include <functional>
#include <string>
#include <vector>

namespace diptych {

extern const char* const plotStyle;  // plot.css, in a page and in separate files

// A plot in its own file contains its style and title; in a page, the page has both.
enum class PlotPlace { file, page };

// The rectangle that the axes enclose.
struct PlotBox {
    double left, top, right, bottom;  // edges; y grows downwards
};

class Drawing {
public:
    void line(const char* kind, double x1, double y1, double x2, double y2);
    void text(const char* kind, double x, double y, const std::string& words);  // escaped
    void add(const std::string& markup) { lines_ += markup; }

    struct Axis {
        std::vector<Tick> ticks;
        std::function<double(double)> place;  // maps a value to its position
        std::string name;
    };
    // Ticks, grid and names of two axes. The names need 50 units below the box and 30 above.
    void axes(const PlotBox& box, const Axis& across, const Axis& up);

    std::string group() const { return "<g>" + lines_ + texts_ + "</g>"; }  // text on top

private:
    std::string lines_, texts_;
};

// A length with one decimal digit, for SVG attributes.
std::string svgNumber(double length);

// The SVG element around a plot's markup.
std::string plotElement(double width, double height, const std::string& title, PlotPlace place,
                        const std::string& markup);

// For a plot's file of another machine: throws std::runtime_error unless plotElement() may write it
// (compare/page/emitted.h).
void checkPlot(std::string svg);

}  // namespace diptych
