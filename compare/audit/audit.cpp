// SPDX-License-Identifier: MIT
#include "compare/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace diptych::audit {

namespace {

constexpr double resolved = 1.25;     // a breaking point is known to this factor
constexpr std::size_t maxAdded = 16;  // refinement steps of a quantity
constexpr double agreement = 2;

// The steps in order of distance from the default one.
BreakingPoint breakingPointOf(const BreakCriterion& criterion, const std::vector<Step>& steps,
                              std::size_t series, std::size_t original, int way) {
    BreakingPoint point{.last = steps[original].magnitude};
    for (auto i = static_cast<std::ptrdiff_t>(original) + way; i >= 0 && i < std::ssize(steps); i += way) {
        const Step& step = steps[static_cast<std::size_t>(i)];
        // A case that the device rejects is no arithmetic failure.
        if (!step.outcomes[series].failed.empty()) return point;
        if (!passes(criterion, step.outcomes[series])) {
            point.first = step.magnitude;
            point.broken = true;
            return point;
        }
        point.last = step.magnitude;
    }
    return point;
}

// Four digits, which is finer than the resolution.
double rounded(double magnitude, const Quantity& quantity) {
    return quantity.whole ? std::round(magnitude) : std::stod(fmt::format("{:.4g}", magnitude));
}

Predicted predictedOf(const Quantity& quantity, const Subject& subject, const Settings& settings,
                      double error) {
    Settings original = settings;
    if (quantity.predicts_formats) original.depth_format = DepthFormat::d32f;
    if (!isPrecise(original)) return {};
    if (quantity.predict) return quantity.predict(subject, settings, error);
    return {.up = quantity.fails_at, .because = std::string(quantity.because)};
}

// Geometric mean, because magnitudes are tried by ratios.
double between(double a, double b) {
    return std::sqrt(a * b);
}

// The next magnitude to measure between two steps, so that a breaking point is known to a factor of 1.25.
// Empty if all are known, or after the maximum number of refinement steps.
std::optional<double> nextMagnitude(const QuantityAudit& audit) {
    if (audit.steps.size() >= audit.quantity->magnitudes.size() + 1 + maxAdded) return {};
    for (const std::vector<ValidRange>& of : audit.valid_ranges)
        for (const ValidRange& range : of)
            for (const BreakingPoint* point : {&range.up, &range.down}) {
                if (!range.at_original || !point->broken || point->last == 0 || point->first == 0) continue;
                if (std::max(point->last / point->first, point->first / point->last) <= resolved) continue;
                return rounded(between(point->last, point->first), *audit.quantity);
            }
    return {};
}

}  // namespace

const std::array<BreakCriterion, criterionCount> criteria{{
    {"1e-3", "error below 1e-3", 1e-3, [](const Outcome& outcome) { return outcome.error(); }},
    {"1e-2", "error below 1e-2", 1e-2, [](const Outcome& outcome) { return outcome.error(); }},
    {"visible", "not visible", 0.05, [](const Outcome& outcome) { return outcome[Measure::flip]; }},
    {"finite", "all finite", 0.5, [](const Outcome& outcome) { return outcome[Measure::nonfinite_pixels]; }},
}};

bool passes(const BreakCriterion& criterion, const Outcome& outcome) {
    return criterion.metric(outcome) < criterion.limit;
}

bool agrees(const BreakingPoint& point, double predicted, bool up, double tried) {
    if (!point.broken) return up ? predicted * agreement >= tried : predicted / agreement <= tried;
    const double measured = point.last > 0 ? between(point.last, point.first) : point.first;
    return predicted > 0 && std::max(measured / predicted, predicted / measured) <= agreement;
}

std::optional<bool> agrees(const QuantityAudit& audit, std::size_t criterion, std::size_t series) {
    const ValidRange& range = audit.valid_ranges[criterion][series];
    const Predicted& predicted = audit.predicted[criterion][series];
    if (predicted.because.empty()) return {};
    const double first = audit.steps.front().magnitude, last = audit.steps.back().magnitude;
    if (!range.at_original) return {};  // another error is larger
    // An upper bound is only refuted by passing beyond it.
    if (predicted.at_most && range.up.broken && range.up.last <= predicted.up) return {};
    return agrees(range.up, predicted.up, true, last) && agrees(range.down, predicted.down, false, first);
}

