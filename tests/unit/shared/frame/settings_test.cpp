// SPDX-License-Identifier: MIT
// Reading and writing Settings, and what each path reads of them.
#include "shared/frame/settings.h"

#include "shared/frame/setting_rows.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <stdexcept>

namespace diptych {
namespace {

// Every member changed. A member of Settings that fields() omits would keep its default here.
Settings everythingChanged() {
    Settings s;
    s.path = Path::deferred;
    s.assign = Assignment::per_object;
    s.light_kernel = LightKernel::gather;
    s.prepass = Switch::off;
    s.cull = false;
    s.gbuffer = GBufferEncoding::full;
    s.lighting = Lighting::compute;
    s.layers = Layers::forward;
    s.depth_format = DepthFormat::d16;
    s.lit_format = LitFormat::b10g11r11;
    s.shading_precision = ShadingPrecision::fp16;
    s.size = {1920, 17};
    s.camera = "eye=1,2,3 target=0,0,0 \"quoted\"";
    s.time = 1.0 / 3.0;
    s.animation = "walk \"fast\", \xc3\xa9";
    s.variant = "red, \"\xc3\xa9\"";
    s.skinning = Skinning::vertex;
    s.skin_normals = SkinNormals::blended;
    s.env = "sky \\ \xc3\xa9.exr";
    s.env_rotation = -30.5f;
    s.env_sun = true;
    s.ibl_intensity = 0.1f;
    s.ibl = Ibl::sampled;
    s.ibl_diffuse = IblDiffuse::map;
    s.ibl_samples = 31;
    s.ibl_bias = 0.5f;
    s.ambient = {1e-30f, 0.3f, 16777217.0f};
    s.scene_lights = false;
    s.lights = "point:64,spot:16";
    s.seed = 4294967295u;
    s.light_cutoff = 1e-3f;
    s.pixel_lights = 0;
    s.area_lights = AreaLights::representative;
    s.textures = TexturePrecision::packed;
    s.specular_albedo = SpecularAlbedo::fit;
    s.multiscatter = Multiscatter::fdez;
    s.base_layer = BaseLayer::component;
    s.spot_cone = SpotFalloff::smoothstep;
    s.range_window = RangeWindow::squared;
    s.shadows = Shadows::clipmap;
    s.shadow_lights = 7;
    s.shadow_size = 512;
    s.shadow_cascades = 2;
    s.shadow_kernel = 5;
    s.shadow_fit = ShadowFit::depth;
    s.shadow_distance = 12.5f;
    s.shadow_bias = 0.25f;
    s.shadow_casters = ShadowCasters::all;
    s.clipmap_pages = 99;
    s.clipmap_page_size = 64;
    s.evsm_precision = EvsmPrecision::fp16;
    s.evsm_exponent = 5.5f;
    s.evsm_negative_exponent = 4.5f;
    s.evsm_depth = EvsmDepth::from_zero;
    s.evsm_bleed = 0.2f;
    s.evsm_min_variance = 1e-6f;
    s.msaa = 4;
    s.msaa_shading = MsaaShading::sample;
    s.msaa_edges = MsaaEdges::similar;
    s.resolve = Resolve::tonemapped;
    s.alpha_to_coverage = true;
    s.spec_aa = true;
    s.spec_aa_variance = 0.3f;
    s.spec_aa_limit = 0.4f;
    s.spec_aa_normals = SpecularNormals::mapped;
    s.spec_aa_kernel = SpecularKernel::slope;
    s.transparency = Transparency::list;
    s.transparency_layers = 12;
    s.haze = true;
    s.haze_density = 3.5f;
    s.haze_rayleigh = {1e-7f, 0.25f, 3e5f};
    s.haze_rayleigh_height = 500.5f;
    s.haze_mie = {1.0f, 2e-4f, 0.0f};
    s.haze_mie_height = 12.5f;
    s.haze_g = -0.3f;
    s.haze_ground = -17.25f;
    s.haze_march_steps = 24;
    s.spp = 256;
    s.reference_mode = ReferenceMode::scene;
    return s;
}

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

TEST(Settings, JsonRoundTripIsExact) {
    EXPECT_EQ(settingsFromJson(toJson(Settings())), Settings());
    EXPECT_EQ(settingsFromJson(toJson(everythingChanged())), everythingChanged());
    EXPECT_NE(settingsFromJson(toJson(everythingChanged())), Settings());
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

TEST(Settings, WordsRoundTrip) {
    const Settings changed = everythingChanged();
    Settings back;
    Settings::fields(changed, [&](const Field& field, const auto&) {
        EXPECT_NE(changed.valueOf(field.option), back.valueOf(field.option)) << field.option;
        back.set(field.option, changed.valueOf(field.option));
    });
    EXPECT_EQ(back, changed);
}

TEST(Settings, FieldsNameEachMemberOnce) {
    std::set<std::string_view> names;
    for (const Field& field : settingFields()) {
        EXPECT_TRUE(names.insert(field.option).second) << field.option;
        EXPECT_FALSE(acceptedValues(field.option).empty()) << field.option;
    }
}

// Values of a Setting other than the default, as text: the swept ones and one more.
std::vector<std::string> otherValues(const Field& field) {
    const Settings defaults;
    std::vector<std::string> values = sweptValues(defaults, field.option);
    values.push_back(everythingChanged().valueOf(field.option));
    std::erase(values, defaults.valueOf(field.option));
    return values;
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
        EXPECT_FALSE(otherValues(field).empty());
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
    for (const Field& field : settingFields()) {
        std::string key(field.option);
        std::ranges::replace(key, '-', '_');
        EXPECT_NE(sentence.find("\"\\\"" + key + "\\\"\""), std::string::npos) << key;
    }
}

// Effective Settings of a path omit exactly the Settings that their row declares as ignored.
TEST(Settings, EffectiveOnesAreWithoutWhatTheirPathIgnores) {
    for (const auto& [path, name] : enumNames<Path>())
        for (const Field& field : settingFields()) {
            if (field.option == "path") continue;
            Settings plain;
            plain.path = path;
            EXPECT_EQ(effectiveSettings(plain), plain) << name;
            for (const std::string& value : otherValues(field)) {
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
        for (const std::string& value : otherValues(field)) {
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

TEST(Settings, AbsentKeysKeepTheBase) {
    Settings base;
    base.seed = 7;
    const Settings s = settingsFromJson(R"({"size": [8, 4], "haze": true})", base);
    EXPECT_EQ(s.seed, 7u);
    EXPECT_EQ(s.size, (Size{8, 4}));
    EXPECT_TRUE(s.haze);
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
        {R"({"msaa": "four"})", "msaa"},
        {R"({"msaa": 1.5})", "msaa"},
        {R"({"seed": -1})", "seed"},
        {R"({"seed": 4294967296})", "seed"},
        {R"({"size": [1, 2, 3]})", "size"},
        {R"({"size": {"w": 1}})", "size"},
        {R"({"ambient": [1, "x", 0]})", "ambient"},
        {R"({"path": 1})", "path"},
        {R"({"path": "raster"})", "path"},
        {R"({"evsm_bleed": 1e300})", "evsm_bleed"},
        {R"({"haze": 1})", "haze"},
        {R"({"camera": 0.5})", "camera"},
        {R"({"time": null})", "time"},
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

TEST(Settings, BadWordsAreRefusedByOptionAndValue) {
    const std::pair<const char*, const char*> bad[] = {
        {"size", "640"},        {"size", "x"},          {"size", "640x"},  {"size", "640x360x1"},
        {"size", "6.5x3"},      {"msaa", ""},           {"msaa", "4 "},    {"seed", "-1"},
        {"seed", "1e3"},        {"time", "nan"},        {"time", "inf"},   {"time", "1s"},
        {"ambient", "1,2"},     {"ambient", "1,2,3,4"}, {"haze", "maybe"}, {"path", "Deferred"},
        {"evsm-bleed", "1e99"},
    };
    for (const auto& [option, value] : bad) {
        Settings s;
        const std::string what = faultOf([&, o = option, v = value] { s.set(o, v); });
        EXPECT_EQ(what.find(std::string("--") + option + " " + value), 0u) << what;
    }
    Settings s;
    EXPECT_NE(faultOf([&] { s.set("gamma", "2"); }).find("gamma"), std::string::npos);
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
        changed.set(option, everythingChanged().valueOf(option));
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
    for (const auto& [json, expected] : cases) try {
            settingsFromJson(json);
            ADD_FAILURE() << json;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
        }
}

TEST(Settings, OffAndNoneCallOffWhateverCanBe) {
    for (const char* option : {"prepass", "cull", "env", "ambient", "lights", "light-cutoff", "shadow-lights",
                               "shadows", "evsm-bleed", "msaa", "haze", "haze-march-steps"})
        for (const std::string word : {"off", "none"}) {
            Settings said;
            ASSERT_NO_THROW(said.set(option, word)) << option << " " << word;
            EXPECT_EQ(said.problem().value_or(""), "") << option << " " << word;
            std::string key = option;
            std::ranges::replace(key, '-', '_');
            EXPECT_EQ(settingsFromJson("{\"" + key + "\": \"" + word + "\"}"), said) << option;
            EXPECT_EQ(settingsFromJson(toJson(said)), said) << option;
        }
    Settings settings;
    settings.set("env", "off");
    EXPECT_EQ(settings.env, "none");
    settings.set("shadows", "none");
    EXPECT_EQ(settings.valueOf("shadows"), "off");
    EXPECT_THROW(settings.set("gbuffer", "off"), std::runtime_error);
}

}  // namespace
}  // namespace diptych
