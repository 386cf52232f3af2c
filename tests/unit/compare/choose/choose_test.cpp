// SPDX-License-Identifier: MIT
// Choices compared with exhaustive sweeps: recorded times and errors of every candidate.
#include "compare/choose/search.h"
#include "tests/unit/compare/choose/replay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace diptych::choose {

namespace {

// Best value within a budget: the smallest time, or the smallest error.
std::optional<double> bestOf(const RecordedSweep& sweep, const Budget& budget) {
    std::optional<double> best;
    for (const RecordedRow& row : sweep.rows) {
        if (budget.error && row.error > *budget.error) continue;
        if (budget.ms && row.ms > *budget.ms) continue;
        if (budget.bytes && row.bytes > *budget.bytes) continue;
        const double value = budget.isForSpeed() ? row.ms : row.error;
        if (!best || value < *best) best = value;
    }
    return best;
}

struct SearchOutcome {
    bool right = false;
    double off = 0;      // chosen value relative to the best one
    double timings = 0;  // fraction of an exhaustive search's timings
    std::size_t evaluated = 0;
};

constexpr double near = 1.05, frames_of_each = 6;

// In the command line's order: the given Settings first, then by the number of changed values.
std::vector<Settings> candidatesOf(const RecordedSweep& sweep) {
    Settings requested;
    requested.size = {320, 180};
    std::vector<std::pair<std::ptrdiff_t, Settings>> candidates;
    for (const RecordedRow& row : sweep.rows)
        candidates.emplace_back(std::ranges::count_if(settingFields(),
                                                      [&](const Field& field) {
                                                          return field.option != "path" &&
                                                                 row.settings.valueOf(field.option) !=
                                                                     requested.valueOf(field.option);
                                                      }),
                                row.settings);
    std::ranges::stable_sort(candidates, {}, [](const auto& candidate) { return candidate.first; });
    std::vector<Settings> sorted;
    for (auto& [others, settings] : candidates) sorted.push_back(std::move(settings));
    return sorted;
}

std::optional<Settings> anyOf(const Settings& of, std::span<const Change> changes) {
    Settings made = of;
    for (const Change& change : changes) made.set(change.option, change.value);
    return made;
}

SearchOutcome chosenFrom(const RecordedSweep& sweep, std::span<const Settings> candidates, Budget budget,
                         const ReplayNoise& noise, std::uint64_t seed) {
    RecordedEvaluator evaluator(sweep, noise, seed);
    SearchOptions options;
    options.budget = budget;
    options.combine = [&](const Settings& of, std::span<const Change> changes) {
        const std::optional<Settings> made = anyOf(of, changes);
        return std::ranges::count(sweep.rows, *made, &RecordedRow::settings) > 0 ? made : std::nullopt;
    };
    const std::vector<Settings> table = tableOf(candidates);
    const SettingsChoice choice = search(table, evaluator, options);
    // Compare the time limit with the device's speed in the middle of the race.
    double raced = 0;
    for (const Candidate& candidate : choice.candidates)
        if (candidate.race) raced += 2 * candidate.race->pairs;
    if (budget.ms) *budget.ms /= evaluator.drift(0.5 * raced);
    SearchOutcome outcome;
    outcome.timings =
        static_cast<double>(choice.timings) / (frames_of_each * static_cast<double>(sweep.rows.size()));
    outcome.evaluated = choice.evaluated;
    const std::optional<double> best = bestOf(sweep, budget);
    if (!choice.chosen) {
        // Correct if nothing fits, or if the fitting rows are too close to the limit.
        Budget tight = budget;
        if (tight.ms) *tight.ms /= near;
        outcome.right = !bestOf(sweep, tight);
        return outcome;
    }
    const RecordedRow& row = sweep.find(choice.candidates[*choice.chosen].settings);
    const bool fits = !(budget.error && row.error > *budget.error) &&
                      !(budget.ms && row.ms > *budget.ms * near) &&
                      !(budget.bytes && row.bytes > *budget.bytes);
    Budget wide = budget;
    if (wide.ms) *wide.ms /= near;
    const std::optional<double> near_best = bestOf(sweep, wide);
    const double value = budget.isForSpeed() ? row.ms : row.error;
    outcome.off = near_best ? value / *near_best : 1;
    outcome.right = fits && best && (!near_best || value <= *near_best * near + 1e-12);
    return outcome;
}

// Budgets between the extremes of a sweep.
std::vector<Budget> budgetsFor(const RecordedSweep& sweep) {
    std::vector<double> errors, times;
    std::vector<std::uint64_t> bytes;
    for (const RecordedRow& row : sweep.rows) {
        errors.push_back(row.error);
        times.push_back(row.ms);
        bytes.push_back(row.bytes);
    }
    std::ranges::sort(errors);
    std::ranges::sort(times);
    std::ranges::sort(bytes);
    const auto at = [](const auto& sorted, double part) {
        return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
    };
    std::vector<Budget> budgets;
    for (const double part : {0.1, 0.25, 0.5, 0.75, 0.95}) {
        budgets.push_back({.error = at(errors, part) * 1.0001, .ms = {}, .bytes = {}});
        budgets.push_back({.error = {}, .ms = at(times, part) * 1.0001, .bytes = {}});
    }
    budgets.push_back({.error = at(errors, 0.5) * 1.0001, .ms = {}, .bytes = at(bytes, 0.5)});
    budgets.push_back({.error = {}, .ms = at(times, 0.5) * 1.0001, .bytes = at(bytes, 0.5)});
    return budgets;
}

// `seeds`: noise streams for each budget; DIPTYCH_REPLAY_SEEDS overrides it.
void sweepAll(const ReplayNoise& noise, std::uint64_t seeds) {
    if (const char* const wished = std::getenv("DIPTYCH_REPLAY_SEEDS")) seeds = std::stoull(wished);
    std::size_t cases = 0, right = 0;
    double timings = 0, evaluated = 0;
    fmt::print("{:<28} {:>6} {:>14} {:>12} {:>12} {:>10}\n", "scene", "rows", "right", "timings", "worst",
               "judged");
    for (const RecordedSweep& sweep : recordedSweeps()) {
        std::size_t tried = 0, good = 0;
        double worst = 1, fraction = 0, images = 0;
        const std::vector<Settings> candidates = candidatesOf(sweep);
        for (const Budget& budget : budgetsFor(sweep))
            for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
                const SearchOutcome outcome = chosenFrom(sweep, candidates, budget, noise, seed);
                ++tried;
                good += outcome.right;
                worst = std::max(worst, outcome.off);
                fraction += outcome.timings;
                images += static_cast<double>(outcome.evaluated);
                if (!outcome.right && std::getenv("DIPTYCH_REPLAY_VERBOSE"))
                    fmt::print("  wrong: error {} ms {} bytes {} seed {}: off {:.3f} timings {:.1f} %\n",
                               budget.error.value_or(0), budget.ms.value_or(0), budget.bytes.value_or(0),
                               seed, outcome.off, 100 * outcome.timings);
            }
        cases += tried;
        right += good;
        timings += fraction;
        evaluated += images;
        const auto n = static_cast<double>(tried);
        fmt::print("{:<28} {:>6} {:>6} of {:>4} {:>10.1f} % {:>11.3f} {:>10.1f}\n", sweep.scene,
                   sweep.rows.size(), good, tried, 100 * fraction / n, worst, images / n);
    }
    const auto n = static_cast<double>(cases);
    fmt::print("{} of {} ({:.1f} %) within 5 %, {:.1f} % of a sweep's timings, {:.1f} judged\n", right, cases,
               100 * static_cast<double>(right) / n, 100 * timings / n, evaluated / n);
    EXPECT_GE(static_cast<double>(right), 0.95 * n);
    EXPECT_LE(timings / n, 0.10);
    EXPECT_LE(evaluated / n, 35);
}

