// SPDX-License-Identifier: MIT
// The benchmark's table of layers, with made-up times.
#include "compare/bench/findings.h"
#include "compare/bench/registers.h"
#include "shared/scene/builtin/builtin.h"
#include "tests/support/command_lines.h"
#include "tests/support/errors.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace diptych {
namespace {

using namespace bench;

BenchOptions layerOptions(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"bench", "--table", "layers"});
    return parsedAs<BenchOptions>(words);
}

std::string layerRefusal(const std::vector<std::string>& words) {
    return faultOf([&] { makeBenchCases("builtin:gallery", Settings(), layerOptions(words)); });
}

TEST(BenchLayers, EachKindAndFractionIsTimedUnderEachLightCountInThreeWays) {
    const BenchOptions options = layerOptions();
    const BenchCases cases = makeBenchCases("builtin:gallery", Settings(), options);
    std::set<std::tuple<std::string_view, int, std::uint32_t>> groups;
    for (const BenchGroup& group : cases.groups) {
        groups.insert({group.cover->kind, group.cover->percent, *group.lights});
        std::vector<std::string> names;
        for (const Settings& s : group.settings) names.push_back(modeName(s, partsOf(options, s)));
        EXPECT_EQ(names, (std::vector<std::string>{"deferred, clustered, layers gbuffer",
                                                   "deferred, clustered, layers forward",
                                                   "forward_plus, clustered"}));
    }
    EXPECT_EQ(cases.groups.size(), 39u) << "4 kinds by 3 shares, and none of them once, by 3 light counts";
    EXPECT_EQ(groups.size(), 39u);
    EXPECT_TRUE(groups.contains({"", 0, 1u}) && groups.contains({"glass", 100, 1024u}));
    const auto settingsOf = [](const std::vector<std::string>& words) {
        return makeBenchCases("builtin:gallery", Settings(), layerOptions(words)).groups[0].settings;
    };
    ASSERT_EQ(settingsOf({"--paths", "forward_plus"}).size(), 1u);
    EXPECT_EQ(settingsOf({"--assign", "tiled"})[2].assign, Assignment::tiled);
    EXPECT_EQ(makeBenchCases("", Settings(), layerOptions({"--light-counts", "4,16"})).groups.size(), 26u);
}

// The scene holds what the row says.
TEST(BenchLayers, EveryGroupHasItsSceneAndAName) {
    const std::set<std::pair<std::string, std::uint32_t>> layers{{"", 0},
                                                                 {"coated", gpu::LAYER_CLEARCOAT},
                                                                 {"woven", gpu::LAYER_SHEEN},
                                                                 {"brushed", gpu::LAYER_ANISOTROPY},
                                                                 {"glass", gpu::LAYER_TRANSMISSION}};
    for (const BenchGroup& group : makeBenchCases("", Settings(), layerOptions()).groups) {
        ASSERT_TRUE(group.scene.starts_with("builtin:"));
        const Scene scene = makeBuiltin(group.scene.substr(8));
        EXPECT_EQ(scene.lights.size(), *group.lights) << group.scene;
        std::uint32_t all = 0;
        std::size_t tiles = 0;
        for (const Node& node : scene.nodes) {
            const int material = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].material;
            const std::uint32_t own = layersOf(scene.materials[static_cast<std::size_t>(material)]);
            all |= own;
            tiles += own != 0;
        }
        EXPECT_TRUE(layers.contains({std::string(group.cover->kind), all})) << group.scene;
        EXPECT_EQ(tiles, static_cast<std::size_t>(4 * group.cover->percent)) << group.scene;
    }
    EXPECT_EQ(coverName({}), "no layers");
    EXPECT_EQ(coverName({"woven", 5}), "5 % woven");
    BenchRow skip;
    skip.requested_lights = 64;
    skip.cover = Cover{"glass", 25};
    skip.settings.path = Path::deferred;
    skip.settings.assign = Assignment::tiled;
    skip.settings.size = {0, 0};
    EXPECT_EQ(skipName(skip), "deferred, tiled, 64 lights, 25 % glass");
}

