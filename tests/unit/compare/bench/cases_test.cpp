// SPDX-License-Identifier: MIT
// What a benchmark times, mode by mode, and what it refuses, word for word.
#include "compare/bench/bench.h"
#include "tests/support/command_lines.h"
#include "tests/support/errors.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

namespace diptych {
namespace {

using namespace bench;
using Words = std::vector<std::string>;

BenchOptions optionsOf(const Words& words) {
    Words line{"bench", "builtin:spheres"};
    line.insert(line.end(), words.begin(), words.end());
    return parsedAs<BenchOptions>(line);
}

TEST(BenchCaseLists, WhatIsRefusedSaysWhatIsTaken) {
    const std::string paths = acceptedValues("path"), assign = acceptedValues("assign");
    const std::tuple<const char*, const char*, std::string> wrong[] = {
        {"--paths", "sideways", "--paths sideways: takes " + paths + ", separated by commas"},
        {"--paths", "deferred,reference",
         "--paths reference: bench does not time it; use deferred, forward_plus"},
        {"--assign", "tiled,some", "--assign some: takes " + assign + ", separated by commas"},
        {"--assign", "tiled,,every", "--assign 'tiled,,every': an empty value between commas"},
        {"--assign", "tiled,", "--assign 'tiled,': an empty value between commas"},
        {"--sizes", "8", "--sizes 8: takes " + acceptedValues("size") + ", separated by commas"},
        {"--transparencies", "no",
         "--transparencies no: takes " + acceptedValues("transparency") + ", separated by commas"},
        {"--lightings", "no",
         "--lightings no: takes " + acceptedValues("lighting") + ", separated by commas"},
        {"--light-counts", "4x",
         "--light-counts 4x: whole numbers from 0 to 2147483647, separated by commas"},
        {"--light-counts", "2147483648",
         "--light-counts 2147483648: whole numbers from 0 to 2147483647, separated by commas"},
        {"--axes", "lights,colours",
         "--axes colours: takes triangles, draws, instances, textures, lights, pixels, separated by commas"},
        {"--table", "aa", "--table aa: takes modes, msaa, growth or layers"}};
    for (const auto& [option, words, why] : wrong)
        EXPECT_EQ(faultOf([&, option = option, words = words] { optionsOf({option, words}); }), why);
    EXPECT_EQ(optionsOf({"--light-counts", "2147483647,0"}).light_counts,
              (std::vector<std::uint32_t>{0, 2147483647}));
    const BenchOptions usual;
    EXPECT_EQ(usual.table, BenchTable::modes);
    EXPECT_EQ(usual.max_ms, 2000);
    EXPECT_EQ(optionsOf({}).max_ms, 2000);
    for (const auto& [word, table] : {std::pair{"modes", BenchTable::modes},
                                      {"msaa", BenchTable::msaa},
                                      {"growth", BenchTable::growth},
                                      {"layers", BenchTable::layers}})
        EXPECT_EQ(benchTableOf(word), table);
    EXPECT_EQ(optionsOf({"--axes", "lights,draws,lights"}).axes,
              (std::vector{GrowthAxis::lights, GrowthAxis::draws}));
    EXPECT_EQ(optionsOf({"--transparencies", "off,list"}).transparencies,
              (std::vector{Transparency::off, Transparency::list}));
    EXPECT_EQ(optionsOf({"--lightings", "compute,fragment"}).lightings,
              (std::vector{Lighting::compute, Lighting::fragment}));
}

TEST(BenchCaseLists, ATableRefusesWhatItHasNoRowsFor) {
    const auto whyNot = [](Words words, const char* lights = "") {
        Settings settings;
        settings.lights = lights;
        return faultOf([&] { makeBenchCases("builtin:spheres", settings, optionsOf(words)); });
    };
    EXPECT_EQ(whyNot({"--table", "msaa", "--assign", "tiled,every"}),
              "--table msaa: takes one --assign; run it once for each");
    EXPECT_EQ(
        whyNot({"--table", "msaa", "--transparencies", "list"}),
        "--transparencies: --table msaa has rows with and without --transparency already; leave it out");
    EXPECT_EQ(whyNot({"--table", "msaa", "--lightings", "compute"}),
              "--lightings: --table msaa takes one --lighting; run it once for each");
    for (const std::string table : {"growth", "layers"}) {
        EXPECT_EQ(whyNot({"--table", table, "--assign", "tiled,every"}),
                  "--table " + table + ": takes one --assign; run it once for each");
        for (const auto& [list, word] :
             {std::pair{"--sizes", "8x8"}, {"--transparencies", "off"}, {"--lightings", "compute"}})
            EXPECT_EQ(whyNot({"--table", table, list, word}),
                      "--table " + table +
                          ": takes no --sizes, --transparencies or --lightings; run it once for each");
        EXPECT_EQ(whyNot({"--table", table, "--paths", "deferred", "--assign", "per_object"}),
                  "--assign per_object cannot be used with --path deferred: its G-buffer does not store the "
                  "object; use --path forward_plus, or --forward-plus assign=per_object if both paths are "
                  "rendered");
        EXPECT_EQ(whyNot({"--table", table, "--paths", "forward_plus", "--assign", "per_object"}), "");
    }
    EXPECT_EQ(whyNot({"--table", "growth", "--light-counts", "4"}),
              "--table growth: takes no --light-counts: lights are an axis");
    for (const char* table : {"modes", "msaa", "layers"})
        EXPECT_EQ(whyNot({"--table", table, "--axes", "draws"}), "--axes: needs --table growth");
    EXPECT_EQ(whyNot({"--light-counts", "4"}, "spot:2"),
              "--lights spot:2: --light-counts sets the number; leave one out, or write {} in place of the "
              "number");
}

std::string wordsOfMode(const Settings& s) {
    return fmt::format("{}x{} {} {} {} {}", s.size.width, s.size.height, nameOf(s.assign), nameOf(s.path),
                       nameOf(s.transparency), nameOf(s.lighting));
}

// Sizes vary slowest, then assignments, paths and orderings. Only deferred is lit in several ways.
TEST(BenchCaseLists, ModesAreTimedInThisOrder) {
    BenchOptions options = optionsOf({"--sizes", "8x6,4x3", "--assign", "tiled,every", "--transparencies",
                                      "off,list", "--lightings", "compute,fragment"});
    Settings requested;
    requested.lighting = Lighting::fragment;
    const auto modesOf = [&] {
        Words modes;
        const BenchCases cases = makeBenchCases("a.glb", requested, options);
        for (const Settings& s : cases.groups.at(0).settings) modes.push_back(wordsOfMode(s));
        return modes;
    };
    Words expected;
    for (const char* size : {"8x6", "4x3"})
        for (const char* assign : {"tiled", "every"})
            for (const char* rest :
                 {"deferred off compute", "deferred off fragment", "deferred list compute",
                  "deferred list fragment", "forward_plus off fragment", "forward_plus list fragment"})
                expected.push_back(fmt::format("{} {} {}", size, assign, rest));
    EXPECT_EQ(modesOf(), expected);
    // What no list names is as requested; all assignments that can be drawn.
    options = BenchOptions();
    requested.size = {5, 4};
    requested.transparency = Transparency::weighted;
    EXPECT_EQ(
        modesOf(),
        (Words{"5x4 every deferred weighted fragment", "5x4 every forward_plus weighted fragment",
               "5x4 tiled deferred weighted fragment", "5x4 tiled forward_plus weighted fragment",
               "5x4 clustered deferred weighted fragment", "5x4 clustered forward_plus weighted fragment",
               "5x4 per_object forward_plus weighted fragment"}));
}

TEST(BenchCaseLists, WhatCannotBeDrawnIsSkippedOnceForEachReason) {
    BenchOptions options;
    options.assign = {Assignment::tiled, Assignment::per_object};
    options.sizes = {{8, 6}, {4, 3}};
    options.light_counts = {1, 2};
    Settings requested;
    requested.pixel_lights = 3;  // of per_object alone
    const BenchCases cases = makeBenchCases("a.glb", requested, options);
    Words skips;
    for (const BenchRow& skip : cases.skips) {
        Settings drawn = skip.settings;
        drawn.size = {8, 6};
        EXPECT_EQ(skip.failed, drawn.problem().value_or(""));
        EXPECT_EQ(skip.scene, "a.glb");
        EXPECT_EQ(skip.settings.size, (Size{0, 0})) << "at every size";
        EXPECT_FALSE(skip.requested_lights) << "for every count";
        skips.push_back(skipName(skip));
    }
    EXPECT_EQ(skips, (Words{"deferred, tiled", "forward_plus, tiled", "deferred, per_object"}));
    ASSERT_EQ(cases.groups.size(), 2u);
    for (const BenchGroup& group : cases.groups) {
        ASSERT_EQ(group.settings.size(), 2u);
        EXPECT_EQ(wordsOfMode(group.settings[0]),
                  "8x6 per_object forward_plus sorted " + std::string(nameOf(requested.lighting)));
    }
    options.assign = {Assignment::tiled};
    EXPECT_EQ(faultOf([&] { makeBenchCases("a.glb", requested, options); }),
              "nothing to time: deferred, tiled: " + cases.skips[0].failed);
}

TEST(BenchCaseLists, LightsOfABuiltInSceneStandInItsName) {
    BenchOptions options;
    options.light_counts = {8};
    for (const auto& [scene, named, lights] : {std::tuple{"builtin:spheres", "builtin:spheres?lights=8", ""},
                                               {"builtin:spheres?lights=64", "builtin:spheres?lights=8", ""},
                                               {"builtin:triangle", "builtin:triangle", "point:8"},
                                               {"builtin:nowhere", "builtin:nowhere", "point:8"},
                                               {"spheres", "spheres", "point:8"}}) {
        const BenchGroup group = makeBenchCases(scene, {}, options).groups.at(0);
        EXPECT_EQ(group.scene, named);
        EXPECT_EQ(group.settings.at(0).lights, lights) << scene;
        EXPECT_EQ(group.lights, 8u);
    }
    options.light_counts = {0};
    EXPECT_EQ(makeBenchCases("builtin:spheres", {}, options).groups.at(0).scene, "builtin:spheres?lights=0");
}

TEST(BenchCaseLists, AModesNameHasTheParts) {
    BenchRow row;
    row.settings.path = Path::deferred;
    row.settings.assign = Assignment::tiled;
    EXPECT_EQ(row.name(), "deferred, tiled");
    EXPECT_EQ(row.assignLabel(), "tiled");
    EXPECT_EQ(row.label(), "deferred, tiled");
    EXPECT_EQ(row.point(), "");
    EXPECT_EQ(row.lightsText(), "0 lights");
    row.measured[Measure::lights] = 1;
    row.parts = {Transparency::list, 4, Lighting::compute, Layers::forward};
    EXPECT_EQ(row.name(), "deferred, tiled, list, compute, layers forward, 4 samples");
    EXPECT_EQ(row.lightsText(), "1 light");
    row.parts = {.samples = 1};
    row.settings.path = Path::forward_plus;
    row.settings.assign = Assignment::per_object;
    EXPECT_EQ(row.name(), "forward_plus, per_object, 1 sample");
    EXPECT_EQ(row.assignLabel(), "per_object *, 1 sample");
    EXPECT_EQ(row.label(), "forward_plus, per_object *, 1 sample");
    row.settings.size = {8, 6};
    row.requested_lights = 1;
    EXPECT_EQ(skipName(row), "forward_plus, per_object, 1 sample, 8x6, 1 light");
    row.growth = GrowthPoint{GrowthAxis::triangles, 1e6};
    EXPECT_EQ(row.point(), "1e+06 triangles");
    row.growth->value = 123456;
    EXPECT_EQ(skipName(row), "forward_plus, per_object, 1 sample, 8x6, 1 light, 123456 triangles");
    row.cover = Cover{"woven", 25};
    EXPECT_EQ(row.point(), "25 % woven");
    for (const Assignment assign : {Assignment::every, Assignment::tiled, Assignment::clustered})
        EXPECT_FALSE(drawsAnotherImage(assign));
    EXPECT_TRUE(drawsAnotherImage(Assignment::per_object));
}

// Parts that the options vary, and those of a G-buffer only where there is one.
TEST(BenchCaseLists, PartsAreThoseThatVary) {
    Settings settings;
    settings.transparency = Transparency::list;
    settings.msaa = 4;
    settings.lighting = Lighting::fragment;
    settings.layers = Layers::forward;
    const auto partsIn = [&](const Words& words, Path path) {
        settings.path = path;
        return partsOf(optionsOf(words), settings);
    };
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        const bool deferred = path == Path::deferred;
        EXPECT_EQ(partsIn({}, path), ModeParts());
        EXPECT_EQ(partsIn({"--transparencies", "list", "--lightings", "compute"}, path), ModeParts());
        EXPECT_EQ(partsIn({"--transparencies", "list,off"}, path),
                  (ModeParts{.transparency = Transparency::list}));
        EXPECT_EQ(partsIn({"--table", "msaa"}, path), (ModeParts{Transparency::list, 4, {}, {}}));
        EXPECT_EQ(partsIn({"--table", "growth"}, path), ModeParts());
        EXPECT_EQ(partsIn({"--lightings", "compute,fragment"}, path),
                  deferred ? (ModeParts{.lighting = Lighting::fragment}) : ModeParts());
        EXPECT_EQ(partsIn({"--table", "layers"}, path),
                  deferred ? (ModeParts{.layers = Layers::forward}) : ModeParts());
    }
}

// ---- Growth ----

// Meshes, instances and textures of an array, lights among spheres, pixels of 16:9.
TEST(BenchCaseLists, EachAxisOfGrowthHasItsScenes) {
    const auto scenesOf = [](const char* axis) {
        Words scenes;
        for (const BenchGroup& group :
             makeBenchCases("", {}, optionsOf({"--table", "growth", "--axes", axis})).groups) {
            scenes.push_back(group.scene);
            EXPECT_EQ(nameOf(group.growth.value().axis), axis);
            EXPECT_FALSE(group.lights || group.cover);
            EXPECT_EQ(group.settings.size(), 2u);
        }
        return scenes;
    };
    EXPECT_EQ(
        scenesOf("triangles"),
        (Words{"builtin:array?meshes=100&triangles=10000", "builtin:array?meshes=100&triangles=30000",
               "builtin:array?meshes=100&triangles=100000", "builtin:array?meshes=100&triangles=300000",
               "builtin:array?meshes=100&triangles=1000000", "builtin:array?meshes=100&triangles=3000000",
               "builtin:array?meshes=100&triangles=10000000"}));
    EXPECT_EQ(scenesOf("draws"), (Words{"builtin:array?objects=10&materials=10&triangles=20",
                                        "builtin:array?objects=100&materials=100&triangles=200",
                                        "builtin:array?objects=1000&materials=1000&triangles=2000",
                                        "builtin:array?objects=10000&materials=10000&triangles=20000",
                                        "builtin:array?objects=100000&materials=100000&triangles=200000"}));
    EXPECT_EQ(scenesOf("instances"), (Words{"builtin:array?objects=10&materials=1&triangles=20",
                                            "builtin:array?objects=100&materials=1&triangles=200",
                                            "builtin:array?objects=1000&materials=1&triangles=2000",
                                            "builtin:array?objects=10000&materials=1&triangles=20000",
                                            "builtin:array?objects=100000&materials=1&triangles=200000",
                                            "builtin:array?objects=1000000&materials=1&triangles=2000000"}));
    EXPECT_EQ(
        scenesOf("textures"),
        (Words{"builtin:array?objects=1&texture_mib=4", "builtin:array?objects=4&texture_mib=16",
               "builtin:array?objects=16&texture_mib=64", "builtin:array?objects=64&texture_mib=256",
               "builtin:array?objects=256&texture_mib=1024", "builtin:array?objects=1024&texture_mib=4096"}));
    EXPECT_EQ(scenesOf("lights"),
              (Words{"builtin:spheres?lights=16", "builtin:spheres?lights=64", "builtin:spheres?lights=256",
                     "builtin:spheres?lights=1024", "builtin:spheres?lights=4096",
                     "builtin:spheres?lights=16384", "builtin:spheres?lights=65536"}));
    EXPECT_EQ(scenesOf("pixels"), Words(5, "builtin:array"));
}

TEST(BenchCaseLists, OnlyTheAxisOfPixelsChangesTheSize) {
    Settings requested;
    requested.size = {64, 48};
    requested.assign = Assignment::every;
    std::vector<Size> sizes;
    std::vector<GrowthAxis> axes;
    for (const BenchGroup& group : makeBenchCases("", requested, optionsOf({"--table", "growth"})).groups) {
        if (axes.empty() || axes.back() != group.growth->axis) axes.push_back(group.growth->axis);
        ASSERT_EQ(group.settings.size(), 2u);
        EXPECT_EQ(group.settings[0].path, Path::deferred);
        EXPECT_EQ(group.settings[1].path, Path::forward_plus);
        for (const Settings& s : group.settings) {
            EXPECT_EQ(s.assign, Assignment::every);
            if (group.growth->axis == GrowthAxis::pixels) {
                EXPECT_EQ(s.size.width * s.size.height, group.growth->value);
            } else {
                EXPECT_EQ(s.size, (Size{64, 48}));
            }
        }
        if (group.growth->axis == GrowthAxis::pixels) sizes.push_back(group.settings[1].size);
    }
    EXPECT_EQ(sizes, (std::vector<Size>{{320, 180}, {640, 360}, {1280, 720}, {2560, 1440}, {5312, 2988}}));
    EXPECT_EQ(axes, (std::vector{GrowthAxis::triangles, GrowthAxis::draws, GrowthAxis::instances,
                                 GrowthAxis::textures, GrowthAxis::lights, GrowthAxis::pixels}));
    const BenchCases one = makeBenchCases(
        "", requested,
        optionsOf({"--table", "growth", "--axes", "pixels", "--paths", "forward_plus", "--assign", "tiled"}));
    for (const BenchGroup& group : one.groups) {
        ASSERT_EQ(group.settings.size(), 1u);
        EXPECT_EQ(group.settings[0].path, Path::forward_plus);
        EXPECT_EQ(group.settings[0].assign, Assignment::tiled);
    }
}

// A path that had too much of something gets no more of it; without a path left, its scene is not read.
TEST(BenchCaseLists, WhatWasTooManyIsTooManyEverAfter) {
    BenchGroup group;
    group.growth = GrowthPoint{GrowthAxis::draws, 1000};
    group.settings.resize(2);
    group.settings[0].path = Path::deferred;
    group.settings[1].path = Path::forward_plus;
    Bench bench;
    const auto skip = [&](Path path, std::optional<GrowthPoint> growth) {
        bench.skips.emplace_back();
        bench.skips.back().settings.path = path;
        bench.skips.back().growth = growth;
    };
    EXPECT_FALSE(isHopeless(bench, group));
    skip(Path::deferred, GrowthPoint{GrowthAxis::draws, 100});
    skip(Path::forward_plus, GrowthPoint{GrowthAxis::lights, 100});
    skip(Path::forward_plus, {});
    EXPECT_FALSE(isHopeless(bench, group)) << "forward+ had too many lights, not draws";
    skip(Path::forward_plus, GrowthPoint{GrowthAxis::draws, 100});
    EXPECT_TRUE(isHopeless(bench, group));
    group.growth.reset();
    EXPECT_FALSE(isHopeless(bench, group));
}

}  // namespace
}  // namespace diptych
