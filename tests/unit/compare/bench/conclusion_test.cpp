// SPDX-License-Identifier: MIT
// A benchmark's conclusions as text, and its plot of a single light count.
#include "compare/bench/findings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>
#include <string>

namespace diptych {
namespace {

using namespace bench;
using Times = std::vector<double>;

BenchRow timed(const char* path, const char* assign, Times ms, std::vector<PassTime> passes,
               const char* size = "64x48", std::uint32_t lights = 16) {
    BenchRow made;
    made.settings.set("path", path);
    made.settings.set("assign", assign);
    made.settings.set("size", size);
    made.measured[Measure::lights] = lights;
    Times sorted = ms;
    std::ranges::sort(sorted);
    made.measured.set(
        FrameTime{sorted[sorted.size() / 2], sorted.front(), sorted.back(), static_cast<int>(ms.size())});
    made.ms = std::move(ms);
    made.passes = std::move(passes);
    return made;
}

// Both paths twice and per_object, six interleaved frames each.
Bench oneCount() {
    Bench bench;
    bench.scene = "hall.glb";
    bench.rows = {
        timed("deferred", "clustered", {10, 11, 10, 12, 10, 10},
              {{"G-buffer", 3}, {"assign lights", 1}, {"light <all>", 6}}),
        timed("deferred", "tiled", {14, 14, 14, 14, 14, 14}, {{"G-buffer", 3}, {"light <all>", 11}}),
        timed("forward_plus", "clustered", {20, 22, 21, 26, 20, 21}, {{"assign lights", 2}, {"shade", 19}}),
        timed("forward_plus", "per_object", {1, 1, 1, 1, 1, 1}, {{"shade", 1}})};
    return bench;
}

TEST(BenchConclusion, SaysWhichIsFasterByHowMuchAndWhy) {
    const Bench bench = oneCount();
    const std::vector<Conclusion> all = conclusionsOf(bench);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].faster, &bench.rows[0]) << "per_object draws another picture";
    EXPECT_EQ(all[0].slower, &bench.rows[2]) << "the other path, although tiled is closer";
    EXPECT_EQ(all[0].pass, "shade");
    EXPECT_EQ(all[0].describe(),
              "64x48, 16 lights: deferred (clustered) takes 10 ms, forward_plus (clustered) takes 2.05 times "
              "as long (median ratio of 6 interleaved frame pairs; 2.00 to 2.17 at 96.9 % confidence); the "
              "pass that differs most is shade: none against 19 ms");
}

TEST(BenchConclusion, IsNotSureWhereFramesScatter) {
    Bench bench;
    bench.rows = {timed("deferred", "clustered", {10, 12, 10, 9, 13, 10}, {{"a", 10}}),
                  timed("forward_plus", "clustered", {11, 11, 11, 11, 11, 11}, {{"b", 11}})};
    const std::vector<Conclusion> all = conclusionsOf(bench);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_FALSE(all[0].ratio.isSure());
    EXPECT_NE(all[0].describe().find("no significant difference"), std::string::npos) << all[0].describe();
    EXPECT_EQ(all[0].describe().find("differs most"), std::string::npos);
}

TEST(BenchConclusion, IsOfEachSizeAndLightCount) {
    Bench bench = oneCount();
    bench.rows.push_back(timed("deferred", "tiled", {5, 5, 5, 5, 5, 5}, {}, "32x24"));
    bench.rows.push_back(timed("deferred", "every", {7, 7, 7, 7, 7, 7}, {}, "32x24"));
    bench.rows.push_back(timed("deferred", "every", {7, 7, 7, 7, 7, 7}, {}, "32x24", 64));
    const std::vector<Conclusion> all = conclusionsOf(bench);
    ASSERT_EQ(all.size(), 2u) << "a row alone says nothing";
    EXPECT_EQ(all[1].faster->settings.assign, Assignment::tiled);
    EXPECT_EQ(all[1].slower->settings.assign, Assignment::every) << "of one path, the next";
    EXPECT_EQ(all[1].pass, "");
}

