// SPDX-License-Identifier: MIT
// Sensitivity analysis: which scene properties make the other path faster, and from which value on. Times
// the best candidates of both paths, interleaved, while one property varies. Break-even points come from
// linear interpolation and extrapolation of the time differences.
#pragma once

#include "compare/choose/ranking.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::choose {

// The scene with a changed property. Index 0 in `draw`: the chosen Settings; 1: the other path's.
struct Variation {
    double value = 0;
    DrawInOrder draw;
};

// A property and its variations.
struct Property {
    std::string name;  // "overdraw"
    std::string unit;  // "fragments per covered pixel"
    std::string how;   // how the scene is varied
    double value = 0;  // of the original scene
    // Range to search for a break-even point. Not used with few values, such as samples per pixel: these
    // report the measurements only.
    double min = 0, max = 0;
    bool few_values = false;
    std::vector<std::function<Variation()>> others{};  // created when timed
    std::string not_varied{};                          // reason for no variation
};

// Times of both paths at one value of a property.
struct TimedValue {
    double value = 0;
    std::array<double, 2> ms{};  // means; chosen, other path
    // Extra time of the other path, ms, with the half-width of its 95 % interval.
    double difference = 0, half_width = 0;
    bool isSignificant() const { return difference > half_width || -difference > half_width; }
};

// A break-even point: both paths take the same time.
struct BreakEvenPoint {
    double value = 0;
    double low = 0, high = 0;   // 95 % interval, within the searched range
    bool extrapolated = false;  // outside the measured values
    bool other_above = false;   // the other path is faster above the point; else below
};

struct PropertySensitivity {
    Property property;
    std::vector<TimedValue> times;  // ascending values
    std::optional<BreakEvenPoint> break_even;
    // Without a break-even point: least and greatest value where the faster path is uncertain, if any.
    std::optional<std::pair<double, double>> open{};
    // With few values: one at which the other path is significantly faster.
    std::optional<double> reversed_at;
    bool isReversed() const { return break_even || reversed_at; }
};

struct Sensitivities {
    TimedValue as_is;                             // original scene; `value` is unused
    std::vector<PropertySensitivity> properties;  // break-even points first, nearest first
    std::size_t frames = 0;                       // timed, per camera
};

// Times `rounds` x 4 frames per variation, interleaving both paths, also for the original scene. `rounds`:
// at least 2. `progress`: see SearchOptions.
Sensitivities analyzeSensitivity(const DrawInOrder& asIs, std::vector<Property> properties, int rounds,
                                 const std::function<void(double, std::string_view)>& progress = {});

}  // namespace diptych::choose
