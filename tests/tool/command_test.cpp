// SPDX-License-Identifier: MIT
// The built program as users and scripts see it: exit codes, stdout, stderr.
#include "shared/image/exr.h"
#include "shared/image/png.h"
#include "tests/tool/run.h"
#include "tests/tool/sweep.h"

#include <map>
#include <regex>
#include <set>

namespace diptych {
namespace {

// Small and untimed: these tests are about the tool, not the image.
const std::string quick = " --size 48x27 --runs 0";
// For tests that need any scene: the default one takes ten times as long to load and compile.
const std::string quickTriangle = " builtin:triangle" + quick;

// On a busy machine a command may exceed the ten seconds after which a log shows progress.
std::string withoutProgress(const std::string& err) {
    static const std::regex line("diptych: [^\n]* % [^\n]* left\n");
    return std::regex_replace(err, line, "");
}

bool isPng(const fs::path& file) {
    return contentsOf(file).starts_with("\x89PNG\r\n\x1a\n");
}
bool isExr(const fs::path& file) {
    return contentsOf(file).starts_with("\x76\x2f\x31\x01");
}

TEST(Command, UsageErrorsAreOneLineAndExitTwo) {
    const Folder folder;
    EXPECT_TRUE(runTool(folder, "render --debug gloss").failedOver("texcoords"));
    EXPECT_TRUE(runTool(folder, "render --channels lit,gloss").failedOver("texcoords"));
    EXPECT_TRUE(runTool(folder, "diff 'a\nb.png' b.png").failedOver("a?b.png: has a line break in its name"));
}

TEST(Command, WhatHasNoMeaningIsNamedAndExitTwo) {
    const Folder folder;
    for (const std::string command : {"compare ", "render ", "plan "})
        EXPECT_TRUE(runTool(folder, command + "--spec-aa-limit 0.5")
                        .failedOver("--spec-aa-limit 0.5 has no effect without --spec-aa on"));
    EXPECT_TRUE(
        runTool(folder, "render --heat --path reference").failedOver("--heat: light_count: the reference"));
    EXPECT_TRUE(runTool(folder, "diff a.png b.png").failedOver("a.png: no such file"));
}

// Two images of nothing always agree.
TEST(Command, CompareNeedsSomethingToDraw) {
    const Folder folder;
    const auto changed = [](const std::string& from, const std::string& to) {
        std::string text = triangleGltf;
        return text.replace(text.find(from), from.size(), to);
    };
    folder.write("lines.gltf", changed("\"POSITION\": 0 }", "\"POSITION\": 0 }, \"mode\": 1"));
    folder.write("nan.gltf",
                 changed("AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA", std::string(48, '/')));
    folder.write("point.gltf",
                 changed("AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA", std::string(48, 'A')));
    folder.write("flat.gltf", changed("\"mesh\": 0 }", "\"mesh\": 0, \"scale\": [1, 0, 0] }"));
    const std::string compare = "compare" + quick + " --channels lit -o report ";
    for (const char* empty : {"point.gltf", "flat.gltf"})
        EXPECT_TRUE(runTool(folder, compare + empty)
                        .failedOver(std::string(empty) + ": has nothing to draw: no triangle has an area"));
    EXPECT_TRUE(runTool(folder, compare + "lines.gltf")
                    .failedOver("lines.gltf: has nothing to draw: mesh 0, primitive 0: points or lines, left "
                                "out; --allow-empty"));
    EXPECT_EQ(runTool(folder, compare + "lines.gltf --allow-empty -q").code, 0);
    EXPECT_TRUE(runTool(folder, compare + "nan.gltf --allow-empty")
                    .failedOver("nan.gltf: mesh 0, primitive 0: every triangle has a vertex that is not"));
    EXPECT_EQ(runTool(folder, compare + "lines.gltf builtin:triangle -q").code, 2);
    EXPECT_TRUE(fs::exists(folder / "report/index.html")) << "the other is compared";
}

// Both paths read the angle of suns but do not render their discs: the report says so for each.
TEST(Command, DiscsOfSunsAreNoted) {
    const Folder folder;
    folder.write("unlit.gltf", triangleGltf);
    folder.write("lights.json", R"({"lights": [{"type": "rect", "position": [0, 2, 0]},
        {"type": "directional", "angle": 0.0093, "intensity": 2}]})");
    const Image sky(4, 2, 3, 1.0f);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    const std::string options = " unlit.gltf --size 16x9 --runs 0 --prepass on --lights lights.json";
    const Json report = parsed(runTool(folder, "compare --json" + options));
    ASSERT_EQ(report["frames"].size(), 2u);
    for (const Json& frame : report["frames"]) {
        const std::string path = frame["path"];
        EXPECT_NE(
            frame["notes"].dump().find("1 sun disc: not rendered by " + path + " yet; the reference has it"),
            std::string::npos);
        EXPECT_EQ(frame["counters"]["lights"], 2) << "those of the file, and no other";
    }
    // The default sun is not added to a scene with an area light.
    folder.write("rect.json", R"({"lights": [{"type": "rect"}]})");
    const Json lit =
        parsed(runTool(folder, "render -o x.png --json unlit.gltf --size 16x9 --runs 0 --lights rect.json"));
    EXPECT_EQ(lit["frames"][0]["counters"]["lights"], 1);
    const Json plan = parsed(runTool(folder, "plan --json unlit.gltf --lights lights.json --env sky.exr"));
    std::map<std::string, std::string> leftOut;
    for (const Json& line : plan["scenes"][0]["left_out"]) leftOut[line["what"]] = line["why"];
    EXPECT_FALSE(leftOut.contains("area lights"));
    EXPECT_FALSE(leftOut.contains("environment"));
    EXPECT_NE(leftOut["sun discs"].find("only the reference"), std::string::npos) << leftOut["sun discs"];
    EXPECT_EQ(plan["scenes"][0]["lights"], 2);
}

