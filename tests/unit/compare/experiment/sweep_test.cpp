// SPDX-License-Identifier: MIT
// The Settings of a sweep's rows.
#include "compare/experiment/sweep.h"
#include "shared/frame/setting_rows.h"
#include "tests/support/errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace diptych::experiment {
namespace {

SweepRows defaultSweep(const Settings& requested = {}) {
    return makeSweepRows(requested, defaultGrids(requested));
}

std::vector<std::string> wordsOfRows(const SweepRows& sweep, const Settings& requested = {}) {
    std::vector<std::string> words;
    for (const Settings& row : sweep.rows) words.push_back(describe(changesOf(row, requested)));
    return words;
}

bool holds(const std::vector<std::string>& all, const std::string& one) {
    return std::ranges::count(all, one) > 0;
}

std::vector<std::string> reasonsOf(const SweepRows& sweep, const std::string& option) {
    std::vector<std::string> reasons;
    for (const SweepSkip& skip : sweep.skips)
        for (const Change& choice : skip.tried)
            if (choice.option == option) reasons.push_back(skip.reason);
    return reasons;
}

TEST(ExperimentSweep, TheDefaultStandsFirstAndNothingTwice) {
    const SweepRows sweep = defaultSweep();
    ASSERT_FALSE(sweep.rows.empty());
    EXPECT_EQ(sweep.rows.front(), Settings());
    for (std::size_t i = 0; i < sweep.rows.size(); ++i) {
        EXPECT_EQ(std::ranges::count(sweep.rows, sweep.rows[i]), 1) << i;
        EXPECT_EQ(sweep.rows[i].problem(), std::nullopt) << i;
        EXPECT_EQ(effectiveSettings(sweep.rows[i]), sweep.rows[i]) << i;
    }
}

// For any base Settings, each swept value of each Setting is a row for each path, or a skip with a reason.
TEST(ExperimentSweep, EveryValueOfEverySettingIsDrawnOrHasAReason) {
    const Settings requested;
    const SweepRows sweep = defaultSweep(requested);
    std::size_t tried = 0;
    Settings::fields(requested, [&](const Field& field, const auto&) {
        for (const std::string& value : sweptValues(requested, field.option)) {
            if (field.option == "path") continue;
            for (const Path path : {Path::deferred, Path::forward_plus}) {
                Settings asked = requested;
                asked.path = path;
                asked.set(field.option, value);
                const Change choice{std::string(field.option), asked.valueOf(field.option)};
                const auto skipped = [&](const SweepSkip& skip) {
                    return !skip.reason.empty() && skip.tried.size() == 2 &&
                           std::ranges::count(skip.tried, choice) == 1 &&
                           std::ranges::count(skip.tried, Change{"path", std::string(nameOf(path))}) == 1;
                };
                const bool drawn = std::ranges::count(sweep.rows, asked) == 1;
                EXPECT_NE(drawn, std::ranges::any_of(sweep.skips, skipped))
                    << nameOf(path) << " " << field.option << " " << value;
                ++tried;
            }
        }
    });
    EXPECT_GT(tried, 50u);
}

TEST(ExperimentSweep, OneAtATimeAndPairsButNotTheProduct) {
    const std::vector<std::string> rows = wordsOfRows(defaultSweep());
    for (const char* row :
         {"forward_plus", "deferred", "deferred, gbuffer full", "forward_plus, size 320x180",
          "deferred, gbuffer full, size 320x180", "forward_plus, prepass off"})
        EXPECT_TRUE(holds(rows, row)) << row;
    EXPECT_FALSE(holds(rows, "forward_plus, prepass off, size 320x180")) << "no declared pair";
}

TEST(ExperimentSweep, WhatAPathIgnoresIsSaidOnce) {
    Settings requested;
    requested.shadows = Shadows::off;
    const SweepRows sweep = defaultSweep(requested);
    const std::vector<std::string> gbuffer = reasonsOf(sweep, "gbuffer"),
                                   prepass = reasonsOf(sweep, "prepass");
    EXPECT_EQ(gbuffer, (std::vector<std::string>(2, "forward_plus has no G-buffer"))) << "compact and full";
    EXPECT_EQ(prepass, (std::vector<std::string>(2, "deferred has no depth pre-pass"))) << "on and off";
    EXPECT_FALSE(holds(wordsOfRows(sweep, requested), "forward_plus, gbuffer full"));
    EXPECT_TRUE(holds(wordsOfRows(defaultSweep()), "forward_plus, gbuffer full"))
        << "with shadows it is read";
}

TEST(ExperimentSweep, TheReferenceIsNoRow) {
    const SweepRows sweep = defaultSweep();
    EXPECT_EQ(reasonsOf(sweep, "path").front(), "is the reference that all rows are compared with");
    for (const Settings& row : sweep.rows) EXPECT_NE(row.path, Path::reference);
}

TEST(ExperimentSweep, ReferenceSamplesReachNoRow) {
    Settings requested;
    requested.spp = 64;
    requested.reference_mode = ReferenceMode::scene;
    for (const Settings& row : defaultSweep(requested).rows) EXPECT_EQ(row.problem(), std::nullopt);
}

// Against a ground truth with one sample per pixel, or with other weights, the mean of several samples
// would count as an error.
TEST(ExperimentSweep, SamplesAreTriedAgainstATruthOfSamples) {
    const Grid samples{{"msaa", {"1", "4"}}, {"resolve", {"linear", "tonemapped"}}};
    Settings requested;
    EXPECT_EQ(wordsOfRows(makeSweepRows(requested, {samples})), std::vector<std::string>{"forward_plus"});
    for (const auto& [mode, spp, use] : {std::tuple{"surface", "1", "use --reference-mode scene --spp 64"},
                                         {"scene", "3", "use --spp 64"}}) {
        requested.set("reference-mode", mode);
        requested.set("spp", spp);
        bool said = false;
        for (const std::string& reason : reasonsOf(makeSweepRows(requested, {samples}), "msaa"))
            said = said || reason.find(use) != std::string::npos;
        EXPECT_TRUE(said) << use;
    }
    requested.set("spp", "64");
    EXPECT_EQ(wordsOfRows(makeSweepRows(requested, {samples}), requested),
              (std::vector<std::string>{"forward_plus", "forward_plus, msaa 4"}));
    requested.set("msaa", "4");
    requested.set("resolve", "tonemapped");
    EXPECT_EQ(wordsOfRows(makeSweepRows(requested, {samples}), requested),
              (std::vector<std::string>{"forward_plus, msaa 1, resolve linear", "forward_plus"}));
}

TEST(ExperimentSweep, SizesArePartsOfTheGivenOne) {
    Settings requested;
    requested.size = {641, 3};
    const std::vector<std::string> expected{"160x1", "321x2", "481x2"};
    EXPECT_EQ(sweptValues(requested, "size"), expected);
    EXPECT_EQ(wordsFor(requested, "size", "1/1000"), "1x1") << "never empty";
    EXPECT_EQ(wordsFor(requested, "size", "8x4"), "8x4");
    EXPECT_EQ(wordsFor(requested, "gbuffer", "1/2"), "1/2") << "only of a size";
    EXPECT_EQ(wordsFor(requested, "size", "1/0"), "1/0") << "left for set() to refuse";
    EXPECT_THROW(static_cast<void>(sweptValues(requested, "gamma")), std::runtime_error);
}

TEST(ExperimentSweep, AGridIsItsProduct) {
    const Settings requested;
    const SweepRows sweep = makeSweepRows(
        requested, {{{"path", {"deferred", "forward_plus"}}, {"size", {"64x36", "32x18"}}}, {}});
    const std::vector<std::string> expected{"deferred, size 64x36", "deferred, size 32x18",
                                            "forward_plus, size 64x36", "forward_plus, size 32x18",
                                            "forward_plus"};
    EXPECT_EQ(wordsOfRows(sweep), expected) << "an empty grid is the given Settings";
    EXPECT_TRUE(sweep.skips.empty());
}

TEST(ExperimentSweep, OneThatIsIgnoredIsDrawnWithoutAndSaid) {
    Settings requested;
    requested.shadows = Shadows::off;
    const SweepRows sweep = makeSweepRows(requested, {{{"gbuffer", {"compact", "full"}}}});
    EXPECT_EQ(wordsOfRows(sweep, requested), std::vector<std::string>{"forward_plus"});
    EXPECT_EQ(sweep.skips.size(), 2u);
}

TEST(ExperimentSweep, WhatADeviceLacksIsLeftOutAndSaid) {
    Settings requested;
    const auto noSteps = [](const Settings& row) -> std::optional<std::string> {
        if (row.depth_format != DepthFormat::d24) return {};
        return "there are no steps";
    };
    const auto asked = [&](const std::vector<std::string>& formats) {
        return withoutRefused(makeSweepRows(requested, {{{"depth-format", formats}}}), requested, noSteps);
    };
    const SweepRows sweep = asked({"d32f", "d24", "d16"});
    ASSERT_EQ(sweep.rows.size(), 2u);
    EXPECT_EQ(sweep.rows[1].depth_format, DepthFormat::d16);
    ASSERT_EQ(sweep.skips.size(), 1u);
    EXPECT_EQ(sweep.skips[0].reason, "there are no steps");
    EXPECT_EQ(sweep.skips[0].tried.back(), (Change{"depth-format", "d24"}));
    EXPECT_THROW(asked({"d24"}), std::runtime_error);
}

TEST(ExperimentSweep, NothingToDrawIsAnError) {
    const std::string refusal = faultOf([&] { makeSweepRows({}, {{{"msaa-shading", {"sample"}}}}); });
    EXPECT_NE(refusal.find("--msaa-shading sample"), std::string::npos) << refusal;
}

TEST(ExperimentSweep, TooManyCombinationsAreRefusedBeforeTheyAreMade) {
    Grid grid;
    for (int i = 0; i < 12; ++i) grid.push_back({"size", std::vector<std::string>(10, "8x8")});
    EXPECT_THROW(makeSweepRows({}, {grid}), std::runtime_error);
}

TEST(ExperimentSweep, SkipsOfOneReasonAreOneLine) {
    const auto refused = [](const std::string& path, const std::string& option, const std::string& value) {
        Settings settings;
        settings.set("path", path);
        settings.set(option, value);
        return SweepSkip{{{"path", path}, {option, value}}, settings.problem().value()};
    };
    const std::vector<SweepSkip> skips{
        refused("deferred", "msaa-edges", "all"),
        refused("forward_plus", "msaa-edges", "all"),
        refused("deferred", "msaa-edges", "similar"),
        refused("deferred", "msaa-shading", "sample"),
        {{{"path", "deferred"}, {"prepass", "on"}}, "deferred has no depth pre-pass"},
        {{{"path", "deferred"}, {"msaa", "4"}, {"size", "9x9"}}, "together too large"}};
    EXPECT_EQ(skips[0].reason, "--msaa-edges all has no effect without --msaa 4; use exact");
    const std::vector<SkipGroup> groups = groupsOf(skips);
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[0].reason, "has no effect without --msaa 4");
    EXPECT_EQ(groups[0].tried, (std::vector<std::string>{"msaa-edges all|similar", "msaa-shading sample"}));
    EXPECT_EQ(groups[1].tried, std::vector<std::string>{"prepass on"});
    EXPECT_EQ(groups[2].tried, std::vector<std::string>{"deferred, msaa 4, size 9x9"});
}

