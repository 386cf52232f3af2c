// SPDX-License-Identifier: MIT
// Plans, predictions and output of a benchmark, with made-up times.
#include "compare/bench/bench.h"
#include "tests/support/command_lines.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace diptych {

using namespace bench;

namespace {

using Json = nlohmann::json;

BenchOptions asked(const std::vector<std::string>& words) {
    std::vector<std::string> line{"bench", "builtin:spheres"};
    line.insert(line.end(), words.begin(), words.end());
    return parsedAs<BenchOptions>(line);
}

TEST(BenchCases, DeferredIsTimedByEachWayToShadeThatIsAskedFor) {
    const auto names = [](const BenchOptions& options) {
        std::vector<std::string> all;
        const BenchCases cases = makeBenchCases("builtin:spheres", {}, options);
        for (const Settings& s : cases.groups.front().settings)
            all.push_back(modeName(s, partsOf(options, s)));
        return all;
    };
    EXPECT_EQ(names(asked({"--assign", "tiled", "--lightings", "fragment,compute"})),
              (std::vector<std::string>{"deferred, tiled, fragment", "deferred, tiled, compute",
                                        "forward_plus, tiled"}));
    EXPECT_EQ(names(asked({"--assign", "tiled", "--lightings", "compute"})),
              (std::vector<std::string>{"deferred, tiled", "forward_plus, tiled"}));
    EXPECT_NE(faultOf([] {
                  asked({"--lightings", "raster"});
              }).find("--lightings raster"),
              std::string::npos);
    for (const char* table : {"msaa", "growth", "layers"})
        EXPECT_NE(faultOf([&] {
                      makeBenchCases("builtin:spheres", {},
                                     asked({"--table", table, "--lightings", "fragment,compute"}));
                  }).find("--lightings"),
                  std::string::npos);
}

TEST(BenchCases, ListsParseAndAreNamedWhereTheyDoNot) {
    const BenchOptions bench =
        asked({"--paths", "forward_plus", "--assign", "every,tiled,every", "--sizes", "16x12,8x8",
               "--light-counts", "256,4,16,4", "--max-ms", "12.5", "--kernels", "off"});
    EXPECT_EQ(bench.paths, std::vector{Path::forward_plus});
    EXPECT_EQ(bench.assign, (std::vector{Assignment::every, Assignment::tiled}));
    EXPECT_EQ(bench.sizes, (std::vector{Size{16, 12}, Size{8, 8}}));
    EXPECT_EQ(bench.light_counts, (std::vector<std::uint32_t>{4, 16, 256}));
    EXPECT_EQ(bench.max_ms, 12.5);
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{"--paths", "sideways"}, "--paths sideways"},
        {{"--paths", "reference"}, "--paths reference"},
        {{"--assign", "tiled,,every"}, "--assign 'tiled,,every'"},
        {{"--assign", "some"}, "--assign some"},
        {{"--sizes", "12"}, "--sizes 12"},
        {{"--light-counts", "4,-1"}, "--light-counts -1"},
        {{"--light-counts", "4.5"}, "--light-counts 4.5"},
        {{"--light-counts", "4294967296"}, "--light-counts 4294967296"},
        {{"--max-ms", "0"}, "--max-ms 0"},
        {{"--max-ms", "nan"}, "--max-ms nan"},
        {{"--kernels", "on"},
         "--kernels on: bench times frames alone; build/tests/bench_kernels times the kernels"},
        {{"--kernels", "only"},
         "--kernels only: bench times frames alone; build/tests/bench_kernels times the kernels"}};
    for (const auto& [words, message] : wrong)
        EXPECT_EQ(faultOf([&] { asked(words); }).find(message), 0u) << words[1];
}

TEST(BenchCases, EveryModeOfACountIsTimedInTurn) {
    BenchOptions options;
    options.assign = {Assignment::every};
    options.sizes = {{32, 24}, {16, 12}};
    options.light_counts = {16, 64};
    const BenchCases cases = makeBenchCases("builtin:spheres?lights=7", Settings(), options);
    ASSERT_EQ(cases.groups.size(), 2u);
    EXPECT_EQ(cases.groups[1].scene, "builtin:spheres?lights=64");
    EXPECT_EQ(cases.groups[1].lights, 64u);
    EXPECT_EQ(cases.groups[0].settings.size(), 4u) << "2 paths, 2 sizes";
    EXPECT_EQ(cases.groups[0].settings[3].path, Path::forward_plus);
    EXPECT_EQ(cases.groups[0].settings[3].size, (Size{16, 12}));
}

