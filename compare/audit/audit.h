// SPDX-License-Identifier: MIT
// Increases quantities until the paths fail, and finds the last magnitude at which they pass.
#pragma once

#include "compare/audit/measure.h"
#include "compare/audit/quantities.h"
#include "shared/frame/frame.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

// A criterion that a path's image must meet.
struct BreakCriterion {
    std::string_view name, title;  // "1e-3", "error below 1e-3"
    double limit;
    double (*metric)(const Outcome&);
};
// Error below 1e-3 and below 1e-2; not visible (mean HDR-FLIP below 0.05); and every pixel finite.
inline constexpr std::size_t criterionCount = 4;
extern const std::array<BreakCriterion, criterionCount> criteria;
inline constexpr std::size_t requiredCriterion = 1;  // the criterion of --require
inline constexpr std::size_t visibleCriterion = 2, numberCriterion = 3;

bool passes(const BreakCriterion& criterion, const Outcome& outcome);

// How far one way a criterion is met, starting at the default magnitude.
struct BreakingPoint {
    double last = 0;   // last magnitude tried that meets it
    double first = 0;  // first one that does not; meaningless if not broken
    bool broken = false;
};
// `up` and `down` are empty if the criterion fails at the default magnitude.
struct ValidRange {
    bool at_original = false;
    BreakingPoint up, down;
};

// Where a series fails, in the smallest scene that reproduces it.
struct Failure {
    std::string text;     // "forward_plus at 1e6: 1 triangle, 1 light, 1x1 pixels: error 0.8"
    std::string scene;    // file in the audit's folder; empty: the original scene
    std::string command;  // reproduces the failure
};

struct QuantityAudit {
    const Quantity* quantity = nullptr;
    std::string lacks;  // why it is not varied; empty if it is
    double original = 0;
    std::vector<Series> series;
    std::vector<std::string> omitted;  // ChosenSeries::left_out
    std::vector<Step> steps;           // ascending
    // By criterion and series.
    std::array<std::vector<ValidRange>, criterionCount> valid_ranges;
    // By criterion (only the two error criteria) and series.
    std::array<std::vector<Predicted>, 2> predicted;
    std::vector<Failure> failures;
};

// Whether a measured and a predicted breaking point agree: within a factor of 2, or both beyond the last
// magnitude tried (`tried`).
bool agrees(const BreakingPoint& point, double predicted, bool up, double tried);
// Whether they agree for a criterion (only the two error criteria) and a series; empty without a prediction.
std::optional<bool> agrees(const QuantityAudit& audit, std::size_t criterion, std::size_t series);

// Ranges in which measured steps meet the criteria.
std::array<std::vector<ValidRange>, criterionCount> validRangesOf(const std::vector<Step>& steps,
                                                                  std::size_t series, double original);

// Measures a quantity. `step` measures at a magnitude, or returns an earlier measurement. `beside`:
// additional magnitudes.
QuantityAudit auditQuantity(const Quantity& quantity, const Subject& subject,
                            const std::function<Step(std::span<const Series>, double magnitude)>& step,
                            std::span<const double> beside = {});

// --require: whether the best series of every path meets requiredCriterion up to the magnitude.
struct Requirement {
    std::string quantity;
    double magnitude = 0;
    bool met = false;
    std::string because{};  // "deferred: the error is below 1e-2 up to 3e5"
};
Requirement evaluate(const QuantityAudit& audit, double magnitude);

struct Audit : Audited {
    std::vector<QuantityAudit> quantities;
    std::vector<std::string> to_come;  // quantities still to measure; empty when complete
    std::vector<Requirement> requirements;
    std::map<std::string, std::string> scenes;  // reduced scenes: file name and text
    std::size_t resumed = 0;                    // steps measured by an earlier command

    // Whether all requirements are met.
    bool passes() const { return std::ranges::all_of(requirements, &Requirement::met); }
};

}  // namespace diptych::audit
