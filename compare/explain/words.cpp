// SPDX-License-Identifier: MIT
#include "compare/explain/write.h"
#include "compare/files/our_files.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace diptych {

namespace {

constexpr double namedPart = 0.01;  // of a cause's share, in JSON

std::string causeLine(const Explanation& all, const Cause& cause) {
    std::string line = fmt::format("{:>8.2f} %", 100 * all.shareOf(cause.share));
    if (cause.interval > 0) line += fmt::format(" +- {:.2f}", 100 * all.shareOf(cause.interval));
    line += fmt::format(
        "  {:<18}  {}; {:.2f} % of FLIP; worst at {},{}; the largest cause at {:.0f} % of the pixels\n",
        cause.name, cause.shows, 100 * all.shareOfFlip(cause.flip), cause.worst_x, cause.worst_y,
        100 * cause.dominates);
    constexpr double any = -std::numeric_limits<double>::infinity();
    for (const std::string& parts : {partsOf(cause, cause.materials, "on ", "material", 3, any),
                                     partsOf(cause, cause.lights, "of ", "light", 3, any)})
        if (!parts.empty()) line += fmt::format("{:>12}{}\n", "", parts);
    return line;
}

}  // namespace

std::string partsOf(const Cause& cause, const std::vector<CausePart>& parts, std::string_view before,
                    std::string_view noun, std::size_t most, double least) {
    std::string line;
    for (std::size_t i = 0; cause.share != 0 && i < std::min(most, parts.size()); ++i) {
        const double share = parts[i].share / cause.share;
        if (share < least) break;
        line += fmt::format("{}{:.0f} % {}", i == 0 ? "" : "; ", 100 * share, before);
        line += parts[i].index < 0 ? "background" : fmt::format("{} {}", noun, parts[i].index);
        if (!parts[i].name.empty()) line += ", " + parts[i].name;
    }
    return line;
}

std::vector<std::string> remarksOn(const Explanation& e, const ExplainedPictures& of) {
    std::vector<std::string> lines;
    for (const auto& [first, second, interaction] : e.pairs)
        lines.push_back(
            fmt::format("{} and {} {} (interaction {:+.1f} %)", e.causes[first].name, e.causes[second].name,
                        interaction < 0 ? "are redundant" : "hide each other", 100 * e.shareOf(interaction)));
    if (!e.without_effect.empty())
        lines.push_back(
            fmt::format("differs without an effect on any pixel: {}", fmt::join(e.without_effect, ", ")));
    if (e.reproduction[0] != 0 || e.reproduction[1] != 0)
        lines.push_back(
            fmt::format("lighting its own channels misses lit by {:.2g} % in {} and by {:.2g} % in {}",
                        100 * e.reproduction[0], of.baseline, 100 * e.reproduction[1], of.test));
    if (e.lights_left_out > 0)
        lines.push_back(fmt::format("by light: the {} brightest were rendered alone, the other {} were not",
                                    e.lights_drawn, e.lights_left_out));
    return lines;
}

std::string inWords(const Explanation& e, const ExplainedPictures& of) {
    std::string text =
        fmt::format("{}: lit of {} differs from lit of {} by {:.4g} W/(sr m^2) on average, FLIP {:.4g}\n",
                    of.scene, of.test, of.baseline, e.distance, e.flip);
    if (e.nonfinite > 0)
        text +=
            fmt::format("excluded: {} with NaN or infinity in one of them\n", counted(e.nonfinite, "pixel"));
    if (e.distance == 0) return text + "no cause: lit is the same\n";
    if (e.causes.empty()) text += "no cause: no difference has an effect on lit\n";
    if (!e.devices.empty()) text += "across devices, by origin:\n";
    for (const DeviceShare& part : e.devices)
        text += fmt::format("{:>8.2f} %  {:<18}  {}\n", 100 * e.shareOf(part.share), part.name, part.shows);
    if (!e.devices.empty()) text += "by channel:\n";
    for (const Cause& cause : e.causes) text += causeLine(e, cause);
    const double left = e.shareOf(e.unexplained);
    text += fmt::format("{:>8.2f} %  {}\n", 100 * left,
                        left > worthUnexplained
                            ? "unexplained: lit still differs by this much with every cause swapped; the "
                              "rest comes from something that no channel and no Setting describes"
                            : "unexplained");
    for (const std::string& line : remarksOn(e, of)) text += line + "\n";
    return text + fmt::format("{} shaded from {}\n",
                              counted(static_cast<std::uint64_t>(e.subsets), "picture"),
                              counted(static_cast<std::uint64_t>(e.frames), "rendered frame"));
}

nlohmann::ordered_json toJson(const Explanation& e, const ExplainedPictures& of) {
    using Json = nlohmann::ordered_json;
    Json causes = Json::array(), pairs = Json::array(), devices = Json::array();
    for (const DeviceShare& part : e.devices)
        devices.push_back({{"name", part.name}, {"share", e.shareOf(part.share)}, {"shows", part.shows}});
    const auto partsJson = [&](const Cause& cause, const std::vector<CausePart>& parts, const char* index) {
        Json all = Json::array();
        for (const CausePart& part : parts)
            if (std::abs(part.share) >= namedPart * std::abs(cause.share))
                all.push_back({{index, part.index}, {"name", part.name}, {"share", e.shareOf(part.share)}});
        return all;
    };
    for (const Cause& cause : e.causes)
        causes.push_back({{"name", cause.name},
                          {"share", e.shareOf(cause.share)},
                          {"interval", e.shareOf(cause.interval)},
                          {"where", {cause.worst_x, cause.worst_y}},
                          {"shows", cause.shows},
                          {"alone", e.shareOf(cause.alone)},
                          {"last", e.shareOf(cause.last)},
                          {"dominates", cause.dominates},
                          {"flip_share", e.shareOfFlip(cause.flip)},
                          {"materials", partsJson(cause, cause.materials, "id")},
                          {"lights", partsJson(cause, cause.lights, "place")}});
    for (const CausePair& pair : e.pairs)
        pairs.push_back({{"causes", {e.causes[pair.first].name, e.causes[pair.second].name}},
                         {"interaction", e.shareOf(pair.interaction)}});
    return {{"schema", 1},
            {"software", softwareName},
            {"scene", of.scene},
            {"baseline", of.baseline},
            {"test", of.test},
            {"distance", e.distance},
            {"flip", e.flip},
            {"causes", std::move(causes)},
            {"unexplained", e.shareOf(e.unexplained)},
            {"flip_unexplained", e.flip_unexplained},
            {"pairs", std::move(pairs)},
            {"devices", std::move(devices)},
            {"inert", e.without_effect},
            {"reproduction", {e.reproduction[0], e.reproduction[1]}},
            {"shaded", e.subsets},
            {"lights_drawn", e.lights_drawn},
            {"lights_left_out", e.lights_left_out},
            {"nonfinite", e.nonfinite},
            {"drawn", e.frames},
            {"command", of.commands.empty() ? Json(nullptr) : Json(of.commands.front().line)}};
}

}  // namespace diptych
