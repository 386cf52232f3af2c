// SPDX-License-Identifier: MIT
// Reading and writing Settings, and what each path reads of them.
#include "shared/frame/settings.h"

#include "tests/support/errors.h"
#include "tests/support/setting_samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

TEST(PathRows, AreInOrderAndSayWhoDraws) {
    ASSERT_EQ(path_rows.size(), enumNames<Path>().size());
    std::vector<Path> drawn;
    for (const auto& [path, name] : enumNames<Path>()) {
        const PathRow& row = pathRow(path);
        EXPECT_EQ(row.path, path) << name;
        EXPECT_EQ(isReference(path), name == "reference");
        EXPECT_EQ(row.drawn, row.gbuffer || row.fragments) << name << " has to shade something";
        EXPECT_FALSE(row.gbuffer && row.fragments) << name;
        EXPECT_EQ(row.side.empty(), !row.drawn) << name;
        if (row.drawn) drawn.push_back(path);
    }
    EXPECT_EQ(drawn, std::vector(drawn_paths.begin(), drawn_paths.end()));
    EXPECT_TRUE(shadesFragments(unencoded_path)) << "no encoding changes its surfaces";
    for (const Path path : drawn_paths) EXPECT_NE(otherPath(path), path);
}

// Converts to any member, so that braces count them.
struct AnyMember {
    template <class T>
    operator T() const;
};
template <std::size_t... i>
constexpr bool hasMembers(std::index_sequence<i...>) {
    return requires {
        Settings{(static_cast<void>(i), AnyMember())...};
    };
}
template <std::size_t n = 1>
constexpr std::size_t membersOfSettings() {
    if constexpr (hasMembers(std::make_index_sequence<n + 1>()))
        return membersOfSettings<n + 1>();
    else
        return n;
}

TEST(Settings, EveryMemberHasARowOfItsOwn) {
    std::set<std::string_view> names;
    std::set<const void*> members;
    const Settings settings;
    Settings::fields(settings, [&](const Field& field, const auto& member) {
        EXPECT_TRUE(names.insert(field.option).second) << field.option;
        EXPECT_TRUE(members.insert(&member).second) << field.option << " is another row's member";
    });
    EXPECT_EQ(names.size(), membersOfSettings());
}

std::string keyFor(const Field& field) {
    std::string key(field.option);
    std::ranges::replace(key, '-', '_');
    return key;
}

// Text and JSON of one value change this Setting alone, to the last bit. Absent keys keep the base.
TEST(Settings, EveryValueSurvivesTextAndJson) {
    const Settings defaults, base = everythingChanged();
    Settings::rows([&](const Field& field, auto member) {
        EXPECT_FALSE(acceptedValues(field.option).empty()) << field.option;
        for (const auto& value : samplesOf<std::remove_cvref_t<decltype(defaults.*member)>>()) {
            Settings changed, said;
            changed.*member = value;
            SCOPED_TRACE(fmt::format("--{} {}", field.option, changed.valueOf(field.option)));
            said.set(field.option, changed.valueOf(field.option));
            EXPECT_EQ(said, changed);
            EXPECT_EQ(settingsFromJson(toJson(changed)), changed);
            const nlohmann::json all = nlohmann::json::parse(toJson(changed));
            Settings based = base;
            based.*member = value;
            EXPECT_EQ(settingsFromJson(nlohmann::json{{keyFor(field), all[keyFor(field)]}}.dump(), base),
                      based);
        }
    });
    EXPECT_EQ(settingsFromJson(toJson(base)), base);
}

// Invalid values of a type, as text and as JSON.
template <class T>
std::array<std::vector<std::string>, 2> wrongValuesOf() {
    std::array<std::vector<std::string>, 2> wrong;
    auto& [words, json] = wrong;
    if constexpr (std::is_enum_v<T>) {
        words = {"", "?", "Deferred"};
        json = {"1", "\"?\""};
    } else if constexpr (std::is_same_v<T, bool>) {
        words = {"", "maybe", "true"};
        json = {"1", "\"maybe\""};
    } else if constexpr (std::is_same_v<T, std::string>) {
        json = {"0.5", "true"};
    } else if constexpr (std::is_same_v<T, Size>) {
        words = {"640", "x", "640x", "640x360x1", "6.5x3"};
        json = {"[1, 2, 3]", "\"640\"", "1"};
    } else if constexpr (std::is_same_v<T, Rgb>) {
        words = {"1,2", "1,2,3,4", "a,b,c"};
        json = {"[1, \"x\", 0]", "[1, 2]", "1"};
    } else if constexpr (std::is_integral_v<T>) {
        words = {"", "4 ", "1e3", "1.5", "0x10", "99999999999"};
        json = {"1.5", "\"four\"", "99999999999"};
        if (std::is_unsigned_v<T>)
            for (auto& list : wrong) list.push_back("-1");
    } else {
        words = {"", "nan", "inf", "1s", "0x1", "1e999"};
        json = {"\"one\"", "true"};
        if (std::is_same_v<T, float>)
            for (auto& list : wrong) list.push_back("1e99");
    }
    json.insert(json.end(), {"null", "{\"w\": 1}", "[1, \"x\"]"});
    return wrong;
}