TEST(Command, AnEnvironmentThatCannotBeReadIsNamed) {
    const Folder folder;
    folder.write("sky.exr", "not an EXR");
    for (const std::string command : {"render --path reference ", "plan "}) {
        EXPECT_TRUE(runTool(folder, command + "--env none.exr").failedOver("none.exr: no such file"));
        EXPECT_TRUE(
            runTool(folder, command + "--env sky.exr").failedOver("sky.exr: is not a supported image"));
    }
    EXPECT_FALSE(fs::exists(folder / "diptych-report"));
    EXPECT_FALSE(fs::exists(folder / "diptych-render"));
}

// A glTF file's own environment applies unless another is given.
TEST(Command, AnEnvironmentIsGivenOrTheFiles) {
    const Folder folder;
    const Image sky(4, 2, 3, 1.0f);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    Json cube = Json::parse(triangleGltf);
    writePng(folder / "face.png", {1, 1, 4, {200, 200, 200, 255}});
    cube["images"] = Json::array({{{"uri", "face.png"}}});
    cube["extensions"]["EXT_lights_image_based"]["lights"] =
        Json::array({Json{{"specularImages", Json::array({{0, 0, 0, 0, 0, 0}})}}});
    cube["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    folder.write("cube.gltf", cube.dump());
    const auto told = [&](const std::string& options) {
        return runTool(folder, "plan --size 16x16 cube.gltf " + options);
    };
    EXPECT_NE(told("").out.find("EXT_lights_image_based: light 0: prefiltered maps"), std::string::npos)
        << told("").out;
    EXPECT_EQ(told("--env scene --ibl-intensity 2").code, 0);
    const Ran other = told("--env sky.exr");
    EXPECT_NE(other.out.find("EXT_lights_image_based: light 0: ignored because --env is given"),
              std::string::npos);
    EXPECT_NE(other.out.find("sky.exr: prefiltered maps"), std::string::npos) << other.out;
    EXPECT_TRUE(runTool(folder, "plan builtin:furnace --env scene")
                    .failedOver("--env scene: builtin:furnace has no"));
}

TEST(Command, RenderDrawsAnImageOfEachChannelAskedFor) {
    const Folder folder;
    const auto pngs = [&](const char* in) {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder / in))
            if (isPng(entry.path())) names.insert(entry.path().filename());
        return names;
    };
    using Names = std::set<std::string>;
    EXPECT_EQ(runTool(folder, "render --channels normals,albedo -o a.png" + quickTriangle).code, 0);
    EXPECT_EQ(pngs("."), (Names{"a.albedo.png", "a.normals.png"}));
    EXPECT_EQ(runTool(folder, "render --channels normals -o b.png" + quickTriangle).code, 0);
    EXPECT_TRUE(fs::exists(folder / "b.png")) << "one is the picture itself";
    EXPECT_EQ(runTool(folder, "render --channels normals,albedo -o c" + quickTriangle).code, 0);
    EXPECT_EQ(pngs("c"), (Names{"albedo.png", "normals.png"}));
    EXPECT_EQ(runTool(folder, "render --channels normals --debug depth -o d" + quickTriangle).code, 0);
    EXPECT_EQ(pngs("d"), (Names{"depth.png", "normals.png"}));
    // A foreign file among them is kept.
    folder.write("e.albedo.png", "mine");
    EXPECT_TRUE(runTool(folder, "render --channels normals,albedo -o e.png" + quickTriangle)
                    .failedOver("e.albedo.png"));
    EXPECT_FALSE(fs::exists(folder / "e.normals.png"));
}