TEST(BenchLayers, WhatTheTableHasNoColumnForIsRefused) {
    EXPECT_TRUE(layerRefusal({"--assign", "tiled,every"}).starts_with("--table layers: takes one --assign"));
    for (const auto& [list, value] :
         {std::pair{"--sizes", "8x8"}, {"--transparencies", "sorted"}, {"--lightings", "compute"}})
        EXPECT_TRUE(layerRefusal({list, value}).starts_with("--table layers: takes no --sizes")) << list;
    EXPECT_TRUE(layerRefusal({"--axes", "lights"}).starts_with("--axes: needs --table growth"));
    EXPECT_TRUE(layerRefusal({"--assign", "per_object"}).find("per_object") != std::string::npos);
    EXPECT_EQ(layerRefusal({}), "");
}

using Milliseconds = std::vector<double>;

// Adds the ways of a row: forward+, deferred by G-buffer, deferred by forward. Empty: not timed.
void addWays(Bench& bench, const Cover& cover, std::uint32_t lights, const std::vector<Milliseconds>& ways) {
    for (std::size_t way = 0; way < ways.size(); ++way) {
        if (ways[way].empty()) continue;
        BenchRow row;
        row.settings.path = layerWays.at(way).path();
        row.settings.layers = layerWays.at(way).layers;
        row.settings.size = {64, 36};
        row.requested_lights = lights;
        row.measured[Measure::lights] = lights;
        row.cover = cover;
        row.ms = ways[way];
        Milliseconds sorted = row.ms;
        std::ranges::sort(sorted);
        row.measured.set(FrameTime{sorted[sorted.size() / 2], sorted.front(), sorted.back(),
                                   static_cast<int>(sorted.size())});
        const std::uint64_t stored = way == 0 ? 4u : way == 1 && !cover.kind.empty() ? 28u : 24u;
        row.measured.set(
            FrameBytes{.gbuffer_per_pixel = stored, .full_size_images = (stored + 16) * 64 * 36});
        row.parts = partsOf(bench.options, row.settings);
        bench.rows.push_back(std::move(row));
    }
}

Milliseconds always(double ms) {
    return Milliseconds(6, ms);
}

Bench layerBench() {
    Bench bench;
    bench.scene = "layers";
    bench.options.table = BenchTable::layers;
    const Milliseconds a{20, 22, 18, 20, 22, 18}, b{22, 18, 20, 22, 18, 20}, c{18, 20, 22, 18, 20, 22};
    addWays(bench, {}, 1, {a, b, c});
    addWays(bench, {"coated", 5}, 1, {always(10), always(14), always(12)});
    addWays(bench, {"coated", 5}, 64, {always(30), a, b});
    addWays(bench, {"coated", 25}, 1, {always(10), always(13), always(15)});
    addWays(bench, {"coated", 25}, 64, {always(30), always(20), always(26)});
    return bench;
}

TEST(BenchLayers, ARowHasThreeWaysAndItsFastest) {
    const Bench bench = layerBench();
    const std::vector<LayerRow> rows = layerRows(bench);
    ASSERT_EQ(rows.size(), 5u);
    using Ways = std::vector<std::size_t>;
    EXPECT_EQ(rows[0].fastest, (Ways{0, 1, 2})) << "nothing differs";
    EXPECT_EQ(rows[0].lead, 0);
    EXPECT_EQ(rows[1].cover, (Cover{"coated", 5}));
    EXPECT_EQ(rows[1].lights, 1u);
    EXPECT_EQ(rows[1].fastest, Ways{0});
    EXPECT_DOUBLE_EQ(rows[1].lead, 1.2) << "of the next, not of the slowest";
    EXPECT_EQ(rows[2].fastest, (Ways{1, 2})) << "these two scatter around each other";
    EXPECT_EQ(rows[4].fastest, Ways{1});
    EXPECT_EQ(rows[4].ways[2]->settings.layers, Layers::forward);
    EXPECT_EQ(rows[4].ways[0]->settings.path, Path::forward_plus);
    EXPECT_TRUE(conclusionsOf(bench).empty()) << "layersInWords() replaces them";

    Bench few;
    few.options.table = BenchTable::layers;
    addWays(few, {}, 1, {{10, 10, 10}, {20, 20, 20}, {}});
    addWays(few, {}, 64, {{}, always(10), {}});
    addWays(few, {}, 1024, {always(10), {}, always(20)});
    const std::vector<LayerRow> some = layerRows(few);
    EXPECT_EQ(some[0].fastest, (Ways{0, 1})) << "three rounds prove nothing";
    EXPECT_EQ(some[0].ways[2], nullptr);
    EXPECT_TRUE(some[1].fastest.empty()) << "nothing to compare with";
    EXPECT_EQ(some[2].fastest, Ways{0});
    EXPECT_TRUE(std::regex_search(benchEnd(few), std::regex("no layers +64  - +-"))) << benchEnd(few);
    EXPECT_TRUE(layerRows(Bench()).empty());
}

