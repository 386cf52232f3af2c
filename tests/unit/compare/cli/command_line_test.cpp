// SPDX-License-Identifier: MIT
#include "compare/cli/command_line.h"
#include "compare/bench/cases.h"
#include "compare/choose/search.h"
#include "compare/cli/command_diff.h"
#include "compare/cli/command_view.h"
#include "tests/support/command_lines.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

namespace diptych {

using namespace cli;

namespace {

std::string whatIsThrown(const std::vector<std::string>& words) {
    return faultOf([&] { parseCommandLine(words); });
}

const std::vector<std::string> rendering{"compare", "render", "plan"};

TEST(CommandLine, WithoutWordsTheGalleryIsMeant) {
    EXPECT_EQ(parseCommandLine({"compare"}).command.name, "compare");
    const auto options = parsedAs<CompareLine>({"compare"});
    EXPECT_EQ(options.scenes, std::vector<std::string>{"builtin:gallery"});
    EXPECT_EQ(options.cameras, std::vector<std::string>{""});
    EXPECT_EQ(options.settings, Settings());
    EXPECT_EQ(options.baseline, Path::deferred);
    EXPECT_TRUE(options.channels.empty());
    EXPECT_TRUE(options.out.empty());
}

// Options other than Settings.
TEST(CommandLine, TheOtherSharedOptionsParse) {
    for (const std::string& command : rendering) {
        const auto options = parsedAs<SceneGroup>(
            {command,        "a.glb",    "--debug",  "normals",    "--channels", "2,lit,albedo,2",
             "--frames",     "1",        "--fps",    "25",         "--ev100",    "-2.5",
             "--no-tonemap", "--device", "llvmpipe", "--validate", "-o",         "out",
             "--force",      "--json",   "-v",       "--runs",     "3"});
        EXPECT_EQ(options.scenes, std::vector<std::string>{"a.glb"});
        EXPECT_EQ(options.shown, Channel::normals);
        EXPECT_EQ(options.channels, (std::vector{Channel::lit, Channel::albedo, Channel::normals}));
        EXPECT_EQ(options.image.ev100, -2.5);
        EXPECT_FALSE(options.image.tonemap);
        EXPECT_EQ(options.device, "llvmpipe");
        EXPECT_TRUE(options.validate && options.force && options.json && options.verbose);
        EXPECT_EQ(options.out, "out");
        EXPECT_EQ(options.runs, 3);
        EXPECT_TRUE(parsedAs<OutputGroup>({command, "-q", "--exposure", "2"}).quiet);
    }
}

// Several times give several Frames per camera; without --times there is one, at --time.
TEST(CommandLine, TimesAndFrames) {
    EXPECT_EQ(parsedAs<SettingsGroup>({"compare"}).times, std::vector{0.0});
    EXPECT_EQ(parsedAs<SettingsGroup>({"compare", "--time", "0.75"}).times, std::vector{0.75});
    const auto several = parsedAs<SettingsGroup>({"compare", "--times", "0.5,0,1e6", "--camera", "a"});
    EXPECT_EQ(several.times, (std::vector{0.5, 0.0, 1e6}));
    EXPECT_EQ(several.settings.time, 0.5) << "the first";
    const auto drawn = parsedAs<SettingsGroup>({"render", "--frames", "4", "--fps", "8", "--time", "1"});
    EXPECT_EQ(drawn.frames, 4);
    EXPECT_EQ(timeOfFrame(drawn, 0), 1);
    EXPECT_EQ(timeOfFrame(drawn, 3), 1.375);
}

// The last accepted values; values beyond are among the usage errors.
TEST(CommandLine, LimitsAreTaken) {
    EXPECT_EQ(parsedAs<SceneGroup>({"compare", "--runs", "0"}).runs, 0) << "no times, no profile";
    EXPECT_EQ(parsedAs<DiffLine>({"diff", "a", "b", "--tolerance", "0"}).diff.tolerance, 0);
    EXPECT_EQ(parsedAs<ImageGroup>({"compare", "--ev100", "0"}).image.ev100, 0);
    EXPECT_EQ(parsedAs<ImageGroup>({"compare", "--exposure", "1e-30"}).image.exposure, 1e-30);
    EXPECT_EQ(parsedAs<bench::BenchOptions>({"bench", "--max-ms", "1e-3"}).max_ms, 1e-3);
}

TEST(CommandLine, AMistypedWordIsFollowedByTheOneThatWasMeant) {
    const std::pair<std::vector<std::string>, const char*> mistyped[] = {
        {{"compar"}, "; did you mean compare?"},
        {{"compare", "--siez", "4x4"}, "; did you mean --size?"},
        {{"diff", "a", "b", "--metrik=rmse"}, "; did you mean --metric?"},
        {{"render", "--debug", "albdeo"}, "; did you mean albedo?"},
        {{"compare", "--tolerance=3"}, "; did you mean --tolerances?"},
        {{"render", "--channels", "lit,normal"}, "; did you mean normals?"},
        {{"render", "--gbuffer", "comapct"}, "; did you mean compact?"},
        {{"compare", "--assign", "tile"}, "; did you mean tiled?"},
        {{"compare", "--baseline", "defered"}, "; did you mean deferred?"},
    };
    for (const auto& [words, meant] : mistyped) {
        const std::string what = whatIsThrown(words);
        EXPECT_NE(what.find(meant), std::string::npos) << what;
    }
    EXPECT_EQ(whatIsThrown({"compare", "--paint"}).find("did you mean"), std::string::npos);
    EXPECT_EQ(whatIsThrown({"compare", "--size", "WxxH"}).find("did you mean"), std::string::npos)
        << "no word of a list";
    EXPECT_EQ(whatIsThrown({"compare", "--color", "maybe"}), "--color maybe: takes auto, on or off");
}

TEST(CommandLine, WhatIsShownIsLitUnlessAChannelOrTheHeatIsAskedFor) {
    const auto shown = [](std::vector<std::string> words) {
        words.insert(words.begin(), "render");
        return parsedAs<ImageGroup>(words).shown;
    };
    EXPECT_EQ(shown({}), Channel::lit);
    EXPECT_EQ(shown({"--debug", "depth"}), Channel::depth);
    EXPECT_EQ(shown({"--heat"}), Channel::light_count);
    EXPECT_EQ(shown({"--heat=true"}), Channel::light_count);
    EXPECT_EQ(shown({"--heat", "on"}), Channel::light_count);
    EXPECT_EQ(shown({"--heat", "off"}), Channel::lit);
    EXPECT_TRUE(parsedAs<ImageGroup>({"render", "--debug", "lit"}).debug_requested);
    EXPECT_FALSE(parsedAs<ImageGroup>({"render", "--heat"}).debug_requested);
    EXPECT_TRUE(parsedAs<SettingsGroup>({"render", "--path", "deferred"}).path_requested);
    EXPECT_FALSE(parsedAs<SettingsGroup>({"render", "--seed", "1"}).path_requested);
}

TEST(CommandLine, DevicesParsesWhatAllCommandsShare) {
    const auto options = parsedAs<SceneGroup>(
        {"devices", "--size", "3x3", "--device", "0", "--validate", "--debug", "1", "--env", "none", "-q"});
    EXPECT_EQ(options.device, "0");
    EXPECT_TRUE(options.validate);
    EXPECT_EQ(options.settings.size, (Size{3, 3}));
}

TEST(CommandLine, DevicesMayBeProbed) {
    EXPECT_NO_THROW(parseCommandLine({"devices", "--probe"}));
    EXPECT_NE(parseCommandLine({"devices", "--help"}).help.find("--probe"), std::string::npos);
}

TEST(CommandLine, OffAndNoneAlwaysWork) {
    for (const std::string word : {"off", "none"}) {
        const auto options = parsedAs<SceneGroup>({"render", "--env", word, "--shadows", word, "--haze", word,
                                                   "--lights", word, "--heat", word, "--heat=" + word,
                                                   "a.glb", "--msaa", "1", "--spp", "1"});
        Settings unshadowed;
        unshadowed.shadows = Shadows::off;
        EXPECT_EQ(options.settings, unshadowed);
        EXPECT_EQ(options.scenes, std::vector<std::string>{"a.glb"});
    }
}

TEST(CommandLine, SeveralScenesAndCameras) {
    const auto options = parsedAs<SceneGroup>({"compare", "a.glb", "--camera", "1", "b.glb",
                                               "--camera=eye=1,2,3 target=0,0,0", "--size", "8x4", "c.glb"});
    EXPECT_EQ(options.scenes, (std::vector<std::string>{"a.glb", "b.glb", "c.glb"}));
    EXPECT_EQ(options.cameras, (std::vector<std::string>{"1", "eye=1,2,3 target=0,0,0"}));
    EXPECT_EQ(options.settings.camera, "1");
}

TEST(CommandLine, ASettingsFileComesFirstWhereverItStands) {
    const std::filesystem::path file = folder() / "settings.json";
    std::ofstream(file) << R"({"seed": 7, "size": [8, 4], "path": "deferred", "camera": "2"})";
    const auto options = parsedAs<SettingsGroup>({"render", "--size", "3x2", "--settings", file.string()});
    EXPECT_EQ(options.settings.size, (Size{3, 2}));
    EXPECT_EQ(options.settings.seed, 7u);
    EXPECT_EQ(options.settings.path, Path::deferred);
    EXPECT_FALSE(options.path_requested);
    EXPECT_EQ(options.cameras, std::vector<std::string>{"2"});

    std::ofstream(file) << R"({"sed": 7})";
    const std::string what = whatIsThrown({"render", "--settings", file.string()});
    EXPECT_NE(what.find("sed"), std::string::npos) << what;
    EXPECT_NE(what.find(file.string()), std::string::npos) << what;
}

// view accepts the words of any compare command.
TEST(CommandLine, ViewUnderstandsTheWordsOfAnyCompare) {
    const std::vector<std::string> words{
        "compare", "a.glb",     "--gbuffer", "compact", "--baseline", "reference", "--camera", "1",  "--runs",
        "0",       "--explain", "--crop",    "0,0,8x8", "--pixel",    "3,4",       "--strict", "-o", "x"};
    std::vector<std::string> viewed = words;
    viewed.front() = "view";
    const auto compared = parsedAs<CompareLine>(words);
    const auto seen = parsedAs<ViewLine>(viewed);
    EXPECT_EQ(seen.settings, compared.settings);
    EXPECT_EQ(seen.baseline, Path::reference);
    EXPECT_EQ(seen.pixel->y, 4);
    EXPECT_FALSE(seen.watch);
    const auto more = parsedAs<ViewLine>({"view", "--report", "diptych-report", "--watch"});
    EXPECT_EQ(more.report, "diptych-report");
    EXPECT_TRUE(more.watch);
    EXPECT_FALSE(more.scene_requested);
}

TEST(CommandLine, WhatIsAudited) {
    const auto o =
        parsedAs<SceneGroup>({"audit", "a.glb", "--quantity", "near,fov", "--require", "near=1e6,fov=0.1"});
    EXPECT_FALSE(o.size_requested);
    EXPECT_FALSE(o.shadows_requested);
    const auto requested = parsedAs<SettingsGroup>({"audit", "--size", "64x36", "--shadows", "off"});
    EXPECT_TRUE(requested.size_requested);
    EXPECT_TRUE(requested.shadows_requested);
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{"audit", "--quantity", "ofset"}, "did you mean offset"},
        {{"audit", "--require", "ofset=1"}, "--require ofset: there is no such quantity"},
        {{"audit", "--require", "offset"}, "takes NAME=MAGNITUDE"},
        {{"audit", "--require", "offset=far"}, "takes NAME=MAGNITUDE"},
        {{"audit", "--require", "offset=1e3m"}, "takes NAME=MAGNITUDE"},
        {{"audit", "--require", "offset=-1"}, "takes NAME=MAGNITUDE"},
    };
    for (const auto& [words, name] : wrong) {
        const std::string what = whatIsThrown(words);
        EXPECT_NE(what.find(name), std::string::npos) << what;
    }
}

