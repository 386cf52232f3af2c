// SPDX-License-Identifier: MIT
// The benchmark's table by samples per pixel, with made-up times.
#include "compare/bench/findings.h"
#include "compare/render/sample_counts.h"
#include "tests/support/command_lines.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace diptych {
namespace {

using namespace bench;

BenchOptions sampleOptions(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"bench", "builtin:glass", "--table", "msaa"});
    return parsedAs<BenchOptions>(words);
}

std::string refusal(const std::vector<std::string>& words) {
    return faultOf([&] { makeBenchCases("builtin:glass", Settings(), sampleOptions(words)); });
}

TEST(BenchSamples, EachPathWithoutBlendedSurfacesAndWithThem) {
    const BenchCases cases = makeBenchCases("builtin:glass", Settings(), sampleOptions());
    ASSERT_EQ(cases.groups.size(), 1u);
    std::set<std::tuple<Path, Transparency, int>> rows;
    for (const Settings& s : cases.groups[0].settings) {
        rows.insert({s.path, s.transparency, s.msaa});
        EXPECT_EQ(s.assign, Settings().assign);
    }
    EXPECT_EQ(cases.groups[0].settings.size(), 12u);
    EXPECT_EQ(rows.size(), 12u) << "2 paths, 2 of blending, 3 of samples";
    EXPECT_TRUE(rows.contains({Path::deferred, Transparency::off, 8}));
    Settings requested;
    requested.transparency = Transparency::off;
    EXPECT_EQ(makeBenchCases("builtin:glass", requested, sampleOptions()).groups[0].settings.size(), 6u);
    const BenchOptions one = sampleOptions({"--paths", "forward_plus", "--assign", "tiled"});
    const BenchCases tiled = makeBenchCases("builtin:glass", Settings(), one);
    EXPECT_EQ(tiled.groups[0].settings.size(), 6u);
    for (const Settings& s : tiled.groups[0].settings) {
        EXPECT_EQ(s.path, Path::forward_plus);
        EXPECT_EQ(s.assign, Assignment::tiled);
    }
}

// Settings that only apply to MSAA are requested once; single-sample frames drop them.
TEST(BenchSamples, WhatSamplesAreForIsLeftToThem) {
    Settings requested;
    requested.msaa_shading = MsaaShading::sample;
    requested.msaa_edges = MsaaEdges::all;
    requested.resolve = Resolve::tonemapped;
    requested.pixel_lights = 3;  // has no effect either, but not because of the sample count
    for (const int samples : {1, 4, 8}) {
        const Settings sampled = withSamples(requested, samples);
        EXPECT_EQ(sampled.msaa, samples);
        EXPECT_EQ(sampled.msaa_shading == MsaaShading::sample, samples > 1);
        EXPECT_EQ(sampled.msaa_edges == MsaaEdges::all, samples > 1);
        EXPECT_EQ(sampled.resolve == Resolve::tonemapped, samples > 1);
        EXPECT_EQ(sampled.pixel_lights, 3);
    }
    requested.pixel_lights = Settings().pixel_lights;
    const BenchCases cases = makeBenchCases("builtin:glass", requested, sampleOptions());
    EXPECT_FALSE(cases.groups[0].settings.empty());
    for (const Settings& s : cases.groups[0].settings)
        EXPECT_EQ(s.msaa_shading == MsaaShading::sample, s.msaa > 1);
}

TEST(BenchSamples, WhatTheTableHasNoRowForIsRefused) {
    EXPECT_TRUE(refusal({"--assign", "tiled,clustered"}).starts_with("--table msaa: takes one --assign"));
    EXPECT_TRUE(refusal({"--transparencies", "sorted"}).starts_with("--transparencies: "));
    EXPECT_TRUE(refusal({"--paths", "deferred", "--assign", "per_object"}).starts_with("nothing to time"));
    EXPECT_EQ(refusal({}), "");
    EXPECT_THROW(benchTableOf("aa"), std::runtime_error);
}

BenchRow sampledRow(Path path, Transparency transparency, int samples, double ms, std::uint64_t bytes) {
    BenchRow made;
    made.settings.path = path;
    made.settings.transparency = transparency;
    made.settings.msaa = samples;
    made.settings.size = {64, 48};
    made.scene = "builtin:glass";
    made.measured[Measure::lights] = 4;
    made.measured.set(FrameTime{ms, ms - 1, ms + 2, 3});
    made.ms = {ms, ms - 1, ms + 2};
    made.passes = {{"shade earlier lights", 1}, {"assign lights", 10}, {"shade", ms / 2}};
    made.measured.set(FrameBytes{.gbuffer_per_pixel = bytes, .full_size_images = (bytes + 16) * 64 * 48});
    BenchOptions options;
    options.table = BenchTable::msaa;
    made.parts = partsOf(options, made.settings);
    return made;
}

