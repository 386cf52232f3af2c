// SPDX-License-Identifier: MIT
#include "compare/choose/plot.h"

#include "compare/experiment/pareto.h"
#include "compare/plot/error_over_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::choose {
namespace {

// One end of the confidence interval of a finalist's time, ms; its time if the end is not known.
double endOf(const Candidate& candidate, double TimeRatio::*end) {
    if (!candidate.race || !std::isfinite((*candidate.race).*end)) return candidate.ms();
    return candidate.ms() / candidate.race->ratio * (*candidate.race).*end;
}

std::string labelOf(const Choice& choice, std::size_t i) {
    if (i == choice.chosen) return "chosen";
    if (i == choice.runner_up) return "runner-up";
    return i == choice.nearest ? "nearest" : "";
}

}  // namespace

std::string choicePlot(const ChoiceReport& report, PlotPlace place) {
    const Choice& choice = report.choice;
    ErrorPlot plot{
        .title = fmt::format("{} over time of the measured candidates, {}", report.figure(), report.scene),
        .error_name = report.figure() + " against the reference",
        .most_ms = report.budget.ms,
        .most_error = report.budget.error};
    std::vector<experiment::TimeError> points;
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const Candidate& candidate = choice.candidates[i];
        if (!candidate.isJudged() || candidate.timings == 0) continue;
        const double ms = candidate.ms(), error = candidate[report.budget.figure];
        const bool raced = candidate.status == CandidateStatus::raced;
        if (raced) plot.bar = "finalist, 99 % interval";
        points.push_back({ms, error});
        plot.points.push_back({candidate.settings.path, ms, endOf(candidate, &TimeRatio::low),
                               endOf(candidate, &TimeRatio::high), error, error, error, i + 1,
                               fmt::format("{}; {:.4g} ms, {} {:.4g}; {}", report.words[i], ms,
                                           report.figure(), error, statusInWords(candidate.status)),
                               false, raced, labelOf(choice, i)});
    }
    for (const std::size_t i : experiment::paretoFront(points)) plot.points[i].front = true;
    return errorPlot(plot, place, "img");
}

}  // namespace diptych::choose
