// SPDX-License-Identifier: MIT
// Our file formats, changed at random: every reader accepts any bytes or reports one line, and nothing
// outside the output is read or changed.
#include "compare/cli/command_line.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/files/diptych_files.h"
#include "compare/files/file_moves.h"
#include "compare/files/scene_folders.h"
#include "compare/output/writers.h"
#include "compare/report/trends.h"
#include "compare/tradeoff/plot.h"
#include "compare/tradeoff/sweep_state.h"
#include "compare/tradeoff/tables.h"
#include "compare/tradeoff/tradeoff.h"
#include "tests/fuzz/json_mutator.h"
#include "tests/support/shards_builder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// For every reader, on any bytes.
void expectALine(const std::function<void()>& read, const std::string& text) {
    try {
        read();
    } catch (const std::runtime_error& error) {
        const std::string line = error.what();
        EXPECT_FALSE(line.empty());
        EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos) << line;
        EXPECT_EQ(line.find("json.exception"), std::string::npos) << line << "\nof " << text.substr(0, 400);
        EXPECT_LT(line.size(), 8000u) << line.substr(0, 200);
    }
}

TEST(HostileFuzz, PartsOfAReport) {
    const Shards shards;
    fs::create_directory_symlink(shards.root, shards.shard / "link");
    ASSERT_EQ(::mkfifo((shards.shard / "fifo.png").c_str(), 0600), 0);
    const std::string sound = contentsOf(shards.part());
    const std::vector<std::string> before = shards.outside();
    fs::remove(shards.part());
    int joined = 0;
    for (unsigned seed = 0; seed < 150; ++seed) {
        const std::string text = fuzz::JsonMutator(seed).mutated(sound);
        std::ofstream(shards.part()) << text;
        expectALine([&] { joined += shards.merged().empty(); }, text);
    }
    EXPECT_GT(joined, 5) << "some edits change nothing that matters, and reach the writer";
    EXPECT_EQ(shards.outside(), before);
    EXPECT_EQ(contentsOf(shards.root / "secret.png"), "secret");
}

TEST(HostileFuzz, ManifestsOfShards) {
    const Shards shards;
    const std::string sound = contentsOf(shards.shard / "shard.json");
    const std::vector<std::string> before = shards.outside();
    for (unsigned seed = 0; seed < 50; ++seed) {
        const std::string text = fuzz::JsonMutator(seed).mutated(sound);
        std::ofstream(shards.shard / "shard.json") << text;
        expectALine([&] { shards::join({shards.shard}); }, text);
        expectALine([&] { shards::choose({shards.shard}, "shard.json"); }, text);
    }
    EXPECT_EQ(shards.outside(), before);
}

TEST(HostileFuzz, EarlierReports) {
    const Shards shards;
    const fs::path file = shards.shard / "report.json";
    const Report report = smallReport();
    const ReportPart part = readPart(shards.shard, "box-1/");
    const std::string sound = contentsOf(file);
    fs::remove(file);
    const cli::Command accept =
        cli::parseCommandLine({"accept", shards.shard, "-q", "-o", shards.root / "out/accepted.json"})
            .command;
    fs::create_directories(shards.root / "out");
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::string text = fuzz::JsonMutator(seed).mutated(sound);
        std::ofstream(file) << text;
        expectALine([&] { trendsSince(shards.shard, report, part.rows); }, text);
        expectALine([&] { shards::timingsOf(shards.shard); }, text);
        expectALine([&] { accept.run(); }, text);
        for (const std::string& name : manifestFiles(shards.shard, "report.json"))
            EXPECT_TRUE(isDiptychFileName(name)) << name;
    }
}

tradeoff::MeasuredRow smallRow() {
    tradeoff::MeasuredRow measured;
    measured.row.cameras.resize(1);
    measured.row.cameras[0].blocks = {{2, 1, 3, 5}};
    measured.row.cameras[0].passes = {{"shade", 1}};
    measured.row.cameras[0].measured.set(tradeoff::Measure::flip, tradeoff::Errors{0.1, 0.2, 0.3});
    joinBlocks(measured.row.cameras[0]);
    measured.row.measured = measured.row.cameras[0].measured;
    measured.row.warnings = {"a warning"};
    measured.image = measured.errors = Image8{1, 1, 3, {1, 2, 3}};
    return measured;
}

void makeOutputs(const tradeoff::Tradeoff& whole) {
    tradeoffHtml(whole);
    inCsv(csvTable(whole));
    tradeoffJson(whole);
    tradeoffEnd(whole);
    for (std::size_t metric = 0; metric < tradeoff::errorMetrics.size(); ++metric)
        tradeoffPlot(whole, metric, {}, PlotTarget::file);
}

