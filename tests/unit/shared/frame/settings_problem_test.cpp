// SPDX-License-Identifier: MIT
// Valid and invalid values and combinations of Settings.
#include "shared/frame/settings.h"

#include "tests/support/setting_samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace diptych {
namespace {

std::string problemOf(const Settings& settings) {
    return settings.problem().value_or("none");
}

// "--option value" of the Settings.
std::string saidOf(const Settings& settings, std::string_view option) {
    return fmt::format("--{} {}", option, settings.valueOf(option));
}

Settings withValue(Settings settings, std::string_view option, const std::string& value) {
    settings.set(option, value);
    return settings;
}

// ---- the range of a single Setting ------------------------------------------------------------------------

template <class T>
constexpr bool has_numbers = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) ||
                             std::is_same_v<T, Size> || std::is_same_v<T, Rgb>;

// The numbers that a member has: one, or its components.
template <class T>
auto numbersIn(T& member) {
    if constexpr (std::is_same_v<T, Size>)
        return std::array{&member.width, &member.height};
    else if constexpr (std::is_same_v<T, Rgb>)
        return std::array{&member.r, &member.g, &member.b};
    else
        return std::array{&member};
}

template <class T>
T neighbour(T value, bool above) {
    if constexpr (std::is_integral_v<T>)
        return above ? value + 1 : value - 1;
    else
        return std::nextafter(
            value, above ? std::numeric_limits<T>::infinity() : -std::numeric_limits<T>::infinity());
}

template <class T>
struct SettingRange {
    std::vector<T> accepted, refused;
};

// The ends of the range that the sentence of a row states, and their neighbours beyond.
template <class T>
SettingRange<T> rangeIn(const std::string& sentence) {
    constexpr T most = std::numeric_limits<T>::max();
    const auto number = [](const std::string& text) { return static_cast<T>(std::stod(text)); };
    std::smatch found;
    SettingRange<T> range;
    if (std::regex_search(sentence, found, std::regex("must be ([-0-9.e]+) to ([-0-9.e]+)")))
        range = {{number(found[1]), number(found[2])},
                 {neighbour(number(found[1]), false), neighbour(number(found[2]), true)}};
    else if (std::regex_search(sentence, found, std::regex("must be ([0-9]+) or more and below ([0-9]+)")))
        range = {{number(found[1]), neighbour(number(found[2]), false)},
                 {neighbour(number(found[1]), false), number(found[2])}};
    else if (std::regex_search(sentence, found, std::regex("must be (finite and )?at least ([0-9]+)")))
        range = {{number(found[2]), most}, {neighbour(number(found[2]), false)}};
    else if (std::regex_search(sentence, std::regex("must be finite$")))
        range = {{most, std::numeric_limits<T>::lowest()}, {}};
    else if (std::regex_search(sentence, std::regex("must be [0-9]+(, [0-9]+)* or [0-9]+$")))
        for (int i = -1; i < 300; ++i)
            (std::regex_search(sentence, std::regex(fmt::format("\\b{}\\b", i))) && i >= 0 ? range.accepted
                                                                                           : range.refused)
                .push_back(static_cast<T>(i));
    if constexpr (std::is_floating_point_v<T>)
        range.refused.insert(range.refused.end(),
                             {std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
                              std::numeric_limits<T>::quiet_NaN()});
    return range;
}

// Every number with a range is accepted as far as its row says and refused beyond, with value and reason.
TEST(Settings, EveryRangeIsWhatItsRowSays) {
    EXPECT_EQ(problemOf(Settings()), "none");
    Settings::rows([](const Field& field, auto member) {
        using T = std::remove_cvref_t<decltype(Settings().*member)>;
        SCOPED_TRACE(field.option);
        if (!field.valid.check) return;
        if constexpr (!has_numbers<T>) {
            EXPECT_EQ(field.option, "env") << "has a range that is not tested";
        } else {
            Settings settings;
            const auto refusal = [&] {
                return fmt::format("{}: {}", saidOf(settings, field.option), field.valid.are);
            };
            for (auto* const number : numbersIn(settings.*member)) {
                const auto before = *number;
                const auto range =
                    rangeIn<std::remove_cvref_t<decltype(before)>>(std::string(field.valid.are));
                ASSERT_FALSE(range.accepted.empty()) << field.valid.are << ": not understood";
                for (const auto value : range.accepted) {
                    *number = value;
                    EXPECT_NE(problemOf(settings), refusal());
                }
                for (const auto value : range.refused) {
                    *number = value;
                    EXPECT_EQ(problemOf(settings), refusal());
                }
                *number = before;
            }
        }
    });
    EXPECT_EQ(problemOf(withValue({}, "env", "")), "--env '': is empty; name a file, or use none");
}

// ---- Settings that only others give an effect -------------------------------------------------------------

