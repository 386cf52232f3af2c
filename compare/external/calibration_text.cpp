// SPDX-License-Identifier: MIT
#include "compare/external/calibration.h"

#include <fmt/format.h>

namespace diptych::external {
namespace {

using Json = nlohmann::ordered_json;

Json correctionsOf(std::span<const Deviation> deviations) {
    Json corrections = Json::object();
    for (const Deviation& deviation : deviations) corrections.update(deviation.correction);
    return corrections;
}

}  // namespace

std::string describe(const ExternalRenderer& renderer, std::span<const Deviation> deviations) {
    const std::vector<std::string> applied = describe(renderer.corrections);
    const Json corrections = correctionsOf(deviations);
    std::string out;
    for (const std::string& line : applied) out += fmt::format("granted {}\n", line);
    for (const Deviation& one : deviations)
        out += fmt::format("FAIL {}: {}{}\n", one.name, one.text,
                           one.correction.empty() ? "; no input correction exists for it" : "");
    if (deviations.empty()) out += "pass: it interprets its inputs as Diptych does\n";
    if (!corrections.empty())
        out += fmt::format(
            "to correct its inputs, add to {}{}: \"granted\": {}\n", renderer.file.string(),
            applied.empty() ? "" : ", on top of the present \"granted\" (factors multiply, offsets add)",
            corrections.dump());
    return out;
}

Json toJson(const ExternalRenderer& renderer, std::span<const Deviation> deviations) {
    Json json{{"schema", 1},
              {"renderer", renderer.file.string()},
              {"verdict", deviations.empty() ? "pass" : "fail"},
              {"granted_already", describe(renderer.corrections)},
              {"deviations", Json::array()},
              {"granted", correctionsOf(deviations)}};
    for (const Deviation& one : deviations)
        json["deviations"].push_back({{"name", one.name}, {"words", one.text}, {"grant", one.correction}});
    return json;
}

}  // namespace diptych::external