TEST(Settings, WhatIsNoValueIsRefusedByNameInTextAndJson) {
    Settings::rows([](const Field& field, auto member) {
        const Settings defaults;
        const auto [words, json] = wrongValuesOf<std::remove_cvref_t<decltype(defaults.*member)>>();
        const auto expectStart = [](const std::string& what, const std::string& start) {
            EXPECT_TRUE(what.starts_with(start)) << start << " -> " << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        };
        for (const std::string& word : words)
            expectStart(faultOf([&] { Settings().set(field.option, word); }),
                        fmt::format("--{} {}: not ", field.option, word));
        for (const std::string& value : json)
            expectStart(
                faultOf([&] { settingsFromJson(fmt::format("{{\"{}\": {}}}", keyFor(field), value)); }),
                fmt::format("settings: \"{}\": ", keyFor(field)));
    });
    EXPECT_NE(faultOf([] { Settings().set("gamma", "2"); }).find("gamma"), std::string::npos);
}

TEST(Settings, JsonRoundTripIsExactForEveryKindOfFloat) {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        Settings s;
        const auto bits = static_cast<std::uint32_t>(random());
        std::memcpy(&s.evsm_exponent, &bits, sizeof bits);
        if (s.evsm_exponent - s.evsm_exponent != 0) continue;  // infinite or NaN
        const std::uint64_t wide = (std::uint64_t(random()) << 32) | random();
        std::memcpy(&s.time, &wide, sizeof wide);
        if (s.time - s.time != 0) s.time = 0;
        const Settings back = settingsFromJson(toJson(s, -1));
        ASSERT_EQ(std::memcmp(&back.evsm_exponent, &s.evsm_exponent, sizeof(float)), 0) << s.evsm_exponent;
        ASSERT_EQ(std::memcmp(&back.time, &s.time, sizeof(double)), 0) << s.time;
    }
}

TEST(Settings, EveryRowIsComplete) {
    std::set<std::string_view> options;
    for (const Field& field : settingFields()) options.insert(field.option);
    const Settings defaults;
    for (const Field& field : settingFields()) {
        SCOPED_TRACE(field.option);
        EXPECT_EQ(&settingField(field.option), &field);
        EXPECT_FALSE(field.help.empty());
        EXPECT_EQ(field.valid.are.empty(), field.valid.check == nullptr);
        EXPECT_TRUE(!field.valid.check || field.valid.check(defaults));
        EXPECT_TRUE(!field.default_only.unless || !field.default_only.because.empty());
        for (const auto& word : {field.off, field.for_surfaces})
            if (word) {
                Settings settings;
                EXPECT_NO_THROW(settings.set(field.option, std::string(*word))) << *word;
                EXPECT_TRUE(!field.valid.check || field.valid.check(settings)) << *word;
            }
        for (const std::string& value : sweptValues(defaults, field.option)) {
            Settings settings;
            EXPECT_NO_THROW(settings.set(field.option, value)) << value;
            EXPECT_TRUE(!field.valid.check || field.valid.check(settings)) << value;
        }
        EXPECT_TRUE(field.sweep_with.empty() || !field.sweep.empty()) << "nothing of it is swept";
    }
    for (const SweepPair& pair : sweepPairs())
        for (const std::string_view option : {pair.a, pair.b})
            if (option != "*") {
                EXPECT_TRUE(options.contains(option)) << option;
                EXPECT_FALSE(settingField(option).sweep.empty()) << option << " is not swept";
            }
    EXPECT_THROW(settingField("gamma"), std::runtime_error);
}

TEST(Settings, TheFuzzersDictionaryNamesThemAll) {
    std::ifstream stream(DIPTYCH_SOURCE_DIR "/tests/fuzz/settings.dict");
    const std::string sentence(std::istreambuf_iterator<char>(stream), {});
    for (const Field& field : settingFields())
        EXPECT_NE(sentence.find("\"\\\"" + keyFor(field) + "\\\"\""), std::string::npos) << field.option;
}

