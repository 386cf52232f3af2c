// SPDX-License-Identifier: MIT
// Settings of one path alone, on top of those that both paths have: --deferred and --forward-plus.
#pragma once

#include "shared/frame/settings.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

// Options that choose which picture is seen: both sides have the same.
std::span<const std::string_view> viewOptions();

struct SideSettings {
    using Words = std::vector<std::pair<std::string, std::string>>;  // option, value as of Settings::set()

    // By path, as drawn_paths. Both name the same options in the same order.
    std::array<Words, 2> words;

    bool any() const { return !words[0].empty(); }
    bool names(std::string_view option) const;
    // `common` of that path, with the Settings of its side. The reference has none of its own.
    Settings of(const Settings& common, Path path) const;

    bool operator==(const SideSettings&) const = default;
};

// Reads "NAME=VALUE,..." of each drawn path, empty: none; a value may contain commas. What the other side is
// not told is as in `common`. A Setting that the other path does not read (gbuffer, prepass) is set in
// `common`, so that both are judged by the same. Throws std::runtime_error, one line, naming what was given.
SideSettings readSides(const std::array<std::string, 2>& given, Settings& common);

// The words of the command line that readSides() reads back: empty without any.
std::vector<std::string> wordsOf(const SideSettings& sides);
// "--deferred", "--forward-plus"
std::string sideOption(Path path);

// A Setting that two pictures do not share.
struct SettingDifference {
    std::string option, baseline, test;  // values in words
};
// Those of two drawn paths that both read, but the path itself.
std::vector<SettingDifference> settingDifferences(const Settings& baseline, const Settings& test);

// Those of them that may change light, "--assign clustered and per_object, --shadows pcf and evsm"; empty
// where both sides draw the same light to the bit.
std::string lightDifferences(const Settings& baseline, const Settings& test);
// "--assign clustered and per_object"
std::string inWords(std::span<const SettingDifference> differences);

}  // namespace diptych
