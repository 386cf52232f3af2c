// SPDX-License-Identifier: MIT
#include "compare/explain/words.h"

#include "compare/files/our_files.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace diptych {

namespace {

constexpr std::size_t namedParts = 3;  // materials, lights; in text
constexpr double namedPart = 0.01;     // of a cause's share, in JSON

// "78 % on material 12, Lantern glass; 9 % on background".
std::string partsLine(const Cause& cause, const auto& parts, const char* preposition, const auto& nameOf) {
    std::string line;
    for (std::size_t i = 0; cause.share != 0 && i < std::min(namedParts, parts.size()); ++i)
        line += fmt::format("{}{:.0f} % {} {}", i == 0 ? "" : "; ", 100 * parts[i].share / cause.share,
                            preposition, nameOf(parts[i]));
    return line.empty() ? line : fmt::format("{:>12}{}\n", "", line);
}

std::string causeLine(const Explanation& all, std::size_t place) {
    const Cause& cause = all.causes[place];
    std::string line = fmt::format("{:>8.2f} %", 100 * all.shareOf(cause.share));
    if (cause.interval > 0) line += fmt::format(" +- {:.2f}", 100 * all.shareOf(cause.interval));
    line += fmt::format(
        "  {:<18}  {}; {:.2f} % of FLIP; worst at {},{}; the largest cause at {:.0f} % of the pixels\n",
        cause.name, cause.shows, 100 * all.shareOfFlip(cause.flip), cause.worst_x, cause.worst_y,
        100 * dominatedShare(all, place));
    return line + partsLine(cause, cause.materials, "on", materialName) +
           partsLine(cause, cause.lights, "of", lightName);
}

}  // namespace

std::string materialName(const MaterialShare& material) {
    if (material.material < 0) return "background";
    return material.name.empty() ? fmt::format("material {}", material.material)
                                 : fmt::format("material {}, {}", material.material, material.name);
}

std::string lightName(const LightShare& light) {
    return fmt::format("light {}, {}", light.light, light.name);
}

std::string lightsLine(const Explanation& e) {
    if (e.lights_left_out == 0) return {};
    return fmt::format("by light: the {} brightest were rendered alone, the other {} were not",
                       e.lights_drawn, e.lights_left_out);
}

double dominatedShare(const Explanation& explanation, std::size_t cause) {
    const auto& data = explanation.dominant.data;
    const auto differ = std::ranges::count_if(data, [](float place) { return place >= 0; });
    const auto own = std::ranges::count(data, static_cast<float>(cause));
    return differ > 0 ? static_cast<double>(own) / static_cast<double>(differ) : 0.0;
}

std::string pairLine(const Explanation& all, const CausePair& pair) {
    return fmt::format(
        "{} and {} {} (interaction {:+.1f} %)", all.causes[pair.first].name, all.causes[pair.second].name,
        pair.interaction < 0 ? "are redundant" : "hide each other", 100 * all.shareOf(pair.interaction));
}

std::string reproductionLine(const Explanation& e, const ExplainedPictures& of) {
    if (std::max(e.reproduction[0], e.reproduction[1]) == 0) return {};
    return fmt::format("lighting its own channels misses lit by {:.2g} % in {} and by {:.2g} % in {}",
                       100 * e.reproduction[0], of.baseline, 100 * e.reproduction[1], of.test);
}

std::string inShort(const Explanation& e) {
    if (e.distance == 0) return "lit does not differ";
    std::string causes;
    for (const Cause& cause : e.causes)
        causes += fmt::format("{} {} {:.1f} %", causes.empty() ? " because of" : ",", cause.name,
                              100 * e.shareOf(cause.share));
    std::string devices;
    for (const DeviceShare& part : e.devices)
        devices += fmt::format("{} {} {:.1f} %", devices.empty() ? "; across devices by" : ",", part.name,
                               100 * e.shareOf(part.share));
    return fmt::format("lit differs{}; unexplained {:.1f} %{}",
                       causes.empty() ? " for an unknown reason" : causes, 100 * e.shareOf(e.unexplained),
                       devices);
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
    for (std::size_t i = 0; i < e.causes.size(); ++i) text += causeLine(e, i);
    const double left = e.shareOf(e.unexplained);
    text += fmt::format("{:>8.2f} %  {}\n", 100 * left,
                        left > worthUnexplained
                            ? "unexplained: lit still differs by this much with every cause swapped; the "
                              "rest comes from something that no channel and no Setting describes"
                            : "unexplained");
    for (const CausePair& pair : e.pairs) text += pairLine(e, pair) + "\n";
    if (!e.without_effect.empty())
        text +=
            fmt::format("differs without an effect on any pixel: {}\n", fmt::join(e.without_effect, ", "));
    if (const std::string line = reproductionLine(e, of); !line.empty()) text += line + "\n";
    if (const std::string line = lightsLine(e); !line.empty()) text += line + "\n";
    return text + fmt::format("{} shaded from {}\n",
                              counted(static_cast<std::uint64_t>(e.subsets), "picture"),
                              counted(static_cast<std::uint64_t>(e.frames), "rendered frame"));
}

nlohmann::ordered_json toJson(const Explanation& e, const ExplainedPictures& of) {
    using Json = nlohmann::ordered_json;
    Json causes = Json::array(), pairs = Json::array(), devices = Json::array();
    for (const DeviceShare& part : e.devices)
        devices.push_back({{"name", part.name}, {"share", e.shareOf(part.share)}, {"shows", part.shows}});
    for (std::size_t i = 0; i < e.causes.size(); ++i) {
        const Cause& cause = e.causes[i];
        Json materials = Json::array(), lights = Json::array();
        for (const MaterialShare& material : cause.materials)
            if (std::abs(material.share) >= namedPart * std::abs(cause.share))
                materials.push_back({{"id", material.material},
                                     {"name", material.name},
                                     {"share", e.shareOf(material.share)}});
        for (const LightShare& light : cause.lights)
            if (std::abs(light.share) >= namedPart * std::abs(cause.share))
                lights.push_back(
                    {{"place", light.light}, {"name", light.name}, {"share", e.shareOf(light.share)}});
        causes.push_back({{"name", cause.name},
                          {"share", e.shareOf(cause.share)},
                          {"interval", e.shareOf(cause.interval)},
                          {"where", {cause.worst_x, cause.worst_y}},
                          {"shows", cause.shows},
                          {"alone", e.shareOf(cause.alone)},
                          {"last", e.shareOf(cause.last)},
                          {"dominates", dominatedShare(e, i)},
                          {"flip_share", e.shareOfFlip(cause.flip)},
                          {"materials", std::move(materials)},
                          {"lights", std::move(lights)}});
    }
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
