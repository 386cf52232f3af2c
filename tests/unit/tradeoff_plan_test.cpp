// SPDX-License-Identifier: MIT
// Which Settings a sweep draws.
#include "compare/tradeoff/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace diptych {
namespace {

SweepRows usualPlan(const Settings& given = {}) {
    return planSweep(given, usualGrids(given));
}

std::vector<std::string> wordsOfRows(const SweepRows& plan, const Settings& given = {}) {
    std::vector<std::string> words;
    for (const Settings& row : plan.rows) words.push_back(inWords(choicesOf(row, given)));
    return words;
}

bool holds(const std::vector<std::string>& all, const std::string& one) {
    return std::ranges::count(all, one) > 0;
}

std::vector<std::string> reasonsOf(const SweepRows& plan, const std::string& option) {
    std::vector<std::string> reasons;
    for (const SweepSkip& skip : plan.skips)
        for (const Choice& choice : skip.tried)
            if (choice.first == option) reasons.push_back(skip.reason);
    return reasons;
}

TEST(TradeoffSweep, TheDefaultStandsFirstAndNothingTwice) {
    const SweepRows plan = usualPlan();
    ASSERT_FALSE(plan.rows.empty());
    EXPECT_EQ(plan.rows.front(), Settings());
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        EXPECT_EQ(std::ranges::count(plan.rows, plan.rows[i]), 1) << i;
        EXPECT_EQ(plan.rows[i].problem(), std::nullopt) << i;
        EXPECT_EQ(effectiveSettings(plan.rows[i]), plan.rows[i]) << i;
    }
}

// Whatever Settings there are: each swept value of each is a row of each path, or a skip with a reason.
TEST(TradeoffSweep, EveryValueOfEverySettingIsDrawnOrHasAReason) {
    const Settings given;
    const SweepRows plan = usualPlan(given);
    std::size_t tried = 0;
    Settings::fields(given, [&](const Field& field, const auto&) {
        for (const std::string& value : sweptValues(given, field.option)) {
            if (field.option == "path") continue;
            for (const Path path : {Path::deferred, Path::forward_plus}) {
                Settings asked = given;
                asked.path = path;
                asked.set(field.option, value);
                const Choice choice{std::string(field.option), asked.valueOf(field.option)};
                const auto skipped = [&](const SweepSkip& skip) {
                    return !skip.reason.empty() && std::ranges::count(skip.tried, choice) == 1 &&
                           std::ranges::count(skip.tried, Choice{"path", std::string(nameOf(path))}) == 1;
                };
                const bool drawn = std::ranges::count(plan.rows, asked) == 1;
                EXPECT_NE(drawn, std::ranges::any_of(plan.skips, skipped))
                    << nameOf(path) << " " << field.option << " " << value;
                ++tried;
            }
        }
    });
    EXPECT_GT(tried, 50u);
}

TEST(TradeoffSweep, OneAtATimeAndPairsButNotTheProduct) {
    const std::vector<std::string> rows = wordsOfRows(usualPlan());
    for (const char* row :
         {"forward_plus", "deferred", "deferred, gbuffer full", "forward_plus, size 320x180",
          "deferred, gbuffer full, size 320x180", "forward_plus, prepass off"})
        EXPECT_TRUE(holds(rows, row)) << row;
    EXPECT_FALSE(holds(rows, "forward_plus, prepass off, size 320x180")) << "no declared pair";
}

TEST(TradeoffSweep, WhatAPathIgnoresIsSaidOnce) {
    const SweepRows plan = usualPlan();
    const std::vector<std::string> gbuffer = reasonsOf(plan, "gbuffer"), prepass = reasonsOf(plan, "prepass");
    EXPECT_EQ(gbuffer, (std::vector<std::string>(2, "forward_plus has no G-buffer"))) << "compact and full";
    EXPECT_EQ(prepass, (std::vector<std::string>(2, "deferred has no depth pre-pass"))) << "on and off";
    const std::vector<std::string> rows = wordsOfRows(plan);
    EXPECT_FALSE(holds(rows, "forward_plus, gbuffer full"));
}

TEST(TradeoffSweep, TheReferenceIsNoRow) {
    const SweepRows plan = usualPlan();
    EXPECT_EQ(reasonsOf(plan, "path").front(), "is what the others are measured against");
    for (const Settings& row : plan.rows) EXPECT_NE(row.path, Path::reference);
}