TEST(ExperimentSweep, DeclaredPairsAndIgnoredSettingsExist) {
    const Settings defaults;
    std::set<std::string> options{"*"};
    Settings::fields(defaults, [&](const Field& field, const auto&) {
        options.emplace(field.option);
        for (const std::string& value : sweptValues(defaults, field.option)) {
            Settings other;
            EXPECT_NO_THROW(other.set(field.option, value)) << field.option << " " << value;
        }
    });
    for (const SweepPair& pair : sweepPairs())
        for (const std::string_view option : {pair.a, pair.b})
            EXPECT_TRUE(options.contains(std::string(option))) << option;
    for (const auto& [path, name] : enumNames<Path>()) {
        Settings settings;
        settings.path = path;
        EXPECT_EQ(effectiveSettings(settings), settings) << name << ": an unknown option would throw";
    }
}

// Multiple scattering is swept if the command line requests it, and compared with the random walk.
TEST(ExperimentMultiscatter, IsSweptWhereItIsAskedForAgainstTheWalk) {
    const auto tried = [](const SweepRows& sweep) {
        std::set<Multiscatter> values;
        for (const Settings& row : sweep.rows) values.insert(row.multiscatter);
        return values;
    };
    Settings requested;
    const SweepRows defaults = defaultSweep(requested);
    EXPECT_EQ(tried(defaults), std::set{Multiscatter::off});
    EXPECT_EQ(referenceFor(requested, defaults.rows), requested);
    requested.multiscatter = Multiscatter::energy;
    const SweepRows asked = defaultSweep(requested);
    EXPECT_EQ(tried(asked), (std::set{Multiscatter::off, Multiscatter::energy, Multiscatter::fdez}));
    const Settings truth = referenceFor(requested, asked.rows);
    EXPECT_EQ(truth.multiscatter, Multiscatter::walk);
    EXPECT_EQ(referenceSettings(truth).problem(), std::nullopt);
}