// SettingWords of a Setting: those with a name, or some.
std::vector<std::string> valuesOf(std::string_view option) {
    if (option == "env") return {"none", "scene", "sky.exr"};
    if (option == "msaa") return {"1", "4", "8"};
    if (option == "spp") return {"1", "4"};
    std::vector<std::string> values;
    std::istringstream accepted(acceptedValues(option));
    for (std::string value; std::getline(accepted, value, '|');) values.push_back(value);
    return values;
}

// The only values of another Setting, `option`, with which the Settings of these rows have an effect.
struct EffectCondition {
    std::string_view because, option;
    std::set<std::string> values;
};
const std::vector<EffectCondition>& conditions() {
    static const std::vector<EffectCondition> all{
        {"has no effect without --shadows", "shadows", {"pcf", "evsm", "evsm4", "msm4", "pcss", "clipmap"}},
        {"has no effect without --shadows pcf, pcss, evsm, evsm4 or msm4",
         "shadows",
         {"pcf", "pcss", "evsm", "evsm4", "msm4"}},
        {"has no effect without --shadows evsm or evsm4", "shadows", {"evsm", "evsm4"}},
        {"has no effect without --shadows evsm4", "shadows", {"evsm4"}},
        {"has no effect without --shadows clipmap", "shadows", {"clipmap"}},
        {"has no effect without --env (--env scene uses the environment in the scene's file)",
         "env",
         {"sky.exr", "scene"}},
        {"has no effect without --haze on", "haze", {"on"}},
        {"has no effect without --spec-aa on", "spec-aa", {"on"}},
        {"has no effect without --transparency list", "transparency", {"list"}},
        {"has no effect without --assign per_object", "assign", {"per_object"}},
        {"has no effect without a reference (--path reference, compare: --baseline reference)",
         "path",
         {"reference"}},
        {"has no effect without --msaa 4", "msaa", {"4", "8"}},
        {"has no effect without --msaa 4 or a reference", "msaa", {"4", "8"}},
        {"has no effect without --msaa 4 and --msaa-shading pixel: a single sample is covered or not",
         "msaa",
         {"4", "8"}},
        {"requires --msaa 1", "msaa", {"1"}},
        {"cannot be used with --msaa 4, which shades interpolated positions instead of the stored depth",
         "msaa",
         {"1"}}};
    return all;
}

// Without effect, a value other than the default is refused, whatever it is. With it, all are accepted, and
// so are those of Settings without a condition, but for "walk".
TEST(Settings, EachIsRefusedExactlyWhereItHasNoEffect) {
    for (const Field& field : settingFields()) {
        const DefaultOnly& only = field.default_only;
        SCOPED_TRACE(field.option);
        if (only.because.empty()) {
            for (const std::string& value : otherValues(field.option))
                if (value != "walk") {
                    EXPECT_EQ(problemOf(withValue({}, field.option, value)), "none");
                }
            continue;
        }
        const auto known = std::ranges::find(conditions(), only.because, &EffectCondition::because);
        ASSERT_NE(known, conditions().end()) << only.because << ": has no line here";
        for (const std::string& value : otherValues(field.option)) {
            const Settings said = withValue({}, field.option, value);
            for (const std::string& other : valuesOf(known->option)) {
                Settings settings = withValue(said, known->option, other);
                if (field.option == "spp") settings.reference_mode = ReferenceMode::scene;
                EXPECT_EQ(problemOf(settings),
                          known->values.contains(other)
                              ? "none"
                              : fmt::format("{} {}; use {}", saidOf(said, field.option), only.because,
                                            Settings().valueOf(field.option)))
                    << other;
            }
        }
    }
    Settings several = withValue(withValue({}, "alpha-to-coverage", "on"), "msaa", "4");
    several.msaa_shading = MsaaShading::sample;
    EXPECT_TRUE(problemOf(several).starts_with("--alpha-to-coverage on has no effect without --msaa 4 and"));
    EXPECT_EQ(problemOf(withValue(withValue({}, "resolve", "tonemapped"), "path", "reference")), "none");
}

// ---- invalid combinations ---------------------------------------------------------------------------------

using SettingWords = std::map<std::string_view, std::string>;  // by option

struct Combination {
    SettingWords words;
    std::string problem;
};