TEST(CommandLine, WhatIsChosenFor) {
    const auto o =
        parsedAs<choose::Budget>({"choose", "a.glb", "--max-error", "0.1", "--max-bytes", "1.5MiB"});
    EXPECT_EQ(o.error, 0.1);
    EXPECT_EQ(o.bytes, 1572864u);
    EXPECT_FALSE(o.ms);
    EXPECT_EQ(parsedAs<choose::Budget>({"choose", "--max-bytes", "1000"}).bytes, 1000u);
    for (const char* wrong : {"5MB", "-1", "MiB", "0"})
        EXPECT_NE(whatIsThrown({"choose", "--max-bytes", wrong}).find("--max-bytes"), std::string::npos);
}

TEST(CommandLine, WhatDiffCompares) {
    std::istringstream words(
        "diff a.exr b.exr --metric rmse --tolerance 0.1 --ppd 60 --channels lit,normal* --map "
        "albedo=d.R,d.G,d.B --map ao=x.Y --mask m.png --ids 3,5 --ignore-edges 2 --crop 1,2,30x40 --shift 1 "
        "--blur 0.5 --warn 0.05 --exposures 4 --start-exposure -2 --stop-exposure 3 --tolerances t.json -o d "
        "--json");
    const auto o = parsedAs<DiffLine>({std::istream_iterator<std::string>(words), {}});
    EXPECT_EQ(o.images, (std::vector<std::string>{"a.exr", "b.exr"}));
    EXPECT_EQ(o.diff.metric, "rmse");
    EXPECT_EQ(o.diff.tolerance, 0.1);
    EXPECT_EQ(o.diff.warn, 0.05);
    EXPECT_EQ(o.diff.flip.pixels_per_degree, 60);
    EXPECT_EQ(o.diff.flip.exposures, 4);
    EXPECT_EQ(o.diff.flip.start_exposure, -2);
    EXPECT_EQ(o.diff.flip.stop_exposure, 3);
    EXPECT_EQ(o.diff.channels, (std::vector<std::string>{"lit", "normal*"}));
    EXPECT_EQ(o.diff.names, (std::vector<std::string>{"albedo=d.R,d.G,d.B", "ao=x.Y"}));
    EXPECT_EQ(o.diff.selection.mask, "m.png");
    EXPECT_EQ(o.diff.selection.ids, (std::vector<int>{3, 5}));
    EXPECT_EQ(o.diff.selection.ignore_edges, 2);
    ASSERT_TRUE(o.diff.selection.crop);
    EXPECT_EQ(o.diff.selection.crop->height, 40);
    EXPECT_EQ(o.diff.shift, 1);
    EXPECT_EQ(o.diff.blur, 0.5);
    EXPECT_EQ(o.tolerances, "t.json");
}