TEST(ChooseReplay, FindsWhatASweepOfEverythingFinds) {
    sweepAll({.deviation = 0.03, .drift = 0}, 4);
}

TEST(ChooseReplay, FindsItUnderNoiseAndDrift) {
    sweepAll({.deviation = 0.05, .drift = 0.05}, 4);
}

// Each option value multiplies the time and adds to the error by a given law.
class LawfulEvaluator final : public Evaluator {
public:
    std::map<std::pair<std::string, std::string>, std::pair<double, double>> law;
    std::size_t evaluated = 0;

    Measures evaluate(const Settings& settings) override {
        ++evaluated;
        Measures measured;
        measured[Measure::flip] = of(settings).second;
        measured[Measure::memory] = 0;
        return measured;
    }
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override {
        std::vector<double> times;
        for (const std::size_t i : order) times.push_back(of(frames[i]).first);
        return times;
    }
    std::vector<PassTime> profile(const Settings& settings) override {
        return {{"shade", of(settings).first}};
    }

private:
    std::pair<double, double> of(const Settings& settings) const {
        double ms = 100, error = 0.01;
        for (const auto& [change, does] : law)
            if (settings.valueOf(change.first) == change.second) {
                ms *= does.first;
                error += does.second;
            }
        return {ms, error};
    }
};

