// SPDX-License-Identifier: MIT
// Benchmarks through the whole program.
#include "tests/tool/page_builder.h"
#include "tests/tool/sweep.h"

#include <regex>
#include <set>

namespace diptych {
namespace {

// A high limit, so that no frame is too slow on a busy machine.
constexpr const char* benchTriangle =
    "bench builtin:triangle --sizes 32x24,16x12 --assign every --runs 2 --max-ms 1e6 ";

TEST(Bench, LeavesTableJsonPlotAndPage) {
    const Folder folder;
    const Ran ran = runTool(folder, std::string(benchTriangle) + "--light-counts 1,4,16 --json -q -o b");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(ran.out, contentsOf(folder / "b/bench.json")) << "--json prints it and nothing else";
    const Json bench = readJson(folder / "b/bench.json");
    std::set<std::string> listed, there;
    for (const Json& name : bench["files"]) listed.insert(name);
    for (const auto& entry : fs::directory_iterator(folder / "b")) there.insert(entry.path().filename());
    EXPECT_EQ(listed, there);
    EXPECT_EQ(there, (std::set<std::string>{"bench.json", "bench.svg", "index.html", "rows.csv"}));
    ASSERT_EQ(bench["rows"].size(), 12u) << "2 paths, 2 sizes, 3 counts";
    std::set<int> lights;
    for (const Json& row : bench["rows"]) {
        EXPECT_EQ(row["ms"]["runs"], 2);
        EXPECT_GT(row["ms"]["min"], 0);
        EXPECT_LE(row["ms"]["min"], row["ms"]["median"]);
        EXPECT_LE(row["ms"]["median"], row["ms"]["max"]);
        EXPECT_FALSE(row["passes"].empty());
        EXPECT_EQ(row["counters"]["lights"], row["light_count"].get<int>() + 1) << "and the sun";
        EXPECT_EQ(row["counters"]["nonfinite_pixels"], 0);
        EXPECT_GE(row["assign_share"], 0);
        EXPECT_LE(row["assign_share"], 1);
        lights.insert(row["light_count"].get<int>());
    }
    EXPECT_EQ(lights, (std::set<int>{1, 4, 16}));
    // Its own folder may be replaced, a foreign one may not.
    EXPECT_EQ(runTool(folder, std::string(benchTriangle) + "--light-counts 1 --kernels off -q -o b").code, 0)
        << "which scripts say";
    folder.write("other/note.txt", "mine");
    EXPECT_TRUE(runTool(folder, std::string(benchTriangle) + "-o other").failedOver("-o other"));
}

TEST(Bench, GrowthIsDrawnUntilItIsTooMuch) {
    const Folder folder;
    const std::string growth = "bench --table growth --size 16x12 --runs 1 --shadows off -q -o b ";
    ASSERT_EQ(runTool(folder, growth + "--axes lights --max-ms 1e6").code, 0);
    const Json lights = readJson(folder / "b/bench.json");
    ASSERT_EQ(lights["growth"]["lines"].size(), 2u) << "a line a path";
    for (const Json& line : lights["growth"]["lines"]) {
        ASSERT_EQ(line["points"].size(), 7u);
        EXPECT_EQ(line["points"][6]["value"], 65536);
        EXPECT_GT(line["points"][6]["mib"], line["points"][0]["mib"]) << "lights take memory";
    }
    EXPECT_EQ(lights["growth"]["words"].size(), 4u);
    EXPECT_NE(contentsOf(folder / "b/bench.svg").find("memory on the device"), std::string::npos);
    EXPECT_NE(contentsOf(folder / "b/index.html").find("How time and memory grow"), std::string::npos);
    // Above the limit, larger configurations are neither tried nor loaded.
    ASSERT_EQ(runTool(folder, growth + "--axes instances,triangles --max-ms 1e-6").code, 0);
    const Json slow = readJson(folder / "b/bench.json");
    EXPECT_TRUE(slow["rows"].empty());
    EXPECT_EQ(slow["skipped"].size(), 4u) << slow["skipped"];
    EXPECT_TRUE(runTool(folder, growth + "--axes time").failedOver("--axes time: takes triangles, draws"));
    EXPECT_TRUE(runTool(folder, growth + "--sizes 8x8").failedOver("--table growth: takes no"));
    EXPECT_TRUE(runTool(folder, "bench --axes lights").failedOver("--axes: needs --table growth"));
}

TEST(Bench, SkipsWithAReasonWhatIsNotDrawnOrTooSlow) {
    const Folder folder;
    const Ran ran = runTool(folder,
                            "bench builtin:triangle --size 16x12 --runs 1 --paths deferred "
                            "--assign every,per_object --light-counts 1,2 --max-ms 1e-6 -o b");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json bench = readJson(folder / "b/bench.json");
    EXPECT_TRUE(bench["rows"].empty());
    ASSERT_EQ(bench["skipped"].size(), 3u) << bench["skipped"];
    EXPECT_EQ(bench["skipped"][0]["assign"], "per_object");
    EXPECT_NE(bench["skipped"][1]["reason"].get<std::string>().find("its first frame took"),
              std::string::npos);
    EXPECT_NE(
        bench["skipped"][2]["reason"].get<std::string>().find("already over --max-ms 1e-06 with 1 light"),
        std::string::npos);
    EXPECT_NE(ran.out.find("\ndeferred, every, 16x12, 2 lights: already over --max-ms 1e-06"),
              std::string::npos)
        << ran.out;
    EXPECT_FALSE(fs::exists(folder / "b/bench.svg")) << "nothing to plot";
}

TEST(Bench, KernelsHaveATable) {
    const Folder folder;
    const Ran ran = runShell(folder, "'" DIPTYCH_BINARY_DIR "/tests/bench_kernels' 1", folder.path());
    ASSERT_EQ(ran.code, 0) << ran.err;
    for (const char* row :
         {"kernel +ns +ratio to CPU +goal\n", "texel buffer, as the paths read it +-?\\d+\\.\\d+ ",
          "storage buffer, divergent base +-?\\d+\\.\\d+ "})
        EXPECT_TRUE(std::regex_search(ran.out, std::regex(row))) << row << ran.out;
    EXPECT_EQ(runShell(folder, "'" DIPTYCH_BINARY_DIR "/tests/bench_kernels' none", folder.path()).code, 2);
}

// Every sample count of the device, without blended surfaces and, if the scene has some, with them.
TEST(Bench, BySamplesAPixel) {
    const Folder folder;
    const auto table = [&](const std::string& scene) {
        const Ran ran = runTool(folder, "bench " + scene +
                                            " --table msaa --paths forward_plus --size 33x17 --runs 1 "
                                            "--shadows off --max-ms 1e6 -q --force -o b");
        EXPECT_EQ(ran.code, 0) << ran.err;
        const Json bench = readJson(folder / "b/bench.json");
        EXPECT_EQ(bench["msaa_tables"].size(), 1u);
        return bench["msaa_tables"][0];
    };
    const Json glass = table("builtin:glass");
    ASSERT_EQ(glass["rows"].size(), 2u);
    EXPECT_EQ(glass["rows"][0]["transparency"], "off");
    EXPECT_EQ(glass["rows"][1]["transparency"], "sorted");
    EXPECT_EQ(glass["columns"][0], 1);
    EXPECT_EQ(glass["columns"][1], 4);
    for (const Json& row : glass["rows"])
        for (const Json& cell : row["cells"]) {
            const int samples = cell["samples"];
            EXPECT_EQ(cell["bytes_per_pixel"], 4 * samples) << "depth";
            // Depth and light of each sample, plus resolved light with MSAA.
            const int image = (4 + 16) * samples + (samples > 1 ? 16 : 0);
            EXPECT_DOUBLE_EQ(cell["image_mib"].get<double>() * (1 << 20), 33.0 * 17 * image);
            EXPECT_GT(cell["lighting_ms"].get<double>(), 0);
            EXPECT_LE(cell["ms"]["min"], cell["ms"]["median"]);
        }
    const Json solid = table("builtin:triangle");
    ASSERT_EQ(solid["rows"].size(), 1u) << "nothing blends";
    EXPECT_EQ(solid["rows"][0]["cells"].size(), solid["columns"].size());
}

// The stored bytes are known: layers by G-buffer alone, and nothing where forward draws all.
TEST(Bench, LayersByWhatTheyCover) {
    const Folder folder;
    const Ran ran = runTool(folder,
                            "bench --table layers --light-counts 4 --size 32x18 --runs 1 --shadows off "
                            "--max-ms 1e6 -o b");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json bench = readJson(folder / "b/bench.json");
    EXPECT_EQ(bench["rows"].size(), 39u);
    for (const Json& row : bench["rows"]) EXPECT_EQ(row["counters"]["nonfinite_pixels"], 0);
    const Json rows = bench["layers"]["rows"];
    ASSERT_EQ(rows.size(), 13u) << "4 kinds by 3 shares, and none";
    ASSERT_EQ(rows[0]["percent"], 0);
    const int depth = rows[0]["ways"][0]["bytes_per_pixel"], plain = rows[0]["ways"][1]["bytes_per_pixel"];
    for (const Json& row : rows) {
        ASSERT_EQ(row["ways"].size(), 3u) << row;
        for (const Json& way : row["ways"]) EXPECT_LE(way["ms"]["min"], way["ms"]["median"]);
        EXPECT_EQ(row["ways"][0]["bytes_per_pixel"], depth);
        const int stored = row["ways"][1]["bytes_per_pixel"], apart = row["ways"][2]["bytes_per_pixel"];
        const bool solid = row["covered"] != "" && row["covered"] != "glass";
        EXPECT_EQ(stored > plain, solid) << row;
        EXPECT_EQ(apart, solid && row["percent"] == 100 ? depth : plain) << row;
    }
    EXPECT_FALSE(bench["layers"]["words"].empty());
    for (const Json& words : bench["layers"]["words"])
        EXPECT_NE(ran.out.find(words.get<std::string>()), std::string::npos) << ran.out;
    EXPECT_NE(contentsOf(folder / "b/bench.svg").find("covered, %"), std::string::npos);
    EXPECT_NE(contentsOf(folder / "b/index.html").find("Where each way is the fastest"), std::string::npos);
}

TEST(Bench, WhatItCannotDoIsNamed) {
    const Folder folder;
    EXPECT_TRUE(runTool(folder, "bench --runs 0").failedOver("--runs 0"));
    EXPECT_TRUE(runTool(folder, "bench a.glb b.glb").failedOver("b.glb: bench takes one scene"));
    EXPECT_TRUE(runTool(folder, "bench --camera 0 --camera 1").failedOver("--camera"));
    EXPECT_TRUE(runTool(folder, "bench --path reference").failedOver("--path reference"));
    EXPECT_TRUE(runTool(folder, "bench -o x.png").failedOver("-o x.png"));
    EXPECT_TRUE(
        runTool(folder, "bench --table area").failedOver("--table area: takes modes, msaa, growth or"));
    EXPECT_TRUE(runTool(folder, "bench --compile-on vega10").failedOver("--compile-on: bench needs --table"));
    EXPECT_TRUE(runTool(folder, "bench --paths deferred --assign per_object").failedOver("nothing to time"));
    EXPECT_FALSE(fs::exists(folder / "diptych-bench"));
}

// Lines and bars, on a phone: every label is inside its plot, and no two legend entries overlap.
TEST(Bench, PlotsFitAPhone) {
    SKIP_WITHOUT_BROWSER();
    for (const std::string counts : {"1,4", "4"}) {
        const Folder folder;
        const Ran ran = runTool(folder,
                                "bench builtin:triangle --size 16x12 --runs 1 --max-ms 1e6 --kernels off -q "
                                "--light-counts " +
                                    counts + " -o b");
        ASSERT_EQ(ran.code, 0) << ran.err;
        const Visit seen = visit(folder, folder / "b/index.html", R"(
  document.documentElement.style.width = '390px'; await wait(100);
  const plot = $('svg.chart').getBoundingClientRect();
  const boxes = $$('svg.chart text').map(text => [text.textContent, text.getBoundingClientRect()]);
  const out = boxes.filter(([, b]) => b.left < plot.left || b.right > plot.right || b.bottom > plot.bottom)
    .map(([t]) => t);
  const legend = boxes.filter(([t, b]) => b.top > plot.bottom - 130);
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top + 2 < b.bottom && b.top + 2 < a.bottom;
  const over = legend.filter(([t, a], i) => legend.some(([, b], k) => k < i && meet(a, b))).map(([t]) => t);
  tell({ width: plot.width, words: boxes.length, out, over });)",
                                 "", 390);
        ASSERT_TRUE(seen.told.is_object()) << seen.told;
        EXPECT_LE(seen.told["width"].get<double>(), 390) << counts;
        EXPECT_GT(seen.told["words"], 10);
        EXPECT_EQ(seen.told["out"], Json::array()) << counts;
        EXPECT_EQ(seen.told["over"], Json::array()) << counts;
    }
}

}  // namespace
}  // namespace diptych