// Without a tolerance only identical images pass, whether larger or smaller metric values are better.
TEST(CommandLine, TheUsualToleranceOfDiffIsIdentity) {
    const auto toleranceOf = [](const char* metric) {
        return parsedAs<DiffLine>({"diff", "a", "b", "--metric", metric}).diff.tolerance;
    };
    EXPECT_EQ(parsedAs<DiffLine>({"diff", "a", "b"}).diff.metric, "flip");
    EXPECT_EQ(toleranceOf("flip"), 0);
    EXPECT_EQ(toleranceOf("relative"), 0);
    EXPECT_EQ(toleranceOf("ssim"), 1);
    EXPECT_EQ(toleranceOf("psnr"), std::numeric_limits<double>::infinity());
    EXPECT_FALSE(parsedAs<DiffLine>({"diff", "a", "b"}).diff.tolerance_requested);
    EXPECT_FALSE(parsedAs<DiffLine>({"diff", "a", "b"}).diff.metric_requested);
    const auto requested =
        parsedAs<DiffLine>({"diff", "a", "b", "--metric", "ssim", "--tolerance", "-0.5"}).diff;
    EXPECT_EQ(requested.tolerance, -0.5) << "of pictures that are each other's negatives";
    EXPECT_TRUE(requested.tolerance_requested && requested.metric_requested);
}

