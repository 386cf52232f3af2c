// SPDX-License-Identifier: MIT
#include "compare/tradeoff/plot.h"

#include "compare/page/text.h"
#include "compare/plot/error_over_time.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::tradeoff {

std::string tradeoffPlot(const Tradeoff& tradeoff, std::size_t figure, std::optional<Path> path,
                         PlotPlace place) {
    const std::string title(errorFigures[figure].title);
    ErrorPlot plot{.title = fmt::format("{} over time, {}{}", title, tradeoff.scene,
                                        path ? ", " + std::string(nameOf(*path)) : ""),
                   .error_name = title,
                   .legend = !path};
    const std::vector<std::size_t> front = frontOf(tradeoff, figure, path);
    for (const std::size_t i : rowsOf(tradeoff, path)) {
        const TradeoffRow& row = tradeoff.rows[i];
        const Spread error = spreadOf(row, errorMeasure(figure));
        const bool best = std::ranges::count(front, i) > 0;
        plot.points.push_back({row.settings.path, row[Measure::ms], row[Measure::ms_min],
                               row[Measure::ms_max], error.value, error.low, error.high, i + 1,
                               fmt::format("row {}: {}; {:.4g} ms, {} {}{}", i + 1,
                                           inWords(changesOf(row.settings, tradeoff.given)), row[Measure::ms],
                                           title, page::number(error.value), best ? ", on the front" : ""),
                               best, best, best ? fmt::format("{}", i + 1) : ""});
    }
    return errorPlot(plot, place, "button");
}

std::string plotName(std::size_t figure, std::optional<Path> path) {
    const std::string_view name = errorFigures[figure].name;
    return path ? fmt::format("{}.{}.svg", name, nameOf(*path)) : fmt::format("{}.svg", name);
}

}  // namespace diptych::tradeoff
