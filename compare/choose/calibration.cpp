// SPDX-License-Identifier: MIT
#include "compare/choose/calibration.h"

#include "shared/image/atomic_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace diptych::choose {

using Json = nlohmann::ordered_json;

double Effect::spread() const {
    if (scenes < 2) return std::max(0.25, 0.5 * std::abs(mean));
    return std::max(0.1, std::sqrt(squares / (scenes - 1)));
}

std::optional<Effect> Calibration::find(const PassChange& change) const {
    const auto found = effects.find(change);
    return found == effects.end() ? std::optional<Effect>() : found->second;
}

void Calibration::learn(const PassChange& change, double logRatio) {
    Effect& effect = effects[change];
    ++effect.scenes;
    const double before = logRatio - effect.mean;  // Welford 1962
    effect.mean += before / effect.scenes;
    effect.squares += before * (logRatio - effect.mean);
}

std::filesystem::path calibrationFile(const std::filesystem::path& folder, const std::string& device) {
    if (folder.empty()) return {};
    std::string name = device;
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '-');
    return folder / ("calibration-" + name + ".json");
}

Calibration readCalibration(const std::filesystem::path& file, const std::string& device,
                            const std::string& driver, const std::string& program) {
    Calibration result{device, driver, program, {}};
    std::ifstream stream(file);
    if (!stream) return result;
    try {
        const Json json = Json::parse(stream);
        if (json.at("schema") != 1 || json.at("device") != device || json.at("driver") != driver ||
            json.at("program") != program)
            return result;
        for (const Json& each : json.at("effects")) {
            Settings path;
            path.set("path", each.at("path").get<std::string>());
            const Effect effect{each.at("mean"), each.at("squares"), each.at("scenes")};
            if (!std::isfinite(effect.mean) || !(effect.squares >= 0) || effect.scenes < 1)
                return {device, driver, program, {}};
            result
                .effects[{each.at("pass"), {path.path, each.at("option"), each.at("from"), each.at("to")}}] =
                effect;
        }
    } catch (const std::exception&) {
        return {device, driver, program, {}};
    }
    return result;
}

bool writeCalibration(const std::filesystem::path& file, const Calibration& calibration) {
    if (file.empty()) return false;
    Json effects = Json::array();
    for (const auto& [key, effect] : calibration.effects) {
        const auto& [pass, change] = key;
        effects.push_back({{"pass", pass},
                           {"path", nameOf(change.path)},
                           {"option", change.option},
                           {"from", change.from},
                           {"to", change.to},
                           {"mean", effect.mean},
                           {"squares", effect.squares},
                           {"scenes", effect.scenes}});
    }
    const Json json{{"schema", 1},
                    {"device", calibration.device},
                    {"driver", calibration.driver},
                    {"program", calibration.program},
                    {"effects", std::move(effects)}};
    try {
        std::filesystem::create_directories(file.parent_path());
        writeFile(file, json.dump(1) + "\n");
    } catch (const std::exception&) {
        return false;
    }
    return true;
}

}  // namespace diptych::choose
