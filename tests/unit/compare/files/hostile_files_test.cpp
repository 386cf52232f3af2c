// SPDX-License-Identifier: MIT
// Our file formats, written by an attacker. Every reader accepts the content or reports one line, and
// nothing outside the output is read or changed.
#include "compare/cli/command_line.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/diptych_files.h"
#include "compare/files/scene_folders.h"
#include "shared/text/one_line.h"
#include "tests/support/errors.h"
#include "tests/support/shards_builder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <tuple>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

TEST(HostileParts, AFileOfAnotherFolderIsRefusedByName) {
    const Shards shards;
    const std::string sound = contentsOf(shards.part());
    const std::vector<std::string> before = shards.outside();
    for (const char* name :
         {"../secret.png", "../autostart/evil.desktop", "/etc/shadow", "box-1/../../secret.png",
          "box-2/a.png", "box-1/.hidden.png", "box-1/evil.desktop", "box-1/a.png/", "index.html"})
        for (const char* list : {"files", "sections"}) {
            std::ofstream(shards.part()) << sound;
            shards.change(shards.part(), [&](Json& json) { json[list][0] = name; });
            EXPECT_NE(shards.merged().find(std::string("part.json: ") + list + "[0]: \"" + name +
                                           "\" is not a file"),
                      std::string::npos)
                << name;
            EXPECT_EQ(shards.outside(), before) << name;
        }
}