// Through merge, and as a checkpointed row of a sweep, with all outputs made from it.
TEST(HostileFuzz, Tradeoffs) {
    using namespace tradeoff;
    const fs::path root = folder(), shard = root / "shard";
    std::ofstream(root / "secret.png") << "secret";
    MeasuredRow measured = smallRow();
    SweepState state(root / "swept", {{"schema", 1}, {"software", softwareName}});
    state.keep(measured);
    const fs::path row_file = state / (fs::path(measured.row.image).stem().string() + ".json");
    Tradeoff whole;
    whole.scene = "a";
    whole.cameras = {""};
    whole.rows = {measured.row};
    const shards::Manifest manifest{
        "build", "tradeoff", {{"asked", Json::object()}}, {1, 1}, {{"a", "a/", 1}, {"b", "b/", 1}}, {}};
    for (const char* scene : {"a", "b"}) {
        fs::create_directories(shard / scene);
        std::ofstream(shard / scene / "row-001.png") << "picture";
    }
    fs::create_directory_symlink(root, shard / "a/link");
    ASSERT_EQ(::mkfifo((shard / "fifo.png").c_str(), 0600), 0);
    Json swept = tradeoffJson(whole);
    swept["files"] = {"row-001.png", "tradeoff.json"};
    const std::string scene = swept.dump(2), list = textOf(manifest), row = contentsOf(row_file);
    std::ofstream(shard / "b/tradeoff.json") << scene;
    const cli::Command merge = cli::parseCommandLine({"merge", shard, "-q", "-o", root / "out"}).command;
    const auto outside = [&] {
        std::vector<std::string> files = filesIn(root);
        std::erase_if(files, [](const std::string& name) { return name.starts_with("out/"); });
        return files;
    };
    std::ofstream(shard / "a/tradeoff.json") << scene;
    std::ofstream(shard / "tradeoffs.json") << list;
    const std::vector<std::string> before = outside();
    int joined = 0, found = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        fuzz::JsonMutator mutator(seed);
        const bool of_scene = seed % 3 > 0;
        std::ofstream(shard / "a/tradeoff.json") << (of_scene ? mutator.mutated(scene) : scene);
        std::ofstream(shard / "tradeoffs.json") << (of_scene ? list : mutator.mutated(list));
        testing::internal::CaptureStderr();
        expectALine([&] { joined += merge.run() == 0; }, contentsOf(shard / "a/tradeoff.json"));
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_LE(std::ranges::count(said, '\n'), 1) << said;
        EXPECT_EQ(said.find("json.exception"), said.npos) << said;

        std::ofstream(row_file) << mutator.mutated(row);
        whole.rows.clear();
        if (const auto kept = state.find(measured.row.settings, 1, 2)) whole.rows = {*kept};
        if (whole.rows.empty()) continue;
        ++found;
        makeOutputs(whole);
    }
    EXPECT_GT(joined, 5);
    EXPECT_GT(found, 5);
    EXPECT_EQ(outside(), before);
    EXPECT_EQ(contentsOf(root / "secret.png"), "secret");
}

TEST(HostileFuzz, KeysAndPlansAndLists) {
    const fs::path root = folder();
    std::ofstream(root / "secret.png") << "secret";
    const Json key{{"schema", 1}, {"software", softwareName}, {"asked", {{"size", {1, 2}}}}};
    const std::string plan = R"({"files": ["a.png", "b/c.png"], "earlier": ["d.png"]})";
    const std::string list = "# scenes\nbuiltin:points\n  a b.glb # here\n@other\nfolder/**/*.gltf\n";
    for (unsigned seed = 0; seed < 50; ++seed) {
        fuzz::JsonMutator mutator(seed);
        fs::remove_all(root / ".out.kept");
        fs::create_directories(root / ".out.kept");
        const std::string kept = mutator.mutated(key.dump());
        std::ofstream(root / ".out.kept/key.json") << kept;
        std::ofstream(root / ".out.kept/part.json") << mutator.mutated(R"({"a": [1, 2, {"b": "c"}]})");
        expectALine([&] { CheckpointFolder(root / "out", "kept", key).find("part"); }, kept);

        fs::remove_all(root / "out");
        fs::create_directories(root / "out/.diptych.put");
        std::ofstream(root / "out/.diptych.put/a.png") << "new";
        const std::string moves = mutator.mutated(plan);
        std::ofstream(root / "out/.diptych.put/.plan.json") << moves;
        expectALine([&] { finishMoves(root / "out"); }, moves);

        std::string sentence = list;
        sentence.replace(seed % sentence.size(), 1 + seed % 5, mutator.mutated("[\"@list\", \"x\\n\"]"));
        std::ofstream(root / "list") << sentence;
        expectALine([&] { scenesOf({"@" + (root / "list").string()}); }, sentence);
    }
    EXPECT_EQ(contentsOf(root / "secret.png"), "secret");
}

}  // namespace
}  // namespace diptych