TEST(Command, RenderWritesWhatTheEndingSays) {
    const Folder folder;
    EXPECT_EQ(runTool(folder, "render -o a.exr" + quickTriangle).code, 0);
    EXPECT_TRUE(isExr(folder / "a.exr"));
    EXPECT_EQ(runTool(folder, "render --path deferred --debug normals -o b.png" + quickTriangle).code, 0);
    EXPECT_TRUE(isPng(folder / "b.png"));
    EXPECT_TRUE(runTool(folder, "render -o c.jpg" + quickTriangle).failedOver(".jpg"));
    const Ran ran = runTool(folder, "render -o both" + quickTriangle);
    EXPECT_EQ(ran.code, 0) << ran.err;
    int exr = 0, png = 0;
    for (const auto& entry : fs::directory_iterator(folder / "both")) {
        exr += isExr(entry.path());
        png += isPng(entry.path());
    }
    EXPECT_EQ(exr, 1);
    EXPECT_EQ(png, 1);
    for (const std::string own : {"a.exr", "b.png", "both"})
        EXPECT_EQ(runTool(folder, "render -o " + own + quickTriangle).code, 0)
            << own << " is our own and is replaced";
}

TEST(Command, AnothersFilesAreLeftAloneWithoutForce) {
    const Folder folder;
    folder.write("theirs.exr", "not ours");
    EXPECT_TRUE(runTool(folder, "render -o theirs.exr" + quickTriangle).failedOver("--force"));
    EXPECT_EQ(contentsOf(folder / "theirs.exr"), "not ours");
    EXPECT_EQ(runTool(folder, "render --force -o theirs.exr" + quickTriangle).code, 0);
    EXPECT_TRUE(isExr(folder / "theirs.exr"));
}

TEST(Command, AChannelThatDeferredCannotMakeNamesThePathThatCan) {
    const Folder folder;
    EXPECT_TRUE(runTool(folder, "render --path deferred --debug texcoords" + quickTriangle)
                    .failedOver("forward_plus"));
    EXPECT_TRUE(runTool(folder, "render --path deferred --channels lit,9" + quickTriangle)
                    .failedOver("forward_plus"));
    EXPECT_EQ(runTool(folder, "render --path deferred -o a.exr" + quickTriangle).code, 0);
    EXPECT_EQ(runTool(folder, "render --path forward_plus --debug texcoords -o b.png" + quickTriangle).code,
              0);
}

