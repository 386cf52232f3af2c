// SPDX-License-Identifier: MIT
// The scenes of a shard, and its name.
#include "compare/shards/manifest.h"
#include "compare/shards/merge.h"
#include "compare/shards/partition.h"
#include "compare/shards/scene_items.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <system_error>

namespace diptych {
namespace {

using namespace shards;
namespace fs = std::filesystem;

Variables setTo(std::map<std::string, std::string> variables) {
    return [variables](const char* name) {
        const auto found = variables.find(name);
        return found == variables.end() ? std::nullopt : std::optional(found->second);
    };
}

Variables task(int id, int first, int last, int step) {
    return setTo({{"SLURM_ARRAY_TASK_ID", std::to_string(id)},
                  {"SLURM_ARRAY_TASK_MIN", std::to_string(first)},
                  {"SLURM_ARRAY_TASK_MAX", std::to_string(last)},
                  {"SLURM_ARRAY_TASK_STEP", std::to_string(step)}});
}

std::string shardWords(const std::string& word, const Variables& environment = setTo({})) {
    try {
        const Shard shard = shardOf(word, environment);
        return fmt::format("{}/{}", shard.index, shard.count);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

TEST(Shards, AreCountedFromOne) {
    EXPECT_EQ(shardWords("1/1"), "1/1");
    EXPECT_EQ(shardWords("16/16"), "16/16");
    EXPECT_EQ(shardWords("0/3"), "--shard 0/3: there is no shard 0 of 3; the first is 1");
    EXPECT_EQ(shardWords("4/3"), "--shard 4/3: there is no shard 4 of 3; the first is 1");
    for (const char* word : {"", "3", "1/", "/3", "a/3", "1/3/5", "1 /3", "1.5/3", "slurm/x"})
        EXPECT_NE(shardWords(word).find("give I/N, counted from 1"), std::string::npos) << word;
}

TEST(Shards, ARegularArrayOfSlurmSaysItself) {
    EXPECT_EQ(shardWords("slurm", task(1, 1, 16, 1)), "1/16");
    EXPECT_EQ(shardWords("slurm", task(15, 0, 15, 1)), "16/16");
    EXPECT_EQ(shardWords("slurm", task(10, 4, 16, 3)), "3/5") << "4, 7, 10, 13, 16";
    EXPECT_EQ(shardWords("slurm", task(7, 7, 7, 1)), "1/1");
    EXPECT_NE(shardWords("slurm").find("SLURM_ARRAY_TASK_ID is not set"), std::string::npos);
    EXPECT_NE(shardWords("slurm", setTo({{"SLURM_ARRAY_TASK_ID", "x"}})).find("is not a number: x"),
              std::string::npos);
}

TEST(Shards, AnIrregularArrayNeedsItsNumber) {
    Variables uncounted = task(5, 1, 7, 1);
    const Variables counted = [&](const char* name) {
        return std::string(name) == "SLURM_ARRAY_TASK_COUNT" ? std::optional<std::string>("3")
                                                             : uncounted(name);
    };
    EXPECT_NE(shardWords("slurm", counted).find("the array is irregular"), std::string::npos) << "1, 5, 7";
    EXPECT_NE(shardWords("slurm", task(5, 1, 8, 2)).find("the array is irregular"), std::string::npos);
    EXPECT_NE(shardWords("slurm", task(4, 1, 7, 2)).find("the array is irregular"), std::string::npos);
    EXPECT_NE(shardWords("slurm", task(1, 1, 7, 0)).find("the array is irregular"), std::string::npos);
    EXPECT_EQ(shardWords("slurm/7", counted), "5/7");
    EXPECT_NE(shardWords("slurm/4", counted).find("there is no shard 5 of 4"), std::string::npos);
}

TEST(Shards, EverySceneIsOfOneShard) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> weight(1, 1000);
    for (const int count : {1, 2, 3, 7, 16}) {
        std::vector<double> weights(40);
        for (double& w : weights) w = weight(random);
        const std::vector<int> of = partition(weights, count);
        std::vector<double> loads(static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < of.size(); ++i)
            loads.at(static_cast<std::size_t>(of[i] - 1)) += weights[i];
        const double mean = std::accumulate(loads.begin(), loads.end(), 0.0) / count;
        const double best = std::max(mean, *std::ranges::max_element(weights));
        EXPECT_LE(*std::ranges::max_element(loads), 4.0 / 3 * best) << count << ": Graham's bound";
        EXPECT_EQ(of, partition(weights, count)) << "of the same the same";
    }
    EXPECT_EQ(partition({5, 5, 5, 5}, 2), (std::vector<int>{1, 2, 1, 2})) << "equal ones in turns";
    EXPECT_EQ(partition({1, 9, 2, 8}, 2), (std::vector<int>{1, 1, 2, 2})) << "the longest first";
    EXPECT_EQ(partition({1, 2}, 4), (std::vector<int>{2, 1})) << "and two shards have none";
    EXPECT_TRUE(partition({}, 3).empty());
}

TEST(Shards, ASceneWeighsWhatItsFilesDo) {
    const fs::path root = folder();
    std::ofstream(root / "a b.bin") << std::string(5000, 'x');
    std::ofstream(root / "t.png") << std::string(700, 'x');
    const std::string text =
        R"({"buffers":[{"uri":"a%20b.bin"},{"uri":"data:,x"}],
            "images":[{"uri":"t.png"},{"bufferView":0},{"uri":"gone.png"}]})";
    std::ofstream(root / "s.gltf") << text;
    std::string glb = "glTF";
    const auto word = [&](std::size_t value) {
        for (int i = 0; i < 4; ++i) glb += static_cast<char>(value >> 8 * i & 255);
    };
    word(2);
    word(20 + text.size());
    word(text.size());
    word(0x4e4f534a);
    std::ofstream(root / "s.glb", std::ios::binary) << glb + text;
    std::ofstream(root / "cut.glb", std::ios::binary) << glb;
    EXPECT_EQ(bytesOf((root / "s.gltf").string()), text.size() + 5700);
    EXPECT_EQ(bytesOf((root / "s.gltf?scene=1").string()), text.size() + 5700);
    EXPECT_EQ(bytesOf((root / "s.glb").string()), 20 + text.size() + 5700);
    EXPECT_EQ(bytesOf((root / "cut.glb").string()), 20u);
    EXPECT_EQ(bytesOf((root / "none.glb").string()), 0u);
    EXPECT_EQ(bytesOf("builtin:gallery"), 0u);
    const std::vector<double> weights =
        weightsOf({"builtin:gallery", (root / "s.glb").string(), "builtin:spots"}, {});
    EXPECT_GT(weights[1], weights[0]);
    EXPECT_EQ(weights[0], weights[2]);
    EXPECT_GT(weights[0], 0) << "drawing is not for nothing";
    // Slow scenes come first. For a scene without a recorded time, its bytes and the others' rate give an
    // estimate.
    const std::vector<double> timed = weightsOf(
        {"builtin:gallery", (root / "s.glb").string(), "builtin:spots"}, {{"builtin:gallery", 500}});
    EXPECT_EQ(timed[0], 500);
    EXPECT_NEAR(timed[2], 500, 1e-9);
    EXPECT_GT(timed[1], 500);
}

TEST(Shards, TimingsAreThoseOfAReport) {
    const fs::path root = folder();
    std::ofstream(root / "report.json")
        << R"({"frames":[{"scene":"a","made_in_ms":10},{"scene":"a","made_in_ms":5.5},
                         {"scene":"b","made_in_ms":1}]})";
    for (const fs::path& name : {root, root / "report.json"})
        EXPECT_EQ(timingsOf(name), (std::map<std::string, double>{{"a", 15.5}, {"b", 1}}));
    std::ofstream(root / "empty.json") << R"({"frames":[]})";
    EXPECT_THROW(timingsOf(root / "empty.json"), std::runtime_error);
    EXPECT_THROW(timingsOf(root / "gone.json"), std::runtime_error);
}