TEST(ChooseSearch, CombinesChangesThatHelpAndLeavesOutWhatExceedsTheError) {
    LawfulEvaluator evaluator;
    evaluator.law = {{{"shadow-size", "512"}, {0.8, 0.001}},  {{"lit-format", "fp16"}, {0.9, 0.001}},
                     {{"depth-format", "d24"}, {0.9, 0.001}}, {{"spec-aa", "on"}, {0.5, 1}},
                     {{"light-kernel", "gather"}, {2, 0}},    {{"shadow-kernel", "1"}, {0.7, 0.001}}};
    const Settings first;
    std::vector<Settings> table{first};
    for (const auto& [change, does] : evaluator.law) {
        if (change.first == "shadow-kernel") continue;  // the table lacks this option
        table.push_back(first);
        table.back().set(change.first, change.second);
    }
    SearchOptions options;
    options.budget.error = 0.02;
    options.combine = anyOf;
    options.changes = {{first.path, "shadow-kernel", "1"}};
    const SettingsChoice choice = search(table, evaluator, options);
    ASSERT_TRUE(choice.chosen);
    EXPECT_NEAR(choice.ms, 100 * 0.8 * 0.9 * 0.9 * 0.7, 1e-9);
    EXPECT_EQ(choice.evaluated, evaluator.evaluated);
    EXPECT_LE(choice.evaluated, 16u);
    EXPECT_TRUE(choice.significant);
    EXPECT_EQ(choice.candidates[*choice.chosen].status, CandidateStatus::raced);
    for (const Candidate& candidate : choice.candidates)
        if (candidate.settings.valueOf("spec-aa") == "on") {
            EXPECT_NE(candidate.status, CandidateStatus::raced);
        }
}

TEST(ChooseSearch, WhereNothingFitsTheNearestIsNamed) {
    LawfulEvaluator evaluator;
    evaluator.law = {{{"shadow-size", "512"}, {1, 0.02}}, {{"shadow-size", "4096"}, {1, -0.005}}};
    const Settings first;
    std::vector<Settings> table(3, first);
    table[1].set("shadow-size", "512");
    table[2].set("shadow-size", "4096");
    SearchOptions options;
    options.budget.error = 0.001;
    const SettingsChoice choice = search(table, evaluator, options);
    EXPECT_FALSE(choice.chosen);
    EXPECT_EQ(choice.nearest, 2u);
    for (const Candidate& candidate : choice.candidates) EXPECT_EQ(candidate.status, CandidateStatus::misses);
}

TEST(ChooseSearch, TheMostAccurateWithinATime) {
    LawfulEvaluator evaluator;
    evaluator.law = {{{"shadow-size", "4096"}, {1.3, -0.005}}, {{"spec-aa", "on"}, {1.3, -0.004}}};
    const Settings first;
    std::vector<Settings> table(3, first);
    table[1].set("shadow-size", "4096");
    table[2].set("spec-aa", "on");
    SearchOptions options;
    options.combine = anyOf;
    for (const auto& [max, ms] : {std::pair{110.0, 100.0}, {140.0, 130.0}, {170.0, 169.0}}) {
        options.budget.ms = max;
        const SettingsChoice choice = search(table, evaluator, options);
        ASSERT_TRUE(choice.chosen);
        EXPECT_NEAR(choice.ms, ms, 1e-9);
    }
    options.budget.ms = 90;
    EXPECT_FALSE(search(table, evaluator, options).chosen);
}

// The table has each path's first candidate and its single default changes; of a few candidates, all.
TEST(ChooseTable, HoldsTheUsualChangesOfEachPath) {
    for (const RecordedSweep& sweep : recordedSweeps()) {
        const std::vector<Settings> candidates = candidatesOf(sweep), table = tableOf(candidates);
        EXPECT_GE(table.size(), 15u) << sweep.scene;
        EXPECT_LE(table.size(), maxInTable) << sweep.scene;
        const std::vector<Settings> few(candidates.begin(), candidates.begin() + 10);
        EXPECT_EQ(tableOf(few).size(), few.size());
    }
    std::vector<Settings> many(40, Settings());
    for (std::size_t i = 1; i < many.size(); ++i) many[i].set("shadow-bias", std::to_string(i));
    EXPECT_EQ(tableOf(many).size(), 1u) << "no usual change";
}

}  // namespace

}  // namespace diptych::choose
