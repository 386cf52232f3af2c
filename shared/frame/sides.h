// SPDX-License-Identifier: MIT
// Settings of one path alone, in addition to the common ones: --deferred and --forward-plus.
#pragma once

#include "shared/frame/settings.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {

// Options that select the image; both sides share them.
std::span<const std::string_view> viewOptions();

struct SideSettings {
    using Words = std::vector<std::pair<std::string, std::string>>;  // option, value for Settings::set()

    // By path, as in drawn_paths. Both list the same options in the same order.
    std::array<Words, 2> words;

    bool any() const { return !words[0].empty(); }
    bool names(std::string_view option) const;
    // `common` for a path, with the Settings of its side. The reference has no side.
    Settings of(const Settings& common, Path path) const;

    bool operator==(const SideSettings&) const = default;
};

// Parses "NAME=VALUE,..." of each drawn path; empty: none. A value may contain commas. Settings missing on
// the other side are as in `common`. Settings that the other path ignores (gbuffer, prepass) are set in
// `common`, so that both are evaluated with the same values. Throws std::runtime_error, one line, naming the
// input.
SideSettings readSides(const std::array<std::string, 2>& requested, Settings& common);

// Command line words that readSides() parses; empty without any.
std::vector<std::string> wordsOf(const SideSettings& sides);
// "--deferred", "--forward-plus"
std::string sideOption(Path path);

// A Setting that differs between two images.
struct SettingDifference {
    std::string option, baseline, test;  // values in words
};
// Differences of settings that both paths read, except the path itself.
std::vector<SettingDifference> settingDifferences(const Settings& baseline, const Settings& test);

// Text of the differences that may change light, "--assign clustered and per_object, --shadows pcf and
// evsm"; empty if light is bit for bit the same.
std::string lightDifferences(const Settings& baseline, const Settings& test);
// "--assign clustered and per_object"
std::string describe(std::span<const SettingDifference> differences);

}  // namespace diptych
