// SPDX-License-Identifier: MIT
#include "compare/plot/drawing.h"

#include "compare/page/emitted.h"
#include "compare/page/text.h"

#include <fmt/format.h>

namespace diptych {

using page::markup;

namespace {

constexpr double nameLeft = 10;

}  // namespace

std::string svgNumber(double length) {
    return fmt::format("{:.1f}", length);
}

void Drawing::line(const char* kind, double x1, double y1, double x2, double y2) {
    lines_ += fmt::format("<line class=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>", kind, svgNumber(x1),
                          svgNumber(y1), svgNumber(x2), svgNumber(y2));
}

void Drawing::text(const char* kind, double x, double y, const std::string& words) {
    texts_ += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>", kind, svgNumber(x), svgNumber(y),
                          markup(words));
}

// The vertical axis is named above it: a rotated name beside it would collide with the ticks if text is
// large.
void Drawing::axes(const PlotBox& box, const Axis& across, const Axis& up) {
    for (const Tick& tick : across.ticks) {
        const double x = across.place(tick.value);
        line(tick.text.empty() ? "minor" : "grid", x, box.top, x, box.bottom);
        text("tick middle", x, box.bottom + 20, tick.text);
    }
    for (const Tick& tick : up.ticks) {
        const double y = up.place(tick.value);
        line(tick.text.empty() ? "minor" : "grid", box.left, y, box.right, y);
        text("tick end", box.left - 8, y + 4, tick.text);
    }
    line("axis", box.left, box.bottom, box.right, box.bottom);
    line("axis", box.left, box.top, box.left, box.bottom);
    text("name middle", (box.left + box.right) / 2, box.bottom + 47, across.name);
    text("name", nameLeft, box.top - 12, up.name);
}

std::string plotElement(double width, double height, const std::string& title, PlotPlace place,
                        const std::string& inside) {
    const bool file = place == PlotPlace::file;
    std::string out = fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" {}role=\"{}\" aria-label=\"{}\">", width, height,
        file ? "xmlns=\"http://www.w3.org/2000/svg\" " : "", file ? "img" : "group", markup(title));
    if (file)
        out += fmt::format(
            "<title>{}</title><style>{}</style><rect class=\"paper\" width=\"100%\" height=\"100%\"/>",
            markup(title), plotStyle);
    return out + inside + "</svg>\n";
}

void checkPlot(std::string svg) {
    const std::string style = fmt::format("<style>{}</style>", plotStyle);
    if (const std::size_t at = svg.find(style); at != svg.npos) svg.erase(at, style.size());
    page::checkMarkup(svg);
}

}  // namespace diptych
