// SPDX-License-Identifier: MIT
// Folders of several scenes and cameras, the files that are kept, and a report's memory.
#include "compare/report/folders.h"
#include "compare/files/diptych_files.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// A scene, a camera and a time, s; roughness differs if it fails.
struct Asked {
    std::string scene, camera{};
    bool fails = false;
    double time = 0;
};

const std::set<Channel> threeChannels{Channel::roughness, Channel::metallic, Channel::material_id};

Report askedFor(const std::vector<Asked>& all) {
    std::vector<Frame> frames;
    for (const Asked& asked : all) {
        std::vector<Frame> pair = withOnly(threeChannels, bothFrames(asked.scene));
        for (Frame& frame : pair) {
            frame.settings.camera = asked.camera;
            frame.settings.time = asked.time;
        }
        if (asked.fails) pair[1].channels[Channel::roughness].at(1, 2) = 0.75f;
        std::ranges::move(pair, std::back_inserter(frames));
    }
    return reportOf(std::move(frames));
}

// Key: scene and camera. Value: folder.
std::map<std::string, std::string> foldersBy(const std::vector<Asked>& all) {
    const Report report = askedFor(all);
    const std::vector<std::string> names = reportFolders(report).comparisons;
    std::map<std::string, std::string> folders;
    for (std::size_t i = 0; i < names.size(); ++i) folders[all[i].scene + " " + all[i].camera] = names[i];
    return folders;
}

TEST(ReportFolders, ANameDependsOnItsSceneAlone) {
    EXPECT_EQ(nameOfFolder("gallery", "gallery"), "gallery");
    EXPECT_EQ(nameOfFolder("Box", "scenes/Box.glb"), "Box-0e518f");
    EXPECT_EQ(nameOfFolder("a/../b c", "a/../b c").substr(0, 6), "a-b-c-");
    EXPECT_EQ(nameOfFolder("\xc3\xa4", "\xc3\xa4").size(), 6u) << "no letter is left: digits alone";
    EXPECT_EQ(nameOfFolder(std::string(300, 'x'), std::string(300, 'x')).size(), 47u);
    for (const char* text : {"..", ".hidden", "-o", "a/b", " ", "builtin:x?y=1"})
        EXPECT_TRUE(isDiptychFileName(fs::path(nameOfFolder(text, text)) / "lit.png")) << text;
}

TEST(ReportFolders, AnotherSceneChangesNoName) {
    const std::vector<Asked> two{{"x/Box.glb"}, {"builtin:gallery", "entrance"}};
    const auto before = foldersBy(two);
    EXPECT_EQ(before.at("builtin:gallery entrance"), "gallery/entrance/");
    for (const Asked& added :
         std::vector<Asked>{{"A.glb"}, {"y/Box.glb"}, {"x/Box.gltf"}, {"builtin:gallery"}})
        for (const std::size_t index : {0, 1, 2}) {
            std::vector<Asked> three = two;
            three.insert(three.begin() + static_cast<std::ptrdiff_t>(index), added);
            const auto after = foldersBy(three);
            std::set<std::string> names;
            for (const auto& [key, name] : after) names.insert(name);
            EXPECT_EQ(names.size(), 3u) << added.scene << " has a folder of its own";
            for (const auto& [key, name] : before) EXPECT_EQ(after.at(key), name) << added.scene << index;
        }
    EXPECT_EQ(foldersBy({{"./x/Box.glb"}, {"A.glb"}}).at("./x/Box.glb "), before.at("x/Box.glb "))
        << "however its path is written";
}

TEST(ReportFolders, WhatIsAskedForTwiceHasTwo) {
    const Report report = askedFor({{"a.glb"}, {"a.glb"}, {"a.glb", "0"}, {"a.glb", "0"}});
    const ReportFolders folders = reportFolders(report);
    const std::string scene = nameOfFolder("a", "a.glb");
    EXPECT_EQ(folders.comparisons,
              (std::vector<std::string>{scene + "/", scene + "-2/", scene + "/0/", scene + "/0-2/"}));
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(folders.frames[i], folders.comparisons[i / 2]);
}

// Each time has a folder inside the camera's folder, with a name that diptych recognizes as its own.
TEST(ReportFolders, TimesHaveFolders) {
    const Report report = askedFor({{"builtin:a", "0", false, 0},
                                    {"builtin:a", "0", false, 0.5},
                                    {"builtin:a", "", false, 1e-5},
                                    {"builtin:a", "", false, 1e20}});
    const std::vector<std::string> names = reportFolders(report).comparisons;
    EXPECT_EQ(names, (std::vector<std::string>{"a/0/0s/", "a/0/0_5s/", "a/1e-05s/", "a/1e20s/"}));
    for (const std::string& name : names) EXPECT_TRUE(isDiptychFileName(fs::path(name) / "lit.png")) << name;
    EXPECT_EQ(reportFolders(askedFor({{"a.glb", "", false, 2}})).comparisons, std::vector<std::string>{""})
        << "one comparison stands on top";
}

