// SPDX-License-Identifier: MIT
#include "shared/frame/sides.h"

#include "shared/text/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace diptych {
namespace {

constexpr std::string_view view_options[] = {"size", "camera",       "time",   "animation", "variant",
                                             "env",  "scene-lights", "lights", "seed"};

// Settings that change how an image is rendered, but not the image.
constexpr std::string_view same_image[] = {"light-kernel", "prepass",  "cull",
                                           "lighting",     "skinning", "shadow-casters"};

// assign: only per_object changes the light.
bool changesLight(const SettingDifference& of) {
    if (of.option == "assign") {
        const std::string_view per_object = nameOf(Assignment::per_object);
        return of.baseline == per_object || of.test == per_object;
    }
    return std::ranges::find(same_image, of.option) == std::end(same_image);
}

Path other(Path path) {
    return path == drawn_paths[0] ? drawn_paths[1] : drawn_paths[0];
}

void checkOption(Path path, const std::string& requested, const std::string& option) {
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("{} {}: {}", sideOption(path), requested, why));
    };
    std::vector<std::string> known;
    for (const Field& field : settingFields()) known.emplace_back(field.option);
    if (std::ranges::find(known, option) == known.end())
        refuse(fmt::format("there is no Setting {}{}", option, didYouMean(option, known)));
    if (option == "path") refuse("the option already selects the path");
    if (std::ranges::find(view_options, option) != std::end(view_options))
        refuse(fmt::format("both paths show one view of one scene; use --{}, which sets both", option));
    const Field& field = settingField(option);
    if (field.ignored.of(path).empty()) return;
    const Path reads = other(path);
    refuse(std::string(field.ignored.of(path)) +
           (field.ignored.of(reads).empty() ? fmt::format("; {} {} sets it", sideOption(reads), requested)
                                            : ""));
}

// "ambient=1,0,0,shadows=off": a piece without = continues the previous value.
SideSettings::Words wordsOf(Path path, const std::string& list) {
    SideSettings::Words words;
    std::istringstream pieces(list);
    for (std::string piece; std::getline(pieces, piece, ',');) {
        const std::size_t at = piece.find('=');
        if (at == 0 || (at == piece.npos && words.empty()))
            throw std::runtime_error(
                fmt::format("{} {}: takes NAME=VALUE,..., for example assign=every", sideOption(path), list));
        if (at == piece.npos)
            words.back().second += "," + piece;
        else
            words.emplace_back(piece.substr(0, at), piece.substr(at + 1));
    }
    if (words.empty())
        throw std::runtime_error(
            fmt::format("{} '': takes NAME=VALUE,..., for example assign=every", sideOption(path)));
    return words;
}

const std::string* find(const SideSettings::Words& words, std::string_view option) {
    const auto found = std::ranges::find(words, option, &std::pair<std::string, std::string>::first);
    return found == words.end() ? nullptr : &found->second;
}

}  // namespace

std::span<const std::string_view> viewOptions() {
    return view_options;
}

bool SideSettings::names(std::string_view option) const {
    return find(words[0], option) != nullptr;
}

Settings SideSettings::of(const Settings& common, Path path) const {
    Settings settings = common;
    settings.path = path;
    for (std::size_t side = 0; side < words.size(); ++side)
        if (path == drawn_paths.at(side))
            for (const auto& [option, value] : words.at(side)) settings.set(option, value);
    return settings;
}

SideSettings readSides(const std::array<std::string, 2>& requested, Settings& common) {
    std::array<SideSettings::Words, 2> own;
    for (std::size_t side = 0; side < requested.size(); ++side) {
        if (requested.at(side).empty()) continue;
        const Path path = drawn_paths.at(side);
        for (auto& [option, value] : wordsOf(path, requested.at(side))) {
            const std::string word = fmt::format("{}={}", option, value);
            checkOption(path, word, option);
            if (find(own.at(side), option))
                throw std::runtime_error(
                    fmt::format("{} {}: {} is given twice", sideOption(path), requested.at(side), option));
            Settings tried;
            try {
                tried.set(option, value);
            } catch (const std::runtime_error& error) {
                throw std::runtime_error(fmt::format("{} {}: {}", sideOption(path), word, error.what()));
            }
            if (settingField(option).ignored.of(other(path)).empty())
                own.at(side).emplace_back(option, tried.valueOf(option));
            else
                common.set(option, value);
        }
    }
    SideSettings sides;
    for (const SideSettings::Words& words : own)
        for (const auto& [option, value] : words)
            if (!sides.names(option))
                for (std::size_t side = 0; side < own.size(); ++side) {
                    const std::string* const word = find(own.at(side), option);
                    sides.words.at(side).emplace_back(option, word ? *word : common.valueOf(option));
                }
    return sides;
}

std::string sideOption(Path path) {
    return std::string(pathRow(path).side);
}

std::vector<std::string> wordsOf(const SideSettings& sides) {
    std::vector<std::string> words;
    for (std::size_t side = 0; sides.any() && side < sides.words.size(); ++side) {
        std::string list;
        for (const auto& [option, value] : sides.words.at(side))
            list += fmt::format("{}{}={}", list.empty() ? "" : ",", option, value);
        words.insert(words.end(), {sideOption(drawn_paths.at(side)), list});
    }
    return words;
}

std::vector<SettingDifference> settingDifferences(const Settings& baseline, const Settings& test) {
    std::vector<SettingDifference> all;
    for (const Field& field : settingFields()) {
        const std::string left = baseline.valueOf(field.option), right = test.valueOf(field.option);
        const bool read = field.ignored.of(baseline.path).empty() && field.ignored.of(test.path).empty();
        if (read && field.option != "path" && left != right)
            all.push_back({std::string(field.option), left, right});
    }
    return all;
}

std::string describe(std::span<const SettingDifference> differences) {
    const auto quoted = [](const std::string& value) { return value.empty() ? "none" : value; };
    std::string words;
    for (const SettingDifference& of : differences)
        words += fmt::format("{}--{} {} and {}", words.empty() ? "" : ", ", of.option, quoted(of.baseline),
                             quoted(of.test));
    return words;
}

std::string lightDifferences(const Settings& baseline, const Settings& test) {
    std::vector<SettingDifference> all = settingDifferences(baseline, test);
    std::erase_if(all, [](const SettingDifference& of) { return !changesLight(of); });
    return describe(all);
}

}  // namespace diptych