// Deferred with blending and 4 samples exceeds the time limit.
Bench sampledBench() {
    Bench bench;
    bench.scene = "builtin:glass";
    bench.device = {"llvmpipe", "Mesa", "cpu"};
    bench.runs = 3;
    bench.options.table = BenchTable::msaa;
    for (const int samples : {1, 4}) {
        const auto n = static_cast<std::uint64_t>(samples);
        for (const Transparency transparency : {Transparency::off, Transparency::sorted}) {
            const double ms = 10 * samples + (transparency == Transparency::off ? 0 : 5);
            if (samples == 1 || transparency == Transparency::off)
                bench.rows.push_back(sampledRow(Path::deferred, transparency, samples, 2 * ms, 32 * n));
            bench.rows.push_back(sampledRow(Path::forward_plus, transparency, samples, ms, 4 * n));
        }
    }
    return bench;
}

TEST(BenchSamples, LinesArePathsAndColumnsSamples) {
    const Bench bench = sampledBench();
    const std::vector<SampleTable> tables = sampleTables(bench);
    ASSERT_EQ(tables.size(), 1u);
    const SampleTable& table = tables[0];
    EXPECT_EQ(table.columns, (std::set{1, 4}));
    ASSERT_EQ(table.lines.size(), 4u);
    EXPECT_EQ(table.lines[0].name(), "deferred, opaque only");
    EXPECT_EQ(table.lines[3].name(), "forward_plus, transparency sorted");
    EXPECT_EQ((*table.lines[1].cells.at(4))[Measure::ms], 40);
    EXPECT_EQ(table.lines[2].name(), "deferred, transparency sorted");
    EXPECT_EQ(table.lines[2].cells, (std::map<int, const BenchRow*>{{1, &bench.rows[2]}}));
    EXPECT_EQ(passMs(*table.lines[1].cells.at(4), "shade"), 1 + 20.0);
    EXPECT_EQ(bytesPerSample(*table.lines[0].cells.at(4)), 32u);
    Bench modes = bench;
    modes.options.table = BenchTable::modes;
    EXPECT_TRUE(sampleTables(modes).empty());
    EXPECT_TRUE(sampleBlocks(modes).empty());
}

// The paper's deferred renderer has 32 bytes per sample, too: 63, 253 and 506 MiB at 1920x1080.
TEST(BenchSamples, MemoryIsThatOfThePapersSize) {
    const std::vector<std::string> words = memoryText(sampleTables(sampledBench())[0]);
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0],
              "deferred stores 32, 32 B of G-buffer and depth per sample with 1, 4 samples per pixel: 63, "
              "253 MiB at 1920x1080");
    EXPECT_EQ(
        words[1],
        "forward_plus stores 4, 4 B of depth per sample with 1, 4 samples per pixel: 8, 32 MiB at 1920x1080");
    Bench eight;
    eight.options.table = BenchTable::msaa;
    eight.rows = {sampledRow(Path::deferred, Transparency::off, 8, 9, 8 * 32)};
    EXPECT_NE(memoryText(sampleTables(eight)[0])[0].find("506 MiB at 1920x1080"), std::string::npos);
}

TEST(BenchSamples, TextPageAndJsonHaveTheTable) {
    const Bench bench = sampledBench();
    const std::string text = benchEnd(bench), page = benchHtml(bench);
    for (const char* words : {"deferred, opaque only", "40 (39 to 42)", "4 samples", "B/pixel"}) {
        EXPECT_NE(text.find(words), std::string::npos) << text;
        EXPECT_NE(page.find(words), std::string::npos) << words;
    }
    EXPECT_NE(text.find(memoryText(sampleTables(bench)[0])[1] + "\n"), std::string::npos) << text;
    const nlohmann::json json = benchJson(bench);
    const auto& table = json["msaa_tables"][0];
    EXPECT_EQ(table["columns"], (nlohmann::json{1, 4}));
    EXPECT_EQ(table["rows"][1]["name"], "forward_plus, opaque only");
    const auto& cell = table["rows"][1]["cells"][1];
    EXPECT_EQ(cell["samples"], 4);
    EXPECT_EQ(cell["ms"]["median"], 40.0);
    EXPECT_EQ(cell["bytes_per_pixel"], 16);
    EXPECT_EQ(cell["bytes_per_sample"], 4);
    EXPECT_DOUBLE_EQ(cell["image_mib"].get<double>(), 32.0 * 64 * 48 / (1 << 20));
    EXPECT_EQ(table["rows"][2]["cells"].size(), 1u);
    EXPECT_EQ(json["rows"][3]["name"], "forward_plus, clustered, sorted, 1 sample");
}

// Frames with other sample counts show other images, so their times are not compared.
TEST(BenchSamples, ConclusionsCompareOneNumberOfSamples) {
    const Bench bench = sampledBench();
    const std::vector<Conclusion> all = conclusionsOf(bench);
    ASSERT_EQ(all.size(), 3u);
    for (const Conclusion& c : all) {
        EXPECT_EQ(c.faster->settings.msaa, c.slower->settings.msaa);
        EXPECT_EQ(c.faster->settings.transparency, c.slower->settings.transparency);
        EXPECT_EQ(c.faster->settings.path, Path::forward_plus);
    }
    EXPECT_NE(all[2].describe().find("forward_plus (clustered, off, 4 samples)"), std::string::npos)
        << all[2].describe();
}

