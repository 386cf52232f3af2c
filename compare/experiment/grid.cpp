// SPDX-License-Identifier: MIT
#include "compare/experiment/grid.h"

#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace diptych::experiment {
namespace {

using Json = nlohmann::ordered_json;

std::string quotedLine(const Json& json) {
    return oneLine(jsonText(json, -1));
}

// The option for a JSON key. Throws std::runtime_error if a sweep cannot vary it.
std::string optionOf(const std::string& key) {
    std::string option, all, key_ = key;
    std::ranges::replace(key_, '_', '-');
    bool content = false;
    for (const Field& field : settingFields()) {
        if (field.option == key_ && !field.sweep.empty()) option = key_;
        if (field.option == key_ && field.sweep.empty()) content = true;
        if (!field.sweep.empty()) all += (all.empty() ? "" : ", ") + std::string(field.option);
    }
    if (content)
        throw std::runtime_error(
            fmt::format("\"{}\": does not trade time for accuracy; --{} sets it for every row", key, key_));
    if (option.empty())
        throw std::runtime_error(fmt::format("\"{}\": no such setting; there are {}", oneLine(key), all));
    return option;
}

// The value in the words of Settings::set(). `json`: such a word, or a value as in reports.
std::string valueFrom(const std::string& key, const std::string& option, const Json& json,
                      const Settings& requested) {
    Settings settings = requested;
    if (json.is_string())
        settings.set(option, wordsFor(requested, option, json.get<std::string>()));
    else
        settings = settingsFromJson(Json::object({{key, json}}).dump(), requested);
    return settings.valueOf(option);
}

Grid gridOf(const Json& json, const Settings& requested) {
    if (!json.is_object() || !json.contains("settings") || !json["settings"].is_object())
        throw std::runtime_error(quotedLine(json) + " is not an object that holds a \"settings\" object");
    for (const auto& [key, value] : json.items())
        if (key != "settings")
            throw std::runtime_error(fmt::format("\"{}\": unknown key beside \"settings\"", oneLine(key)));
    Grid grid;
    for (const auto& [key, json_values] : json["settings"].items()) {
        const std::string option = optionOf(key);
        const Json list = json_values.is_array() ? json_values : Json::array({json_values});
        if (list.empty()) throw std::runtime_error(fmt::format("\"{}\": has no value", key));
        if (std::ranges::any_of(grid, [&](const auto& axis) { return axis.first == option; }))
            throw std::runtime_error(fmt::format("\"{}\": appears twice", key));
        std::vector<std::string> words;
        for (const Json& value : list)
            if (std::string word = valueFrom(key, option, value, requested);
                std::ranges::count(words, word) == 0)
                words.push_back(std::move(word));
        grid.emplace_back(option, std::move(words));
    }
    return grid;
}

}  // namespace

std::vector<Grid> readGrids(const std::string& fileOrText, const Settings& requested) {
    const bool isText = fileOrText.starts_with('{') || fileOrText.starts_with('[');
    const std::string name = isText ? "--grid" : "--grid " + fileOrText;
    try {
        const Json json = parseUniqueJson(isText ? fileOrText : textIn(fileOrText, json_bytes));
        std::vector<Grid> grids;
        if (!json.is_array()) return {gridOf(json, requested)};
        for (const Json& one : json) grids.push_back(gridOf(one, requested));
        if (grids.empty()) throw std::runtime_error("is an empty list; give objects with \"settings\"");
        return grids;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + oneLine(error.what(), 350));
    }
}

}  // namespace diptych::experiment