TEST(BenchCases, WhatCannotBeDrawnIsSkippedOnceWithItsReason) {
    BenchOptions options;
    options.assign = {Assignment::every, Assignment::per_object};
    options.paths = {Path::deferred};
    options.light_counts = {1, 2, 3};
    Settings perObject;
    perObject.path = Path::deferred;
    perObject.assign = Assignment::per_object;
    ASSERT_TRUE(perObject.problem());
    const BenchCases cases = makeBenchCases("builtin:spheres", Settings(), options);
    ASSERT_EQ(cases.skips.size(), 1u);
    EXPECT_EQ(cases.skips[0].failed, *perObject.problem());
    EXPECT_EQ(skipName(cases.skips[0]), "deferred, per_object");
    EXPECT_EQ(cases.groups.size(), 3u);
    options.assign = {Assignment::per_object};
    EXPECT_EQ(faultOf([&] {
                  makeBenchCases("builtin:spheres", Settings(), options);
              }).find("nothing to time: deferred, per_object: "),
              0u);
}

TEST(BenchCases, LightsComeFromTheSceneAFileOrARig) {
    BenchOptions options;
    options.light_counts = {0, 64};
    EXPECT_EQ(makeBenchCases("a.glb", Settings(), options).groups[0].settings[0].lights, "");
    EXPECT_EQ(makeBenchCases("a.glb", Settings(), options).groups[1].settings[0].lights, "point:64");
    EXPECT_EQ(makeBenchCases("a.glb", Settings(), options).groups[1].scene, "a.glb");
    EXPECT_EQ(makeBenchCases("builtin:triangle", Settings(), options).groups[1].settings[0].lights,
              "point:64")
        << "it takes no ?lights=N";
    Settings files;
    files.lights = "rigs/{}.lights.json";
    EXPECT_EQ(makeBenchCases("builtin:spheres", files, options).groups[1].settings[0].lights,
              "rigs/64.lights.json");
    EXPECT_EQ(makeBenchCases("builtin:spheres", files, options).groups[1].scene, "builtin:spheres");
    files.lights = "spot:4";
    EXPECT_EQ(
        faultOf([&] { makeBenchCases("a.glb", files, options); }).find("--lights spot:4: --light-counts"),
        0u);
    options.light_counts.clear();
    EXPECT_EQ(makeBenchCases("a.glb", files, options).groups[0].settings[0].lights, "spot:4");
    EXPECT_FALSE(makeBenchCases("a.glb", files, options).groups[0].lights);
}

TEST(BenchCases, PredictsAlongTheLastTwo) {
    using Points = std::vector<std::pair<std::uint32_t, double>>;
    EXPECT_FALSE(predictedMs(Points{}, 64));
    EXPECT_FALSE(predictedMs(Points{{16, 20}}, 64));
    EXPECT_DOUBLE_EQ(*predictedMs(Points{{16, 20}, {64, 68}}, 256), 260.0);
    EXPECT_DOUBLE_EQ(*predictedMs(Points{{4, 500}, {16, 20}, {64, 68}}, 256), 260.0);
    EXPECT_DOUBLE_EQ(*predictedMs(Points{{16, 20}, {64, 19}}, 1024), 19.0) << "noise takes no time off";
}

BenchRow row(const char* path, const char* assign, const char* size, std::uint32_t lights, double ms,
             std::vector<PassTime> passes) {
    BenchRow made;
    made.settings.set("path", path);
    made.settings.set("assign", assign);
    made.settings.set("size", size);
    made.scene = "builtin:spheres";
    made.requested_lights = lights;
    made.measured[Measure::lights] = lights + 1;
    made.measured.set(FrameTime{ms, 0.5 * ms, 2 * ms, 3});
    made.ms = {ms, 0.5 * ms, 2 * ms};
    made.passes = std::move(passes);
    return made;
}

