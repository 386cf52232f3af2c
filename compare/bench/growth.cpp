// SPDX-License-Identifier: MIT
#include "compare/bench/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::bench {
namespace {

// Smaller exponents count as flat: doubling the quantity adds less than 42 %.
constexpr double flatExponent = 0.5;

double valueOf(const BenchRow& row) {
    return row.growth->value;
}

double slope(double x0, double y0, double x1, double y1) {
    return std::log(y1 / y0) / std::log(x1 / x0);
}

std::string numberText(double value) {
    return value < 1e5 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

// The pass whose time grows most from the first row to the last, and its fraction of all added time.
std::string cause(const GrowthLine& line) {
    const std::vector<PassTime>&first = line.rows.front()->passes, &last = line.rows.back()->passes;
    double all = 0, max = 0;
    std::string name;
    for (const PassTime& pass : last) {
        const auto before = std::ranges::find(first, pass.name, &PassTime::name);
        const double grown = pass.ms - (before == first.end() ? 0 : before->ms);
        all += std::max(grown, 0.0);
        if (grown <= max) continue;
        max = grown;
        name = pass.name;
    }
    if (name.empty()) return {};
    return fmt::format("; {:.0f} % of the added time is in {}", 100 * max / all, name);
}

std::string lineText(const GrowthLine& line, const char* what, const std::vector<double>& amounts,
                     const char* unit, const std::string& why) {
    std::vector<double> values;
    for (const BenchRow* row : line.rows) values.push_back(valueOf(*row));
    const std::string begin = fmt::format(
        "{}, {} over {}: {:.4g} {} at {}, {:.4g} {} at {}", nameOf(line.path), what, nameOf(line.axis),
        amounts.front(), unit, numberText(values.front()), amounts.back(), unit, numberText(values.back()));
    const Bend bend = bendOf(values, amounts);
    if (!bend.found) return begin + "; flat";
    const std::string from =
        bend.value == values.front() ? "" : fmt::format("flat up to {}, then ", numberText(bend.value));
    const std::string to =
        bend.until == values.back() ? "" : fmt::format(" up to {}", numberText(bend.until));
    return fmt::format("{}; {}grows with exponent {:.2f}{}{}", begin, from, bend.exponent, to, why);
}

}  // namespace

std::vector<GrowthLine> growthLines(const Bench& bench) {
    std::vector<GrowthLine> lines;
    for (const BenchRow& row : bench.rows) {
        if (!row.growth) continue;
        const auto known = std::ranges::find_if(lines, [&](const GrowthLine& line) {
            return line.axis == row.growth->axis && line.path == row.settings.path;
        });
        if (known != lines.end())
            known->rows.push_back(&row);
        else
            lines.push_back({row.growth->axis, row.settings.path, {&row}});
    }
    std::ranges::stable_sort(lines, {}, &GrowthLine::axis);
    for (GrowthLine& line : lines)
        std::ranges::stable_sort(line.rows, {}, [](auto* r) { return valueOf(*r); });
    return lines;
}

Bend bendOf(const std::vector<double>& values, const std::vector<double>& amounts) {
    if (values.size() != amounts.size()) throw std::logic_error("a value has no amount");
    Bend max;
    double grown = 0;  // log of the growth ratio
    for (std::size_t first = 0, last = 0; first + 1 < values.size(); first = std::max(last, first + 1)) {
        last = first;
        while (last + 1 < values.size() &&
               slope(values[last], amounts[last], values[last + 1], amounts[last + 1]) >= flatExponent)
            ++last;
        if (last == first || std::log(amounts[last] / amounts[first]) <= grown) continue;
        grown = std::log(amounts[last] / amounts[first]);
        max = {values[first], values[last], slope(values[first], amounts[first], values[last], amounts[last]),
               true};
    }
    return max;
}

double memoryMib(const BenchRow& row) {
    return static_cast<double>(row.whole(Measure::memory)) / (1 << 20);
}

std::vector<std::string> growthText(const Bench& bench) {
    std::vector<std::string> words;
    for (const GrowthLine& line : growthLines(bench)) {
        if (line.rows.size() < 2) continue;
        std::vector<double> ms, mib;
        for (const BenchRow* row : line.rows) {
            ms.push_back((*row)[Measure::ms]);
            mib.push_back(memoryMib(*row));
        }
        words.push_back(lineText(line, "time", ms, "ms", cause(line)));
        words.push_back(lineText(line, "memory", mib, "MiB", ""));
    }
    return words;
}

}  // namespace diptych::bench
