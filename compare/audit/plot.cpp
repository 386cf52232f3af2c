// SPDX-License-Identifier: MIT
#include "compare/plot/plot.h"
#include "compare/audit/report.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::audit {

namespace {

constexpr double minError = 1e-8, maxError = 1e2;

std::string wordsOf(const QuantityAudit& audit, const Step& step, std::size_t series) {
    const Outcome& outcome = step.outcomes[series];
    const std::uint64_t nonfinite = outcome.whole(Measure::nonfinite_pixels);
    return fmt::format("{}: {} {}: error {:.3g} (light {:.3g}, depth {:.3g}), FLIP {:.3g}{}",
                       audit.series[series].describe(), magnitudeText(step.magnitude), audit.quantity->unit,
                       outcome.error(), outcome[Measure::light_p99], outcome[Measure::depth_p99],
                       outcome[Measure::flip],
                       nonfinite > 0 ? fmt::format(", {} NaN or infinite", counted(nonfinite, "pixel")) : "");
}

}  // namespace

std::string auditPlot(const QuantityAudit& audit, PlotTarget target) {
    const Quantity& quantity = *audit.quantity;
    PlotPanel panel{
        .across = {fmt::format("{}{}{}", quantity.name, quantity.unit.empty() ? "" : ", ", quantity.unit)},
        .up = {.name = "relative error", .shown = {minError, maxError}}};
    for (std::size_t s = 0; s < audit.series.size(); ++s)
        for (const Step& step : audit.steps) {
            const double error = step.outcomes[s].error();
            panel.pointsOf(audit.series[s].describe(), audit.series[s].path)
                .push_back({step.magnitude,
                            error > 0 && std::isfinite(error) ? std::clamp(error, minError, maxError) : error,
                            wordsOf(audit, step, s)});
        }
    for (const std::size_t limit : {std::size_t{0}, requiredCriterion})
        panel.limits.push_back({.y = criteria[limit].limit, .name = std::string(criteria[limit].title)});
    panel.limits.push_back({.x = audit.original, .name = "magnitude in the scene", .strict = false});
    return svgOf({.title = fmt::format("error over {}", quantity.name), .panels = {panel}}, target);
}

}  // namespace diptych::audit