Bench several() {
    Bench bench;
    bench.scene = "a & b's <scene>";
    bench.device = {"llvmpipe", "Mesa", "cpu"};
    bench.runs = 3;
    bench.rows = {row("deferred", "every", "64x48", 16, 10, {{"G-buffer", 4}, {"shade", 6}}),
                  row("deferred", "every", "64x48", 1024, 400, {{"G-buffer", 4}, {"shade", 396}}),
                  row("forward_plus", "clustered", "64x48", 16, 8,
                      {{"assign froxels", 0.5}, {"assign lights", 0.5}, {"shade", 7}}),
                  row("forward_plus", "clustered", "64x48", 1024, 40, {{"assign lights", 10}, {"shade", 30}}),
                  row("deferred", "every", "32x24", 16, 3, {{"shade", 3}})};
    bench.skips = {row("deferred", "every", "64x48", 4096, 0, {})};
    bench.skips[0].failed = "would take <long>";
    for (BenchRow& made : bench.rows) made.warnings = {"one note"};
    bench.rows[3].warnings.push_back("its own note");
    return bench;
}

TEST(BenchOutput, TheFractionIsOfThePassesThatAssign) {
    const Bench bench = several();
    EXPECT_EQ(passMs(bench.rows[0], "assign"), 0.0);
    EXPECT_EQ(assignFraction(bench.rows[0]), 0.0);
    EXPECT_DOUBLE_EQ(passMs(bench.rows[2], "assign"), 1.0);
    EXPECT_DOUBLE_EQ(assignFraction(bench.rows[2]), 0.125);
    EXPECT_DOUBLE_EQ(assignFraction(bench.rows[3]), 0.25);
    EXPECT_EQ(assignFraction(BenchRow{}), 0.0);
}

TEST(BenchOutput, MillisecondsHaveFourDigitsOrAllBeforeThePoint) {
    EXPECT_EQ(msText(0.01234567), "0.01235");
    EXPECT_EQ(msText(36.42), "36.42");
    EXPECT_EQ(msText(999.96), "1000");
    EXPECT_EQ(msText(40316.4), "40316");
}

TEST(BenchOutput, TableHasALineARowAndEndsWithSkips) {
    const Bench bench = several();
    const std::string table = benchTable(bench, 0);
    EXPECT_EQ(std::ranges::count(table, '\n'), 6) << table;
    EXPECT_EQ(table.find('*'), std::string::npos);
    EXPECT_EQ(std::ranges::count(benchTable(bench, 4), '\n'), 1);
    const std::string end = benchEnd(bench);
    EXPECT_NE(end.find("Not timed, and why\ndeferred, every, 64x48, 4096 lights: would take <long>\n"),
              std::string::npos);
    EXPECT_NE(end.find("Notes\n  one note\n"), std::string::npos);
    EXPECT_EQ(end.find("its own note"), std::string::npos) << "of one row, among so many";
}