TEST(BenchLayers, SaysWhereEachWayWins) {
    EXPECT_EQ(
        layersText(layerBench()),
        (std::vector<std::string>{
            "forward_plus is the fastest in 2 of 5 rows (the next takes up to 1.30 times as long: 25 % "
            "coated, 1 light): 5, 25 % coated under 1 light",
            "deferred by G-buffer is the fastest in 1 of 5 rows (the next takes up to 1.30 times as "
            "long: 25 % coated, 64 lights): 25 % coated under 64 lights",
            "deferred by G-buffer and deferred by forward are the fastest, without a significant "
            "difference between them, in 1 of 5 rows: 5 % coated under 64 lights",
            "no significant difference between the ways in 1 of 5 rows: no layers under 1 light",
            "forward_plus stores 4 bytes per pixel of depth; all its images 20",
            "deferred by G-buffer stores 24 to 28 bytes per pixel of G-buffer and depth; all its images "
            "40 to 44",
            "deferred by forward stores 24 bytes per pixel of G-buffer and depth; all its images 40"}));
    Bench wide;
    wide.options.table = BenchTable::layers;
    for (const Cover& cover :
         {Cover(), Cover{"woven", 5}, Cover{"woven", 100}, Cover{"glass", 5}, Cover{"glass", 100}})
        for (const std::uint32_t lights : {1u, 64u}) addWays(wide, cover, lights, {always(1), always(2), {}});
    EXPECT_TRUE(layersText(wide)[0].ends_with(
        ": no layers under 1, 64 lights; 5, 100 % woven, glass under 1, 64 lights"))
        << layersText(wide)[0];
}