TEST(Shards, AManifestComesBack) {
    const fs::path root = folder();
    const Manifest manifest{
        buildName(),         "compare", {{"shards", 3}}, {2, 3}, {{"a.glb", "a/", 1}, {"b", "", 2}},
        {{"b", "cut short"}}};
    std::ofstream(root / "shard.json") << textOf(manifest);
    const Manifest read = readManifest(root, "shard.json");
    EXPECT_EQ(textOf(read), textOf(manifest));
    EXPECT_EQ(read.shard, (Shard{2, 3}));
    EXPECT_EQ(read.errors.front().message, "cut short");
    for (const char* text : {"", "{}", R"({"schema":1,"software":"diptych"})"}) {
        std::ofstream(root / "shard.json") << text;
        EXPECT_THROW(readManifest(root, "shard.json"), std::runtime_error) << text;
    }
}

// A manifest that is no shard's, or whose values do not fit, is named with the place.
TEST(Shards, AManifestThatDoesNotFitIsNamed) {
    const fs::path root = folder();
    const Manifest manifest{
        "1.0, commit 1",     "compare", {{"shards", 3}}, {2, 3}, {{"a.glb", "a/", 1}, {"b", "b/", 2}},
        {{"b", "cut short"}}};
    const nlohmann::ordered_json whole = nlohmann::ordered_json::parse(textOf(manifest));
    EXPECT_EQ(
        whole,
        (nlohmann::ordered_json{
            {"schema", 1},
            {"software", "diptych"},
            {"build", "1.0, commit 1"},
            {"command", "compare"},
            {"plan_hash", planHash(manifest.plan)},
            {"shard", {{"index", 2}, {"count", 3}}},
            {"items", {{"a.glb", "a/", 1}, {"b", "b/", 2}}},
            {"errors", nlohmann::ordered_json::array({nlohmann::ordered_json::array({"b", "cut short"})})},
            {"plan", {{"shards", 3}}}}));
    EXPECT_NE(planHash(manifest.plan), planHash({{"shards", 4}}));
    const auto fault = [&](const std::string& patch) {
        std::ofstream(root / "shard.json") << whole.patch(nlohmann::json::parse(patch));
        const std::string who = root.string() + ": ",
                          said = faultOf([&] { readManifest(root, "shard.json"); });
        EXPECT_TRUE(said.starts_with(who)) << said;
        return said.substr(std::min(who.size(), said.size()));
    };
    const auto put = [&](const std::string& at, const std::string& value) {
        return fault(R"([{"op":"replace","path":")" + at + R"(","value":)" + value + "}]");
    };
    const std::string foreign =
        "is not the report of a shard (shard.json is not from diptych); give the folders that --shard I/N "
        "wrote";
    EXPECT_EQ(put("/schema", "2"), foreign);
    EXPECT_EQ(put("/software", "\"other\""), foreign);
    for (const auto& [at, value] : {std::pair{"/shard/count", "0"},
                                    {"/shard/count", "1000000000"},
                                    {"/shard/index", "0"},
                                    {"/shard/index", "4"},
                                    {"/items/0/2", "4"},
                                    {"/items/0/2", "0"}})
        EXPECT_NE(put(at, value), "") << at << value;
    EXPECT_TRUE(put("/items/1/1", "\"a/\"").ends_with("uses the folder of another scene"));
    for (const char* folder_name : {"b", "../b/", "/b/", "b/c/d\\n/"})
        EXPECT_TRUE(put("/items/1/1", std::string("\"") + folder_name + "\"")
                        .ends_with(" is not a folder name of diptych"))
            << folder_name;
}

