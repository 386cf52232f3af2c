// SPDX-License-Identifier: MIT
// Many scenes: folders, patterns and lists; shards and their merge; resuming after an interruption.
#include "tests/support/campaign.h"
#include "tests/tool/faults.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <random>
#include <regex>
#include <set>

namespace diptych {
namespace {

// Small scenes, one of them missing. -o and --shard are added.
const std::string manyScenes =
    "builtin:points builtin:triangle gone.glb builtin:spots builtin:areas builtin:crossed";
const std::string manyHow = " --size 32x18 --runs 0 --channels lit,normals,roughness";

// All files of a report, without times, which differ between runs.
std::map<std::string, std::string> timeless(const fs::path& folder) {
    static const std::regex json_times(
        "\"(made_in_ms|compare_ms|encode_ms|ms|record|object_lists)\": [-+.e0-9]+");
    static const std::regex junit_times(" (time|timestamp)=\"[^\"]*\"");
    static const std::regex part_seconds("(\"junit\": \\[\\s*[0-9]+,\\s*[0-9]+,)\\s*[-+.e0-9]+");
    static const std::regex page_times(
        "compared in [0-9]+ ms, pictures, values and EXRs encoded in [0-9]+ ms");
    static const std::regex made_in("made in</td><td[^<]*</td>|[0-9.]+ (s|ms)</td>");
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::string text = contentsOf(entry.path());
        const std::string name = entry.path().lexically_relative(folder).string();
        const std::string file = entry.path().filename().string();
        if (file == "part.json") text = std::regex_replace(text, part_seconds, "$1");
        if (name == "report.json" || file.starts_with("part"))
            text = std::regex_replace(text, json_times, "\"$1\": 0");
        if (name == "junit.xml" || file == "part-junit.xml") text = std::regex_replace(text, junit_times, "");
        if (name == "index.html") text = std::regex_replace(text, page_times, "");
        if (name.ends_with(".html") || name.ends_with(".section.js"))
            text = std::regex_replace(text, made_in, "");
        // Replaces the folder in the attachment paths of junit.xml.
        for (std::size_t at = text.find(folder.filename().string() + "/");
             name == "junit.xml" && at != text.npos; at = text.find(folder.filename().string() + "/", at))
            text.replace(at, folder.filename().string().size() + 1, "REPORT/");
        files[name] = std::move(text);
    }
    return files;
}

testing::AssertionResult alike(const fs::path& a, const fs::path& b) {
    const auto first = timeless(a), second = timeless(b);
    for (const auto& [name, text] : first) {
        const auto found = second.find(name);
        if (found == second.end()) return testing::AssertionFailure() << name << " is in " << a << " alone";
        if (found->second == text) continue;
        const auto [at, other] = std::ranges::mismatch(text, found->second);
        const auto where = static_cast<std::size_t>(at - text.begin());
        return testing::AssertionFailure()
               << name << " differs at " << where << ": ..." << text.substr(where < 60 ? 0 : where - 60, 160)
               << "\n  and ..." << found->second.substr(where < 60 ? 0 : where - 60, 160);
    }
    for (const auto& [name, text] : second)
        if (!first.contains(name)) return testing::AssertionFailure() << name << " is in " << b << " alone";
    return testing::AssertionSuccess();
}

TEST(ManyScenes, ShardsOfAnyNumberMakeTheWholeReport) {
    const Folder folder;
    const Ran whole = runTool(folder, "compare " + manyScenes + manyHow + " -o whole");
    EXPECT_EQ(whole.code, 2) << "one cannot be drawn";
    EXPECT_NE(whole.out.find("5 comparisons"), std::string::npos) << whole.out;
    std::mt19937 random(3);
    for (const int count : {1, 2, 7}) {  // of 7 shards, some have no scene
        std::vector<std::string> folders;
        std::size_t comparisons = 0;
        for (int i = 1; i <= count; ++i) {
            folders.push_back(fmt::format("s{}/{}", count, i));
            const Ran ran = runTool(folder, fmt::format("compare -q {}{} --shard {}/{} -o {}", manyScenes,
                                                        manyHow, i, count, folders.back()));
            const auto json = nlohmann::json::parse(contentsOf(folder / folders.back() / "report.json"));
            comparisons += json["comparisons"].size();
            EXPECT_EQ(ran.code, json["errors"].empty() ? 0 : 2) << ran.err;
            EXPECT_TRUE(fs::exists(folder / folders.back() / "index.html")) << "stands by itself";
        }
        EXPECT_EQ(comparisons, 5u) << "each scene once";
        std::ranges::shuffle(folders, random);
        const std::string out = fmt::format("merged-{}", count);
        const Ran merged = runTool(folder, fmt::format("merge -q {} -o {}", fmt::join(folders, " "), out));
        EXPECT_EQ(merged.code, 2) << merged.err;
        EXPECT_NE(merged.err.find("gone.glb"), std::string::npos) << merged.err;
        EXPECT_TRUE(alike(folder / "whole", folder / out)) << count;
    }
}

// Changes a pixel of one image, and a digit of one number.
TEST(ManyScenes, ADifferenceOfReportsIsSeen) {
    const Folder folder;
    runTool(folder, "compare -q builtin:points builtin:triangle" + manyHow + " -o a");
    fs::copy(folder / "a", folder / "b", fs::copy_options::recursive);
    ASSERT_TRUE(alike(folder / "a", folder / "b"));
    std::string text = contentsOf(folder / "b/report.json");
    text.replace(text.find("\"covered_pixels\": ") + 18, 1, "9");
    std::ofstream(folder / "b/report.json") << text;
    EXPECT_FALSE(alike(folder / "a", folder / "b"));
    fs::remove(folder / "b/report.json");
    EXPECT_FALSE(alike(folder / "a", folder / "b"));
}

// Attachment paths are relative to merge's working folder, where CI servers look for them.
TEST(ManyScenes, FailuresOfManyScenesAreAttached) {
    const Folder folder;
    folder.write("strict.json", R"({"rules":[{"channel":"lit","max":0,"because":"none"}]})");
    for (const int i : {1, 2})
        runTool(folder, fmt::format("compare -q builtin:points builtin:spots{} --keep failing --tolerances "
                                    "strict.json --shard {}/2 -o {}",
                                    manyHow, i, i));
    EXPECT_EQ(runTool(folder, "merge -q 1 2 -o out/all").code, 1);
    const std::string junit = contentsOf(folder / "out/all/junit.xml");
    std::size_t found = 0;
    for (std::size_t at = junit.find("[[ATTACHMENT|"); at != junit.npos;
         at = junit.find("[[ATTACHMENT|", at + 1)) {
        const std::string name = junit.substr(at + 13, junit.find("]]", at) - at - 13);
        EXPECT_TRUE(name.starts_with("out/all/") && fs::exists(folder / name)) << name;
        ++found;
    }
    EXPECT_GE(found, 2u);
}

TEST(ManyScenes, MergeNamesWhatItMust) {
    const Folder folder;
    const std::string few = "compare -q builtin:points builtin:triangle builtin:spots" + manyHow;
    for (const int i : {1, 2, 3}) runTool(folder, fmt::format("{} --shard {}/3 -o {}", few, i, i));
    const auto merged = [&](const std::string& folders) {
        return runTool(folder, "merge -q " + folders + " -o out");
    };
    EXPECT_EQ(merged("3 1 2").code, 0);
    const auto before = timeless(folder / "2");

    Ran ran = merged("1 3");
    EXPECT_TRUE(ran.failedOver("shard 2/3 is missing")) << "and says so";
    auto json = nlohmann::json::parse(contentsOf(folder / "out/report.json"));
    EXPECT_EQ(json["comparisons"].size(), 2u) << "what is there is kept";
    EXPECT_EQ(json["errors"].size(), 1u);

    fs::copy(folder / "2", folder / "twice", fs::copy_options::recursive);
    EXPECT_TRUE(merged("1 2 3 twice").failedOver("shard 2/3 exists twice"));
    EXPECT_EQ(nlohmann::json::parse(contentsOf(folder / "out/report.json"))["comparisons"].size(), 3u);

    runTool(folder, few + " --gbuffer compact --shard 2/3 -o other");
    EXPECT_TRUE(merged("1 other 3").failedOver("other: has another gbuffer"));
    runTool(folder,
            "compare -q builtin:points builtin:triangle builtin:areas" + manyHow + " --shard 2/3 -o scene");
    EXPECT_TRUE(merged("1 scene 3").failedOver("scene: has another scene: builtin:areas"));
    runTool(folder, few + " --shard 2/4 -o four");
    EXPECT_TRUE(merged("1 four 3").failedOver("four: is one of 4 shards, the others of 3"));

    fs::copy(folder / "2", folder / "built", fs::copy_options::recursive);
    std::string manifest = contentsOf(folder / "built/shard.json");
    const std::size_t at = manifest.find("\"build\": \"") + 10;
    manifest.replace(at, 5, "9.9.9");
    std::ofstream(folder / "built/shard.json") << manifest;
    EXPECT_TRUE(merged("1 built 3").failedOver("built: is from another build (9.9.9"));

    fs::copy(folder / "2", folder / "cut", fs::copy_options::recursive);
    for (const auto& entry : fs::recursive_directory_iterator(folder / "cut"))
        if (entry.path().filename() == "lit.values.js") fs::remove(entry.path());
    EXPECT_TRUE(merged("1 cut 3").failedOver("cut: the report is incomplete"));

    EXPECT_TRUE(merged("1 2 3 nowhere").failedOver("nowhere: is not the report of a shard"));
    EXPECT_TRUE(runTool(folder, "merge nowhere -o out").failedOver("nowhere: is not the report of a shard"));
    EXPECT_TRUE(runTool(folder, "merge -o out").failedOver("the folders of the shards are missing"));
    EXPECT_EQ(before, timeless(folder / "2")) << "no shard is changed";
}

TEST(ManyScenes, ATaskOfASlurmArrayTakesItsShard) {
    const Folder folder;
    const std::string variables =
        "export SLURM_ARRAY_TASK_ID=6 SLURM_ARRAY_TASK_MIN=2 SLURM_ARRAY_TASK_MAX=6 "
        "SLURM_ARRAY_TASK_STEP=2; ";
    const std::string compare = "'" DIPTYCH_PROGRAM
                                "' compare -q builtin:points builtin:triangle builtin:spots" +
                                manyHow + " -o s --shard ";
    EXPECT_EQ(runShell(folder, variables + compare + "slurm", folder.path()).code, 0);
    const auto json = nlohmann::json::parse(contentsOf(folder / "s/shard.json"));
    EXPECT_EQ(json["shard"], (nlohmann::json{{"index", 3}, {"count", 3}}));
    const Ran irregular =
        runShell(folder, variables + "export SLURM_ARRAY_TASK_COUNT=2; " + compare + "slurm", folder.path());
    EXPECT_TRUE(irregular.failedOver("the array is irregular"));
    EXPECT_TRUE(runTool(folder, "compare --shard slurm").failedOver("SLURM_ARRAY_TASK_ID is not set"));
    EXPECT_TRUE(runTool(folder, "compare --shard 0/2").failedOver("there is no shard 0 of 2"));
    EXPECT_TRUE(runTool(folder, "compare --shard 1/2 --single-file").failedOver("--single-file"));
}

#ifdef DIPTYCH_FAULTS
// A kill hits one of some 170 calls that move or remove a file. The command is then repeated: it does not
// render finished scenes again, and no kill leaves half a report.
TEST(ManyScenes, AfterAKillAtAnyFileTheSameCommandMakesTheWholeReport) {
    const Folder folder;
    const std::string compare =
        "compare builtin:points builtin:triangle builtin:spots builtin:areas" + manyHow + " --shard 1/1 -o ";
    ASSERT_EQ(runTool(folder, compare + "whole").code, 0);
    const Rows rows(8);
    std::set<std::size_t> kept_scenes;
    for (int row = 0;; row = rows.after(row)) {
        const int at = 10 + 5 * row;
        const std::string out = fmt::format("cut-{}", at);
        const Faulted cut = runFaulted(folder, compare + out, {"move,remove", "kill"}, at);
        if (cut.seen.empty()) break;
        const bool ended_before = fs::exists(folder / out);
        EXPECT_EQ(fs::exists(folder / out / "report.json"), ended_before) << at << ": all or nothing";
        std::size_t kept = 0;
        for (const auto& entry : fs::directory_iterator(folder / ("." + out + ".scenes")))
            kept += entry.path().filename().string().ends_with("-scene.json");
        const Ran again = runTool(folder, compare + out);
        EXPECT_EQ(again.code, 0) << at << again.err;
        if (!ended_before) {
            EXPECT_EQ(again.err.find(fmt::format("{} of 4 scenes are kept", kept)) != again.err.npos,
                      kept > 0)
                << at << again.err;
            kept_scenes.insert(kept);
        }
        ASSERT_TRUE(alike(folder / "whole", folder / out)) << at;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            EXPECT_FALSE(entry.path().filename().string().starts_with("." + out)) << entry.path();
    }
    EXPECT_GE(kept_scenes.size(), 2u) << "after none and after some";
}
#endif

TEST(ManyScenes, FoldersAndListsMeanTheirScenes) {
    const Folder folder;
    folder.write("scenes/a/bad.gltf", "{}");
    folder.write("scenes/list.txt", "# two\nbuiltin:points\na/bad.gltf\nbuiltin:triangle\n");
    const Ran ran = runTool(folder, "compare @scenes/list.txt 'scenes/**/*.gltf'" + manyHow + " -o r --json");
    EXPECT_EQ(ran.code, 2);
    const auto json = nlohmann::json::parse(ran.out);
    EXPECT_EQ(json["comparisons"].size(), 2u) << "the others are compared";
    ASSERT_EQ(json["errors"].size(), 1u) << "it is named twice and stands once";
    EXPECT_EQ(json["errors"][0]["scene"], "scenes/a/bad.gltf");
    EXPECT_TRUE(runTool(folder, "compare nothing/*.glb").failedOver("matches no .gltf or .glb file"));
}

// Each scene has its own tradeoff, whichever shard makes it.
TEST(ManyScenes, TradeoffsOfShardsStandBesideEachOther) {
    const Folder folder;
    const std::string tradeoff =
        "tradeoff -q builtin:points builtin:triangle gone.glb --size 32x18 --runs 1 --grid "
        "'{\"settings\":{\"gbuffer\":[\"compact\",\"full\"]}}' ";
    for (const int i : {1, 2}) runTool(folder, fmt::format("{}--shard {}/2 -o t{}", tradeoff, i, i));
    const Ran merged = runTool(folder, "merge t2 t1 -o all");
    EXPECT_EQ(merged.code, 2) << "one cannot be drawn";
    EXPECT_NE(merged.err.find("gone.glb"), std::string::npos) << merged.err;
    const auto json = nlohmann::json::parse(contentsOf(folder / "all/tradeoffs.json"));
    ASSERT_EQ(json["scenes"].size(), 2u);
    for (const char* scene : {"points", "triangle"}) {
        EXPECT_TRUE(fs::exists(folder / "all" / scene / "index.html")) << scene;
        EXPECT_NE(contentsOf(folder / "all/index.html").find(fmt::format("href=\"{}/index.html\"", scene)),
                  std::string::npos);
    }
    EXPECT_EQ(runTool(folder, "merge -q t1 -o half").code, 2) << "a shard is missing";
    EXPECT_EQ(runTool(folder, tradeoff + "-o one").code, 2);
    EXPECT_EQ(nlohmann::json::parse(contentsOf(folder / "one/tradeoffs.json"))["scenes"].size(), 2u);
    EXPECT_EQ(runTool(folder, tradeoff + "-o one").code, 2) << "its own folder may be replaced";
}

TEST(ManyScenes, AnEarlierReportSaysWhatChanged) {
    const Folder folder;
    const std::string compare = "compare builtin:points builtin:triangle" + manyHow + " -o ";
    ASSERT_EQ(runTool(folder, compare + "one").code, 0);
    Ran ran = runTool(folder, compare + "two --since one");
    EXPECT_NE(ran.out.find("since one: nothing has changed"), std::string::npos) << ran.out;
    EXPECT_TRUE(alike(folder / "one", folder / "one"));
    // Rules make the same images fail.
    folder.write("strict.json",
                 R"({"rules":[{"channel":"lit","scene":"*points","max":0,"because":"none"}]})");
    ran = runTool(folder, compare + "three --since one/report.json --tolerances strict.json --json");
    EXPECT_EQ(ran.code, 1);
    auto since = nlohmann::json::parse(ran.out)["since"];
    ASSERT_EQ(since["comparisons"].size(), 1u);
    EXPECT_EQ(since["comparisons"][0]["kind"], "new failure");
    EXPECT_EQ(since["comparisons"][0]["scene"], "builtin:points");
    ran = runTool(folder, compare + "four --since three");
    EXPECT_NE(ran.out.find("since three: 1 mended: builtin:points"), std::string::npos) << ran.out;
    // Different light changes metrics; one scene is new and one is gone.
    ran = runTool(folder,
                  "compare builtin:points builtin:spots" + manyHow + " --ambient 1,1,1 -o five --since one");
    EXPECT_NE(ran.out.find("since one: 1 moved: builtin:points (lit max"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("since one: 1 new: builtin:spots"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("since one: 1 gone: builtin:triangle"), std::string::npos) << ran.out;
    EXPECT_TRUE(runTool(folder, compare + "six --since nowhere").failedOver("--since nowhere: no such file"));
}

TEST(ManyScenes, WhatIsAcceptedPasses) {
    const Folder folder;
    folder.write("strict.json",
                 R"({"rules":[{"channel":"lit","max":0,"because":"none"},
                     {"channel":"roughness","max":0,"because":"none"}]})");
    const std::string compare = "compare builtin:points builtin:triangle" + manyHow + " ";
    ASSERT_EQ(runTool(folder, compare + "--tolerances strict.json -o r").code, 1);
    fs::copy_file(folder / "strict.json", folder / "rules.json");
    EXPECT_EQ(runTool(folder, "accept r builtin:points -o rules.json --because 'seen by eye'").code, 0);
    Ran ran = runTool(folder, compare + "--tolerances rules.json -o s --json");
    const auto json = nlohmann::json::parse(ran.out);
    for (const auto& comparison : json["comparisons"])
        EXPECT_EQ(comparison["verdict"], comparison["scene"] == "builtin:points" ? "pass" : "fail")
            << "the rule is of one scene";
    EXPECT_NE(ran.out.find("seen by eye"), std::string::npos);
    EXPECT_EQ(runTool(folder, "accept r -o rules.json").code, 0);
    EXPECT_EQ(runTool(folder, compare + "--tolerances rules.json -o t").code, 0);
    EXPECT_TRUE(runTool(folder, "accept t").failedOver("nothing fails, so"));
    EXPECT_TRUE(runTool(folder, "accept r builtin:none").failedOver("the report has no such scene"));
}

}  // namespace
}  // namespace diptych