std::vector<Combination> invalidCombinations() {
    std::vector<Combination> all{
        {{{"path", "reference"}, {"reference-mode", "surface"}, {"spp", "7"}},
         "--spp 7: --reference-mode surface shades one sample; use --reference-mode scene"},
        {{{"path", "deferred"}, {"assign", "per_object"}},
         "--assign per_object cannot be used with --path deferred: its G-buffer does not store the object; "
         "use --path forward_plus, or --forward-plus assign=per_object if both paths are rendered"},
        {{{"path", "forward_plus"}, {"assign", "tiled"}, {"prepass", "off"}},
         "--assign tiled cannot be used with --prepass off: it needs the depths of a tile; use --prepass "
         "on"}};
    for (const std::string format : {"d24", "d16"})
        all.push_back({{{"path", "forward_plus"}, {"depth-format", format}, {"prepass", "off"}},
                       fmt::format("--depth-format {} cannot be used with --prepass off: shading needs the "
                                   "stored depth; use --prepass on",
                                   format)});
    for (const std::string_view option : {"evsm-exponent", "evsm-negative-exponent"})
        all.push_back({{{"evsm-precision", "fp16"}, {option, "20"}},
                       fmt::format("--{} 20: must be 0 to 44.36, or 0 to 5.54 with 16-bit moments; larger "
                                   "squares exceed the format",
                                   option)});
    for (const std::string path : {"deferred", "forward_plus"}) {
        all.push_back({{{"path", path}, {"multiscatter", "walk"}},
                       "--multiscatter walk: only the reference simulates it; use energy or fdez"});
        for (const std::string transparency : {"weighted", "moments", "list"})
            for (const std::string samples : {"4", "8"})
                all.push_back(
                    {{{"path", path}, {"transparency", transparency}, {"msaa", samples}},
                     fmt::format("--transparency {} with --msaa {}: it supports only one sample per "
                                 "pixel; use sorted, unsorted or triangles",
                                 transparency, samples)});
    }
    return all;
}

// All pairs of values of all Settings on each path.
TEST(Settings, ExactlyTheInvalidCombinationsAreRefused) {
    const std::vector<Combination> invalid = invalidCombinations();
    std::set<std::string> seen;
    SettingWords defaults;
    for (const Field& field : settingFields()) defaults[field.option] = Settings().valueOf(field.option);
    const auto check = [&](const Settings& settings, const SettingWords& said) {
        std::vector<std::string> expected;
        const auto isSaid = [&](const auto& word) {
            return (said.contains(word.first) ? said : defaults).at(word.first) == word.second;
        };
        for (const Combination& combination : invalid)
            if (std::ranges::all_of(combination.words, isSaid)) expected.push_back(combination.problem);
        const std::string problem = problemOf(settings);
        // The test above has these.
        const auto isWithoutEffect = [&](const Field& field) {
            return !field.default_only.because.empty() &&
                   problem.starts_with(saidOf(settings, field.option) + " " +
                                       std::string(field.default_only.because));
        };
        if (expected.empty() && problem != "none" && std::ranges::any_of(settingFields(), isWithoutEffect))
            return;
        if (expected.empty()) expected.emplace_back("none");
        EXPECT_EQ(std::ranges::count(expected, problem), 1) << problem << toJson(settings, -1);
        seen.insert(problem);
    };
    std::vector<std::pair<std::string_view, std::string>> values;
    for (const Field& field : settingFields())
        if (field.option != "path")
            for (const std::string& value : otherValues(field.option))
                values.emplace_back(field.option, value);
    values.emplace_back("msaa", "8");
    for (const auto& [path, name] : enumNames<Path>()) {
        Settings settings;
        settings.path = path;
        check(settings, {{"path", std::string(name)}});
        for (const auto& first : values) {
            const Settings one = withValue(settings, first.first, first.second);
            for (const auto& second : values)
                if (first.first < second.first)
                    check(withValue(one, second.first, second.second),
                          {{"path", std::string(name)}, first, second});
                else if (first == second)
                    check(one, {{"path", std::string(name)}, first});
        }
    }
    for (const Combination& combination : invalid)
        EXPECT_TRUE(seen.contains(combination.problem)) << combination.problem;
}

// A clipmap level has at least four pages in a row.
TEST(Settings, AClipmapHasFourPagesInARow) {
    Settings s;
    s.shadows = Shadows::clipmap;
    s.clipmap_page_size = 32;
    s.shadow_size = 128;
    EXPECT_EQ(problemOf(s), "none");
    s.shadow_size = 127;
    EXPECT_EQ(problemOf(s),
              "--clipmap-page-size 32: four pages in a row exceed --shadow-size 127; use --shadow-size 128 "
              "or more");
    s.path = Path::reference;
    EXPECT_EQ(problemOf(s), "none") << "which ignores both";
    s.path = Path::deferred;
    s.shadow_size = 200;
    s.clipmap_page_size = 64;
    EXPECT_EQ(problemOf(s),
              "--clipmap-page-size 64: four pages in a row exceed --shadow-size 200; use a smaller one");
}

// 16-bit floats cannot represent the second moment of a larger exponent.
TEST(Settings, ExponentsThatShortMomentsCannotHoldAreRefused) {
    Settings s;
    s.shadows = Shadows::evsm4;
    s.evsm_precision = EvsmPrecision::fp16;
    for (float Settings::*exponent : {&Settings::evsm_exponent, &Settings::evsm_negative_exponent}) {
        s.*exponent = 5.54f;
        EXPECT_EQ(problemOf(s), "none");
        s.*exponent = 5.6f;
        EXPECT_TRUE(problemOf(s).ends_with(
            "exponent 5.6: must be 0 to 44.36, or 0 to 5.54 with 16-bit moments; larger squares exceed the "
            "format"))
            << problemOf(s);
        s.*exponent = 0;
    }
}

}  // namespace
}  // namespace diptych
