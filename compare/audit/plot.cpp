// SPDX-License-Identifier: MIT
#include "compare/audit/report.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::audit {

namespace {

constexpr double plotWidth = 720, plotHeight = 380, leftEdge = 74, rightEdge = 16, topEdge = 34;
constexpr double legendLine = 18;
constexpr double leastError = 1e-8, mostError = 1e2;

// Over many decades, labels only some ticks and removes the unlabelled ones.
std::vector<Tick> fewerNames(std::vector<Tick> ticks) {
    constexpr std::size_t most = 9;
    const auto named = static_cast<std::size_t>(
        std::ranges::count_if(ticks, [](const Tick& tick) { return !tick.text.empty(); }));
    if (named <= most) return ticks;
    std::erase_if(ticks, [](const Tick& tick) { return tick.text.empty(); });
    const std::size_t every = (named + most - 1) / most;
    for (std::size_t i = 0; i < ticks.size(); ++i)
        if (i % every != 0) ticks[i].text.clear();
    return ticks;
}

class AuditPlot {
public:
    explicit AuditPlot(const QuantityAudit& audit)
        : audit_(audit), across_(magnitudesOf(audit)), up_({leastError, mostError}) {}

    std::string svg(PlotPlace place) const {
        const Quantity& quantity = *audit_.quantity;
        const std::string name =
            fmt::format("{}{}{}", quantity.name, quantity.unit.empty() ? "" : ", ", quantity.unit);
        Drawing drawing;
        drawing.axes(box_, {fewerNames(across_.ticks()), [this](double m) { return x(m); }, name},
                     {up_.ticks(), [this](double e) { return y(e); }, "relative error"});
        for (const double limit : {1e-3, 1e-2})
            drawing.line("budget", box_.left, y(limit), box_.right, y(limit));
        if (audit_.original > 0)
            drawing.line("usual", x(audit_.original), box_.top, x(audit_.original), box_.bottom);
        // The first of overlapping series is on top.
        for (std::size_t s = audit_.series.size(); s-- > 0;) drawing.add(line(s));
        double py = box_.bottom + 62;
        for (std::size_t s = 0; s < audit_.series.size(); ++s, py += legendLine) {
            drawing.add(fmt::format("<g class=\"{}\"><path d=\"M{} {}h34\"/></g>", kind(s),
                                    svgNumber(box_.left), svgNumber(py - 4)));
            drawing.text("tick", box_.left + 42, py, audit_.series[s].words());
        }
        return plotElement(plotWidth,
                           box_.bottom + 56 + legendLine * static_cast<double>(audit_.series.size()),
                           fmt::format("error over {}", quantity.name), place, drawing.group());
    }

private:
    static std::vector<double> magnitudesOf(const QuantityAudit& audit) {
        std::vector<double> all;
        for (const Step& step : audit.steps) all.push_back(step.magnitude);
        return all;
    }
    double x(double magnitude) const {
        const double place = magnitude > 0 ? across_.place(magnitude) : 0;
        return box_.left + place * (box_.right - box_.left);
    }
    double y(double error) const {
        const double shown = std::isfinite(error) ? std::clamp(error, leastError, mostError) : mostError;
        return box_.bottom - up_.place(shown) * (box_.bottom - box_.top);
    }
    std::string kind(std::size_t s) const {
        // Dashes distinguish series of the same path.
        std::size_t before = 0;
        for (std::size_t i = 0; i < s; ++i) before += audit_.series[i].path == audit_.series[s].path;
        return fmt::format("curve {} dash{}", nameOf(audit_.series[s].path),
                           std::min<std::size_t>(before, 4));
    }
    std::string line(std::size_t s) const {
        std::string path, marks;
        for (const Step& step : audit_.steps) {
            const Outcome& outcome = step.outcomes[s];
            const double px = x(step.magnitude), py = y(outcome.error());
            path += fmt::format("{}{} {}", path.empty() ? "M" : "L", svgNumber(px), svgNumber(py));
            const std::string words = page::markup(
                fmt::format("{}: {} {}: error {:.3g} (light {:.3g}, depth {:.3g}), FLIP {:.3g}{}",
                            audit_.series[s].words(), magnitudeInWords(step.magnitude), audit_.quantity->unit,
                            outcome.error(), outcome[Measure::light_p99], outcome[Measure::depth_p99],
                            outcome[Measure::flip],
                            outcome.whole(Measure::nonfinite_pixels) > 0
                                ? fmt::format(", {} NaN or infinite",
                                              counted(outcome.whole(Measure::nonfinite_pixels), "pixel"))
                                : ""));
            const bool number = std::isfinite(outcome.error());
            marks += number ? fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3\"><title>{}</title></circle>",
                                          svgNumber(px), svgNumber(py), words)
                            : fmt::format(
                                  "<path class=\"cross\" d=\"M{0} {1}l8 8m0 -8l-8 8\"><title>{2}"
                                  "</title></path>",
                                  svgNumber(px - 4), svgNumber(py - 4), words);
        }
        return fmt::format("<g class=\"{}\"><path d=\"{}\"/>{}</g>", kind(s), path, marks);
    }

    const PlotBox box_{leftEdge, topEdge, plotWidth - rightEdge, plotHeight - 56};
    const QuantityAudit& audit_;
    const LogAxis across_, up_;
};

}  // namespace

std::string auditPlot(const QuantityAudit& audit, PlotPlace place) {
    return AuditPlot(audit).svg(place);
}

}  // namespace diptych::audit