TEST(Command, CompareLeavesAReportWhoseVerdictIsTheExitCode) {
    const Folder folder;
    const Ran ran = runTool(folder, "compare --json" + quickTriangle);
    ASSERT_TRUE(ran.code == 0 || ran.code == 1) << ran.err;
    const Json report = parsed(ran);
    EXPECT_EQ(report["verdict"], ran.code == 0 ? "pass" : "fail");
    EXPECT_EQ(report["frames"].size(), 2u);
    EXPECT_EQ(report["comparisons"].size(), 1u);
    EXPECT_EQ(report["frames"][0]["settings"]["size"], Json({48, 27}));
    for (const char* file : {"index.html", "report.json", "junit.xml", "deferred.exr", "forward_plus.exr"})
        EXPECT_TRUE(fs::exists(folder / ("diptych-report/" + std::string(file)))) << file;
    EXPECT_EQ(runTool(folder, "compare -q" + quickTriangle).code, ran.code) << "our own report is replaced";
}

// Both paths shade the same surfaces: parity holds for every encoding on the built-in scene.
TEST(Command, CompareHoldsParityOnTheGallery) {
    const Folder folder;
    const Ran gallery = runTool(folder, "compare" + quick);
    EXPECT_EQ(gallery.code, 0) << gallery.out << gallery.err;
    EXPECT_EQ(withoutProgress(gallery.err), "");
    for (const std::string gbuffer : {"compact", "standard", "full"}) {
        const Ran ran = runTool(folder, "compare --gbuffer " + gbuffer + quickTriangle);
        EXPECT_EQ(ran.code, 0) << gbuffer << "\n" << ran.out << ran.err;
        EXPECT_EQ(withoutProgress(ran.err), "");
    }
}

TEST(Command, SettingsOfAReportReproduceIt) {
    const Folder folder;
    const Json first =
        parsed(runTool(folder, "render --json --seed 3 --lights point:2 -o a.exr" + quickTriangle));
    const Json settings = first["frames"][0]["settings"];
    folder.write("settings.json", settings.dump());
    const Json second =
        parsed(runTool(folder, "render builtin:triangle --json --runs 0 --settings settings.json -o b.exr"));
    EXPECT_EQ(second["frames"][0]["settings"], settings);
    EXPECT_EQ(settings["seed"], 3);
}

TEST(Command, SeveralScenesAndCamerasMakeOneReport) {
    const Folder folder;
    folder.write("triangle.gltf", triangleGltf);
    const Ran ran = runTool(folder,
                            "compare --json builtin:points triangle.gltf --camera 'eye=2,1,3 target=0,0,0' "
                            "--camera 'eye=3,1,2 target=0,0,0'" +
                                quick);
    ASSERT_TRUE(ran.code == 0 || ran.code == 1) << ran.err;
    const Json report = parsed(ran);
    EXPECT_EQ(report["frames"].size(), 8u);
    EXPECT_EQ(report["comparisons"].size(), 4u);
    EXPECT_TRUE(ran.out == contentsOf(folder / "diptych-report/report.json")) << "byte for byte";
}

TEST(Command, SeveralFramesGetAFolderEach) {
    const Folder folder;
    const std::string two =
        "render builtin:triangle --camera 'eye=2,1,3 target=0,0,0' --camera 'eye=3,1,2 target=0,0,0'";
    EXPECT_TRUE(runTool(folder, two + " -o a.exr" + quick).failedOver("several"));
    for (int run = 0; run < 2; ++run) EXPECT_EQ(runTool(folder, two + " -o all" + quick).code, 0);
    EXPECT_TRUE(isExr(folder / "all/1/forward_plus.exr") && isExr(folder / "all/2/forward_plus.exr"));
    EXPECT_EQ(Json::parse(contentsOf(folder / "all/frames.json"))["frames"].size(), 2u);
}