TEST(CommandLine, ABaselineIsAPathOrAFile) {
    EXPECT_EQ(parsedAs<CompareLine>({"compare", "--baseline", "forward_plus"}).baseline, Path::forward_plus);
    const auto o =
        parsedAs<CompareLine>({"compare", "--baseline", "left.exr", "--update-baseline", "--allow-noise"});
    EXPECT_EQ(o.baseline_file, "left.exr");
    EXPECT_TRUE(o.update_baseline && o.allow_noise);
    EXPECT_EQ(whatIsThrown({"compare", "--update-baseline"}),
              "--update-baseline: needs --baseline FILE.exr (without ?part=), the file to replace");
    EXPECT_EQ(whatIsThrown({"compare", "--baseline", "left"}),
              "--baseline left: is not deferred, forward_plus, reference or an .exr file");
}

TEST(CommandLine, UsageErrorsAreOneLineAndNameTheWord) {
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{}, "--help"},
        {{"diff", "a.exr"}, "images"},
        {{"diff", "a", "b", "--metric", "flop"}, "--metric flop"},
        {{"diff", "a", "b", "--tolerance", "-1"}, "--tolerance -1"},
        {{"diff", "a", "b", "--failing", "0.1"}, "--tolerance"},
        {{"diff", "a", "b", "--failing", "2", "--tolerance", "1"}, "--failing"},
        {{"diff", "a", "b", "--crop", "1,2,3"}, "--crop 1,2,3"},
        {{"diff", "a", "b", "--crop", "1,2,0x4"}, "--crop 1,2,0x4"},
        {{"paint"}, "paint"},
        {{"--paint"}, "--help"},
        {{"compare", "--paint"}, "--paint"},
        {{"compare", "--size"}, "--size"},
        {{"compare", "--gbuffer", "huge"}, "--gbuffer huge"},
        {{"compare", "--size", "1x1", "--size", "2x2", "--size", "3x3"},
         "--size: given 3 times; once is enough"},
        {{"compare", "--runs", "x"}, "--runs"},
        {{"compare", "--runs", "-1"}, "--runs -1"},
        {{"compare", "--exposure", "1", "--ev100", "1"}, "--ev100"},
        {{"compare", "--exposure", "0"}, "--exposure 0"},
        {{"compare", "--exposure", "0x10"}, "--exposure: 0x10 is not a decimal number"},
        {{"compare", "--ev100", "0x1p3"}, "--ev100: 0x1p3 is not a decimal number"},
        {{"compare", "--runs", "0x5"}, "--runs: 0x5 is not a decimal number"},
        {{"diff", "a", "b", "--tolerance", "0x1"}, "--tolerance: 0x1 is not a decimal number"},
        {{"diff", "a", "b", "--ppd", "-0X1.8p3"}, "--ppd: -0X1.8p3 is not a decimal number"},
        {{"choose", "--max-bytes", "0x10MiB"}, "--max-bytes 0x10MiB"},
        {{"choose", "--max-bytes", "infKiB"}, "--max-bytes infKiB"},
        {{"audit", "--require", "offset=0x10"}, "--require offset=0x10"},
        {{"audit", "--require", "offset=inf"}, "--require offset=inf"},
        {{"audit", "--require", "offset="}, "--require offset="},
        {{"audit", "--require", "offset"}, "--require offset"},
        {{"compare", "-o", ""}, "--out: \"\" names no folder or file"},
        {{"compare", "a\nb.glb"}, "a?b.glb: has a line break in its name"},
        {{"compare", "--exposure", "inf"}, "--exposure inf"},
        {{"compare", "--ev100", "inf"}, "--ev100"},
        {{"compare", "--fps", "0"}, "--fps 0"},
        {{"compare", "--fps", "inf"}, "--fps inf"},
        {{"compare", "--frames", "0"}, "--frames 0: must be 1 or more"},
        {{"compare", "--frames", "2"}, "--frames 2: only render takes it; compare takes --times"},
        {{"plan", "--frames", "2"}, "--frames 2: only render takes it"},
        {{"render", "--fps", "-24"}, "--fps -24: must be above 0"},
        {{"render", "--fps", "nan"}, "--fps nan: must be above 0"},
        {{"render", "--frames", "-3"}, "--frames -3: must be 1 or more"},
        {{"render", "--frames", "2.5"}, "--frames"},
        {{"render", "--frames", "3", "--fps", "1e-310"},
         "--fps 1e-310: the time of the last of 3 frames is not finite"},
        {{"compare", "--times", "0,1", "--time", "2"}, "--time"},
        {{"compare", "--times", "0,one"}, "--times 0,one: \"one\" is not a time"},
        {{"compare", "--times", "0,1,"}, "--times 0,1,: \"\" is not a time"},
        {{"compare", "--times", ""}, "--times : \"\" is not a time"},
        {{"compare", "--times", "0.5,1,0.50"}, "--times 0.5,1,0.50: 0.50 is given twice"},
        {{"render", "--fps", "24"}, "--fps 24: needs --frames N"},
        {{"compare", "--times", "0,-1"}, "--times 0,-1: each time must be finite and at least 0 s"},
        {{"compare", "--times", "inf"}, "--times inf: \"inf\" is not a time"},
        {{"render", "--times", "0,1"}, "--times"},
        {{"diff", "a", "b", "--blur", "inf"}, "--blur"},
        {{"diff", "a", "b", "--tolerance", "nan"}, "--tolerance nan"},
        {{"diff", "a", "b", "--failing", "0.1", "--tolerance", "1", "--metric", "rmse"}, "--metric"},
        {{"compare", "--debug", "lits"}, "--debug lits"},
        {{"compare", "--channels", "lit,99"}, "--channels 99"},
        {{"compare", "--settings", "no/such/file.json"}, "no/such/file.json"},
        {{"compare", "--settings", "/"}, "folder"},
        {{"compare", "-q", "-v"}, "--verbose"},
        {{"compare", "--keep", "some"}, "--keep some: takes all, failing or none"},
        {{"compare", "--twice", "some"}, "--twice some: takes all, lit or none"},
        {{"devices", "scene.glb"}, "scene.glb"},
    };
    for (const auto& [words, name] : wrong) {
        const std::string what = whatIsThrown(words);
        EXPECT_NE(what.find(name), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
}

TEST(CommandLine, APixelIsTwoNumbersFromTheTopLeft) {
    const auto options = parsedAs<CompareLine>({"compare", "--pixel", "3,40"});
    ASSERT_TRUE(options.pixel);
    EXPECT_EQ(options.pixel->x, 3);
    EXPECT_EQ(options.pixel->y, 40);
    EXPECT_FALSE(parsedAs<CompareLine>({"compare"}).pixel);
    for (const std::string wrong :
         {"3", "3,", ",4", "3,4,5", "3;4", "3.5,4", "a,b", "3, 4", "-1,4", "3,-4", "99999999999,0"})
        EXPECT_EQ(whatIsThrown({"compare", "--pixel=" + wrong}),
                  "--pixel " + wrong + ": takes X,Y in pixels from the top left, for example 320,180");
    EXPECT_NE(parseCommandLine({"compare", "--help", "all"}).help.find("--pixel X,Y"), std::string::npos);
}

TEST(CommandLine, AnUnknownChannelListsThoseThatThereAre) {
    const std::string what = whatIsThrown({"render", "--channels", "gloss"});
    for (const DebugMode& mode : debugModes())
        EXPECT_NE(what.find(std::to_string(channelIndex(mode.channel)) + " " + std::string(mode.name)),
                  std::string::npos)
            << what;
}

TEST(CommandLine, OneWayToSayTheExposure) {
    EXPECT_EQ(parsedAs<ImageGroup>({"compare", "--match-exposure", "a.exr"}).match_exposure, "a.exr");
    EXPECT_NE(whatIsThrown({"compare", "--match-exposure", "a.exr", "--exposure", "2"}), "");
    EXPECT_NE(whatIsThrown({"compare", "--match-exposure", "a.exr", "--ev100", "2"}), "");
}

}  // namespace
}  // namespace diptych