TEST(HostileParts, ALinkInAShardIsRefusedByName) {
    const Shards shards;
    const std::string image = "box-1/lit.png";
    ASSERT_TRUE(fs::exists(shards.shard / image));
    fs::remove(shards.shard / image);
    fs::create_symlink("../../secret.png", shards.shard / image);
    EXPECT_NE(shards.merged().find(image + ": \"lit.png\" is a link; links are not followed"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(fs::symlink_status(shards.root / "out" / image)));

    fs::remove(shards.shard / image);
    ASSERT_EQ(::mkfifo((shards.shard / image).c_str(), 0600), 0);
    EXPECT_NE(shards.merged().find(image + ": is not a regular file"), std::string::npos);

    fs::rename(shards.shard / "box-1", shards.root / "private");
    fs::create_directory_symlink("../private", shards.shard / "box-1");
    EXPECT_NE(shards.merged().find("\"box-1\" is a link; links are not followed"), std::string::npos);
    EXPECT_FALSE(fs::exists(shards.root / "out/box-1"));
}

TEST(HostileParts, WhatDoesNotFitNamesItsPlace) {
    const std::pair<const char*, std::function<void(Json&)>> attacks[] = {
        {"comparisons[0].frames[0]: is not a whole number from 0 to 1",
         [](Json& json) { json["comparisons"][0]["frames"][0] = 1000000; }},
        {"comparisons[0].frames[1]: is not a whole number from 0 to 1",
         [](Json& json) { json["comparisons"][0]["frames"][1] = -1; }},
        {"closer[0][2]: is not a whole number from 0 to 1",
         [](Json& json) {
             json["closer"] = {{0, 1, 2}};
         }},
        {"closer_tables: has 0 elements, but there are 1 paths",
         [](Json& json) {
             json["closer"] = {{0, 1, 1}};
         }},
        {"sections: has 0 elements, but there are 1 comparisons",
         [](Json& json) { json["sections"] = Json::array(); }},
        {"rows: has 2 elements, but there are 1 comparisons",
         [](Json& json) { json["rows"].push_back(json["rows"][0]); }},
        {"tables: has 0 elements, but there are 1 comparisons",
         [](Json& json) { json["tables"] = Json::array(); }},
        {"exposures: has 0 elements, but there are 1 comparisons",
         [](Json& json) { json["exposures"] = Json::array(); }},
        {"frames: is not an array",
         [](Json& json) {
             json["frames"] = {{"0", 1}};
         }},
        {"frames[1].notes[0]: is not a string", [](Json& json) { json["frames"][1]["notes"] = {1}; }},
        {"rows[0].worst: is not a channel index", [](Json& json) { json["rows"][0]["worst"] = 5000; }},
        {"comparisons[0].channels[0][1]: is not a verdict",
         [](Json& json) { json["comparisons"][0]["channels"][0][1] = "perhaps"; }},
        {"junit[0]: is not a whole number from 0 to", [](Json& json) { json["junit"][0] = -1; }},
        {"is listed twice", [](Json& json) { json["files"].push_back(json["files"][0]); }},
        {"is listed twice", [](Json& json) { json["files"].push_back("box-1/part.json"); }},
        {"is nested deeper than 128 levels",
         [](Json& json) {
             for (int i = 0; i < 200; ++i) json["notes"] = Json::array({json["notes"]});
         }},
    };
    const Shards shards;
    const std::string sound = contentsOf(shards.part());
    for (const auto& [problem, edit] : attacks) {
        std::ofstream(shards.part()) << sound;
        shards.change(shards.part(), edit);
        EXPECT_NE(shards.merged().find(problem), std::string::npos) << problem << "\n" << shards.merged();
    }
    std::ofstream(shards.part()) << sound;
    EXPECT_EQ(shards.merged(), "");
}

TEST(HostileParts, ABadTextIsNamedBeforeAnythingIsWritten) {
    for (const char* name : {"part-frames.json", "part-comparisons.json", "part-truth.json"}) {
        const Shards shards;
        fs::remove(shards.shard / "box-1" / name);
        std::ofstream(shards.shard / "box-1" / name) << "{}], \"software\": [{}";
        EXPECT_NE(shards.merged().find(std::string(name) + ": is not JSON"), std::string::npos) << name;
    }
    const Shards shards;
    const Json json = Json::parse(contentsOf(shards.part()));
    const std::string section = json["sections"][0];
    fs::remove(shards.shard / section);
    std::ofstream(shards.shard / section) << "alert(1, 2, 3)";
    EXPECT_NE(shards.merged().find(section + ": is a script that contains more than data"),
              std::string::npos);
}

// Markup of one shard neither changes the page around it nor takes another's test cases.
TEST(HostileParts, MarkupThatDiptychDoesNotWriteLeavesTheSceneOut) {
    const Shards shards(2);
    const std::vector<fs::path> both{shards.shard, shards.root / "shard-2"};
    const Json json = Json::parse(contentsOf(shards.part()));
    const std::string section = json["sections"][0], sound = contentsOf(shards.shard / section);
    const auto write = [&](const std::string& file, const std::string& text) {
        fs::remove(shards.shard / file);  // it may be a hard link
        std::ofstream(shards.shard / file) << text;
    };
    for (const char* markup : {"<meta http-equiv='refresh' content='0;url=https://evil.example'>",
                               "<style>tr{display:none}</style>", "<link rel='stylesheet' href='x.css'>",
                               "<b>", "</section>", "<p onclick='x'>a</p>", "<!-- a"}) {
        std::string html = "<section>intruder" + std::string(markup) + "</section>";
        write(section, fmt::format("diptychSection({},{});\n", Json(section).dump(), Json(html).dump()));
        const std::string problem = shards.merged(both);
        EXPECT_NE(problem.find("box-1"), problem.npos) << markup << "\n" << problem;
        EXPECT_EQ(contentsOf(shards.root / "out/index.html").find("intruder"), std::string::npos);
        const Json report = Json::parse(contentsOf(shards.root / "out/report.json"));
        EXPECT_EQ(report["comparisons"].size(), 1u);
        EXPECT_EQ(report["errors"][0]["scene"], "scene-1");
    }
    write(section, fmt::format("diptychSection({},{});\n", Json("box-2/lit.section.js").dump(),
                               Json("<p></p>").dump()));
    EXPECT_NE(shards.merged(both).find("is not a report section"), std::string::npos);
    write(section, sound);
    ASSERT_EQ(shards.merged(both), "");
    const std::string suites = contentsOf(shards.shard / "box-1/part-junit.xml");
    for (const char* xml : {"<testsuite name=\"a\"><system-out>", "<testsuite name=\"a\"><![CDATA[", "<!-- ",
                            "</testsuites>", "<testcase name=\"a\"/>"}) {
        write("box-1/part-junit.xml", suites + xml);
        EXPECT_NE(shards.merged(both).find("box-1/part-junit.xml: "), std::string::npos) << xml;
    }
    write("box-1/part-junit.xml", suites);
    shards.change(shards.part(), [](Json& part) { part["files"].push_back("box-1/page.svg"); });
    EXPECT_NE(shards.merged(both).find("\"box-1/page.svg\" is of a kind"), std::string::npos);
}

TEST(HostileParts, WhoWritesToAShardLaterDoesNotChangeTheReport) {
    const Shards shards;
    const fs::path root = shards.root, joined = root / "out/box-1/lit.png";
    ASSERT_EQ(shards.merged(), "");
    const std::string image = contentsOf(joined);
    ASSERT_EQ(contentsOf(shards.shard / "box-1/lit.png"), image);
    std::ofstream(shards.shard / "box-1/lit.png") << "in place";
    EXPECT_EQ(contentsOf(joined), image);
    for (const std::string& name : filesIn(root / "out"))
        EXPECT_EQ(fs::hard_link_count(root / "out" / name), 1u) << name;
    // The command's own parts are hard links in the output and need no second copy on disk.
    ReportOptions options;
    options.scene_folder = "box/";
    WholeReport own;
    own.parts.push_back({writePart(smallReport(), root / "kept", options), root / "kept", true});
    options.scene_folder.reset();
    writeWhole(own, joinedOf(own), root / "own", options);
    EXPECT_EQ(fs::hard_link_count(root / "own/box/lit.png"), 2u);
}

// `cat report.json` is safe, whoever wrote the parts.
TEST(HostileParts, JsonHasNoRawControls) {
    const std::string name = "a\u009b2J\u202e\x7f.gltf";
    const Shards shards;
    const fs::path root = shards.root;
    ReportOptions options;
    options.scene_folder = "box/";
    WholeReport own;
    own.parts.push_back({writePart(smallReport(name), root / "kept", options), root / "kept", true});
    options.scene_folder.reset();
    writeWhole(own, joinedOf(own), root / "own", options);
    for (const char* text : {"part-frames.json", "part-comparisons.json"}) {
        fs::copy_file(root / "kept/box" / text, shards.shard / "box-1" / text,
                      fs::copy_options::overwrite_existing);
        std::string raw = contentsOf(shards.shard / "box-1" / text);
        for (const auto& [escaped, control] :
             {std::pair{"\\u009b", "\u009b"}, {"\\u202e", "\u202e"}, {"\\u007f", "\x7f"}})
            for (std::size_t at = 0; (at = raw.find(escaped)) != raw.npos;) raw.replace(at, 6, control);
        ASSERT_NE(raw.find(name), raw.npos) << text;
        std::ofstream(shards.shard / "box-1" / text) << raw;
    }
    ASSERT_EQ(shards.merged(), "");
    for (const char* folder : {"own", "kept", "out"})
        for (const std::string& file : filesIn(root / folder))
            if (file.ends_with(".json")) {
                const std::string text = contentsOf(root / folder / file);
                EXPECT_EQ(escapeControls(text), text) << folder << "/" << file;
            }
    for (const char* folder : {"own", "out"})
        EXPECT_EQ(Json::parse(contentsOf(root / folder / "report.json"))["frames"][0]["scene"], name);
}

TEST(HostileShards, OneBadShardIsNamedAndTheOthersAreJoined) {
    const Shards shards(2);
    std::ofstream(shards.part()) << "[1, 2";
    const fs::path other = shards.root / "shard-2";
    EXPECT_NE(shards.merged({shards.shard, other}).find("box-1/part.json: is not JSON"), std::string::npos);
    EXPECT_TRUE(fs::exists(shards.root / "out/box-2"));
    const Json report = Json::parse(contentsOf(shards.root / "out/report.json"));
    EXPECT_EQ(report["comparisons"].size(), 1u);
    EXPECT_EQ(report["errors"].size(), 1u);
    for (const char* text : {"", "[", "{}", "5"}) {
        std::ofstream(shards.shard / "shard.json") << text;
        EXPECT_NE(shards.merged({shards.shard, other}).find("shard-1: is not the report of a shard"),
                  std::string::npos);
    }
}

TEST(HostileShards, AManifestOutsideItsBoundsIsNoReportOfAShard) {
    const std::pair<const char*, std::function<void(Json&)>> attacks[] = {
        {"shard.json.shard.count: is not a whole number from 1 to 65536",
         [](Json& json) { json["shard"]["count"] = 2147483647; }},
        {"shard.count: is not a whole number", [](Json& json) { json["shard"]["count"] = -1; }},
        {"shard.index: is not a whole number from 1 to 1", [](Json& json) { json["shard"]["index"] = 2; }},
        {"items[0][2]: is not a whole number from 1 to 1", [](Json& json) { json["items"][0][2] = 0; }},
        {"items[0][1]: \"../\" is not a folder name", [](Json& json) { json["items"][0][1] = "../"; }},
        {"items[0][1]: \"/etc/\" is not a folder name", [](Json& json) { json["items"][0][1] = "/etc/"; }},
        {"items[0][1]: \"box-1\" is not a folder name", [](Json& json) { json["items"][0][1] = "box-1"; }},
        {"items[1]: uses the folder of another scene",
         [](Json& json) { json["items"].push_back(json["items"][0]); }},
        {"items[0]: is not an array", [](Json& json) { json["items"] = {1}; }},
        {"errors[0][1]: is not a string",
         [](Json& json) {
             json["errors"] = Json::array({Json::array({"scene", 5})});
         }},
        {"has no \"plan\"", [](Json& json) { json.erase("plan"); }},
        {"software: is not a string", [](Json& json) { json["software"] = 3; }},
        {"is not from diptych", [](Json& json) { json["schema"] = 2; }},
    };
    const Shards shards;
    const std::string sound = contentsOf(shards.shard / "shard.json");
    for (const auto& [problem, edit] : attacks) {
        std::ofstream(shards.shard / "shard.json") << sound;
        shards.change(shards.shard / "shard.json", edit);
        const std::string refusal = faultOf([&] { shards.merged(); });
        EXPECT_NE(refusal.find(problem), std::string::npos) << problem << "\n" << refusal;
    }
}

// tradeoff: absurd counts give one line; an invalid scene, or one whose file is a link, is named.
TEST(HostileShards, TradeoffsAreCheckedAsReportsAre) {
    const fs::path root = folder();
    const Json metrics{{"ms", {{"median", 1}}}, {"errors", {{"flip", 0.5}}}};
    const Json tradeoff{{"schema", 1},
                        {"software", softwareName},
                        {"device", {{"name", "a CPU"}}},
                        {"rows", Json::array({metrics})},
                        {"fronts", Json::array({{{"error", "flip"}, {"path", nullptr}, {"rows", {0}}}})},
                        {"files", {"row-001.png", "../secret.png"}}};
    Json plan{{"asked", Json::object()}};
    shards::Manifest manifest{"build", "tradeoff", plan, {1, 1}, {}, {}};
    for (const char* scene : {"a", "b", "c", "d", "e", "f"}) {
        manifest.items.push_back({scene, std::string(scene) + "/", 1});
        fs::create_directories(root / "shard" / scene);
        std::ofstream(root / "shard" / scene / "tradeoff.json") << tradeoff.dump();
        std::ofstream(root / "shard" / scene / "row-001.png") << "picture";
    }
    std::ofstream(root / "secret.png") << "secret";
    std::ofstream(root / "shard/b/tradeoff.json") << R"({"software": "diptych", "device": {}, "rows": [1]})";
    for (const auto& [scene, file, text] : {std::tuple{"d", "index.html", "<meta http-equiv='refresh'>"},
                                            {"e", "a.svg", "<svg><script>x</script></svg>"},
                                            {"f", "a.values.js", "x"}}) {
        Json other = tradeoff;
        other["files"] = {file};
        std::ofstream(root / "shard" / scene / "tradeoff.json") << other.dump();
        std::ofstream(root / "shard" / scene / file) << text;
    }
    fs::remove(root / "shard/c/row-001.png");
    fs::create_symlink("../../secret.png", root / "shard/c/row-001.png");
    std::ofstream(root / "shard/tradeoffs.json") << textOf(manifest);
    const auto merge = [&] {
        return cli::parseCommandLine({"merge", root / "shard", "-q", "-o", root / "out"}).command.run();
    };
    testing::internal::CaptureStderr();
    EXPECT_EQ(merge(), 2);
    const std::string line = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(line, '\n'), 1) << line;
    EXPECT_NE(line.find("b/tradeoff.json"), std::string::npos) << line;
    const Json joined = Json::parse(contentsOf(root / "out/tradeoffs.json"));
    EXPECT_EQ(joined["scenes"].size(), 1u);
    EXPECT_EQ(joined["errors"].size(), 5u) << joined["errors"].dump();
    EXPECT_EQ(filesIn(root / "out/a"), (std::vector<std::string>{"row-001.png", "tradeoff.json"}));

    Json text = Json::parse(textOf(manifest));
    text["shard"]["count"] = 2147483647;
    std::ofstream(root / "shard/tradeoffs.json") << text.dump();
    const std::string refusal = faultOf([&] { merge(); });
    EXPECT_NE(refusal.find("count: is not a whole number from 1 to 65536"), std::string::npos) << refusal;
}

