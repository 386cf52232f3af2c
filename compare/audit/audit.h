// SPDX-License-Identifier: MIT
// Pushes quantities until the paths break, and finds the last magnitude at which they hold.
#pragma once

#include "compare/audit/measure.h"
#include "compare/audit/quantity.h"
#include "shared/frame/frame.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

// What a path's picture is held to.
struct Criterion {
    std::string_view name, title;  // "1e-3", "error below 1e-3"
    double limit;
    double (*figure)(const Outcome&);
};
// Error below 1e-3 and below 1e-2; not visible, which is mean HDR-FLIP below 0.05; and every pixel a number.
inline constexpr std::size_t criterionCount = 4;
extern const std::array<Criterion, criterionCount> criteria;
inline constexpr std::size_t requiredCriterion = 1;  // by which --require is judged
inline constexpr std::size_t visibleCriterion = 2, numberCriterion = 3;

bool passes(const Criterion& criterion, const Outcome& outcome);

// How far one way a criterion holds, from the usual magnitude on.
struct BreakingPoint {
    double last = 0;   // the last magnitude tried at which it holds
    double first = 0;  // the first at which it does not; without meaning where there is none
    bool broken = false;
};
// Where it does not hold at the usual magnitude already there is none.
struct ValidRange {
    bool at_original = false;
    BreakingPoint up, down;
};

// Where a series breaks, in the smallest scene that shows it.
struct Failure {
    std::string words;    // "forward_plus at 1e6: 1 triangle, 1 light, 1x1 pixels: error 0.8"
    std::string scene;    // a file of the audit's folder; empty: the scene that was given, as it is
    std::string command;  // that shows it
};

struct QuantityAudit {
    const Quantity* quantity = nullptr;
    std::string lacks;  // why it is not pushed; empty where it is
    double original = 0;
    std::vector<Series> series;
    std::vector<std::string> left_out;  // ChosenSeries::left_out
    std::vector<Step> steps;            // ascending
    // By criterion and series.
    std::array<std::vector<ValidRange>, criterionCount> valid_ranges;
    // By criterion (the two of errors) and series.
    std::array<std::vector<Predicted>, 2> predicted;
    std::vector<Failure> failures;
};

// Whether a measured reach and a predicted one agree: within a factor of 2, or both beyond what was tried.
// `tried`: the last magnitude that was.
bool agrees(const BreakingPoint& point, double predicted, bool up, double tried);

// The holds of steps that have been measured.
std::array<std::vector<ValidRange>, criterionCount> validRangesOf(const std::vector<Step>& steps,
                                                                  std::size_t series, double original);

// A magnitude between two steps at which to measure next, so that a reach is known to a factor of 1.25;
// nothing where all are, or where so many steps have been added as pay.
std::optional<double> nextMagnitude(const QuantityAudit& audit);

// Measures a quantity. `step`: measures at a magnitude, or finds what was measured before. `beside`:
// magnitudes that are measured too.
QuantityAudit auditQuantity(const Quantity& quantity, const Subject& subject,
                            const std::function<Step(std::span<const Series>, double magnitude)>& step,
                            std::span<const double> beside = {});

// --require: whether every path, by its best series, holds requiredCriterion as far as the magnitude.
struct Requirement {
    std::string quantity;
    double magnitude = 0;
    bool met = false;
    std::string because{};  // "deferred: the error is below 1e-2 up to 3e5"
};
Requirement evaluate(const QuantityAudit& audit, double magnitude);

struct Audit : Audited {
    std::vector<QuantityAudit> quantities;
    std::vector<std::string> to_come;  // quantities that are not measured yet; none when it is complete
    std::vector<Requirement> requirements;
    std::map<std::string, std::string> scenes;  // reduced ones: name of the file, and its text
    std::size_t kept = 0;                       // steps that an earlier command had measured
};

}  // namespace diptych::audit