std::array<std::vector<ValidRange>, criterionCount> validRangesOf(const std::vector<Step>& steps,
                                                                  std::size_t series, double original) {
    std::array<std::vector<ValidRange>, criterionCount> all;
    const auto at = static_cast<std::size_t>(std::ranges::lower_bound(steps, original, {}, &Step::magnitude) -
                                             steps.begin());
    for (std::size_t c = 0; c < criterionCount; ++c)
        for (std::size_t s = 0; s < series; ++s) {
            ValidRange range;
            range.at_original = at < steps.size() && passes(criteria[c], steps[at].outcomes[s]);
            if (range.at_original) {
                range.up = breakingPointOf(criteria[c], steps, s, at, 1);
                range.down = breakingPointOf(criteria[c], steps, s, at, -1);
            }
            all[c].push_back(range);
        }
    return all;
}

QuantityAudit auditQuantity(const Quantity& quantity, const Subject& subject,
                            const std::function<Step(std::span<const Series>, double magnitude)>& step,
                            std::span<const double> beside) {
    QuantityAudit audit;
    audit.quantity = &quantity;
    audit.lacks = quantity.lacks(subject);
    if (!audit.lacks.empty()) return audit;
    audit.original = quantity.original(subject);
    ChosenSeries chosen = seriesOf(quantity, subject);
    audit.series = std::move(chosen.series);
    audit.omitted = std::move(chosen.omitted);
    std::set<double> magnitudes(quantity.magnitudes.begin(), quantity.magnitudes.end());
    magnitudes.insert(audit.original);
    magnitudes.insert(beside.begin(), beside.end());
    const auto measure = [&](double magnitude) {
        Step measured = step(audit.series, magnitude);
        const auto after = std::ranges::lower_bound(audit.steps, magnitude, {}, &Step::magnitude);
        audit.steps.insert(after, std::move(measured));
    };
    for (const double magnitude : magnitudes) measure(magnitude);
    for (;;) {
        audit.valid_ranges = validRangesOf(audit.steps, audit.series.size(), audit.original);
        const std::optional<double> next = nextMagnitude(audit);
        if (!next || std::ranges::count(audit.steps, *next, &Step::magnitude) > 0) break;
        measure(*next);
    }
    for (std::size_t c = 0; c < audit.predicted.size(); ++c)
        for (const Series& series : audit.series)
            audit.predicted[c].push_back(
                predictedOf(quantity, subject, series.applied(subject.original.settings), criteria[c].limit));
    return audit;
}

Requirement evaluate(const QuantityAudit& audit, double magnitude) {
    Requirement requirement{.quantity = std::string(audit.quantity->name), .magnitude = magnitude};
    if (!audit.lacks.empty()) {
        requirement.because = "not varied: " + audit.lacks;
        return requirement;
    }
    if (std::ranges::all_of(audit.steps, [](const Step& step) { return !step.isCovered(); })) {
        requirement.because = "no surface is in view";
        return requirement;
    }
    requirement.met = true;
    const bool up = magnitude >= audit.original;
    for (const Path path : drawn_paths) {
        // The best series of the path: a G-buffer that rounds is a choice, not a limit.
        std::optional<double> furthest;
        for (std::size_t s = 0; s < audit.series.size(); ++s) {
            const ValidRange& range = audit.valid_ranges[requiredCriterion][s];
            if (audit.series[s].path != path || !range.at_original) continue;
            const double last = (up ? range.up : range.down).last;
            if (!furthest || (up ? last > *furthest : last < *furthest)) furthest = last;
        }
        if (furthest && (up ? *furthest >= magnitude : *furthest <= magnitude)) continue;
        requirement.met = false;
        requirement.because +=
            fmt::format("{}{}: {}", requirement.because.empty() ? "" : "; ", nameOf(path),
                        furthest ? fmt::format("the error stays below 1e-2 as far as {:.3g}", *furthest)
                                 : "the unchanged scene already has an error of 1e-2 or more");
    }
    return requirement;
}

}  // namespace diptych::audit