// The scenes of a command by their place, and those of one shard.
TEST(Shards, ItemsAreThoseOfTheCommand) {
    const fs::path root = folder();
    std::ofstream(root / "a.gltf") << R"({"buffers":[{"uri":"a%20b.bin"},{"uri":"data:,x"}]})";
    std::ofstream(root / "a b.bin") << "12345";
    const std::string a = (root / "a.gltf").string();
    const std::vector<std::string> scenes{a, "builtin:gallery", "builtin:spheres"};
    const SceneItems all = itemsOf(scenes, true, "", {});
    ASSERT_EQ(all.all.size(), 3u);
    EXPECT_EQ(all.mine.size(), 3u);
    EXPECT_EQ(all.shard, (Shard{1, 1}));
    auto listed = nlohmann::ordered_json::array();
    listed.push_back(nlohmann::ordered_json::array({a, fs::file_size(a) + 5}));
    listed.push_back(nlohmann::ordered_json::array({"builtin:gallery", 0}));
    listed.push_back(nlohmann::ordered_json::array({"builtin:spheres", 0}));
    EXPECT_EQ(all.plan, (nlohmann::ordered_json{{"shards", 1}, {"scenes", listed}}));
    EXPECT_EQ(partOf(Item{"a", "a-1/", 1}), "a-1-scene");
    EXPECT_EQ(partOf(Item{"a", "", 1}), "scene");
    for (const Item& item : itemsOf(scenes, false, "", {}).all) EXPECT_EQ(item.folder, "");
    std::vector<std::string> once;
    for (const char* shard : {"1/2", "2/2"}) {
        const SceneItems part = itemsOf(scenes, true, shard, {});
        EXPECT_EQ(part.plan["shards"], 2);
        for (const Item* item : part.mine) {
            EXPECT_EQ(item->shard, part.shard.index);
            once.push_back(item->scene);
        }
    }
    std::ranges::sort(once);
    EXPECT_EQ(once, scenes);
    const nlohmann::ordered_json stamp = stampOf(a);
    EXPECT_EQ(stamp["scene"], a);
    ASSERT_EQ(stamp["files"].size(), 2u);
    EXPECT_EQ(stamp["files"][1][0], (root / "a b.bin").string());
    EXPECT_EQ(stamp["files"][1][1], 5);
    fs::remove(root / "a b.bin");
    EXPECT_EQ(stampOf(a)["files"][1], (nlohmann::ordered_json{(root / "a b.bin").string(), nullptr}));
}