std::vector<std::string> wordsOf(const std::string& line) {
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

TEST(BenchOutput, EveryNumberOfATableStandsUnderItsHead) {
    const Bench bench = several();
    std::istringstream table(benchTable(bench, 0));
    std::string head, first;
    std::getline(table, head);
    std::getline(table, first);
    const std::vector<std::string> heads{"lights", "size", "path",   "assign",  "ms",
                                         "min",    "max",  "memory", "passes,", "ms"};
    EXPECT_EQ(wordsOf(head), heads);
    const std::vector<std::string> words{"17", "64x48", "deferred", "every", "10",    "5", "20",
                                         "0",  "B",     "G-buffer", "4,",    "shade", "6"};
    EXPECT_EQ(wordsOf(first), words);
}

// Counters of frames make notes, row by row, before the notes that all rows share.
TEST(BenchOutput, WhatFramesCountedIsNoted) {
    Bench bench = several();
    bench.rows[0].measured[Measure::unsorted_pixels] = 9;  // of no fragments
    const auto notes = [&] {
        const std::string end = benchEnd(bench);
        const std::size_t from = end.find("Notes\n");
        return end.substr(from, end.find("\n  one note\n") - from);
    };
    EXPECT_EQ(notes(), "Notes");
    bench.rows[1].measured[Measure::nonfinite_pixels] = 7;
    bench.rows[1].measured[Measure::unsorted_fragments] = 12;
    bench.rows[1].measured[Measure::unsorted_pixels] = 5;
    bench.rows[3].measured[Measure::nonfinite_pixels] = 1;
    bench.rows[4].measured[Measure::unsorted_fragments] = 1;
    bench.rows[4].measured[Measure::unsorted_pixels] = 1;
    EXPECT_EQ(
        notes(),
        "Notes\n"
        "  deferred, every, 1025 lights: 7 pixels not finite\n"
        "  deferred, every, 1025 lights: 12 blended fragments in 5 pixels overflowed the fragment list\n"
        "  forward_plus, clustered, 1025 lights: 1 pixel not finite\n"
        "  deferred, every, 17 lights: 1 blended fragment in 1 pixel overflowed the fragment list");
}

TEST(BenchOutput, JsonReadsBack) {
    const Bench bench = several();
    const Json json = benchJson(bench);
    EXPECT_EQ(json["schema"], 2);
    EXPECT_EQ(json["software"], "diptych");
    ASSERT_EQ(json["rows"].size(), 5u);
    const Json& row = json["rows"][3];
    EXPECT_EQ(row["name"], "forward_plus, clustered");
    EXPECT_EQ(row["light_count"], 1024);
    EXPECT_EQ(row["counters"]["lights"], 1025);
    EXPECT_EQ(row["ms"]["median"], 40.0);
    EXPECT_EQ(row["ms"]["all"].size(), 3u);
    EXPECT_EQ(row["assign_ms"], 10.0);
    EXPECT_EQ(row["assign_share"], 0.25);
    EXPECT_EQ(row["size"], (Json{64, 48}));
    EXPECT_EQ(row["settings"]["assign"], "clustered");
    EXPECT_EQ(row["warnings"], (Json{"one note", "its own note"}));
    EXPECT_EQ(json["skipped"][0]["reason"], "would take <long>");
    EXPECT_EQ(json["skipped"][0]["light_count"], 4096);
    Bench plain = bench;
    plain.rows[0].requested_lights.reset();
    const Json without = benchJson(plain);
    EXPECT_TRUE(without["rows"][0]["light_count"].is_null());
}

// Positions of a series' points, in order.
std::vector<std::array<double, 2>> pointsOf(const std::string& svg, const std::string& series) {
    std::vector<std::array<double, 2>> points;
    const std::regex line("<g class=\"series " + series + "\"><path class=\"trace\" d=\"M([^\"]*)\"");
    std::smatch match;
    if (!std::regex_search(svg, match, line)) return points;
    std::string words = match[1];
    std::ranges::replace(words, 'L', ' ');
    std::istringstream stream(words);
    for (std::array<double, 2> p{}; stream >> p[0] >> p[1];) points.push_back(p);
    return points;
}

TEST(BenchOutput, ThePlotHasALineAModeAndAPanelASize) {
    const Bench bench = several();
    const std::string svg = benchPlot(bench, PlotTarget::file);
    const auto every = pointsOf(svg, "deferred v0"), clustered = pointsOf(svg, "forward_plus v0");
    ASSERT_EQ(every.size(), 2u) << svg;
    ASSERT_EQ(clustered.size(), 2u);
    EXPECT_LT(every[0][0], every[1][0]) << "more lights stand to the right";
    EXPECT_GT(every[0][1], every[1][1]) << "longer stands above";
    EXPECT_EQ(every[1][0], clustered[1][0]);
    EXPECT_LT(every[1][1], clustered[1][1]);
    // Both axes are logarithmic: factors 40 and 5 of one axis.
    EXPECT_NEAR((every[0][1] - every[1][1]) / (clustered[0][1] - clustered[1][1]),
                std::log(40.0) / std::log(5.0), 0.02);
    EXPECT_NE(svg.find("64x48, a &amp; b&#39;s &lt;scene&gt;"), std::string::npos) << svg;
    EXPECT_NE(svg.find(">32x24"), std::string::npos);
    EXPECT_EQ(svg.find("class=\"part"), std::string::npos) << "no bars";
    EXPECT_NE(svg.find("xmlns="), std::string::npos);
    EXPECT_EQ(benchPlot(bench, PlotTarget::page).find("xmlns="), std::string::npos);
}

TEST(BenchOutput, ThePageHasEverything) {
    const std::string page = benchHtml(several());
    for (const char* part : {"<svg class=\"chart\"", "assign lights 10", "would take &lt;long&gt;",
                             "one note", "its own note", "bench.json"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("<scene>"), std::string::npos);
    Bench nothingTimed = several();
    nothingTimed.rows.clear();
    EXPECT_EQ(benchHtml(nothingTimed).find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace diptych