TEST(HostileFolders, AKeptFolderThatIsALinkIsRefused) {
    const fs::path root = folder();
    const Json key{{"schema", 1}, {"software", softwareName}};
    fs::create_directories(root / "elsewhere");
    std::ofstream(root / "elsewhere/key.json")
        << Json{{"schema", 1}, {"software", softwareName}, {"old", 1}}.dump();
    std::ofstream(root / "elsewhere/mine.txt") << "mine";
    fs::create_directory_symlink("elsewhere", root / ".out.scenes");
    const std::string refusal = faultOf([&] { CheckpointFolder kept(root / "out", "scenes", key); });
    EXPECT_NE(refusal.find(".out.scenes: is a symbolic link"), std::string::npos) << refusal;
    EXPECT_EQ(contentsOf(root / "elsewhere/mine.txt"), "mine");
}

TEST(HostileFolders, WhatStandsInPlaceOfOurFilesIsSaidAtOnce) {
    const fs::path root = folder();
    fs::create_directories(root / ".out.kept");
    for (const char* name : {"report.json", "shard.json", "list", ".out.kept/key.json", "scene.gltf"})
        ASSERT_EQ(::mkfifo((root / name).c_str(), 0600), 0);
    const auto line = [&](const std::function<void()>& read) -> std::string {
        try {
            read();
            return "";
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    };
    EXPECT_FALSE(isDiptychManifest(root / "report.json"));
    EXPECT_FALSE(isDiptychManifest("/dev/zero"));
    EXPECT_FALSE(isDiptychImage(root / "report.json"));
    EXPECT_EQ(line([&] { shards::timingsOf(root); }),
              "--timings " + root.string() + ": is not a regular file");
    EXPECT_EQ(line([&] { scenesOf({"@" + (root / "list").string()}); }),
              "@" + (root / "list").string() + ": is not a regular file");
    EXPECT_EQ(line([&] { scenesOf({"@/dev/zero"}); }), "@/dev/zero: is not a regular file");
    EXPECT_NE(line([&] { shards::choose({root}, "shard.json"); }).find("shard.json is not a regular file"),
              std::string::npos);
    EXPECT_NE(line([&] { CheckpointFolder(root / "out", "kept", Json{{"schema", 1}}); }), "x");
    EXPECT_EQ(shards::filesOf((root / "scene.gltf").string()).size(), 1u);
}

}  // namespace
}  // namespace diptych
