// SPDX-License-Identifier: MIT
// What a benchmark's plots show: the described plot, drawn.
#include "compare/bench/findings.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using namespace bench;

void expectPlot(const Bench& bench, const Plot& plot) {
    for (const PlotTarget target : {PlotTarget::file, PlotTarget::page})
        EXPECT_EQ(benchPlot(bench, target), svgOf(plot, target));
}

// The median is `ms`, the least half of it and the greatest its double.
BenchRow plottedRow(Path path, Size size, double lights, double ms, std::vector<PassTime> passes = {}) {
    BenchRow row;
    row.settings.path = path;
    row.settings.assign = Assignment::tiled;
    row.settings.size = size;
    row.measured[Measure::lights] = lights;
    row.measured.set(FrameTime{ms, ms / 2, 2 * ms, 5});
    row.passes = std::move(passes);
    return row;
}

TEST(BenchPlots, TimeStandsOverLightsByModeAndSize) {
    Bench bench;
    bench.scene = "hall";
    bench.rows = {plottedRow(Path::deferred, {64, 48}, 256, 9), plottedRow(Path::deferred, {64, 48}, 1, 3),
                  plottedRow(Path::forward_plus, {64, 48}, 1, 4), plottedRow(Path::deferred, {8, 6}, 1, 2)};
    bench.rows[2].settings.assign = Assignment::per_object;
    Plot plot{.title = "Time against light count, hall", .interval = "least to greatest time"};
    plot.panels = {{.across = {"lights in the scene"}, .up = {"64x48, hall: ms"}},
                   {.across = {"lights in the scene"}, .up = {"8x6, hall: ms"}}};
    plot.panels[0].pointsOf("deferred, tiled", Path::deferred) = {
        {1, 3, "deferred, tiled, 1 light: 3 (1.5 to 6) ms", {}, {1.5, 6}},
        {256, 9, "deferred, tiled, 256 lights: 9 (4.5 to 18) ms", {}, {4.5, 18}}};
    plot.panels[0].pointsOf("forward_plus, per_object *", Path::forward_plus) = {
        {1, 4, "forward_plus, per_object *, 1 light: 4 (2 to 8) ms", {}, {2, 8}}};
    plot.panels[1].pointsOf("deferred, tiled",
                            Path::deferred) = {{1, 2, "deferred, tiled, 1 light: 2 (1 to 4) ms", {}, {1, 4}}};
    expectPlot(bench, plot);
}

TEST(BenchPlots, PassesOfOneLightCountAreStacked) {
    Bench bench;
    bench.scene = "hall";
    bench.rows = {plottedRow(Path::deferred, {64, 48}, 1, 6, {{"a", 2}, {"b", 3}}),
                  plottedRow(Path::forward_plus, {64, 48}, 1, 4, {{"b", 1}, {"c", 2.5}}),
                  plottedRow(Path::deferred, {8, 6}, 1, 2, {{"c", 1}})};
    Plot plot{.title = "Time by pass, hall"};
    plot.parts = {"a", "b", "c"};
    const PlotAxis across{"passes of a profiled frame, one after the other, ms", false};
    plot.panels = {{.across = across}, {.across = across}};
    plot.panels[0].up = {.name = "64x48, 1 light, hall",
                         .categories = {"deferred, tiled: 6 ms", "forward_plus, tiled: 4 ms"}};
    plot.panels[0].bars = {{{0, 2}, barAt(0), 0, "deferred, tiled, a: 2 ms"},
                           {{2, 5}, barAt(0), 1, "deferred, tiled, b: 3 ms"},
                           {{0, 1}, barAt(1), 1, "forward_plus, tiled, b: 1 ms"},
                           {{1, 3.5}, barAt(1), 2, "forward_plus, tiled, c: 2.5 ms"}};
    const auto middle = [](double index) { return (barAt(index).low + barAt(index).high) / 2; };
    plot.panels[0].pointsOf("frame: median, range", {}, false) = {
        {6, middle(0), "deferred, tiled: 6 (3 to 12) ms", {3, 12}},
        {4, middle(1), "forward_plus, tiled: 4 (2 to 8) ms", {2, 8}}};
    plot.panels[1].up = {.name = "8x6, 1 light, hall", .categories = {"deferred, tiled: 2 ms"}};
    plot.panels[1].bars = {{{0, 1}, barAt(0), 2, "deferred, tiled, c: 1 ms"}};
    plot.panels[1].pointsOf("frame: median, range", {},
                            false) = {{2, middle(0), "deferred, tiled: 2 (1 to 4) ms", {1, 4}}};
    expectPlot(bench, plot);
}

