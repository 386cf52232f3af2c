// SPDX-License-Identifier: MIT
// Which properties of a scene decide between the two paths: the fastest of both are timed in turn while one
// property after the other is varied, and where their times cross is found on the lines between the measured
// values, or on those lines drawn on.
#pragma once

#include "compare/choose/told_apart.h"

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

// The scene with another value of a property; draws of 0: the chosen Settings, of 1: the other path's.
struct Variation {
    double value = 0;
    DrawInOrder draw;
};

// How a property can be varied.
struct Property {
    std::string name;  // "overdraw"
    std::string unit;  // "fragments a covered pixel"
    std::string how;   // how other values come about
    double value = 0;  // the scene's
    // Between which values a crossing is looked for. Of one that has a few values alone, as samples a pixel,
    // none is: what was measured at the others is told.
    double least = 0, most = 0;
    bool few_values = false;
    std::vector<std::function<Variation()>> others{};  // made when they are timed
    std::string not_varied{};                          // why there is none
};

// Both paths' times at one value of a property.
struct TimedValue {
    double value = 0;
    std::array<double, 2> ms{};  // means
    // How much longer the other path takes, ms, and half the interval that holds it in 95 of 100 cases.
    double difference = 0, half = 0;
    bool isTold() const { return difference > half || -difference > half; }
};

// Where both take as long.
struct Crossing {
    double value = 0;
    double low = 0, high = 0;   // holds it in 95 of 100 cases, within the values that were looked at
    bool extrapolated = false;  // beyond the measured values
    bool other_above = false;   // the other path is faster above it; else below
};

struct Decider {
    Property property;
    std::vector<TimedValue> times;  // ascending by value
    std::optional<Crossing> crossing;
    // Without a crossing: the least and the greatest value at which the times leave one open, if any.
    std::optional<std::pair<double, double>> open{};
    // Of few values: that at which the other path is faster for sure.
    std::optional<double> turns_at;
    bool isTurned() const { return crossing || turns_at; }
};

struct Deciders {
    TimedValue as_is;                 // its value means nothing
    std::vector<Decider> properties;  // those that turn the choice first, the nearest value first
    std::size_t frames = 0;           // timed, of each camera
};

// Each variation and the scene as it is are drawn `rounds` times 4 frames: both paths in turn and back.
// `rounds`: 2 or more. `progress`: as SearchOptions has it.
Deciders findDeciders(const DrawInOrder& asIs, std::vector<Property> properties, int rounds,
                      const std::function<void(double, std::string_view)>& progress = {});

// The crossing nearest to `value` of the lines through `times`, which ascend by value, within least and most.
// None where the times leave it open up to an end of that range. Half the interval of a line between two
// measured values is that of their mean with the line's weights (the interval of the crossing is then
// Fieller's, 1954).
std::optional<Crossing> crossingOf(std::span<const TimedValue> times, double value, double least,
                                   double most);

}  // namespace diptych::choose