// Passes of one name are one; of two that differ alike, the first by name. What is only in the faster row
// does not count.
TEST(BenchConclusion, ThePassIsTheOneThatCostsMostMore) {
    const auto passOf = [](std::vector<PassTime> fast, std::vector<PassTime> slow) {
        Bench bench;
        bench.rows = {timed("deferred", "tiled", Times(6, 10), std::move(fast)),
                      timed("forward_plus", "tiled", Times(6, 20), std::move(slow))};
        const Conclusion c = conclusionsOf(bench).at(0);
        const std::string text = c.describe();
        const std::size_t from = text.find("confidence)");
        return text.substr(from + 11);
    };
    EXPECT_EQ(passOf({{"a", 1}, {"b", 0.5}}, {{"a", 2}, {"b", 1}, {"a", 1}, {"b", 2}}),
              "; the pass that differs most is b: 0.5 ms against 3 ms");
    EXPECT_EQ(passOf({{"b", 1}, {"a", 2}}, {{"b", 2}, {"a", 3}}),
              "; the pass that differs most is a: 2 ms against 3 ms");
    EXPECT_EQ(passOf({{"a", 4}, {"b", 1}}, {{"b", 1000.4}}),
              "; the pass that differs most is b: 1 ms against 1000 ms");
    EXPECT_EQ(passOf({{"a", 4}, {"b", 1}}, {{"b", 1}, {"a", 3}}), "") << "none takes longer";
}

TEST(BenchConclusion, WhereNothingDiffersItSaysSo) {
    Bench bench;
    bench.rows = {timed("deferred", "clustered", {10, 12, 10, 9, 13, 10}, {{"a", 10}}, "64x48", 1),
                  timed("forward_plus", "clustered", {11, 11, 11, 11, 11, 11}, {{"b", 11}}, "64x48", 1)};
    EXPECT_EQ(
        conclusionsOf(bench).at(0).describe(),
        "64x48, 1 light: deferred (clustered) takes 10 ms, forward_plus (clustered) takes 1.10 times as "
        "long (median ratio of 6 interleaved frame pairs; 0.85 to 1.22 at 96.9 % confidence); no "
        "significant difference, more --runs may help");
    for (BenchRow& row : bench.rows) row.ms.resize(1);
    EXPECT_EQ(
        conclusionsOf(bench).at(0).describe(),
        "64x48, 1 light: deferred (clustered) takes 10 ms, forward_plus (clustered) takes 1.10 times as "
        "long (median ratio of 1 interleaved frame pair; 1.10 to 1.10 at 0.0 % confidence); no "
        "significant difference, more --runs may help");
}

// Rows of other parts show other images. Growth and layers have sentences of their own.
TEST(BenchConclusion, ComparesRowsOfEqualParts) {
    Bench bench = oneCount();
    bench.rows[0].parts.transparency = Transparency::off;
    ASSERT_EQ(conclusionsOf(bench).size(), 1u);
    EXPECT_EQ(conclusionsOf(bench)[0].faster->settings.assign, Assignment::tiled);
    bench.rows[2].parts.transparency = Transparency::off;
    ASSERT_EQ(conclusionsOf(bench).size(), 1u) << "tiled and per_object are alone";
    for (const auto& [table, count] : {std::pair{BenchTable::modes, 1u},
                                       {BenchTable::msaa, 1u},
                                       {BenchTable::growth, 0u},
                                       {BenchTable::layers, 0u}}) {
        bench.options.table = table;
        EXPECT_EQ(conclusionsOf(bench).size(), count);
    }
}

TEST(BenchConclusion, StandsInTableJsonAndPage) {
    const Bench bench = oneCount();
    const std::string text = conclusionsOf(bench)[0].describe();
    const std::string end = benchEnd(bench);
    EXPECT_TRUE(end.ends_with(text + "\n")) << "the last line: " << end;
    EXPECT_NE(benchHtml(bench).find(text), std::string::npos);
    const nlohmann::json json = benchJson(bench);
    EXPECT_EQ(json["conclusions"][0]["in_words"], text);
    EXPECT_EQ(json["conclusions"][0]["faster"], "deferred, clustered");
    EXPECT_EQ(json["conclusions"][0]["sure"], true);
    EXPECT_EQ(json["conclusions"][0]["pass_ms"], (nlohmann::json{0, 19}));
}

