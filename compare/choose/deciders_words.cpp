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

std::string crossingInWords(const Decider& decider, const std::string& other) {
    const Crossing& crossing = *decider.crossing;
    return fmt::format("{} is faster {} {} ({} to {}), {}", other, crossing.other_above ? "above" : "below",
                       figure(crossing.value), figure(crossing.low), figure(crossing.high),
                       crossing.extrapolated ? "extrapolated" : "interpolated");
}

std::string fewInWords(const Decider& decider, const std::string& chosen, const std::string& other) {
    std::vector<std::string> words;
    for (const TimedValue& at : decider.times)
        if (at.value != decider.property.value)
            words.push_back(fmt::format("at {:.4g}, {} takes {:.4g} ms and {} {:.4g} ms{}", at.value, chosen,
                                        at.ms[0], other, at.ms[1],
                                        !at.isTold()        ? ", not measurably different"
                                        : at.difference < 0 ? ": faster there"
                                                            : ": not faster there either"));
    return fmt::format("{}", fmt::join(words, "; "));
}

std::string deciderInWords(const Decider& decider, const std::string& chosen, const std::string& other) {
    const Property& property = decider.property;
    std::string text = fmt::format("{}: {} {}; ", property.name, figure(property.value), property.unit);
    if (!property.not_varied.empty() || decider.times.size() < 2)
        return text + (property.not_varied.empty() ? "its variations change nothing" : property.not_varied);
    if (property.few_values)
        text += fewInWords(decider, chosen, other);
    else if (decider.crossing)
        text += crossingInWords(decider, other);
    else
        text += fmt::format(
            "no value between {} and {} reverses the choice{}", figure(property.least), figure(property.most),
            decider.open ? fmt::format(" significantly; a value between {} and {} may",
                                       figure(decider.open->first), figure(decider.open->second))
                         : "");
    std::vector<std::string> at;
    for (const TimedValue& time : decider.times) at.push_back(figure(time.value));
    return text + fmt::format(" (measured at {}: {})", fmt::join(at, ", "), property.how);
}

}  // namespace

std::vector<std::string> inWords(const DecidersReport& report) {
    const TimedValue& here = report.deciders.as_is;
    std::vector<std::string> lines{fmt::format(
        "Properties that decide between {} and {}{}: here {:.4g} ms against {:.4g} ms{}", report.chosen,
        report.other, report.other_fits ? "" : ", which does not fit and is compared by time only",
        here.ms[0], here.ms[1], here.isTold() ? "" : ", not measurably different")};
    constexpr std::size_t told = 3;  // sorted by relevance; JSON has all
    for (std::size_t i = 0; i < std::min(told, report.deciders.properties.size()); ++i)
        lines.push_back("  " +
                        deciderInWords(report.deciders.properties[i], report.chosen_path, report.other_path));
    return lines;
}

nlohmann::ordered_json toJson(const DecidersReport& report) {
    Json properties = Json::array();
    for (const Decider& decider : report.deciders.properties) {
        const Property& property = decider.property;
        Json times = Json::array();
        for (const TimedValue& at : decider.times)
            times.push_back({{"value", at.value},
                             {"ms", at.ms[0]},
                             {"other_ms", at.ms[1]},
                             {"difference", at.difference},
                             {"half_interval", at.half}});
        Json json{{"name", property.name},
                  {"value", property.value},
                  {"unit", property.unit},
                  {"how", property.how},
                  {"times", std::move(times)}};
        json["open"] = decider.open ? Json{decider.open->first, decider.open->second} : Json();
        if (!property.few_values) json["looked_at"] = {property.least, property.most};
        if (!property.not_varied.empty()) json["not_varied"] = property.not_varied;
        json["crossing"] = Json();
        if (decider.crossing)
            json["crossing"] = {{"value", decider.crossing->value},
                                {"low", decider.crossing->low},
                                {"high", decider.crossing->high},
                                {"extrapolated", decider.crossing->extrapolated},
                                {"other_is_faster", decider.crossing->other_above ? "above" : "below"}};
        json["turns_at"] = decider.turns_at ? Json(*decider.turns_at) : Json();
        properties.push_back(std::move(json));
    }
    return {{"chosen", report.chosen},
            {"other", report.other},
            {"other_fits", report.other_fits},
            {"ms", report.deciders.as_is.ms[0]},
            {"other_ms", report.deciders.as_is.ms[1]},
            {"frames", report.deciders.frames},
            {"properties", std::move(properties)}};
}

}  // namespace diptych::choose
