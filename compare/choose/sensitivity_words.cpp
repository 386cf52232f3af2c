// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace diptych::choose {

using Json = nlohmann::ordered_json;

namespace {

// Four significant digits, or all digits of larger whole numbers.
std::string figure(double value) {
    return std::abs(value) >= 1e4 && std::abs(value) < 1e8 ? fmt::format("{:.0f}", value)
                                                           : fmt::format("{:.4g}", value);
}

std::string breakEvenInWords(const PropertySensitivity& sensitivity, const std::string& other) {
    const BreakEvenPoint& break_even = *sensitivity.break_even;
    return fmt::format("{} is faster {} {} ({} to {}), {}", other, break_even.other_above ? "above" : "below",
                       figure(break_even.value), figure(break_even.low), figure(break_even.high),
                       break_even.extrapolated ? "extrapolated" : "interpolated");
}

std::string fewInWords(const PropertySensitivity& sensitivity, const std::string& chosen,
                       const std::string& other) {
    std::vector<std::string> words;
    for (const TimedValue& at : sensitivity.times)
        if (at.value != sensitivity.property.value)
            words.push_back(fmt::format("at {:.4g}, {} takes {:.4g} ms and {} {:.4g} ms{}", at.value, chosen,
                                        at.ms[0], other, at.ms[1],
                                        !at.isSignificant() ? ", not measurably different"
                                        : at.difference < 0 ? ": faster there"
                                                            : ": not faster there either"));
    return fmt::format("{}", fmt::join(words, "; "));
}

std::string sensitivityInWords(const PropertySensitivity& sensitivity, const std::string& chosen,
                               const std::string& other) {
    const Property& property = sensitivity.property;
    std::string text = fmt::format("{}: {} {}; ", property.name, figure(property.value), property.unit);
    if (!property.not_varied.empty() || sensitivity.times.size() < 2)
        return text + (property.not_varied.empty() ? "its variations change nothing" : property.not_varied);
    if (property.few_values)
        text += fewInWords(sensitivity, chosen, other);
    else if (sensitivity.break_even)
        text += breakEvenInWords(sensitivity, other);
    else
        text += fmt::format(
            "no value between {} and {} reverses the choice{}", figure(property.least), figure(property.most),
            sensitivity.open ? fmt::format(" significantly; a value between {} and {} may",
                                           figure(sensitivity.open->first), figure(sensitivity.open->second))
                             : "");
    std::vector<std::string> at;
    for (const TimedValue& time : sensitivity.times) at.push_back(figure(time.value));
    return text + fmt::format(" (measured at {}: {})", fmt::join(at, ", "), property.how);
}

}  // namespace

std::vector<std::string> inWords(const SensitivityReport& report) {
    const TimedValue& here = report.sensitivities.as_is;
    std::vector<std::string> lines{fmt::format(
        "Properties that decide between {} and {}{}: here {:.4g} ms against {:.4g} ms{}", report.chosen,
        report.other, report.other_fits ? "" : ", which does not fit and is compared by time only",
        here.ms[0], here.ms[1], here.isSignificant() ? "" : ", not measurably different")};
    constexpr std::size_t listed = 3;  // sorted by relevance; JSON has all
    for (std::size_t i = 0; i < std::min(listed, report.sensitivities.properties.size()); ++i)
        lines.push_back("  " + sensitivityInWords(report.sensitivities.properties[i], report.chosen_path,
                                                  report.other_path));
    return lines;
}

nlohmann::ordered_json toJson(const SensitivityReport& report) {
    Json properties = Json::array();
    for (const PropertySensitivity& sensitivity : report.sensitivities.properties) {
        const Property& property = sensitivity.property;
        Json times = Json::array();
        for (const TimedValue& at : sensitivity.times)
            times.push_back({{"value", at.value},
                             {"ms", at.ms[0]},
                             {"other_ms", at.ms[1]},
                             {"difference", at.difference},
                             {"half_interval", at.half_width}});
        Json json{{"name", property.name},
                  {"value", property.value},
                  {"unit", property.unit},
                  {"how", property.how},
                  {"times", std::move(times)}};
        json["open"] = sensitivity.open ? Json{sensitivity.open->first, sensitivity.open->second} : Json();
        if (!property.few_values) json["looked_at"] = {property.least, property.most};
        if (!property.not_varied.empty()) json["not_varied"] = property.not_varied;
        json["crossing"] = Json();
        if (sensitivity.break_even)
            json["crossing"] = {{"value", sensitivity.break_even->value},
                                {"low", sensitivity.break_even->low},
                                {"high", sensitivity.break_even->high},
                                {"extrapolated", sensitivity.break_even->extrapolated},
                                {"other_is_faster", sensitivity.break_even->other_above ? "above" : "below"}};
        json["turns_at"] = sensitivity.reversed_at ? Json(*sensitivity.reversed_at) : Json();
        properties.push_back(std::move(json));
    }
    return {{"chosen", report.chosen},
            {"other", report.other},
            {"other_fits", report.other_fits},
            {"ms", report.sensitivities.as_is.ms[0]},
            {"other_ms", report.sensitivities.as_is.ms[1]},
            {"frames", report.sensitivities.frames},
            {"properties", std::move(properties)}};
}

}  // namespace diptych::choose
