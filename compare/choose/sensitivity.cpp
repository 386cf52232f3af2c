// SPDX-License-Identifier: MIT
#include "compare/choose/sensitivity.h"

#include "compare/experiment/intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace diptych::choose {

namespace {

constexpr double doubted = 0.05;  // 1 - confidence of intervals
constexpr int rangeSteps = 4000;  // resolution of a range

TimedValue timedValue(const Variation& variation, int rounds) {
    std::vector<std::size_t> order;
    for (int round = 0; round < rounds; ++round) {
        const std::size_t first = static_cast<std::size_t>(round % 2);
        for (const std::size_t i : {first, 1 - first, 1 - first, first}) order.push_back(i);
    }
    const std::vector<double> times = variation.draw(order);
    TimedValue result{.value = variation.value};
    std::vector<double> differences(static_cast<std::size_t>(rounds), 0.0);
    const auto n = static_cast<double>(rounds);
    for (std::size_t at = 0; at < order.size(); ++at) {
        result.ms[order[at]] += times[at] / (2 * n);
        differences[at / 4] += (order[at] == 1 ? 0.5 : -0.5) * times[at];
    }
    const experiment::MeanInterval interval = experiment::meanInterval(differences, doubted);
    result.difference = interval.mean;
    result.half_width = interval.half_width;
    return result;
}

// Linear interpolation between measured values, and extrapolation beyond: the difference and its half-width
// interval.
struct Lines {
    std::span<const TimedValue> times;
    std::pair<double, double> at(double value) const {
        std::size_t k = 1;
        while (k + 1 < times.size() && value > times[k].value) ++k;
        const TimedValue &a = times[k - 1], &b = times[k];
        const double u = (value - a.value) / (b.value - a.value);
        return {a.difference + u * (b.difference - a.difference),
                std::hypot((1 - u) * a.half_width, u * b.half_width)};
    }
    bool isOpen(double value) const {
        const auto [difference, half_width] = at(value);
        return std::abs(difference) <= half_width;
    }
};

// Geometric steps. A range from 0 starts with a step to 1e-5 of `max`.
double stepped(double min, double max, int step) {
    if (min <= 0 && step == 0) return 0;
    const double from = min > 0 ? min : 1e-5 * max, part = static_cast<double>(step) / rangeSteps;
    return from * std::pow(max / from, part);
}

double farOff(double a, double b) {
    return a > 0 && b > 0 ? std::abs(std::log(a / b)) : std::abs(a - b);
}

// The break-even point nearest to `value`, between `min` and `max`. `times`: ascending values. Empty if
// its interval reaches an end of that range. Between two measured values, the half-widths are weighted
// like the values and added as independent errors; the interval of the break-even point is then Fieller's
// (1954).
std::optional<BreakEvenPoint> breakEvenOf(std::span<const TimedValue> times, double value, double min,
                                          double max) {
    if (times.size() < 2) return {};
    const Lines lines{times};
    std::optional<BreakEvenPoint> nearest;
    for (int step = 0; step < rangeSteps; ++step) {
        double low = stepped(min, max, step), high = stepped(min, max, step + 1);
        const double before = lines.at(low).first, after = lines.at(high).first;
        if ((before < 0) == (after < 0)) continue;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            ((lines.at(middle).first < 0) == (before < 0) ? low : high) = middle;
        }
        BreakEvenPoint break_even{.value = high, .low = high, .high = high};
        if (nearest && farOff(high, value) >= farOff(nearest->value, value)) continue;
        break_even.extrapolated = high < times.front().value || high > times.back().value;
        break_even.other_above = after < 0;
        // Widen to the steps at which the lines are significant again.
        int down = step, up = step + 1;
        while (down > 0 && lines.isOpen(stepped(min, max, down))) --down;
        while (up < rangeSteps && lines.isOpen(stepped(min, max, up))) ++up;
        break_even.low = stepped(min, max, down);
        break_even.high = stepped(min, max, up);
        if (down == 0 || up == rangeSteps) continue;
        nearest = break_even;
    }
    return nearest;
}

}  // namespace

Sensitivities analyzeSensitivity(const DrawInOrder& asIs, std::vector<Property> properties, int rounds,
                                 const std::function<void(double, std::string_view)>& progress) {
    Sensitivities sensitivities;
    std::size_t all = 1, done = 0;
    for (const Property& property : properties) all += property.others.size();
    const auto measure = [&](const Variation& variation) {
        sensitivities.frames += 4 * static_cast<std::size_t>(rounds);
        return timedValue(variation, rounds);
    };
    const auto reportProgress = [&](std::string_view what) {
        if (progress) progress(static_cast<double>(done++) / static_cast<double>(all), what);
    };
    reportProgress("sensitivity");
    sensitivities.as_is = measure({0, asIs});
    for (Property& property : properties) {
        PropertySensitivity sensitivity;
        sensitivity.times.push_back(sensitivities.as_is);
        sensitivity.times.back().value = property.value;
        for (const auto& make : property.others) {
            reportProgress(property.name);
            // A variation may exceed the device's limits, for example twice the size. Keep the choice.
            try {
                sensitivity.times.push_back(measure(make()));
            } catch (const std::runtime_error& error) {
                property.not_varied = error.what();
            }
        }
        if (sensitivity.times.size() > 1) property.not_varied.clear();
        std::ranges::sort(sensitivity.times, {}, &TimedValue::value);
        // Equal values define no line; they occur if a variation changes nothing.
        const auto same = std::ranges::unique(sensitivity.times, {}, &TimedValue::value);
        sensitivity.times.erase(same.begin(), same.end());
        if (property.few_values) {
            for (const TimedValue& at : sensitivity.times)
                if (at.value != property.value && at.isSignificant() && at.difference < 0)
                    sensitivity.reversed_at = at.value;
        } else if (sensitivity.times.size() > 1) {
            sensitivity.break_even =
                breakEvenOf(sensitivity.times, property.value, property.min, property.max);
            const Lines lines{sensitivity.times};
            for (int step = 0; step <= rangeSteps && !sensitivity.break_even; ++step) {
                const double value = stepped(property.min, property.max, step);
                if (!lines.isOpen(value)) continue;
                if (!sensitivity.open) sensitivity.open = {value, value};
                sensitivity.open->second = value;
            }
        }
        sensitivity.property = std::move(property);
        sensitivities.properties.push_back(std::move(sensitivity));
    }
    const auto rank = [](const PropertySensitivity& sensitivity) {
        const double at =
            sensitivity.break_even ? sensitivity.break_even->value : sensitivity.reversed_at.value_or(0);
        return std::tuple(!sensitivity.isReversed(),
                          sensitivity.break_even && sensitivity.break_even->extrapolated,
                          sensitivity.isReversed() ? farOff(at, sensitivity.property.value) : 0.0);
    };
    std::ranges::stable_sort(sensitivities.properties, {}, rank);
    return sensitivities;
}

}  // namespace diptych::choose