// A scene's own fault lets others go on; the machine's ends the command.
TEST(Shards, OnlyAScenesOwnFaultIsItsError) {
    EXPECT_FALSE(attempt("a", [] {}));
    const std::optional<SceneError> error = attempt("a", [] { throw std::runtime_error("is cut short"); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->scene, "a");
    EXPECT_EQ(error->message, "is cut short");
    EXPECT_THROW(attempt("a", [] { throw std::system_error(28, std::generic_category()); }),
                 std::system_error);
    EXPECT_THROW(attempt("a", [] { throw std::logic_error("ours"); }), std::logic_error);
}

TEST(Shards, OfSeveralCommandsMostFoldersDecideThenTheFirst) {
    const fs::path root = folder();
    const auto shard = [&](const char* name, int index, int plan) {
        fs::create_directories(root / name);
        const Manifest manifest{
            buildName(), "compare", {{"shards", plan}}, {index, 3}, {{"a.glb", "a/", index}}, {}};
        std::ofstream(root / name / "shard.json") << textOf(manifest);
        return root / name;
    };
    const fs::path a = shard("a", 1, 7), b = shard("b", 2, 8), c = shard("c", 3, 8);
    EXPECT_EQ(choose({b, a}, "shard.json").manifest.plan["shards"], 7) << "in whatever order they are given";
    EXPECT_EQ(choose({a, b, c}, "shard.json").manifest.plan["shards"], 8);
    EXPECT_EQ(choose({a, b, c}, "shard.json").folders, (std::map<int, fs::path>{{2, b}, {3, c}}));
}

}  // namespace
}  // namespace diptych