// Effective Settings of a path omit exactly the Settings that their row declares as ignored.
TEST(Settings, EffectiveOnesAreWithoutWhatTheirPathIgnores) {
    for (const auto& [path, name] : enumNames<Path>())
        for (const Field& field : settingFields()) {
            if (field.option == "path") continue;
            Settings plain;
            plain.path = path;
            EXPECT_EQ(effectiveSettings(plain), plain) << name;
            for (const std::string& value : otherValues(field.option)) {
                Settings changed = plain;
                changed.set(field.option, value);
                const bool ignored = !ignoredBecause(changed, field.option).empty();
                if (path == Path::reference && !field.one_for_reference.empty() && value != field.off)
                    changed.set(field.option, std::string(field.one_for_reference));
                EXPECT_EQ(effectiveSettings(changed), ignored ? plain : changed)
                    << name << " " << field.option << " " << value;
            }
        }
}

TEST(Settings, ForwardPlusReadsTheGBuffersEncodingWithShadowsAlone) {
    Settings settings;
    settings.path = Path::forward_plus;
    settings.gbuffer = GBufferEncoding::compact;
    EXPECT_EQ(ignoredBecause(settings, "gbuffer"), "");
    EXPECT_EQ(effectiveSettings(settings), settings);
    settings.shadows = Shadows::off;
    EXPECT_EQ(ignoredBecause(settings, "gbuffer"), "forward_plus has no G-buffer");
    EXPECT_EQ(effectiveSettings(settings).gbuffer, Settings().gbuffer);
}

TEST(Settings, TheReferenceFollowsWhatItsRowsSayAndNothingElse) {
    Settings reference;
    reference.path = Path::reference;
    for (const Field& field : settingFields())
        for (const std::string& value : otherValues(field.option)) {
            SCOPED_TRACE(std::string(field.option) + " " + value);
            Settings changed;
            changed.set(field.option, value);
            Settings told = changed;
            told.path = Path::reference;
            const bool follows = field.option != "path" && ignoredBecause(told, field.option).empty() &&
                                 (field.one_for_reference.empty() ||
                                  (value == field.off) != (Settings().valueOf(field.option) == field.off));
            EXPECT_EQ(referenceSettings(changed) == reference, !follows);
            EXPECT_EQ(referenceSettings(changed), effectiveSettings(referenceSettings(changed)));
            const bool alone = field.option == "spp" || field.option == "reference-mode";
            EXPECT_EQ(withoutReference(changed), alone ? Settings() : changed);
            EXPECT_EQ(withReferenceOf(Settings(), changed), alone ? changed : Settings());
        }
}

// Whatever was requested, mode surface always captures the same surfaces for one scene, view and time.
TEST(Settings, SurfacesAreCapturedWithNothingPacked) {
    Settings asked = everythingChanged();
    asked.spp = 1;
    asked.reference_mode = ReferenceMode::surface;
    Settings expected;
    expected.path = Path::forward_plus;
    expected.prepass = Switch::on;
    expected.gbuffer = GBufferEncoding::full;
    expected.size = asked.size;
    expected.camera = asked.camera;
    expected.time = asked.time;
    expected.animation = asked.animation;
    expected.variant = asked.variant;
    expected.skin_normals = asked.skin_normals;
    expected.scene_lights = asked.scene_lights;
    expected.lights = asked.lights;
    expected.shadows = Shadows::off;
    expected.seed = asked.seed;
    expected.textures = asked.textures;
    expected.spec_aa = true;
    expected.spec_aa_variance = asked.spec_aa_variance;
    expected.spec_aa_limit = asked.spec_aa_limit;
    expected.spec_aa_normals = asked.spec_aa_normals;
    expected.spec_aa_kernel = asked.spec_aa_kernel;
    EXPECT_EQ(surfaceSettings(asked), expected);
    EXPECT_EQ(surfaceSettings(asked).problem().value_or("none"), "none");
}

// Captured surfaces include the paths' roughness filter; samples of the scene need none.
TEST(Settings, TheReferenceFollowsTheFilterOfRoughnessWhereItShadesCaptures) {
    Settings asked;
    asked.spec_aa = true;
    asked.spec_aa_variance = 0.5f;
    EXPECT_EQ(referenceSettings(asked).spec_aa_variance, 0.5f);
    EXPECT_TRUE(surfaceSettings(asked).spec_aa);
    asked.reference_mode = ReferenceMode::scene;
    EXPECT_FALSE(referenceSettings(asked).spec_aa);
    EXPECT_EQ(referenceSettings(asked).spec_aa_variance, Settings().spec_aa_variance);
    asked.path = Path::reference;
    EXPECT_EQ(ignoredBecause(asked, "spec-aa"),
              "the reference takes several samples instead of filtering roughness");
}

