// SPDX-License-Identifier: MIT
// Valid and invalid combinations of Settings.
#include "shared/frame/settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

namespace diptych {
namespace {

TEST(Settings, TheUsualOnesHaveNoProblem) {
    EXPECT_EQ(Settings().problem(), std::nullopt);
}

TEST(Settings, WhatIsBuiltHasNoProblem) {
    const std::pair<const char*, const char*> built[] = {
        {"path", "deferred"},
        {"path", "forward_plus"},
        {"assign", "every"},
        {"assign", "tiled"},
        {"assign", "clustered"},
        {"light-kernel", "gather"},
        {"light-cutoff", "0.01"},
        {"area-lights", "representative"},
        {"textures", "exact"},
        {"textures", "packed"},
        {"specular-albedo", "fit"},
        {"skin-normals", "blended"},
        {"base-layer", "component"},
        {"spot-cone", "smoothstep"},
        {"range-window", "squared"},
        {"multiscatter", "energy"},
        {"multiscatter", "fdez"},
        {"prepass", "on"},
        {"prepass", "off"},
        {"cull", "off"},
        {"gbuffer", "compact"},
        {"gbuffer", "full"},
        {"lighting", "compute"},
        {"layers", "forward"},
        {"size", "1x1"},
        {"size", "16384x1"},
        {"camera", "0"},
        {"time", "2"},
        {"animation", "walk"},
        {"animation", ""},
        {"variant", "red"},
        {"variant", "1"},
        {"scene-lights", "off"},
        {"lights", "point:3"},
        {"lights", "none"},
        {"seed", "9"},
        {"env", "none"},
        {"shadows", "off"},
        {"shadows", "pcf"},
        {"shadows", "evsm"},
        {"shadows", "clipmap"},
        {"shadows", "evsm4"},
        {"shadows", "msm4"},
        {"shadows", "pcss"},
        {"haze", "off"},
        {"haze", "on"},
        {"sort", "off"},
        {"msaa", "1"},
        {"msaa", "4"},
        {"msaa", "8"},
        {"spec-aa", "on"},
        {"spp", "1"},
        {"ibl-intensity", "1"},
        {"env", "sky.exr"},
        {"path", "reference"},
    };
    for (const auto& [option, value] : built) {
        Settings s;
        s.set(option, value);
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
}

TEST(Settings, WhatHasNoMeaningIsNamedWithItsValue) {
    const std::pair<const char*, const char*> rest[] = {
        {"size", "0x5"},
        {"size", "5x16385"},
        {"size", "-1x5"},
        {"time", "-1"},
        {"ibl-intensity", "2"},
        {"ibl-intensity", "-1"},
        {"ambient", "0,-0.1,0"},
        {"light-cutoff", "-0.01"},
        {"pixel-lights", "8"},
        {"shadow-lights", "1"},
        {"shadow-lights", "-1"},
        {"shadow-size", "512"},
        {"shadow-size", "15"},
        {"shadow-cascades", "2"},
        {"shadow-cascades", "5"},
        {"shadow-kernel", "5"},
        {"shadow-kernel", "2"},
        {"shadow-kernel", "9"},
        {"shadow-fit", "depth"},
        {"shadow-distance", "10"},
        {"shadow-bias", "1"},
        {"clipmap-pages", "64"},
        {"clipmap-pages", "0"},
        {"clipmap-page-size", "64"},
        {"clipmap-page-size", "100"},
        {"evsm-depth", "0..1"},
        {"evsm-precision", "fp16"},
        {"evsm-exponent", "5.5"},
        {"evsm-negative-exponent", "5"},
        {"evsm-bleed", "0.2"},
        {"evsm-min-variance", "0.1"},
        {"msaa", "2"},
        {"msaa-shading", "sample"},
        {"msaa-edges", "all"},
        {"resolve", "tonemapped"},
        {"alpha-to-coverage", "on"},
        {"spec-aa-variance", "0.5"},
        {"spec-aa-variance", "-1"},
        {"spec-aa-limit", "0.5"},
        {"spec-aa-limit", "1.5"},
        {"spec-aa-normals", "mapped"},
        {"haze-density", "2"},
        {"haze-density", "-1"},
        {"haze-density", "2000000"},
        {"haze-rayleigh", "0,0,0"},
        {"haze-rayleigh", "0,-1,0"},
        {"haze-rayleigh-height", "100"},
        {"haze-rayleigh-height", "0"},
        {"haze-mie", "1,1,1"},
        {"haze-mie", "1,1,2000000"},
        {"haze-mie-height", "10"},
        {"haze-mie-height", "0.001"},
        {"haze-g", "0.5"},
        {"haze-g", "1"},
        {"haze-ground", "1"},
        {"haze-ground", "2000000000"},
        {"haze-march-steps", "8"},
        {"haze-march-steps", "-1"},
        {"haze-march-steps", "257"},
        {"spp", "16"},
        {"reference-mode", "scene"},
    };
    for (const auto& [option, value] : rest) {
        Settings s;
        s.shadows = Shadows::off;
        s.set(option, value);
        const std::string problem = s.problem().value_or("none");
        EXPECT_EQ(problem.find(std::string("--") + option + " " + value), 0u) << problem;
    }
}

TEST(Settings, LightsByObjectAreForwardPlussAlone) {
    Settings s;
    s.assign = Assignment::per_object;
    s.path = Path::forward_plus;
    for (const int lights : {0, 1, 8, 100000}) {
        s.pixel_lights = lights;
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
    s.pixel_lights = -1;
    EXPECT_EQ(s.problem().value_or("none"), "--pixel-lights -1: must be at least 0");
    s.pixel_lights = 4;
    s.path = Path::deferred;
    EXPECT_EQ(
        s.problem().value_or("none"),
        "--assign per_object cannot be used with --path deferred: its G-buffer does not store the object; "
        "use --path forward_plus, or --forward-plus assign=per_object if both paths are rendered");
}

TEST(Settings, TheReferenceHasMoreThanThePaths) {
    Settings s;
    s.path = Path::reference;
    for (const Shadows shadows : {Shadows::pcf, Shadows::evsm, Shadows::clipmap, Shadows::off}) {
        s.shadows = shadows;
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
    s.spp = 4;
    EXPECT_EQ(s.problem().value_or("none"),
              "--spp 4: --reference-mode surface shades one sample; use --reference-mode scene");
    s.reference_mode = ReferenceMode::scene;
    EXPECT_EQ(s.problem().value_or("none"), "none");
    for (const int spp : {0, -1, 65537}) {
        s.spp = spp;
        EXPECT_EQ(s.problem().value_or("none"), fmt::format("--spp {}: must be 1 to 65536", spp));
    }
    s.spp = 1;
    s.path = Path::deferred;
    EXPECT_EQ(s.problem().value_or("none"),
              "--reference-mode scene has no effect without a reference (--path reference, compare: "
              "--baseline reference); use surface");
}

// Cascades and pages each belong to their technique. A clipmap level has at least four pages in a row.
TEST(Settings, AClipmapHasPagesInPlaceOfCascades) {
    Settings s;
    s.shadows = Shadows::clipmap;
    EXPECT_EQ(s.problem().value_or("none"), "none");
    s.clipmap_pages = 1;
    s.clipmap_page_size = 32;
    s.shadow_size = 128;
    s.shadow_kernel = 7;
    EXPECT_EQ(s.problem().value_or("none"), "none");
    s.shadow_size = 127;
    EXPECT_EQ(s.problem().value_or("none"),
              "--clipmap-page-size 32: four pages in a row exceed --shadow-size 127; use --shadow-size 128 "
              "or more");
    s.path = Path::reference;
    EXPECT_EQ(s.problem().value_or("none"), "none") << "which ignores both";
    s.path = Path::deferred;
    s.shadow_size = 200;
    s.clipmap_page_size = 64;
    EXPECT_EQ(s.problem().value_or("none"),
              "--clipmap-page-size 64: four pages in a row exceed --shadow-size 200; use a smaller one");
    s = {};
    s.shadows = Shadows::clipmap;
    s.shadow_cascades = 2;
    EXPECT_EQ(s.problem().value_or("none"),
              "--shadow-cascades 2 has no effect without --shadows pcf, pcss, evsm, evsm4 or msm4; use 4");
    s = {};
    s.shadows = Shadows::pcf;
    s.clipmap_pages = 64;
    EXPECT_EQ(s.problem().value_or("none"),
              "--clipmap-pages 64 has no effect without --shadows clipmap; use 512");
}

// Settings of EVSM moments have no effect with other shadow techniques.
TEST(Settings, MomentsHaveAMeaningWithEvsmAlone) {
    Settings s;
    s.path = Path::reference;
    s.evsm_exponent = 5;
    for (const Shadows shadows : {Shadows::off, Shadows::pcf, Shadows::clipmap}) {
        s.shadows = shadows;
        EXPECT_EQ(s.problem().value_or("none"),
                  "--evsm-exponent 5 has no effect without --shadows evsm or evsm4; use 0");
    }
    s.shadows = Shadows::evsm;
    EXPECT_EQ(s.problem().value_or("none"), "none");
}

// Neither format can represent the second moment of a larger exponent.
TEST(Settings, ExponentsThatTheFormatCannotHoldAreRefusedWithTheLargest) {
    Settings s;
    s.shadows = Shadows::evsm;
    for (const float exponent : {0.0f, 40.0f, 44.36f}) {
        s.evsm_exponent = exponent;
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
    const std::string are =
        "must be 0 to 44.36, or 0 to 5.54 with 16-bit moments; larger squares exceed the format";
    s.evsm_exponent = 44.4f;
    EXPECT_EQ(s.problem().value_or("none"), "--evsm-exponent 44.4: " + are);
    s.evsm_precision = EvsmPrecision::fp16;
    s.evsm_exponent = 5.54f;
    EXPECT_EQ(s.problem().value_or("none"), "none");
    s.evsm_exponent = 5.6f;
    EXPECT_EQ(s.problem().value_or("none"), "--evsm-exponent 5.6: " + are);
}

TEST(Settings, StepsOfDepthAreReadBackAndHaveOneSample) {
    Settings s;
    s.depth_format = DepthFormat::d16;
    for (const Path path : drawn_paths) {
        s.path = path;
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
    s.path = Path::forward_plus;
    s.prepass = Switch::off;
    EXPECT_EQ(s.problem().value_or("none"),
              "--depth-format d16 cannot be used with --prepass off: shading needs the stored depth; use "
              "--prepass on");
    s.depth_format = DepthFormat::d32f_standard;
    EXPECT_EQ(s.problem().value_or("none"), "none");
    for (const char* option : {"depth-format", "lit-format", "shading-precision"}) {
        Settings several;
        several.msaa = 4;
        EXPECT_EQ(several.problem().value_or("none"), "none");
        several.set(option, option == std::string("depth-format") ? "d24" : "fp16");
        EXPECT_NE(several.problem().value_or("none").find("--" + std::string(option)), std::string::npos);
    }
}

TEST(Settings, EveryPathDrawsEveryTime) {
    Settings s;
    s.time = 1.5;
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference}) {
        s.path = path;
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
    s.reference_mode = ReferenceMode::scene;
    EXPECT_EQ(s.problem().value_or("none"), "none");
    for (const double time :
         {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        s.time = time;
        EXPECT_EQ(s.problem().value_or("none"),
                  fmt::format("--time {}: must be finite and at least 0 s", time));
    }
}

TEST(Settings, AnEnvironmentWithoutANameIsNone) {
    Settings s;
    s.env = "";
    EXPECT_EQ(s.problem().value_or("none"), "--env '': is empty; name a file, or use none");
}

TEST(Settings, AnEnvironmentGivesItsIntensityAMeaning) {
    Settings s;
    s.env = "sky.exr";
    for (const float intensity : {0.0f, 0.5f, 1.0f, 1e30f}) {
        s.ibl_intensity = intensity;
        EXPECT_EQ(s.problem().value_or("none"), "none");
    }
    for (const float intensity :
         {-0.5f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        s.ibl_intensity = intensity;
        EXPECT_EQ(s.problem().value_or("none").find("--ibl-intensity "), 0u) << intensity;
    }
}

constexpr const char* tilesNeedDepthsSays =
    "--assign tiled cannot be used with --prepass off: it needs the depths of a tile; use --prepass on";

// A tile's lights depend on its depths: deferred has a G-buffer, forward+ needs a pre-pass. Froxels and
// objects need no depths.
TEST(SettingsProblem, OnlyForwardPlussTilesNeedAPrePass) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        for (const Assignment assign : {Assignment::every, Assignment::tiled, Assignment::clustered})
            for (const Switch prepass : {Switch::automatic, Switch::on, Switch::off}) {
                Settings s;
                s.path = path;
                s.assign = assign;
                s.prepass = prepass;
                const bool wrong =
                    path == Path::forward_plus && assign == Assignment::tiled && prepass == Switch::off;
                EXPECT_EQ(s.problem().value_or("none"), wrong ? tilesNeedDepthsSays : "none")
                    << nameOf(path) << " " << nameOf(assign) << " " << nameOf(prepass);
            }
}

TEST(SettingsProblem, OnlyDeferredKnowsNoObjects) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        for (const Switch prepass : {Switch::automatic, Switch::on, Switch::off}) {
            Settings s;
            s.path = path;
            s.assign = Assignment::per_object;
            s.prepass = prepass;
            EXPECT_EQ(s.problem().has_value(), path == Path::deferred) << nameOf(path);
        }
}

TEST(SettingsProblem, OnlyTheReferenceFollowsLightBetweenMicrofacets) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        for (const auto& [multiscatter, name] : enumNames<Multiscatter>()) {
            Settings s;
            s.path = path;
            s.multiscatter = multiscatter;
            EXPECT_EQ(s.problem().has_value(), path != Path::reference && multiscatter == Multiscatter::walk)
                << nameOf(path) << " " << name;
        }
}

TEST(SettingsProblem, OnlyTheReferenceInModeSceneHasSamples) {
    for (const ReferenceMode mode : {ReferenceMode::surface, ReferenceMode::scene})
        for (const int spp : {1, 2, 65536}) {
            Settings s;
            s.path = Path::reference;
            s.reference_mode = mode;
            s.spp = spp;
            EXPECT_EQ(s.problem().has_value(), mode == ReferenceMode::surface && spp != 1) << spp;
        }
}

}  // namespace
}  // namespace diptych