TEST(BenchLayers, TextPageJsonAndPlotHaveTheTable) {
    Bench bench = layerBench();
    EXPECT_EQ(benchEnd(bench).find("VGPRs"), std::string::npos) << "no compiler was asked";
    bench.compiler = "a GPU";
    bench.rows[3].registers = {{"shade", 64, 96}};                            // 5 % coated: forward_plus
    bench.rows[5].registers = {{"shade", 64, 64}, {"shade layers", 96, 96}};  // deferred by forward
    const std::string text = benchEnd(bench), page = benchHtml(bench);
    for (const char* words :
         {"deferred by G-buffer", "5 % coated", "20 (18 to 22)", "64 to 96", "64; 96", "a GPU",
          "no significant difference", "deferred by G-buffer or deferred by forward"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
        EXPECT_NE(page.find(words), std::string::npos) << words;
    }
    for (const std::string& words : layersText(bench)) EXPECT_NE(text.find(words + "\n"), std::string::npos);
    const auto json = nlohmann::json(benchJson(bench))["layers"];
    EXPECT_EQ(json["compiler"], "a GPU");
    ASSERT_EQ(json["rows"].size(), 5u);
    const auto& row = json["rows"][1];
    EXPECT_EQ(row["covered"], "coated");
    EXPECT_EQ(row["percent"], 5);
    EXPECT_EQ(row["lights"], 1);
    EXPECT_EQ(row["fastest"], nlohmann::json::array({"forward_plus"}));
    EXPECT_EQ(row["ways"][2]["name"], "deferred by forward");
    EXPECT_EQ(row["ways"][2]["ms"]["median"], 12.0);
    EXPECT_EQ(row["ways"][1]["bytes_per_pixel"], 28);
    EXPECT_EQ(row["ways"][1]["image_bytes_per_pixel"], 44);
    EXPECT_EQ(row["ways"][2]["registers"][1]["pass"], "shade layers");
    EXPECT_EQ(row["ways"][0]["registers"][0]["most"], 96.0);
    EXPECT_EQ(json["words"].size(), 7u);
    // A panel per light count; in each a line per way.
    const std::string plot = benchPlot(bench, PlotTarget::file);
    EXPECT_EQ(countOf(plot, ">covered, %<"), 2u);
    EXPECT_EQ(countOf(plot, "class=\"trace\" d=\""), 2u * 3 + 3) << "and in the legend";
    EXPECT_EQ(countOf(plot, "series deferred v1\""), 3u);
    EXPECT_EQ(countOf(plot, "deferred by forward, 25 % coated: 26 (26 to 26) ms"), 1u);
}

// One row with registers, and one whose way alone was timed.
Bench smallLayerBench() {
    Bench bench;
    bench.scene = "layers";
    bench.options.table = BenchTable::layers;
    addWays(bench, {"coated", 5}, 1, {always(10), always(1400), {}});
    addWays(bench, {}, 64, {{}, {}, always(3)});
    bench.rows[0].registers = {{"shade", 64, 96}, {"transmission", 48, 48}};
    return bench;
}

TEST(BenchLayers, TextIsWhole) {
    Bench bench = smallLayerBench();
    bench.compiler = "a GPU";
    EXPECT_EQ(benchEnd(bench),
              "Where each way is the fastest\n"
              "  forward_plus is the fastest in 1 of 2 rows (the next takes up to 140.00 times as long: 5 % "
              "coated, 1 light): 5 % coated under 1 light\n"
              "  forward_plus stores 4 bytes per pixel of depth; all its images 20\n"
              "  deferred by G-buffer stores 28 bytes per pixel of G-buffer and depth; all its images 44\n"
              "  deferred by forward stores 24 bytes per pixel of G-buffer and depth; all its images 40\n"
              "                                                    forward_plus                              "
              "      deferred by G-buffer                            deferred by forward              \n"
              "covered     lights  fastest       ms (min to max)  B/pixel  all B/pixel         VGPRs      ms "
              "(min to max)  B/pixel  all B/pixel  VGPRs  ms (min to max)  B/pixel  all B/pixel  VGPRs\n"
              "5 % coated       1  forward_plus    10 (10 to 10)        4           20  64 to 96; 48  1400 "
              "(1400 to 1400)       28           44      -                -        -            -      -\n"
              "no layers       64  -                           -        -            -             -         "
              "           -        -            -      -       3 (3 to 3)       24           40      -\n"
              "B/pixel: of G-buffer and depth, and of all images of the picture's size; fastest: by a sign "
              "test of frames of the same round; "
              "VGPRs: vector registers per lane of the pipelines that shade, pass after pass, by the "
              "compiler of a GPU\n");
    const std::string page = benchHtml(bench);
    for (const char* part : {"<div class=\"box says\"><ul><li>forward_plus is the fastest",
                             "rows\"><table><thead>", "<p class=\"soft small\">B/pixel: of G-buffer"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(BenchLayers, JsonIsWhole) {
    Bench bench = smallLayerBench();
    bench.compiler = "a GPU";
    nlohmann::ordered_json json = benchJson(bench)["layers"];
    EXPECT_EQ(json["words"], layersText(bench));
    json.erase("words");
    EXPECT_EQ(json.dump(),
              R"({"compiler":"a GPU","rows":[{"covered":"coated","percent":5,"lights":1,"ways":[)"
              R"({"name":"forward_plus","ms":{"median":10.0,"min":10.0,"max":10.0},"bytes_per_pixel":4,)"
              R"("image_bytes_per_pixel":20,"registers":[{"pass":"shade","least":64.0,"most":96.0},)"
              R"({"pass":"transmission","least":48.0,"most":48.0}]},)"
              R"({"name":"deferred by G-buffer","ms":{"median":1400.0,"min":1400.0,"max":1400.0},)"
              R"("bytes_per_pixel":28,"image_bytes_per_pixel":44,"registers":[]}],)"
              R"("fastest":["forward_plus"],"lead":140.0},)"
              R"({"covered":"","percent":0,"lights":64,"ways":[)"
              R"({"name":"deferred by forward","ms":{"median":3.0,"min":3.0,"max":3.0},"bytes_per_pixel":24,)"
              R"("image_bytes_per_pixel":40,"registers":[]}],"fastest":[],"lead":0.0}]})");
}

// Rows of a table stand together; the same cover and lights later on are another row.
TEST(BenchLayers, ARowEndsWhereCoverOrLightsChange) {
    Bench bench;
    bench.options.table = BenchTable::layers;
    for (const auto& [cover, lights] : {std::pair{Cover{"woven", 5}, 1u},
                                        {Cover{"woven", 5}, 1u},
                                        {Cover{"woven", 25}, 1u},
                                        {Cover{"glass", 25}, 1u},
                                        {Cover{"glass", 25}, 64u}})
        addWays(bench, cover, lights, {always(1), always(2), {}});
    EXPECT_EQ(layerRows(bench).size(), 4u);
    bench.rows[0].cover.reset();
    EXPECT_EQ(layerRows(bench).size(), 4u) << "of no cover, no row";
    // Three ways with one leader: the lead is over the nearest. A doubtful difference is none.
    Bench lead;
    lead.options.table = BenchTable::layers;
    addWays(lead, {}, 1, {always(15), always(10), {11, 12, 11, 10, 11, 11}});
    const LayerRow row = layerRows(lead).at(0);
    EXPECT_EQ(row.fastest, (std::vector<std::size_t>{1, 2})) << "one frame was as fast";
    EXPECT_DOUBLE_EQ(row.lead, 1.5);
    EXPECT_EQ(row.fastestNames(), (std::vector<std::string>{"deferred by G-buffer", "deferred by forward"}));
}

TEST(BenchLayers, AllCasesAreInThisOrder) {
    const BenchCases cases = makeBenchCases("", Settings(), layerOptions({"--light-counts", "2,3"}));
    std::vector<std::string> scenes;
    for (const BenchGroup& group : cases.groups) scenes.push_back(group.scene);
    std::vector<std::string> expected{"builtin:covered?lights=2", "builtin:covered?lights=3"};
    for (const char* kind : {"coated", "woven", "brushed", "glass"})
        for (const char* percent : {"5", "25", "100"})
            for (const char* lights : {"2", "3"})
                expected.push_back("builtin:covered?" + std::string(kind) + "=" + percent +
                                   "&lights=" + lights);
    EXPECT_EQ(scenes, expected);
    Settings requested;
    requested.layers = Layers::forward;
    requested.size = {6, 4};
    for (const BenchGroup& group :
         makeBenchCases("", requested, layerOptions({"--paths", "deferred"})).groups) {
        ASSERT_EQ(group.settings.size(), 2u) << "both ways, whatever was requested";
        EXPECT_EQ(group.settings[0].layers, Layers::gbuffer);
        EXPECT_EQ(group.settings[1].layers, Layers::forward);
        EXPECT_EQ(group.settings[1].size, (Size{6, 4}));
        EXPECT_FALSE(group.growth);
    }
}

TEST(BenchLayers, RegistersAreThoseOfPassesThatShade) {
    PipelineRequest request{.pass = "shade layers"};
    EXPECT_FALSE(shades(request)) << "it evaluates no light";
    request.variant().set(gpu::FEATURE_point_lights);
    EXPECT_TRUE(shades(request));
    request.pass = "transmission";
    EXPECT_TRUE(shades(request));
    request.pass = "assign lights";
    EXPECT_FALSE(shades(request));
    std::vector<PassRegisters> passes;
    addRegisters(passes, "shade", 96);
    addRegisters(passes, "shade", 64);
    addRegisters(passes, "shade", 80);
    addRegisters(passes, "transmission", 128);
    ASSERT_EQ(passes.size(), 2u);
    EXPECT_EQ(passes[0].min, 64);
    EXPECT_EQ(passes[0].max, 96);
    EXPECT_EQ(passes[1].pass, "transmission");
    EXPECT_EQ(passes[1].min, 128);
}

}  // namespace
}  // namespace diptych