// Titles state the time if the report has several, or if it is not 0 s.
TEST(ReportFolders, TitlesSayTheTime) {
    const Report several = askedFor({{"builtin:a", "0", false, 0}, {"builtin:a", "0", true, 0.5}});
    EXPECT_EQ(viewTitle(several, several.frames[0]), "0, 0 s");
    EXPECT_EQ(viewTitle(several, several.frames[3]), "0, 0.5 s");
    EXPECT_EQ(viewLabel(several, several.comparisons[1]), "builtin:a, 0, 0.5 s");
    EXPECT_NE(reportTable(several).find("builtin:a, 0, 0.5 s, 4x3: forward_plus against deferred"),
              std::string::npos)
        << reportTable(several);
    const Report later = askedFor({{"builtin:a", "", false, 2}}), start = askedFor({{"builtin:a"}});
    EXPECT_EQ(viewTitle(later, later.frames[0]), "default view, 2 s");
    EXPECT_EQ(viewTitle(start, start.frames[0]), "default view");
    const std::string junit = junitOf(several), page = pageOf(several);
    EXPECT_NE(junit.find("classname=\"builtin:a | 0, 0_5 s | forward_plus against deferred\""),
              std::string::npos)
        << junit;
    EXPECT_NE(junit.find("<property name=\"time\" value=\"0.5\"/>"), std::string::npos) << junit;
    EXPECT_NE(page.find("camera, time</button>"), std::string::npos);
    EXPECT_NE(page.find(">0, 0.5 s</td>"), std::string::npos);
}

TEST(ReportFolders, OneSceneStandsOnTopAndItsPairsInside) {
    const fs::path out = folder() / "report";
    std::vector<Frame> frames = bothFrames("a/b.glb");
    Frame reference = frames[1];
    reference.name = "reference";
    reference.settings.path = Path::reference;
    frames.insert(frames.begin(), reference);
    const Report report = makeReport({{frames}}, {"a CPU", "1.0", "cpu"});
    writeReport(report, out, {});
    for (const char* file :
         {"reference.exr", "deferred.exr", "forward_plus.exr", "lit.nearer.png",
          "deferred-against-reference/lit.png", "forward_plus-against-deferred/lit.values.js"})
        EXPECT_TRUE(fs::exists(out / file)) << file;
    EXPECT_EQ(filesIn(out), listedIn(out / "report.json")) << "each is a name of ours";
}

// The page keeps the numbers of comparisons whose files --keep omits.
TEST(ReportFolders, KeepSaysOfWhichComparisons) {
    const Report report = askedFor({{"good.glb"}, {"bad.glb", "", true}});
    const std::string good = nameOfFolder("good", "good.glb") + "/",
                      bad = nameOfFolder("bad", "bad.glb") + "/";
    for (const auto& [keep, of_good, of_bad] :
         {std::tuple{Keep::all, true, true}, {Keep::failing, false, true}, {Keep::none, false, false}}) {
        const fs::path out = folder() / "report";
        ReportOptions options;
        options.keep = keep;
        writeReport(report, out, options);
        const std::vector<std::string> files = filesIn(out);
        const auto has = [&](const std::string& name) { return std::ranges::count(files, name) == 1; };
        for (const char* file : {"deferred.exr", "forward_plus.exr", "metallic.png", "metallic.values.js"}) {
            EXPECT_EQ(has(good + file), of_good) << file;
            EXPECT_EQ(has(bad + file), of_bad) << file;
        }
        EXPECT_EQ(has(bad + "roughness.difference.png"), of_bad);
        const std::string page = contentsOf(out / "index.html");
        EXPECT_EQ(markupFault(page, htmlVoids), "");
        EXPECT_EQ(countOf(page, "<div class=\"panel\"") > 0, of_bad);
        EXPECT_EQ(countOf(page, "<figure class=\"histogram\">"), 1u) << "of roughness, whatever is kept";
        const std::size_t channels = threeChannels.size();
        EXPECT_EQ(countOf(page, "--keep failing: pictures of passing channels are not kept"),
                  keep == Keep::failing ? channels : 0);
        EXPECT_EQ(countOf(page, "--keep none: no pictures are kept"), keep == Keep::none ? 2 * channels : 0);
        EXPECT_EQ(files, listedIn(out / "report.json"));
        for (const auto& attached : {"ATTACHMENT|" + (out / bad).string()})
            EXPECT_EQ(countOf(contentsOf(out / "junit.xml"), attached) > 0, of_bad);
    }
}

// A later report removes folders that only an earlier one needed; other files in them stay.
TEST(ReportFolders, EmptyFoldersGo) {
    const fs::path out = folder() / "report";
    const std::string a = nameOfFolder("a", "a.glb"), b = nameOfFolder("b", "b.glb");
    writeReport(askedFor({{"a.glb", "top"}, {"b.glb", "top"}}), out, {});
    ASSERT_TRUE(fs::exists(out / b / "top" / "metallic.png"));
    writeReport(askedFor({{"a.glb"}}), out, {});
    EXPECT_FALSE(fs::exists(out / a));
    EXPECT_EQ(filesIn(out), listedIn(out / "report.json"));
    writeReport(askedFor({{"a.glb", "top"}, {"b.glb", "top"}}), out, {});
    std::ofstream(out / b / "mine.txt") << "keep";
    writeReport(askedFor({{"a.glb"}}), out, {});
    EXPECT_FALSE(fs::exists(out / a)) << "files are moved one by one now";
    EXPECT_EQ(namesIn(out / b), std::vector<std::string>{"mine.txt"});
}

TEST(ReportFolders, AListNamesNothingOutside) {
    const fs::path here = folder();
    for (const char* name :
         {"lit.png", "1/lit.png", "Box-1c9f03/top/lit.values.js", "a/b/comparison.section.js"})
        EXPECT_TRUE(isDiptychFileName(name)) << name;
    for (const char* name : {"../lit.png", "a/../lit.png", "/lit.png", "/a/lit.png", "a/.b/lit.png",
                             "a/lit.txt", ".lit.png", "a/", "", "a b/lit.png", "./lit.png"})
        EXPECT_FALSE(isDiptychFileName(name)) << name;
    EXPECT_EQ(foldersOf("a/b/lit.png"), (std::vector<fs::path>{"a/b", "a"}));
    EXPECT_TRUE(foldersOf("lit.png").empty());
    EXPECT_TRUE(foldersOf("/lit.png").empty());
}

}  // namespace
}  // namespace diptych