TEST(Settings, JsonAcceptsTheWordsOfTheCommandLine) {
    const Settings s =
        settingsFromJson(R"({"size": "8x4", "ambient": "1,2,3", "sort": "off", "lights": "none"})");
    EXPECT_EQ(s.size, (Size{8, 4}));
    EXPECT_EQ(s.ambient, (Rgb{1, 2, 3}));
    EXPECT_EQ(s.transparency, Transparency::unsorted) << "by its other name";
    EXPECT_EQ(s.lights, "");
}

TEST(Settings, BadJsonIsRefusedByName) {
    const std::pair<const char*, const char*> bad[] = {
        {R"({"gamma": 2})", "gamma"},
        {R"({"light-cutoff": 2})", "light-cutoff"},
        {"[1]", "object"},
        {"{", "JSON"},
        {"", "JSON"},
        {R"({"time": 1e999})", "overflow"},
    };
    for (const auto& [text, name] : bad) {
        const std::string what = faultOf([&] { settingsFromJson(text); });
        EXPECT_NE(what.find(name), std::string::npos) << text << " -> " << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << text << " -> " << what;
    }
}

// The reference traces shadows and samples lights, so Settings of shadow techniques do not affect it.
TEST(Settings, TheReferenceIgnoresHowShadowsAndSamplesAreMade) {
    Settings plain;
    plain.path = Path::reference;
    plain.shadows = Shadows::pcf;
    for (const Shadows technique : {Shadows::evsm, Shadows::clipmap}) {
        Settings changed = plain;
        changed.shadows = technique;
        EXPECT_EQ(effectiveSettings(changed), plain);
        EXPECT_EQ(referenceSettings(changed), plain);
    }
    for (const char* option : {"shadow-size", "shadow-cascades", "shadow-kernel", "shadow-distance",
                               "shadow-bias", "clipmap-pages", "clipmap-page-size", "evsm-precision",
                               "evsm-depth", "evsm-bleed", "evsm-min-variance", "msaa"}) {
        Settings changed = plain;
        changed.set(option, otherValues(option).at(0));
        EXPECT_NE(changed, plain) << option;
        EXPECT_EQ(effectiveSettings(changed), plain) << option;
        EXPECT_EQ(referenceSettings(changed), plain) << option;
    }
    // shadow_lights changes the visible light.
    plain.shadow_lights = 3;
    EXPECT_EQ(referenceSettings(plain).shadow_lights, 3);
    EXPECT_EQ(surfaceSettings(plain).shadow_lights, 0);
}

TEST(Settings, JsonTakesACamerasNumberAndTheWholeSettingsMember) {
    EXPECT_EQ(settingsFromJson(R"({"camera": 2})").camera, "2");
    EXPECT_EQ(settingsFromJson(R"({"animation": 2})").animation, "2");
    EXPECT_EQ(settingsFromJson(R"({"variant": 2})").variant, "2");
    EXPECT_EQ(settingsFromJson(R"({"settings": {"seed": 7}})").seed, 7u);
}

TEST(Settings, WhatIsNoSettingIsSentToWhereItBelongs) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"runs": 3})", "--runs"},
        {R"({"debug": "normals"})", "--debug"},
        {R"({"no_tonemap": true})", "--no-tonemap"},
        {R"({"frames": 1})", "--frames"},
        {R"({"frames": [{"settings": {}}]})", "one frame's \"settings\" object"},
        {R"({"name": "deferred", "settings": {}})", "one frame's \"settings\" object"},
    };
    for (const auto& [json, expected] : cases)
        EXPECT_NE(faultOf([&] { settingsFromJson(json); }).find(expected), std::string::npos) << json;
}

TEST(Settings, OffAndNoneCallOffWhateverCanBe) {
    std::set<std::string_view> can;
    for (const Field& field : settingFields())
        for (const std::string word : {"off", "none"}) {
            SCOPED_TRACE(std::string(field.option) + " " + word);
            Settings said;
            const std::string accepted = acceptedValues(field.option);
            if (!field.off) {
                const bool isValue = accepted == "TEXT" || accepted.find(word) != std::string::npos;
                EXPECT_EQ(faultOf([&] { said.set(field.option, word); }).empty(), isValue);
                continue;
            }
            can.insert(field.option);
            ASSERT_EQ(faultOf([&] { said.set(field.option, word); }), "");
            EXPECT_EQ(said.valueOf(field.option), *field.off);
            EXPECT_EQ(said.problem().value_or("none"), "none");
            EXPECT_EQ(settingsFromJson("{\"" + keyFor(field) + "\": \"" + word + "\"}"), said);
        }
    for (const char* option : {"prepass", "cull", "env", "ambient", "lights", "light-cutoff", "shadow-lights",
                               "shadows", "evsm-bleed", "msaa", "haze", "haze-march-steps"})
        EXPECT_TRUE(can.contains(option)) << option;
}

}  // namespace
}  // namespace diptych