TEST(TradeoffSweep, ReferenceSamplesReachNoRow) {
    Settings given;
    given.spp = 64;
    given.reference_mode = ReferenceMode::scene;
    for (const Settings& row : usualPlan(given).rows) EXPECT_EQ(row.problem(), std::nullopt);
}

TEST(TradeoffSweep, SizesArePartsOfTheGivenOne) {
    Settings given;
    given.size = {641, 3};
    const std::vector<std::string> expected{"160x1", "321x2", "481x2"};
    EXPECT_EQ(sweptValues(given, "size"), expected);
    EXPECT_EQ(wordsFor(given, "size", "1/1000"), "1x1") << "never empty";
    EXPECT_EQ(wordsFor(given, "size", "8x4"), "8x4");
    EXPECT_EQ(wordsFor(given, "gbuffer", "1/2"), "1/2") << "only of a size";
    EXPECT_EQ(wordsFor(given, "size", "1/0"), "1/0") << "left for set() to refuse";
    EXPECT_THROW(static_cast<void>(sweptValues(given, "gamma")), std::runtime_error);
}

TEST(TradeoffSweep, AGridIsItsProduct) {
    const Settings given;
    const SweepRows plan =
        planSweep(given, {{{"path", {"deferred", "forward_plus"}}, {"size", {"64x36", "32x18"}}}, {}});
    const std::vector<std::string> expected{"deferred, size 64x36", "deferred, size 32x18",
                                            "forward_plus, size 64x36", "forward_plus, size 32x18",
                                            "forward_plus"};
    EXPECT_EQ(wordsOfRows(plan), expected) << "an empty grid is the given Settings";
    EXPECT_TRUE(plan.skips.empty());
}

TEST(TradeoffSweep, OneThatIsIgnoredIsDrawnWithoutAndSaid) {
    const SweepRows plan = planSweep({}, {{{"gbuffer", {"compact", "full"}}}});
    EXPECT_EQ(wordsOfRows(plan), std::vector<std::string>{"forward_plus"});
    EXPECT_EQ(plan.skips.size(), 2u);
}

TEST(TradeoffSweep, NothingToDrawIsAnError) {
    try {
        planSweep({}, {{{"shadows", {"pcf"}}}});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("--shadows pcf"), std::string::npos) << error.what();
    }
}

TEST(TradeoffSweep, TooManyCombinationsAreRefusedBeforeTheyAreMade) {
    Grid grid;
    for (int i = 0; i < 12; ++i) grid.push_back({"size", std::vector<std::string>(10, "8x8")});
    EXPECT_THROW(planSweep({}, {grid}), std::runtime_error);
}

TEST(TradeoffSweep, SkipsOfOneReasonAreOneLine) {
    const std::vector<SweepSkip> skips{
        {{{"path", "deferred"}, {"assign", "tiled"}}, "--assign tiled is not built yet; use every"},
        {{{"path", "forward_plus"}, {"assign", "tiled"}}, "--assign tiled is not built yet; use every"},
        {{{"path", "deferred"}, {"assign", "clustered"}}, "--assign clustered is not built yet; use every"},
        {{{"path", "deferred"}, {"msaa", "4"}}, "--msaa 4 is not built yet; use 1"},
        {{{"path", "deferred"}, {"prepass", "on"}}, "deferred has no depth pre-pass"},
        {{{"path", "deferred"}, {"msaa", "4"}, {"size", "9x9"}}, "together too large"}};
    const std::vector<SkipGroup> groups = groupsOf(skips);
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[0].reason, "is not built yet");
    EXPECT_EQ(groups[0].tried, (std::vector<std::string>{"assign tiled|clustered", "msaa 4"}));
    EXPECT_EQ(groups[1].tried, std::vector<std::string>{"prepass on"});
    EXPECT_EQ(groups[2].tried, std::vector<std::string>{"deferred, msaa 4, size 9x9"});
}

TEST(TradeoffSweep, DeclaredPairsAndIgnoredSettingsExist) {
    const Settings usual;
    std::set<std::string> options{"*"};
    Settings::fields(usual, [&](const Field& field, const auto&) {
        options.emplace(field.option);
        for (const std::string& value : sweptValues(usual, field.option)) {
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

}  // namespace
}  // namespace diptych
