// SPDX-License-Identifier: MIT
// Titles, labels, orders and the verdict's line, each with all its cases.
#include "compare/report/titles.h"

#include <gtest/gtest.h>

#include <string_view>

namespace diptych {
namespace {

using Words = std::vector<std::string>;

// Comparisons of these scenes, with channels of these verdicts.
Report titled(const Words& scenes, const std::vector<Verdict>& verdicts = {Verdict::pass}) {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    for (const std::string& scene : scenes) {
        Comparison& one = report.comparisons.emplace_back();
        one.baseline = report.frames.size();
        one.test = one.baseline + 1;
        for (const char* name : {"left", "right"}) {
            Frame& frame = report.frames.emplace_back();
            frame.name = name;
            frame.scene = scene;
        }
        for (std::size_t i = 0; i < verdicts.size(); ++i) {
            one.channels.emplace_back().mode = &debugModes()[i];
            one.channels.back().verdict = verdicts[i];
        }
    }
    return report;
}

TEST(ReportTitles, PairsAndTimesAreNamedWhereTheyTellApart) {
    Report report = titled({"a", "b"});
    EXPECT_FALSE(hasMultiplePairs(report));
    EXPECT_EQ(pairTitle(report, report.comparisons[0]), "right against left");
    for (const std::size_t frame : {0, 3}) {
        Report other = report;
        other.frames[frame].origin.file = "a.exr";
        EXPECT_TRUE(hasMultiplePairs(other));
        other.frames[frame].origin = {};
        other.frames[frame].origin.device = "a GPU";
        EXPECT_TRUE(hasMultiplePairs(other));
    }
    Report closer = report;
    closer.closer_paths.emplace_back();
    EXPECT_TRUE(hasMultiplePairs(closer));

    EXPECT_EQ(viewTitle(report, report.frames[0]), "default view");
    report.frames[1].settings.time = 0.5;  // of a test
    EXPECT_EQ(viewTitle(report, report.frames[0]), "default view, 0 s");
    EXPECT_EQ(viewTitle(report, report.frames[1]), "default view, 0.5 s");
    report.frames[1].settings.time = 0;
    report.frames[0].settings.time = 0.5;  // of a baseline
    EXPECT_EQ(viewTitle(report, report.frames[0]), "default view, 0.5 s");
    EXPECT_EQ(viewTitle(report, report.frames[1]), "default view");
}

TEST(ReportTitles, AViewIsNamedWhereItsSceneHasSeveral) {
    Report report = titled({"a", "b", "a"});
    const auto labels = [&] {
        Words all;
        for (const Comparison& comparison : report.comparisons) all.push_back(viewLabel(report, comparison));
        return all;
    };
    EXPECT_EQ(labels(), (Words{"a", "b", "a"}));
    report.frames[2].camera.name = "door";
    EXPECT_EQ(labels(), (Words{"a", "b", "a"})) << "b's door";
    report.frames[4].camera.name = "roof";
    EXPECT_EQ(labels(), (Words{"a, default view", "b", "a, roof"}));
}

TEST(ReportTitles, TheCommonFolderIsThatOfScenesOrFiles) {
    Report report = titled({"x/y/a", "x/b"});
    report.frames[0].origin.file = "f/a.exr";
    for (const std::size_t i : {1, 2, 3}) report.frames[i].origin.file = "f/g/b.exr";
    EXPECT_EQ(folderOfAll(report), "x/");
    report.device = {};
    EXPECT_EQ(folderOfAll(report), "f/");
}

TEST(ReportTitles, FailuresStandFirst) {
    Report report = titled({"a", "b", "c", "d"});
    report.comparisons[1].failures = report.comparisons[3].failures = {"differs"};
    EXPECT_EQ(failingFirst(report), (std::vector<std::size_t>{1, 3, 0, 2}));
    const Report one =
        titled({"a"}, {Verdict::forward_only, Verdict::pass, Verdict::informative, Verdict::fail,
                       Verdict::deferred_only, Verdict::fail, Verdict::pass, Verdict::informative});
    std::vector<std::ptrdiff_t> order;
    for (const ChannelDiff* channel : failuresFirst(one.comparisons[0]))
        order.push_back(channel - one.comparisons[0].channels.data());
    EXPECT_EQ(order, (std::vector<std::ptrdiff_t>{3, 5, 2, 7, 1, 6, 0, 4}));
}

TEST(ReportTitles, NotesAreThoseOfTheComparisonAndItsFramesOnce) {
    Report report = titled({"a"});
    report.comparisons[0].notes = {"1", "2", "1"};
    report.frames[0].notes = {"3", "2"};
    report.frames[1].notes = {"4", "3"};
    EXPECT_EQ(notesOf(report, report.comparisons[0]), (Words{"1", "2", "3", "4"}));
    report.comparisons[0].visual_checks = {{"skins", 0, {}}};
    EXPECT_EQ(checksLine(report.comparisons[0]), "");
    report.comparisons[0].visual_checks = {{"skins", 0, {}}, {"masks", 2, {}}};
    EXPECT_EQ(checksLine(report.comparisons[0]), "2 places to check by eye: skins 0, masks 2");
}

TEST(ReportTitles, NumbersAreReplaced) {
    for (const auto& [text, without] : {std::pair{"a1b", "a#b"},
                                        {"12 34", "# #"},
                                        {"1.5 s", "# s"},
                                        {"1. x", "#. x"},
                                        {".5", ".#"},
                                        {"1.2.3", "#"},
                                        {"a.b", "a.b"},
                                        {"a.1", "a.#"},
                                        {"1.", "#."},
                                        {"/0:9", "/#:#"},
                                        {"0123456789", "#"},
                                        {"", ""},
                                        {"1x2", "#x#"},
                                        {"1#2", "##"}})
        EXPECT_EQ(withoutNumbers(text), without) << text;
}

TEST(ReportTitles, ListsNameTheFirst) {
    EXPECT_EQ(listed({}, 2), "");
    EXPECT_EQ(listed({"a"}, 2), "a");
    EXPECT_EQ(listed({"a", "b"}, 2), "a, b");
    EXPECT_EQ(listed({"a", "b", "c"}, 2), "a, b and 1 more");
    EXPECT_EQ(listed({"a", "b", "c", "d"}, 1), "a and 3 more");
    EXPECT_EQ(errorText({"a", "is short"}), "a: is short");
    EXPECT_EQ(errorText({"a", "a: is short"}), "a: is short");
}

// The line of one comparison after a change.
template <class Change>
std::string lineAfter(const Change& change,
                      const std::vector<Verdict>& verdicts = {Verdict::pass, Verdict::pass}) {
    Report report = titled({"a"}, verdicts);
    change(report, report.comparisons[0]);
    return verdictLine(report);
}

TEST(VerdictText, OfOneComparison) {
    using enum Verdict;
    const auto nothing = [](auto&, auto&) {};
    EXPECT_EQ(lineAfter(nothing), "pass: all 2 compared channels are within tolerance");
    EXPECT_EQ(lineAfter(nothing, {pass}), "pass: the one compared channel is within tolerance");
    EXPECT_EQ(
        lineAfter(nothing, {pass, informative}),
        "pass: the one compared channel is within tolerance; 1 channel of light not counted: the paths' "
        "Settings differ");
    EXPECT_EQ(
        lineAfter(nothing, {pass, informative, informative, forward_only, deferred_only, pass}),
        "pass: all 2 compared channels are within tolerance; 2 channels of light not counted: the paths' "
        "Settings differ (2 more exist on one side only)");
    const auto empty = [](auto&, auto& one) { one.emptiness = "both are black"; };
    EXPECT_EQ(lineAfter(empty), "pass: all 2 compared channels are within tolerance, but both are black");
    EXPECT_EQ(lineAfter(nothing, {fail, pass, fail}), "FAIL: lit, normals beyond tolerance");
    EXPECT_EQ(lineAfter(empty, {fail}), "FAIL: lit beyond tolerance, but both are black");
    EXPECT_EQ(lineAfter([](auto&, auto& one) { one.failures = {"x"}; }), "FAIL: x");
    const auto broken = [](auto&, auto& one) { one.failures = {"x", "y", "x"}; };
    EXPECT_EQ(lineAfter(broken), "FAIL: x and 1 more");
    EXPECT_EQ(lineAfter(broken, {fail}), "FAIL: x and 1 more; lit beyond tolerance");
    const auto unpaired = [](auto& report, auto&) {
        report.failures = {{"b", "is in A only"}, {"c", "too"}};
    };
    EXPECT_EQ(lineAfter(unpaired), "FAIL: b: is in A only, c: too");
    EXPECT_EQ(lineAfter(unpaired, {fail}), "FAIL: lit beyond tolerance; b: is in A only, c: too");
    EXPECT_EQ(lineAfter([&](auto& report, auto& one) {
                  unpaired(report, one);
                  empty(report, one);
              }),
              "FAIL: b: is in A only, c: too, but both are black");
}

TEST(VerdictText, OfSeveralComparisons) {
    Report report = titled({"a", "b", "c"});
    EXPECT_EQ(verdictLine(report), "pass: all 3 compared channels of 3 comparisons are within tolerance");
    for (const std::size_t i : {1, 2}) report.comparisons[i].channels.clear();
    EXPECT_EQ(verdictLine(report), "pass: the one compared channel of 3 comparisons is within tolerance");
    report.comparisons[0].channels[0].verdict = Verdict::fail;
    EXPECT_EQ(verdictLine(report), "FAIL: 1 of 3 comparisons failed: a (lit beyond tolerance)");
    report.comparisons[2].failures = {"x", "y"};
    EXPECT_EQ(verdictLine(report),
              "FAIL: 2 of 3 comparisons failed: a, c (x; lit beyond tolerance), and 1 more");
    report.failures = {{"d", "is in A only"}};
    EXPECT_EQ(verdictLine(report),
              "FAIL: 2 of 3 comparisons failed: a, c (x; lit beyond tolerance; d: is in A only), and 1 more");
    report.failures.clear();
    // Pairs of one view; diff names files instead.
    report.frames[0].origin.file = "f.exr";
    report.frames[4].name = "f.exr";
    EXPECT_EQ(
        verdictLine(report),
        "FAIL: 2 of 3 comparisons failed: a left/right, c f.exr/right (x; lit beyond tolerance), and 1 more");
    report.device = {};
    EXPECT_EQ(verdictLine(report),
              "FAIL: 2 of 3 comparisons failed: a, c (x; lit beyond tolerance), and 1 more");
}

TEST(VerdictText, EightScenesAreNamed) {
    const Words eight{"a", "b", "c", "d", "e", "f", "g", "h"},
        nine{"a", "b", "c", "d", "e", "f", "g", "h", "i"};
    const std::string names = "a, b, c, d, e, f, g, h";
    for (const Words& scenes : {eight, nine}) {
        const std::string more = scenes.size() == 9 ? " and 1 more" : "",
                          count = std::to_string(scenes.size());
        Report failing = titled(scenes, {Verdict::fail}), errors = titled({"x"}), failures = titled({"x"});
        for (const std::string& scene : scenes) {
            errors.errors.push_back({scene, "is short"});
            failures.failures.push_back({scene, scene});
        }
        EXPECT_EQ(verdictLine(failing), "FAIL: " + count + " of " + count + " comparisons failed: " + names +
                                            more + " (lit beyond tolerance)");
        EXPECT_EQ(verdictLine(errors), "ERROR: " + count + " scenes could not be rendered: " + names + more +
                                           "; pass: the one compared channel is within tolerance");
        EXPECT_EQ(verdictLine(failures), "FAIL: " + names + more);
    }
}

TEST(VerdictText, ErrorsSayWhatCouldNotBeMade) {
    Report report = titled({"a"});
    report.errors = {{"b", "is short"}};
    const std::string end = "; pass: the one compared channel is within tolerance";
    EXPECT_EQ(verdictLine(report), "ERROR: 1 scene could not be rendered: b" + end);
    report.errors.push_back({"c", "failed", "cycles", ""});
    EXPECT_EQ(verdictLine(report), "ERROR: 2 pictures could not be rendered: b, c of cycles" + end);
    std::swap(report.errors[0], report.errors[1]);
    EXPECT_EQ(verdictLine(report), "ERROR: 2 pictures could not be rendered: c of cycles, b" + end);
    report.device = {};
    report.errors = {{"b.exr", "is short"}};
    EXPECT_EQ(verdictLine(report), "ERROR: 1 picture could not be compared: b.exr" + end);
    report.failures = {{"d.exr", "is in A only"}};
    EXPECT_EQ(verdictLine(report),
              "ERROR: 1 picture could not be compared: b.exr; FAIL: d.exr: is in A only");
    report.comparisons[0].channels[0].verdict = Verdict::fail;
    EXPECT_EQ(
        verdictLine(report),
        "ERROR: 1 picture could not be compared: b.exr; FAIL: lit beyond tolerance; d.exr: is in A only");
}

TEST(VerdictText, EmptinessNamesThreeScenesAndOneReason) {
    Report report = titled({"a", "b", "c", "d"});
    const std::string all = "pass: all 4 compared channels of 4 comparisons are within tolerance";
    report.comparisons[1].emptiness = "black";
    EXPECT_EQ(verdictLine(report), all + ", but b: black");
    for (const std::size_t i : {0, 2}) report.comparisons[i].emptiness = "black";
    EXPECT_EQ(verdictLine(report), all + ", but a, b, c: black");
    report.comparisons[3].emptiness = "dark";
    EXPECT_EQ(verdictLine(report), all + ", but a, b, c and 1 more: black and 1 more");
    report.comparisons[3].channels[0].verdict = Verdict::fail;
    EXPECT_EQ(verdictLine(report),
              "FAIL: 1 of 4 comparisons failed: d (lit beyond tolerance, but a, b, c and 1 "
              "more: black and 1 more)");
}

TEST(ReportNotes, NameThreeOfTheirScenes) {
    Report report = titled({"x/a", "x/b", "x/c", "x/d", "x/e"});
    const auto noted = [&](std::size_t count) {
        for (std::size_t i = 0; i < report.comparisons.size(); ++i)
            report.comparisons[i].notes = i < count ? Words{"n"} : Words{};
        return notesWithScenes(report, "x/");
    };
    using Notes = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(noted(3), (Notes{{"a, b, c", "n"}}));
    EXPECT_EQ(noted(4), (Notes{{"a, b, c and 1 more", "n"}}));
    EXPECT_EQ(noted(5), (Notes{{"5 scenes", "n"}}));
    EXPECT_EQ(noted(0), Notes{});
    EXPECT_EQ(notesWithScenes(titled({"a"}), ""), Notes{});
    report.comparisons[0].notes = {"took 1 s"};
    report.comparisons[1].notes = {"took 2 s"};
    EXPECT_EQ(notesWithScenes(report, ""), (Notes{{"x/a, x/b, with different numbers", "took 1 s"}}));
    Report one = titled({"a"});
    one.comparisons[0].notes = {"n"};
    EXPECT_EQ(notesWithScenes(one, ""), (Notes{{"", "n"}}));
}

}  // namespace
}  // namespace diptych
