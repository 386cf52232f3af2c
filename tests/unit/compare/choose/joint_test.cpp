// SPDX-License-Identifier: MIT
// A joint choice for several scenes with known times and errors.
#include "compare/choose/joint.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <list>
#include <map>
#include <random>

namespace diptych::choose {

namespace {

struct Known {
    double ms = 0, error = 0;
};

Settings known(Path path, const char* gbuffer) {
    Settings settings;
    settings.path = path;
    settings.set("gbuffer", gbuffer);
    return settings;
}

const Settings compactOne = known(Path::deferred, "compact"), standardOne = known(Path::deferred, "standard"),
               fullOne = known(Path::deferred, "full"), forwardOne = known(Path::forward_plus, "standard");

// Times and errors of the four Settings above, in this order.
class KnownEvaluator final : public Evaluator {
public:
    explicit KnownEvaluator(const std::vector<Known>& of, double deviation = 0, std::uint64_t seed = 1)
        : of_(of), deviation_(deviation), random_(seed) {}
    Measures evaluate(const Settings& settings) override {
        ++evaluated;
        Measures measured;
        measured[Measure::flip] = find(settings).error;
        measured[Measure::memory] = 1000;
        return measured;
    }
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override {
        std::vector<double> times;
        for (const std::size_t i : order)
            times.push_back(find(frames[i]).ms *
                            std::exp(std::normal_distribution<double>(0, deviation_)(random_)));
        return times;
    }
    std::vector<PassTime> profile(const Settings& settings) override {
        return {{"shade", find(settings).ms}};
    }
    std::size_t evaluated = 0;

private:
    const Known& find(Settings settings) const {
        settings.camera.clear();
        const Settings all[] = {compactOne, standardOne, fullOne, forwardOne};
        for (std::size_t i = 0; i < 4; ++i)
            if (all[i] == settings) return of_.at(i);
        throw std::runtime_error("unknown Settings");
    }
    std::vector<Known> of_;
    double deviation_;
    std::mt19937_64 random_;
};

// Each scene's own choice among all four, then the joint choice.
struct ForAll {
    ForAll(const std::vector<std::vector<Known>>& scenes, const Budget& budget, JointOptions options = {}) {
        std::vector<const SettingsChoice*> pointers;
        const std::vector<Settings> candidates{standardOne, forwardOne, compactOne, fullOne};
        for (const std::vector<Known>& scene : scenes) {
            labs.emplace_back(scene, 0.01, labs.size() + 1);
            SearchOptions search_options;
            search_options.budget = budget;
            own.push_back(search(candidates, labs.back(), search_options));
            labs.back().evaluated = 0;
        }
        for (const SettingsChoice& choice : own) pointers.push_back(&choice);
        options.budget = budget;
        std::vector<KnownEvaluator*> by_number;
        for (KnownEvaluator& evaluator : labs) by_number.push_back(&evaluator);
        result = chooseJointly(
            pointers, [&](std::size_t i) -> Evaluator& { return *by_number[i]; }, options);
    }
    const Settings& chosen() const { return result.candidates.at(result.chosen.value()).settings; }
    std::list<KnownEvaluator> labs;
    std::vector<SettingsChoice> own;
    JointChoice result;
};

// No scene chooses forward+. It takes 1.2 times each scene's best time, while each scene's own choice
// takes at least twice the other's best.
TEST(ChooseForAll, TheLeastSumOfLogarithmsThoughNoScenesOwn) {
    const ForAll all({{{10, 0.01}, {22, 0.01}, {30, 0.01}, {12, 0.01}},
                      {{220, 0.01}, {100, 0.01}, {300, 0.01}, {120, 0.01}}},
                     {.error = 0.02, .ms = {}, .bytes = {}});
    ASSERT_TRUE(all.result.chosen);
    EXPECT_EQ(all.own[0].candidates[*all.own[0].chosen].settings, compactOne);
    EXPECT_EQ(all.own[1].candidates[*all.own[1].chosen].settings, standardOne);
    EXPECT_EQ(all.chosen(), forwardOne);
    EXPECT_TRUE(all.result.significant);
    ASSERT_EQ(all.result.slower.size(), 2u);
    for (const auto& slower : all.result.slower) {
        ASSERT_TRUE(slower);
        EXPECT_NEAR(slower->ratio, 1.2, 0.03);
        EXPECT_LE(slower->low, 1.2);
        EXPECT_GE(slower->high, 1.2);
    }
}

// Compact is fastest in both scenes but exceeds the error budget in one.
TEST(ChooseForAll, WhatExceedsTheErrorInOneSceneIsOut) {
    const ForAll all(
        {{{1, 0.01}, {10, 0.01}, {30, 0.001}, {12, 0.01}}, {{1, 0.03}, {10, 0.01}, {30, 0.05}, {12, 0.01}}},
        {.error = 0.02, .ms = {}, .bytes = {}});
    ASSERT_TRUE(all.result.chosen);
    EXPECT_EQ(all.own[0].candidates[*all.own[0].chosen].settings, compactOne);
    EXPECT_EQ(all.chosen(), standardOne);
    for (const JointCandidate& candidate : all.result.candidates)
        EXPECT_EQ(candidate.fits, candidate.settings == standardOne || candidate.settings == forwardOne);
    EXPECT_NEAR(all.result.slower[0]->ratio, 10, 0.5);
    EXPECT_EQ(all.result.slower[1]->ratio, 1) << "the second scene's own choice";
}

TEST(ChooseForAll, WhereNothingFitsAllTheNearestIsNamedWithItsScene) {
    const ForAll all({{{1, 0.01}, {10, 0.5}, {30, 0.5}, {12, 0.5}},
                      {{1, 0.4}, {10, 0.5}, {30, 0.022}, {12, 0.5}},
                      {{1, 0.01}, {10, 0.5}, {30, 0.024}, {12, 0.5}}},
                     {.error = 0.02, .ms = {}, .bytes = {}});
    EXPECT_FALSE(all.result.chosen);
    ASSERT_TRUE(all.result.nearest);
    // Compact's worst error is 0.4, in the second scene; every other candidate reaches 0.5 in some scene.
    const JointCandidate& nearest = all.result.candidates[*all.result.nearest];
    const std::size_t scene = all.result.nearest_scene;
    EXPECT_EQ(nearest.settings, compactOne);
    EXPECT_EQ(scene, 1u);
    EXPECT_EQ(nearest.scenes[scene][Measure::flip], 0.4);
}

// The most accurate candidate takes too long in one scene; the smallest worst error of the rest wins.
TEST(ChooseForAll, TheLeastWorstErrorWithinTheTimeOfEveryScene) {
    const ForAll all({{{10, 0.05}, {11, 0.02}, {12, 0.001}, {13, 0.03}},
                      {{10, 0.05}, {11, 0.03}, {50, 0.001}, {13, 0.02}}},
                     {.error = {}, .ms = 20, .bytes = {}});
    ASSERT_TRUE(all.result.chosen);
    EXPECT_EQ(all.chosen(), standardOne) << "as accurate at worst as forward+, and faster";
    for (const JointCandidate& candidate : all.result.candidates)
        if (candidate.settings == fullOne) {
            EXPECT_FALSE(candidate.fits);
        }
}

TEST(ChooseForAll, WhatIsLeftOutIsCounted) {
    JointOptions options;
    options.max_candidates = 2;
    const ForAll all({{{10, 0.01}, {22, 0.01}, {30, 0.01}, {12, 0.01}},
                      {{220, 0.01}, {100, 0.01}, {300, 0.01}, {120, 0.01}}},
                     {.error = 0.02, .ms = {}, .bytes = {}}, options);
    ASSERT_EQ(all.result.candidates.size(), 2u);
    for (const JointCandidate& candidate : all.result.candidates)
        EXPECT_EQ(candidate.proposed_by, 2u) << "a first one of both scenes, and once each";
    EXPECT_EQ(all.result.omitted, 1u) << "compact; full was not drawn: it is slower";
}

// If nothing fits the budget, a scene proposes its path's first candidate and its most accurate one.
TEST(ChooseForAll, OfCandidatesAsAccurateTheFirstIsProposed) {
    SettingsChoice own;
    for (const auto& [settings, error] :
         {std::pair(compactOne, 0.5), std::pair(fullOne, 0.03), std::pair(standardOne, 0.03)}) {
        Candidate& candidate = own.candidates.emplace_back();
        candidate.settings = settings;
        candidate.measured[Measure::flip] = error;
        candidate.measured[Measure::memory] = 1000;
    }
    KnownEvaluator evaluator({});
    const SettingsChoice* const pointer = &own;
    JointOptions options;
    options.budget = {.error = 0.02, .ms = {}, .bytes = {}};
    const JointChoice all = chooseJointly(
        std::span(&pointer, 1), [&](std::size_t) -> Evaluator& { return evaluator; }, options);
    ASSERT_EQ(all.candidates.size(), 2u);
    EXPECT_EQ(all.candidates[0].settings, compactOne);
    EXPECT_EQ(all.candidates[1].settings, fullOne);
    EXPECT_EQ(evaluator.evaluated, 0u) << "both are known";
}

TEST(ChooseForAll, AMissIsTheWorstOfTheLimits) {
    const Budget budget{.error = 0.1, .ms = 10, .bytes = 100};
    Measures measured;
    measured[Measure::flip] = 0.1;
    measured[Measure::memory] = 100;
    EXPECT_EQ(missOf(measured, budget), 0) << "the time is not known";
    measured[Measure::ms] = 10;
    EXPECT_EQ(missOf(measured, budget), 0);
    measured[Measure::ms] = 12;
    EXPECT_NEAR(missOf(measured, budget), 0.2, 1e-12);
    measured[Measure::flip] = 0.11;
    measured[Measure::memory] = 150;
    EXPECT_NEAR(missOf(measured, budget), 0.5, 1e-12);
}

}  // namespace

}  // namespace diptych::choose