// Its own folder takes any number of Frames; outdated files of an earlier render are removed.
TEST(Command, RenderReplacesItsOwnFolderWhateverItHeld) {
    const Folder folder;
    const auto render = [&](int frames) {
        std::string command = "render builtin:triangle -q -o all" + quick;
        for (int i = 0; i < frames; ++i)
            command += " --camera 'eye=" + std::to_string(i + 1) + ",1,3 target=0,0,0'";
        const Ran ran = runTool(folder, command);
        EXPECT_EQ(ran.code, 0) << frames << ": " << ran.err;
    };
    const auto there = [&](const char* file) { return fs::exists(folder / ("all/" + std::string(file))); };
    render(3);
    folder.write("all/mine.txt", "keep");
    folder.write("all/3/mine.txt", "keep");
    render(2);
    EXPECT_TRUE(there("2/frame.json"));
    EXPECT_FALSE(there("3/frame.json") || there("3/forward_plus.exr"));
    EXPECT_TRUE(there("3/mine.txt")) << "another's file in a folder of ours";
    render(1);
    EXPECT_TRUE(there("frame.json"));
    EXPECT_FALSE(there("1") || there("2") || there("frames.json"));
    render(2);
    EXPECT_TRUE(there("1/frame.json") && there("frames.json"));
    EXPECT_FALSE(there("frame.json") || there("forward_plus.exr"));
    EXPECT_TRUE(there("mine.txt"));
    // 3/ now contains a foreign file, which is reported before rendering.
    EXPECT_TRUE(runTool(folder, "render builtin:triangle builtin:triangle builtin:triangle -o all" + quick)
                    .failedOver("all/3"));
    EXPECT_FALSE(there("3/frame.json"));
}

// material_id identifies the background, which every mean excludes, so it is always compared.
TEST(Command, CompareKnowsTheBackgroundWhateverChannelsAreAskedFor) {
    const Folder folder;
    const Json report = parsed(runTool(folder, "compare builtin:triangle --json --channels albedo" + quick));
    const Json all = parsed(runTool(folder, "compare builtin:triangle --json" + quick));
    const auto albedo = [](const Json& r) {
        for (const Json& channel : r["comparisons"][0]["channels"])
            if (channel["name"] == "albedo") return channel["mean"];
        return Json();
    };
    EXPECT_FALSE(albedo(all).is_null());
    EXPECT_EQ(albedo(report), albedo(all));
}

TEST(Command, ScenesAreFoundFromTheCallersFolder) {
    const Folder folder;
    folder.write("scenes/triangle.gltf", triangleGltf);
    EXPECT_EQ(runTool(folder, "render scenes/triangle.gltf -o a.png" + quick).code, 0);
    const Ran inside =
        runShell(folder, "'" DIPTYCH_PROGRAM "' render triangle.gltf -o ../b.png" + quick, folder / "scenes");
    EXPECT_EQ(inside.code, 0) << inside.err;
    EXPECT_EQ(contentsOf(folder / "a.png"), contentsOf(folder / "b.png"));
}

TEST(Command, ListScenesNamesTheGallery) {
    const Folder folder;
    const Ran ran = runTool(folder, "render --list-scenes");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("builtin:gallery"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.err, "");
}

TEST(Command, ValidationHasNothingToSay) {
    const Folder folder;
    const Ran ran = runTool(folder, "compare builtin:points --validate --lights point:3,spot:2" + quick);
    EXPECT_TRUE(ran.code == 0 || ran.code == 1) << ran.err;
}

TEST(Command, QuietPrintsNothing) {
    const Folder folder;
    const Ran ran = runTool(folder, "render -q -o a.png" + quickTriangle);
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out + ran.err, "");
}

}  // namespace
}  // namespace diptych
