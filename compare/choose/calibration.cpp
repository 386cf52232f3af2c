// SPDX-License-Identifier: MIT
#include "compare/choose/calibration.h"

#include "shared/image/atomic_file.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"
#include "shared/vulkan/user_cache.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

namespace diptych::choose {

using Json = nlohmann::ordered_json;

double Effect::mean() const {
    double sum = 0;
    for (const auto& [scene, value] : scenes) sum += value;
    return sum / static_cast<double>(scenes.size());
}

double Effect::spread() const {
    const double middle = mean();
    if (scenes.size() < 2) return std::max(0.25, 0.5 * std::abs(middle));
    double squares = 0;
    for (const auto& [scene, value] : scenes) squares += (value - middle) * (value - middle);
    return std::max(0.1, std::sqrt(squares / static_cast<double>(scenes.size() - 1)));
}

std::optional<Effect> Calibration::find(const PassChange& change) const {
    const auto found = effects.find(change);
    return found == effects.end() ? std::optional<Effect>() : found->second;
}

void Calibration::learn(const PassChange& change, const std::string& scene, double logRatio) {
    effects[change].scenes[scene] = logRatio;
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
    const CacheFile opened = openCacheFile(file);
    constexpr std::uintmax_t most = 16 << 20;  // ten thousand effects on a hundred scenes
    if (!opened.stream || opened.bytes > most) return result;
    try {
        std::string text(opened.bytes, '\0');
        if (std::fread(text.data(), 1, text.size(), opened.stream.get()) != text.size()) return result;
        const Json json = parseOrderedJson(text);
        if (json.at("schema") != 1 || json.at("device") != device || json.at("driver") != driver ||
            json.at("program") != program)
            return result;
        for (const Json& each : json.at("effects")) {
            Settings path;
            path.set("path", each.at("path").get<std::string>());
            const Effect effect{each.at("scenes").get<std::map<std::string, double>>()};
            if (effect.scenes.empty()) return {device, driver, program, {}};
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
                           {"scenes", effect.scenes}});
    }
    const Json json{{"schema", 1},
                    {"device", calibration.device},
                    {"driver", calibration.driver},
                    {"program", calibration.program},
                    {"effects", std::move(effects)}};
    try {
        makeCacheFolder(file.parent_path());
        const std::string text = jsonText(json, 1) + "\n";
        AtomicFile out(file);
        keepForUser(out.stream());
        std::fwrite(text.data(), 1, text.size(), out.stream());
        out.commit();
    } catch (const std::exception&) {
        return false;
    }
    return true;
}

}  // namespace diptych::choose