TEST(BenchConclusion, AnotherImageIsMarked) {
    const Bench bench = oneCount();
    EXPECT_NE(benchTable(bench, 0).find("per_object *"), std::string::npos);
    EXPECT_NE(benchEnd(bench).find(starMeans), std::string::npos);
    EXPECT_NE(benchHtml(bench).find(starMeans), std::string::npos);
    EXPECT_NE(benchPlot(bench, PlotTarget::file).find("per_object *"), std::string::npos);
    const nlohmann::json json = benchJson(bench);
    EXPECT_EQ(json["rows"][0]["same_picture"], true);
    EXPECT_EQ(json["rows"][3]["same_picture"], false);
    Bench same = oneCount();
    same.rows.pop_back();
    EXPECT_EQ(benchEnd(same).find('*'), std::string::npos);
}

// Widths of a bar's segments, in order.
Times barParts(const std::string& svg, const std::string& mode) {
    Times widths;
    const std::regex part("width=\"([0-9.]+)\" height=\"[0-9.]+\"><title>" + mode + ", [^<]*ms</title>");
    for (std::sregex_iterator at(svg.begin(), svg.end(), part), end; at != end; ++at)
        widths.push_back(std::stod((*at)[1]));
    return widths;
}

TEST(BenchPlot, OfOneLightCountHasABarAModeStackedOfItsPasses) {
    const std::string svg = benchPlot(oneCount(), PlotTarget::file);
    EXPECT_EQ(svg.find("class=\"trace\""), std::string::npos) << "a line needs two counts";
    const Times deferred = barParts(svg, "deferred, clustered"),
                forward = barParts(svg, "forward_plus, clustered");
    ASSERT_EQ(deferred.size(), 3u) << svg;
    ASSERT_EQ(forward.size(), 2u);
    EXPECT_NEAR(deferred[2] / deferred[0], 2, 0.01) << "lengths are proportional to time";
    EXPECT_NEAR(forward[1] / deferred[2], 19.0 / 6, 0.01);
    EXPECT_NE(svg.find(">light &lt;all&gt;</text>"), std::string::npos) << "the legend names passes";
    EXPECT_NE(svg.find("deferred, clustered: 10 ms"), std::string::npos);
}

// Each segment begins where the previous one ends.
TEST(BenchPlot, PartsOfABarStandBesideEachOther) {
    const std::string svg = benchPlot(oneCount(), PlotTarget::file);
    const std::regex part(
        "x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\" height=\"[0-9.]+\"><title>deferred, clustered, "
        "[^<]*ms</title>");
    Times begins, ends;
    for (std::sregex_iterator at(svg.begin(), svg.end(), part), end; at != end; ++at) {
        begins.push_back(std::stod((*at)[1]));
        ends.push_back(begins.back() + std::stod((*at)[2]));
    }
    ASSERT_EQ(begins.size(), 3u) << svg;
    EXPECT_NEAR(begins[1], ends[0], 0.1);
    EXPECT_NEAR(begins[2], ends[1], 0.1);
}

TEST(BenchPlot, PassesBeyondItsColoursAreOnePart) {
    Bench bench = oneCount();
    for (int i = 0; i < 12; ++i) bench.rows[0].passes.push_back({"pass " + std::to_string(i), 0.01});
    const std::string svg = benchPlot(bench, PlotTarget::file);
    EXPECT_NE(svg.find(">other passes</text>"), std::string::npos);
    EXPECT_EQ(svg.find("class=\"part part8"), std::string::npos) << "no colour that is not there";
    EXPECT_NE(svg.find("deferred, clustered, pass 11: 0.01 ms"), std::string::npos) << "each is named";
}

}  // namespace
}  // namespace diptych
