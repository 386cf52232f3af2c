// SPDX-License-Identifier: MIT
#include "compare/tradeoff/plot.h"

#include "compare/page/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::tradeoff {

std::string tradeoffPlot(const Tradeoff& tradeoff, std::size_t metric, std::optional<Path> path,
                         PlotTarget target) {
    const std::string title(errorMetrics[metric].title);
    PlotPanel panel{.across = {"time of a frame, ms"}, .up = {title}};
    const std::vector<std::size_t> front = frontOf(tradeoff, metric, path);
    for (const std::size_t i : rowsOf(tradeoff, path)) {
        const TradeoffRow& row = tradeoff.rows[i];
        const CameraRange error = cameraRangeOf(row, errorMeasure(metric));
        const bool best = std::ranges::count(front, i) > 0;
        if (best) panel.front.emplace_back(row[Measure::ms], error.value);
        panel.pointsOf(std::string(nameOf(row.settings.path)), row.settings.path, false)
            .push_back(
                {.x = row[Measure::ms],
                 .y = error.value,
                 .text = fmt::format("row {}: {}; {:.4g} ms, {} {}{}", i + 1,
                                     describe(changesOf(row.settings, tradeoff.requested)), row[Measure::ms],
                                     title, page::number(error.value), best ? ", on the front" : ""),
                 .across = {row[Measure::ms_min], row[Measure::ms_max]},
                 .up = {error.low, error.high},
                 .row = i + 1,
                 .best = best,
                 .label = best ? fmt::format("{}", i + 1) : ""});
    }
    return svgOf({.title = fmt::format("{} over time, {}{}", title, tradeoff.scene,
                                       path ? ", " + std::string(nameOf(*path)) : ""),
                  .panels = {panel},
                  .interval = "least to greatest",
                  .chooses = true},
                 target);
}

std::string plotName(std::size_t metric, std::optional<Path> path) {
    const std::string_view name = errorMetrics[metric].name;
    return path ? fmt::format("{}.{}.svg", name, nameOf(*path)) : fmt::format("{}.svg", name);
}

}  // namespace diptych::tradeoff