// Haze march steps are swept if there is haze. All haze is compared with the integral between two heights.
TEST(ExperimentHaze, IsSweptWhereThereIsSomeAgainstTheIntegral) {
    const auto tried = [](const SweepRows& sweep) {
        std::set<int> values;
        for (const Settings& row : sweep.rows) values.insert(row.haze_march_steps);
        return values;
    };
    Settings requested;
    const SweepRows defaults = defaultSweep(requested);
    EXPECT_EQ(tried(defaults), std::set{0});
    EXPECT_EQ(referenceFor(requested, defaults.rows), requested);
    requested.haze = true;
    const SweepRows asked = defaultSweep(requested);
    EXPECT_EQ(tried(asked), (std::set{0, 8, 32}));
    EXPECT_GT(referenceFor(requested, asked.rows).haze_march_steps, 0);
}

// Against one sample per pixel, filtered roughness would always count as an error.
TEST(ExperimentSpecularAa, IsSweptAgainstSamplesOfTheSceneAlone) {
    const auto tried = [](const SweepRows& sweep) {
        std::set<std::pair<bool, SpecularNormals>> values;
        for (const Settings& row : sweep.rows) values.emplace(row.spec_aa, row.spec_aa_normals);
        return values;
    };
    using enum SpecularNormals;
    Settings requested;
    EXPECT_EQ(tried(defaultSweep(requested)), (std::set{std::pair(false, geometry)}));
    requested.spec_aa = true;
    EXPECT_EQ(tried(defaultSweep(requested)), (std::set{std::pair(true, geometry)}));
    requested.spec_aa = false;
    requested.reference_mode = ReferenceMode::scene;
    EXPECT_EQ(tried(defaultSweep(requested)),
              (std::set{std::pair(false, geometry), std::pair(true, geometry), std::pair(true, mapped)}));
}

// A sweep over shadows is compared with the shadowed ground truth, whatever the given Settings.
TEST(ExperimentSweep, TheTruthHasShadowsWhereAnyRowDoes) {
    Settings requested;
    requested.shadows = Shadows::off;
    EXPECT_EQ(referenceFor(requested, {requested, requested}), requested);
    Settings shadowed = requested;
    shadowed.shadows = Shadows::evsm;
    EXPECT_NE(referenceFor(requested, {requested, shadowed}).shadows, Shadows::off);
    EXPECT_EQ(referenceSettings(referenceFor(requested, {requested, shadowed})).shadows, Shadows::pcf);
    EXPECT_EQ(referenceFor(shadowed, {requested}), shadowed);
}

}  // namespace
}  // namespace diptych::experiment
