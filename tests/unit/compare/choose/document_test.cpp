// SPDX-License-Identifier: MIT
// What a choice says, sentence by sentence.
#include "compare/choose/report.h"
#include "compare/output/writers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace diptych::choose {
namespace {

Candidate candidateOf(Path path, double ms, double flip, std::uint64_t bytes) {
    Candidate candidate;
    candidate.settings.path = path;
    candidate.status = CandidateStatus::raced;
    candidate.log_ms = std::log(ms);
    candidate.timings = 2;
    candidate.measured[Measure::ms] = ms;
    candidate.measured[Measure::flip] = flip;
    candidate.measured[Measure::memory] = static_cast<double>(bytes);
    return candidate;
}

// The first is chosen over another path's and one of its own.
ChoiceReport chosenReport() {
    ChoiceReport report;
    report.requested.size = {320, 180};
    report.budget.error = 0.02;
    report.words = {"one", "other", "third"};
    report.commands = {"diptych render 1", "diptych render 2", "diptych render 3"};
    report.scene = "a_b.glb";
    report.cameras = {"front", "side"};
    report.choice.candidates = {candidateOf(Path::deferred, 4, 0.01, 1 << 20),
                                candidateOf(Path::forward_plus, 5, 0.0125, 2 << 20),
                                candidateOf(Path::deferred, 4.02, 0.015, 1 << 20)};
    report.choice.candidates[0].passes = {{"G-buffer", 1}, {"shade", 1.5}, {"shade", 1.5}, {"resolve", 0.1}};
    report.choice.candidates[1].passes = {{"shade", 4.75}, {"resolve", 0.24}};
    report.choice.candidates[1].race = TimeRatio{1.25, 1.2, 1.305, 0.99, 8};
    report.choice.candidates[2].race = TimeRatio{0.995, 0.9849, 1.005, 0.99, 8};
    report.choice.chosen = 0;
    report.choice.runner_up = 1;
    return report;
}

const std::string heading = "fits a_b.glb, 320x180, front; side: the fastest with FLIP at most 0.02\none\n";

TEST(ChooseWords, ThatWhichFitsSaysWhyAndAgainstWhat) {
    ChoiceReport report = chosenReport();
    report.choice.ties = {2};
    report.held_out = {{"above", 0.0123456, true}, {"below", 0.5, false}};
    report.notes = {"a note"};
    EXPECT_EQ(
        inText(blocksOf(report)),
        heading +
            "4 ms, FLIP 0.01, 1 MiB\n"
            "  the other path: the fastest settings that fit are other, 5 ms; passes, ms: shade 4.75 "
            "against 3, G-buffer 0 against 1\n"
            "  runner-up: other: takes 25.0 % longer (+20.0 % to +30.5 %)\n"
            "  not measurably slower: third: takes 0.5 % less time (-1.5 % to +0.5 %)\n"
            "  checked from camera above, which the choice did not use: FLIP 0.01235\n"
            "  checked from camera below, which the choice did not use: FLIP 0.5, over the budget: name "
            "both cameras with --camera\n"
            "diptych render 1\n"
            "  note: a note\n");
    report.choice.ties = {1};
    report.choice.significant = true;
    report.held_out.clear();
    report.choice.candidates[1].status = CandidateStatus::misses;
    EXPECT_EQ(inText(blocksOf(report)),
              heading +
                  "4 ms, FLIP 0.01, 1 MiB\n"
                  "  the other path: no measured settings fit\n"
                  "  not measurably slower: other: takes 25.0 % longer (+20.0 % to +30.5 %)\n"
                  "  significant: every other finalist is slower, at 99 % confidence\n"
                  "  not checked from another camera: the scene has no other\n"
                  "diptych render 1\n  note: a note\n")
        << "a tie is not told twice";
    report.choice.candidates[0].measured = {};
    EXPECT_TRUE(inText(blocksOf(report)).starts_with(heading + "not timed\n"));
}

// The most accurate within a time: errors stand beside times.
TEST(ChooseWords, WithoutAnErrorBudgetTheOtherPathsErrorIsSaid) {
    ChoiceReport report = chosenReport();
    report.budget = {Measure::relative_rmse, {}, 6.25, std::uint64_t{3} << 20};
    for (Candidate& candidate : report.choice.candidates)
        candidate.measured[Measure::relative_rmse] = 10 * candidate[Measure::flip];
    report.choice.candidates[0].passes = report.choice.candidates[1].passes;
    EXPECT_EQ(
        whyText(report),
        "the other path: the most accurate settings that fit are other, 5 ms, relative RMSE 0.125 against "
        "0.1");
    EXPECT_TRUE(
        inText(blocksOf(report))
            .starts_with("fits a_b.glb, 320x180, front; side: the most accurate with at most 6.25 ms and "
                         "at most 3 MiB\none\n4 ms, relative RMSE 0.1, 1 MiB\n"))
        << inText(blocksOf(report));
    // A pass counts from 3 % of the other path's frame, 0.15 ms.
    report.choice.candidates[0].passes = {{"shade", 4.75 - 0.149}, {"resolve", 0.24 + 0.151}};
    EXPECT_TRUE(whyText(report).ends_with(" 0.1; passes, ms: resolve 0.24 against 0.391")) << whyText(report);
}

TEST(ChooseWords, WhereNothingFitsEachMissIsSaid) {
    ChoiceReport report = chosenReport();
    report.choice.chosen = report.choice.runner_up = {};
    report.choice.nearest = 1;
    report.budget.ms = 4;
    report.budget.bytes = 1 << 20;
    report.budget.error = 0.01;
    EXPECT_EQ(
        inText(blocksOf(report)),
        "nothing fits a_b.glb, 320x180, front; side: the fastest with FLIP at most 0.01 and at most 4 ms and "
        "at most 1 MiB\nnothing fits; the nearest is other\n5 ms, FLIP 0.0125, 2 MiB\n"
        "  25 % over the error budget of 0.01\n"
        "  25 % over the time budget of 4 ms\n"
        "  100 % over the memory budget of 1 MiB\n");
    report.choice.candidates[1] = candidateOf(Path::forward_plus, 4, 0.01, 1 << 20);
    EXPECT_EQ(inText(blocksOf(report)).find(" over the "), std::string::npos)
        << "up to the limit nothing misses";
    report.choice.nearest = {};
    EXPECT_NE(inText(blocksOf(report)).find("\nno candidate could be drawn\n"), std::string::npos);
}

TEST(ChooseWords, CandidatesAreSortedByHowFarTheyCame) {
    ChoiceReport report = chosenReport();
    report.choice.chosen = 2;
    report.choice.ties = {0};
    report.words.insert(report.words.end(), {"slow", "slowest"});
    report.commands.resize(5);
    for (const double ms : {9.0, 8.0}) {
        Candidate& candidate = report.choice.candidates.emplace_back();
        candidate.log_ms = std::log(ms);
        candidate.measured[Measure::ms] = ms;
    }
    std::vector<std::pair<std::string, std::string>> rows;
    for (const output::Block& block : blocksOf(report))
        if (const auto* table = std::get_if<output::Table>(&block.content)) {
            EXPECT_EQ(table->rows.front().style, "chosen");
            for (const output::Row& row : table->rows)
                rows.emplace_back(row.cells[0].text.spans[1].text, row.cells.back().text.spans[0].text);
        }
    const std::vector<std::pair<std::string, std::string>> expected{{"third", "chosen"},
                                                                    {"other", "timed against each other"},
                                                                    {"one", "tied with the best"},
                                                                    {"slowest", "slower, error not measured"},
                                                                    {"slow", "slower, error not measured"}};
    EXPECT_EQ(rows, expected);
}

TEST(ChooseWords, WhatDecidesIsSaidWithItsBreakEvenPoint) {
    ChoiceReport report = chosenReport();
    SensitivityReport decides;
    decides.chosen = "one";
    decides.other = "other";
    decides.chosen_path = "deferred";
    decides.other_path = "forward_plus";
    decides.as_is = {0, {4, 5}, 1, 0.1};
    const Property lights{"lights", "per pixel", "point lights are added", 12345.6, 0.5, 4e8};
    const auto timed = [](double value, double difference, double half_width) {
        return TimedValue{value, {4, 4 + difference}, difference, half_width};
    };
    const auto said = [&](const PropertySensitivity& property) {
        decides.properties.assign(4, property);
        report.sensitivities = decides;
        const std::string text = inText(blocksOf(report)), start = "  lights: ";
        const std::size_t at = text.find(start);
        EXPECT_EQ(text.find(start, text.find(start, text.find(start, at + 1) + 1) + 1), text.npos) << "three";
        return at == text.npos ? text : text.substr(at + 2, text.find('\n', at) - at - 2);
    };
    PropertySensitivity of{lights, {timed(3, 1, 0.1), timed(12345.6, -1, 0.1)}, {}, {}, {}};
    EXPECT_EQ(
        said(of),
        "lights: 12346 per pixel; no value between 0.5 and 4e+08 reverses the choice (measured at 3, 12346: "
        "point lights are added)");
    of.open = {7, 9};
    EXPECT_EQ(
        said(of),
        "lights: 12346 per pixel; no value between 0.5 and 4e+08 reverses the choice significantly; a value "
        "between 7 and 9 may (measured at 3, 12346: point lights are added)");
    of.break_even = {100, 90, 112.34, false, true};
    EXPECT_EQ(
        said(of),
        "lights: 12346 per pixel; forward_plus is faster above 100 (90 to 112.3), interpolated (measured at "
        "3, 12346: point lights are added)");
    of.break_even = {100, 90, 112.34, true, false};
    EXPECT_EQ(
        said(of),
        "lights: 12346 per pixel; forward_plus is faster below 100 (90 to 112.3), extrapolated (measured at "
        "3, 12346: point lights are added)");
    of.property.few_values = true;
    of.times.push_back(timed(4, -0.5, 0.25));
    of.times.push_back(timed(8, -0.5, 0.75));
    EXPECT_EQ(
        said(of),
        "lights: 12346 per pixel; at 3, deferred takes 4 ms and forward_plus 5 ms: not faster there either; "
        "at 4, deferred takes 4 ms and forward_plus 3.5 ms: faster there; at 8, deferred takes 4 ms and "
        "forward_plus 3.5 ms, not measurably different (measured at 3, 12346, 4, 8: point lights are added)");
    of.times.resize(1);
    EXPECT_EQ(said(of), "lights: 12346 per pixel; its variations change nothing");
    of.property.not_varied = "it cannot be";
    EXPECT_EQ(said(of), "lights: 12346 per pixel; it cannot be");
    const auto headingOf = [&] {
        report.sensitivities = decides;
        const std::string text = inText(blocksOf(report));
        const std::size_t at = text.find("Properties that decide");
        return text.substr(at, text.find('\n', at) - at);
    };
    EXPECT_EQ(headingOf(), "Properties that decide between deferred and other: here 4 ms against 5 ms");
    decides.other_fits = false;
    decides.as_is.half_width = 2;
    EXPECT_EQ(headingOf(),
              "Properties that decide between deferred and other, which does not fit and is compared by time "
              "only: here 4 "
              "ms against 5 ms, not measurably different");
}

TEST(ChooseWords, OneForAllScenesStandsBesideEachOfThem) {
    JointReport report;
    report.requested.size = {320, 180};
    report.budget.error = 0.02;
    report.words = {"one", "other"};
    report.commands = {"diptych render 1", "diptych render 2"};
    report.scenes = {"a.glb", "b.glb", "c.glb"};
    report.choice.candidates.resize(2);
    for (JointCandidate& candidate : report.choice.candidates)
        for (const double ms : {4.0, 5.0, 6.0})
            candidate.scenes.push_back(candidateOf({}, ms, 0.03, 1 << 20));
    report.choice.candidates[0].fits = true;
    report.choice.candidates[1].race = TimeRatio{1.5, 1.4, 1.6, 0.99, 4};
    report.choice.chosen = 0;
    report.choice.runner_up = 1;
    report.choice.significant = true;
    report.choice.omitted = 3;
    report.choice.slower = {TimeRatio{1, 1, 1}, TimeRatio{1.1, 1.05, 1.15}, {}};
    EXPECT_EQ(inText(blocksOf(report)),
              "fits all 3 scenes, 320x180: the fastest with FLIP at most 0.02 in each\none\n"
              "  runner-up: other: over all scenes takes 50.0 % longer (+40.0 % to +60.0 %)\n"
              "  significant: every other finalist is slower over all scenes, at 99 % confidence\n"
              "  1 candidate within all budgets; 3 proposed by fewer scenes left out\n"
              "diptych render 1\n"
              "scene  ms  FLIP  memory  against its own choice\n"
              "a.glb   4  0.03   1 MiB  its own choice\n"
              "b.glb   5  0.03   1 MiB  takes 10.0 % longer (+5.0 % to +15.0 %)\n"
              "c.glb   6  0.03   1 MiB  the scene has no choice of its own\n");
    report.choice.chosen = report.choice.runner_up = {};
    report.choice.nearest = 1;
    report.choice.nearest_scene = 1;
    report.choice.omitted = 0;
    report.choice.candidates[0].fits = false;
    EXPECT_EQ(inText(blocksOf(report)),
              "nothing fits all 3 scenes, 320x180: the fastest with FLIP at most 0.02 in each\n"
              "nothing fits all scenes; the nearest is other\nb.glb: 5 ms, FLIP 0.03, 1 MiB\n"
              "  50 % over the error budget of 0.02\n"
              "  0 candidates within all budgets\n"
              "scene  ms  FLIP  memory\na.glb   4  0.03   1 MiB\nb.glb   5  0.03   1 MiB\nc.glb   6  0.03   "
              "1 MiB\n");
}

}  // namespace
}  // namespace diptych::choose
