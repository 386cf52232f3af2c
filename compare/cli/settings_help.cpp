// SPDX-License-Identifier: MIT
#include "compare/cli/settings_help.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace diptych::cli {
namespace {

// Every path with one other choice made: each value of each enumeration, and an environment.
std::vector<Settings> candidates() {
    std::vector<Settings> all;
    for (const auto& [path, name] : enumNames<Path>()) {
        Settings settings;
        settings.path = path;
        settings.env = "sky.exr";
        all.push_back(settings);
        settings.env = Settings().env;
        for (const Field& field : settingFields()) {
            if (field.option == "path") continue;
            const std::string accepted = acceptedValues(field.option);
            if (accepted.find('|') == accepted.npos) continue;
            std::istringstream words(accepted);
            for (std::string word; std::getline(words, word, '|');) {
                Settings chosen = settings;
                chosen.set(field.option, word);
                all.push_back(chosen);
            }
        }
    }
    // A number that lifts what others need.
    for (std::size_t i = 0, one = all.size(); i < one; ++i) {
        Settings sampled = all[i];
        sampled.msaa = 4;
        all.push_back(sampled);
    }
    std::erase_if(all, [](const Settings& s) { return s.problem().has_value(); });
    return all;
}

}  // namespace

bool isDrawnBy(const std::string& command, const Field& field) {
    static const std::vector<Settings> drawn = candidates();
    return std::ranges::any_of(drawn, [&](const Settings& s) {
        // The reference beside the paths gets nothing that neither of them draws yet.
        const bool later = field.default_only.because.starts_with(row::not_built);
        if (later && command != "render" && s.path == Path::reference) return false;
        if (!ignoredBecause(s, field.option).empty()) return false;
        if (field.option == "env") return s.env != Settings().env;
        return field.default_only.because.empty() ||
               (field.default_only.unless && field.default_only.unless(s));
    });
}

}  // namespace diptych::cli
