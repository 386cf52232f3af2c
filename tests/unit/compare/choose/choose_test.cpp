// SPDX-License-Identifier: MIT
// What is chosen, held against sweeps of every candidate, whose times and errors were recorded.
#include "compare/choose/search.h"
#include "tests/unit/compare/choose/replay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace diptych::choose {

namespace {

// The best of a table within a budget: the least time, or the least error.
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

struct Outcome {
    bool right = false;
    double off = 0;      // of the chosen one's recorded figure to the best
    double timings = 0;  // share of the exhaustive ones
    std::size_t judged = 0;
};

constexpr double near = 1.05, frames_of_each = 6;

// As the command line has it: what it says comes first, then what has few other values.
std::vector<Settings> candidatesOf(const RecordedSweep& sweep) {
    Settings given;
    given.size = {320, 180};
    std::vector<std::pair<std::ptrdiff_t, Settings>> candidates;
    for (const RecordedRow& row : sweep.rows)
        candidates.emplace_back(std::ranges::count_if(settingFields(),
                                                      [&](const Field& field) {
                                                          return field.option != "path" &&
                                                                 row.settings.valueOf(field.option) !=
                                                                     given.valueOf(field.option);
                                                      }),
                                row.settings);
    std::ranges::stable_sort(candidates, {}, [](const auto& candidate) { return candidate.first; });
    std::vector<Settings> sorted;
    for (auto& [others, settings] : candidates) sorted.push_back(std::move(settings));
    return sorted;
}

Outcome chosenFrom(const RecordedSweep& sweep, std::span<const Settings> candidates, Budget budget,
                   const ReplayNoise& noise, std::uint64_t seed) {
    RecordedLab lab(sweep, noise, seed);
    const Calibration calibration;
    CostModel model(calibration);
    SearchOptions options;
    options.budget = budget;
    options.seed = seed;
    const Choice choice = search(candidates, lab, model, options);
    // Whether a frame is in time is said of the device as it was in the race.
    double raced = 0;
    for (const Candidate& candidate : choice.candidates)
        if (candidate.standing) raced += 2 * candidate.standing->rounds;
    if (budget.ms) *budget.ms /= lab.drift(0.5 * raced);
    Outcome outcome;
    outcome.timings =
        static_cast<double>(choice.timings) / (frames_of_each * static_cast<double>(sweep.rows.size()));
    outcome.judged = choice.judged;
    const std::optional<double> best = bestOf(sweep, budget);
    if (!choice.chosen) {
        // Right where nothing fits, or what does is too near to the limit to be told from what does not.
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

// Budgets between the ends of what a sweep holds.
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

// `seeds`: streams of noise, each drawn for every budget; DIPTYCH_REPLAY_SEEDS asks for another number.
void sweepAll(const ReplayNoise& noise, std::uint64_t seeds) {
    if (const char* const wished = std::getenv("DIPTYCH_REPLAY_SEEDS")) seeds = std::stoull(wished);
    std::size_t cases = 0, right = 0;
    double most = 0, sum = 0, all_judged = 0;
    fmt::print("{:<28} {:>6} {:>14} {:>12} {:>12} {:>10}\n", "scene", "rows", "right", "timings", "worst",
               "judged");
    for (const RecordedSweep& sweep : recordedSweeps()) {
        std::size_t tried = 0, good = 0;
        double worst = 1, share = 0;
        std::size_t judged = 0;
        const std::vector<Settings> candidates = candidatesOf(sweep);
        for (const Budget& budget : budgetsFor(sweep))
            for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
                const Outcome outcome = chosenFrom(sweep, candidates, budget, noise, seed);
                ++tried;
                good += outcome.right;
                worst = std::max(worst, outcome.off);
                share += outcome.timings;
                most = std::max(most, outcome.timings);
                judged += outcome.judged;
                if (!outcome.right && std::getenv("DIPTYCH_REPLAY_VERBOSE"))
                    fmt::print("  wrong: error {} ms {} bytes {} seed {}: off {:.3f} timings {:.1f} %\n",
                               budget.error.value_or(0), budget.ms.value_or(0), budget.bytes.value_or(0),
                               seed, outcome.off, 100 * outcome.timings);
            }
        cases += tried;
        all_judged += static_cast<double>(judged);
        right += good;
        sum += share;
        const auto n = static_cast<double>(tried);
        fmt::print("{:<28} {:>6} {:>6} of {:>4} {:>10.1f} % {:>11.3f} {:>10.1f}\n", sweep.scene,
                   sweep.rows.size(), good, tried, 100 * share / n, worst, static_cast<double>(judged) / n);
    }
    fmt::print("{} of {} within 5 %, {:.1f} % of the exhaustive timings in the mean, {:.1f} % at most\n",
               right, cases, 100 * sum / static_cast<double>(cases), 100 * most);
    EXPECT_GE(static_cast<double>(right), 0.95 * static_cast<double>(cases));
    EXPECT_LE(sum / static_cast<double>(cases), 0.10);
    // 54 (51 with noise) where the errors of single changes leave those of several open, 47 (44) where it is
    // learned how far.
    EXPECT_LE(all_judged / static_cast<double>(cases), 50);
}

TEST(ChooseReplay, FindsWhatASweepOfEverythingFinds) {
    sweepAll({.deviation = 0.02, .drift = 0}, 3);
}

TEST(ChooseReplay, FindsItUnderNoiseAndDrift) {
    // 96.7 % of 24 streams: of 3 one in twenty would be right in less than 95 %.
    sweepAll({.deviation = 0.10, .drift = 0.20}, 8);
}

// Errors are estimated from one of two cameras, which shows more of them or less and is off by what the
// gallery's are; and the first frames of some take longer (there 2 of 58 by more than a quarter, where no
// pipeline was made for them).
TEST(ChooseReplay, FindsItByEstimatesAndFirstFrames) {
    sweepAll({.deviation = 0.05,
              .drift = 0.05,
              .slow_firsts = 2 / 58.0,
              .slower_first = 0.4,
              .estimate = 0.22,
              .camera = 1.8},
             8);
}

// A frame of 100 ms, of which each change takes off a tenth; errors are 0.
class CheaperByEachChange final : public Lab {
public:
    explicit CheaperByEachChange(Settings first) : first_(std::move(first)) {}
    Judged judge(const Settings&) override { return {}; }
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override {
        std::vector<double> times;
        for (const std::size_t i : order) times.push_back(ms(frames[i]));
        return times;
    }
    std::vector<std::vector<PassTime>> profile(const Settings& settings, int frames) override {
        return std::vector<std::vector<PassTime>>(static_cast<std::size_t>(frames),
                                                  {{"shade", ms(settings)}});
    }

private:
    double ms(const Settings& settings) const {
        double ms = 100;
        for (const Field& field : settingFields())
            if (settings.valueOf(field.option) != first_.valueOf(field.option)) ms *= 0.9;
        return ms;
    }
    Settings first_;
};

TEST(ChooseSearch, CombinesUpToThreeChangesOfItsPathsFirstCandidate) {
    const Settings first;
    std::vector<Settings> candidates{first};
    const std::vector<std::pair<std::string, std::string>> single{
        {"shadow-size", "512"}, {"shadow-cascades", "1"},  {"shadow-kernel", "1"}, {"shadow-bias", "1"},
        {"lit-format", "fp16"}, {"depth-format", "d24"},   {"spec-aa", "on"},      {"specular-albedo", "fit"},
        {"ibl-samples", "64"},  {"light-kernel", "gather"}};
    for (const auto& [option, value] : single) {
        candidates.push_back(first);
        candidates.back().set(option, value);
    }
    SearchOptions options;
    options.budget.error = 1;
    std::size_t made = 0;
    options.combine = [&](const Settings& of, std::span<const Change> changes) -> std::optional<Settings> {
        EXPECT_TRUE(of == first) << "after " << made;
        EXPECT_GE(changes.size(), 2u);
        EXPECT_LE(changes.size(), 3u);
        ++made;
        Settings settings = first;
        for (const Change& change : changes) settings.set(change.option, change.to);
        return settings;
    };
    CheaperByEachChange lab(first);
    const Calibration calibration;
    CostModel model(calibration);
    const Choice choice = search(candidates, lab, model, options);
    EXPECT_EQ(made, 45u + 120u);
    ASSERT_TRUE(choice.chosen);
    EXPECT_NEAR(choice.ms, 72.9, 1e-9);
}

// Errors of several cameras; the one that is looked at first shows a third of each, and of one change
// nothing.
class OneCameraOfSeveral final : public Lab {
public:
    std::map<std::string, std::pair<double, double>> changes;  // by shadow-size: all cameras' error, time, ms
    std::string hidden, shown = "2048";                        // one whose estimate is that of another
    std::size_t judged = 0, estimated = 0;

    Judged judge(const Settings& settings) override {
        ++judged;
        return {changes.at(settings.valueOf("shadow-size")).first, 0};
    }
    std::optional<double> estimate(const Settings& settings) override {
        ++estimated;
        const std::string size = settings.valueOf("shadow-size");
        return changes.at(size == hidden ? shown : size).first / 3;
    }
    std::vector<double> time(std::span<const Settings> frames, std::span<const std::size_t> order) override {
        std::vector<double> times;
        for (const std::size_t i : order)
            times.push_back(changes.at(frames[i].valueOf("shadow-size")).second);
        return times;
    }
    std::vector<std::vector<PassTime>> profile(const Settings& settings, int frames) override {
        return std::vector<std::vector<PassTime>>(
            static_cast<std::size_t>(frames),
            {{"shade", changes.at(settings.valueOf("shadow-size")).second}});
    }
};

TEST(ChooseSearch, WhatIsChosenWasJudgedInAllCamerasWhateverOneShowed) {
    OneCameraOfSeveral lab;
    lab.changes = {{"2048", {0.01, 100}}, {"1024", {0.015, 80}}, {"512", {0.05, 60}}, {"256", {0.09, 50}}};
    lab.hidden = "512";
    const Settings first;
    std::vector<Settings> candidates;
    for (const char* size : {"2048", "1024", "512", "256"}) {
        candidates.push_back(first);
        candidates.back().set("shadow-size", size);
    }
    SearchOptions options;
    options.budget.error = 0.02;
    const Calibration calibration;
    CostModel model(calibration);
    const Choice choice = search(candidates, lab, model, options);
    ASSERT_TRUE(choice.chosen);
    EXPECT_EQ(choice.candidates[*choice.chosen].settings.shadow_size, 1024);
    EXPECT_EQ(choice.candidates[2].fate, Fate::misses) << "judged, as one camera shows nothing";
    EXPECT_EQ(choice.candidates[3].fate, Fate::spoilt) << "not judged, as that camera shows enough";
    EXPECT_EQ(choice.judged, 3u);
    EXPECT_EQ(choice.estimated, lab.estimated);

    // Where nothing fits, what one camera shows to be the nearest is judged.
    options.budget.error = 0.001;
    lab.changes["1024"].first = 0.005;
    CostModel fresh(calibration);
    const Choice none = search(candidates, lab, fresh, options);
    EXPECT_FALSE(none.chosen);
    ASSERT_TRUE(none.nearest);
    EXPECT_EQ(none.candidates[*none.nearest].settings.shadow_size, 1024);

    // And it is chosen where it fits after all: one camera shows more of it than all do.
    lab.changes["1024"].first = 0.009;
    lab.changes["2048"].first = 0.03;
    lab.changes["512"].first = 0.04;
    lab.changes["256"].first = 0.02;
    lab.hidden = "1024";
    lab.shown = "256";
    options.budget.error = 0.01;
    CostModel last(calibration);
    const Choice after_all = search(candidates, lab, last, options);
    ASSERT_TRUE(after_all.chosen);
    EXPECT_EQ(after_all.candidates[*after_all.chosen].settings.shadow_size, 1024);
}

}  // namespace

}  // namespace diptych::choose