// Eight colours: of nine passes, the seven that are the longest of any row, and one for the others.
TEST(BenchPlots, OnlyTheLongestPassesHaveAColour) {
    std::vector<PassTime> passes;
    for (int i = 0; i < 9; ++i) passes.push_back({std::string(1, static_cast<char>('a' + i)), 1.0 + i});
    Bench bench;
    bench.rows = {plottedRow(Path::deferred, {8, 6}, 1, 2, passes),
                  plottedRow(Path::forward_plus, {8, 6}, 1, 2, {{"a", 20}, {"i", 0.5}})};
    const std::string nine = benchPlot(bench, PlotTarget::page);
    // b and c are the shortest; a is longer in the other row.
    for (const auto& [name, part] : {std::pair{"a", 0}, {"b", 7}, {"c", 7}, {"d", 1}, {"e", 2}, {"i", 6}}) {
        const std::size_t title = nine.find("<title>deferred, tiled, " + std::string(name) + ": ");
        ASSERT_NE(title, std::string::npos) << name;
        const std::size_t rect = nine.rfind("<rect class=\"part part", title);
        EXPECT_EQ(nine.substr(rect + 22, 2), std::to_string(part) + "\"") << name;
    }
    EXPECT_NE(nine.find(">other passes<"), std::string::npos);
    for (BenchRow& row : bench.rows) std::erase_if(row.passes, [](auto& pass) { return pass.name == "b"; });
    EXPECT_EQ(benchPlot(bench, PlotTarget::page).find(">other passes<"), std::string::npos) << "eight fit";
}

TEST(BenchPlots, TimeAndMemoryStandOverWhatGrows) {
    Bench bench;
    bench.options.table = BenchTable::growth;
    const auto add = [&](Path path, GrowthAxis axis, double value, double ms, std::uint64_t mib) {
        bench.rows.push_back(plottedRow(path, {64, 48}, 1, ms));
        bench.rows.back().growth = GrowthPoint{axis, value};
        bench.rows.back().measured.set(FrameBytes{mib << 19, mib << 19});
    };
    add(Path::deferred, GrowthAxis::textures, 4, 2, 10);
    add(Path::deferred, GrowthAxis::draws, 100, 7, 3);
    add(Path::deferred, GrowthAxis::draws, 10, 5, 2);
    add(Path::forward_plus, GrowthAxis::draws, 10, 6, 1);
    Plot plot{.title = "How a frame's time and memory grow", .columns = 2, .height = 260};
    for (const char* across : {"draws", "textures, MiB"})
        for (const char* up : {"time of a frame, ms", "memory on the device, MiB"})
            plot.panels.push_back({.across = {across}, .up = {up}});
    plot.panels[0].pointsOf("deferred", Path::deferred) = {{10, 5, "deferred, 10 draws: 5"},
                                                           {100, 7, "deferred, 100 draws: 7"}};
    plot.panels[0].pointsOf("forward_plus", Path::forward_plus) = {{10, 6, "forward_plus, 10 draws: 6"}};
    plot.panels[1].pointsOf("deferred", Path::deferred) = {{10, 2, "deferred, 10 draws: 2"},
                                                           {100, 3, "deferred, 100 draws: 3"}};
    plot.panels[1].pointsOf("forward_plus", Path::forward_plus) = {{10, 1, "forward_plus, 10 draws: 1"}};
    plot.panels[2].pointsOf("deferred", Path::deferred) = {{4, 2, "deferred, 4 textures: 2"}};
    plot.panels[3].pointsOf("deferred", Path::deferred) = {{4, 10, "deferred, 4 textures: 10"}};
    expectPlot(bench, plot);
}

TEST(BenchPlots, TimeStandsOverWhatLayersCover) {
    Bench bench;
    bench.options.table = BenchTable::layers;
    const auto add = [&](const Cover& cover, std::uint32_t lights, std::size_t way, double ms) {
        bench.rows.push_back(plottedRow(layerWays.at(way).path(), {64, 48}, lights, ms));
        bench.rows.back().settings.layers = layerWays.at(way).layers;
        bench.rows.back().cover = cover;
        bench.rows.back().requested_lights = lights;
    };
    add({}, 64, 0, 2);
    add({}, 64, 2, 3);
    add({"coated", 25}, 64, 2, 5);
    add({"glass", 5}, 64, 1, 6);
    add({"glass", 5}, 1, 1, 7);
    Plot plot{.title = "Time of a frame by what layers cover", .columns = 2, .height = 260};
    // By lights, then kinds. Rows without layers are in each kind's panel of their lights.
    for (const char* up :
         {"coated, 1 light: ms", "glass, 1 light: ms", "coated, 64 lights: ms", "glass, 64 lights: ms"})
        plot.panels.push_back({.across = {"covered, %"}, .up = {up}});
    plot.panels[1].across.categories = {"5"};
    plot.panels[1].pointsOf("deferred by G-buffer",
                            Path::deferred) = {{0, 7, "deferred by G-buffer, 5 % glass: 7 (3.5 to 14) ms"}};
    for (const std::size_t i : {2u, 3u}) {
        plot.panels[i].pointsOf("forward_plus",
                                Path::forward_plus) = {{0, 2, "forward_plus, no layers: 2 (1 to 4) ms"}};
        plot.panels[i].pointsOf("deferred by forward",
                                Path::deferred) = {{0, 3, "deferred by forward, no layers: 3 (1.5 to 6) ms"}};
    }
    plot.panels[2].across.categories = {"0", "25"};
    plot.panels[2]
        .pointsOf("deferred by forward", Path::deferred)
        .push_back({1, 5, "deferred by forward, 25 % coated: 5 (2.5 to 10) ms"});
    plot.panels[3].across.categories = {"0", "5"};
    plot.panels[3].pointsOf("deferred by G-buffer",
                            Path::deferred) = {{1, 6, "deferred by G-buffer, 5 % glass: 6 (3 to 12) ms"}};
    expectPlot(bench, plot);
}

}  // namespace
}  // namespace diptych