// One table: two lines, of which one was timed with four samples alone.
Bench smallSampledBench() {
    Bench bench;
    bench.scene = "builtin:glass";
    bench.runs = 3;
    bench.options.table = BenchTable::msaa;
    bench.rows = {sampledRow(Path::deferred, Transparency::off, 4, 20, 128),
                  sampledRow(Path::forward_plus, Transparency::list, 1, 9, 4),
                  sampledRow(Path::forward_plus, Transparency::list, 4, 1234, 16)};
    for (BenchRow& row : bench.rows) row.ms.clear();
    return bench;
}

TEST(BenchSamples, TextIsWhole) {
    EXPECT_EQ(benchEnd(smallSampledBench()),
              "Samples per pixel: builtin:glass, 64x48, 4 lights\n"
              "                                                   1 sample                                   "
              "      4 samples                      \n"
              "                                 ms (min to max)  lighting ms      MiB  B/pixel      ms (min "
              "to max)  lighting ms      MiB  B/pixel\n"
              "deferred, opaque only                          -            -        -        -        20 (19 "
              "to 22)           11   0.4219      128\n"
              "forward_plus, transparency list      9 (8 to 11)          5.5  0.05859        4  1234 (1233 "
              "to 1236)          618  0.09375       16\n"
              "deferred stores 32 B of G-buffer and depth per sample with 4 samples per pixel: 253 MiB at "
              "1920x1080\n"
              "forward_plus stores 4, 4 B of depth per sample with 1, 4 samples per pixel: 8, 32 MiB at "
              "1920x1080\n");
    const std::string page = benchHtml(smallSampledBench());
    EXPECT_NE(page.find("<h2>Samples per pixel: builtin:glass, 64x48, 4 lights</h2>\n<div class=\"box scroll "
                        "rows\"><table><thead><tr>"),
              std::string::npos);
    EXPECT_NE(page.find("4 samples</th></tr>"), std::string::npos);
    EXPECT_NE(page.find("<p class=\"soft\">deferred stores 32 B"), std::string::npos);
}

TEST(BenchSamples, JsonIsWhole) {
    const nlohmann::ordered_json tables = benchJson(smallSampledBench())["msaa_tables"];
    const auto cell = [](const char* samples, const char* ms, const char* rest) {
        return "{\"samples\":" + std::string(samples) + ",\"ms\":{" + ms + "}," + rest + "}";
    };
    EXPECT_EQ(
        tables.dump(),
        R"([{"scene":"builtin:glass","size":[64,48],"lights":4,"columns":[1,4],"rows":[)"
        R"({"name":"deferred, opaque only","path":"deferred","transparency":"off","cells":[)" +
            cell("4", R"("median":20.0,"min":19.0,"max":22.0)",
                 R"("lighting_ms":11.0,"image_mib":0.421875,"bytes_per_pixel":128,"bytes_per_sample":32)") +
            R"(]},{"name":"forward_plus, transparency list","path":"forward_plus","transparency":"list",)"
            R"("cells":[)" +
            cell("1", R"("median":9.0,"min":8.0,"max":11.0)",
                 R"("lighting_ms":5.5,"image_mib":0.05859375,"bytes_per_pixel":4,"bytes_per_sample":4)") +
            "," +
            cell("4", R"("median":1234.0,"min":1233.0,"max":1236.0)",
                 R"("lighting_ms":618.0,"image_mib":0.09375,"bytes_per_pixel":16,"bytes_per_sample":4)") +
            R"(]}],"memory":["deferred stores 32 B of G-buffer and depth per sample with 4 samples per )"
            R"(pixel: 253 MiB at 1920x1080","forward_plus stores 4, 4 B of depth per sample with 1, 4 )"
            R"(samples per pixel: 8, 32 MiB at 1920x1080"]}])");
}

// A size, a scene and a light count have tables of their own; what differs otherwise is a line.
TEST(BenchSamples, EachSizeSceneAndLightCountHasATable) {
    Bench bench = smallSampledBench();
    bench.rows.resize(4, bench.rows[0]);
    bench.rows[1].settings.size.width = 65;
    bench.rows[2].scene = "builtin:hall";
    bench.rows[3].measured[Measure::lights] = 5;
    bench.rows.push_back(bench.rows[0]);
    bench.rows.back().settings.path = Path::forward_plus;
    const std::vector<SampleTable> tables = sampleTables(bench);
    ASSERT_EQ(tables.size(), 4u);
    EXPECT_EQ(tables[0].lines.size(), 2u);
    EXPECT_EQ(tables[1].size, (Size{65, 48}));
    EXPECT_EQ(tables[2].scene, "builtin:hall");
    EXPECT_EQ(tables[2].columns, std::set{4});
    EXPECT_EQ(tables[3].lights, 5u);
    EXPECT_EQ(tables[3].lines.at(0).cells.at(4), &bench.rows[3]);
}

}  // namespace
}  // namespace diptych
