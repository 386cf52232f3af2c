// SPDX-License-Identifier: MIT
// A verdict's text: the deciding metric and its limit, the fraction of pixels, the last line, notes.
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "compare/verdict/rules.h"
#include "shared/text/did_you_mean.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace diptych {
namespace {

const ReportDevice lineDevice{"a CPU", "1.0", "cpu"};

const ChannelDiff& channelIn(const Report& report, Channel mode) {
    for (const ChannelDiff& channel : report.comparisons.at(0).channels)
        if (channel.mode->channel == mode) return channel;
    throw std::runtime_error("no such channel");
}

Report reportWith(std::vector<Frame> frames, const CompareOptions& options) {
    return makeReport({{std::move(frames)}}, lineDevice, options);
}

TEST(Criterion, SaysHowMuchOfItsLimitIsUsed) {
    EXPECT_EQ(usedOf({.metric = "max", .measured = 1, .limit = 4}), 0.25);
    EXPECT_EQ(usedOf({.metric = "psnr", .measured = 80, .limit = 40, .min = true}), 0.5);
    EXPECT_EQ(usedOf({.metric = "max", .measured = 0, .limit = 0}), 0);
    EXPECT_EQ(usedOf({.metric = "max", .measured = 1, .limit = 0}), std::numeric_limits<double>::infinity());
    constexpr double endless = std::numeric_limits<double>::infinity();
    EXPECT_EQ(usedOf({.metric = "psnr", .measured = endless, .limit = endless, .min = true}), 1);
}

TEST(Criterion, NeverRoundsSomeToNoneOrMostToAll) {
    EXPECT_EQ(percentText(0), "0 %");
    EXPECT_EQ(percentText(1), "100 %");
    EXPECT_EQ(percentText(0.123456), "12.3 %");
    EXPECT_EQ(percentText(1e-9), "under 0.01 %");
    EXPECT_EQ(percentText(0.99e-4), "under 0.01 %");
    EXPECT_EQ(percentText(1e-4), "0.01 %");
    EXPECT_EQ(percentText(0.9991), "99.91 %");
    EXPECT_EQ(percentText(0.9999), "99.99 %");
    EXPECT_EQ(percentText(0.99991), "over 99.99 %");
    EXPECT_EQ(percentText(1 - 1e-9), "over 99.99 %");
    Criterion criterion;
    criterion.fraction = 0.25;
    EXPECT_EQ(fractionText(criterion), ", at 25 % of the pixels");
    criterion.differing = true;
    EXPECT_EQ(fractionText(criterion), "; 25 % of the pixels differ");
}

// Among bounds that must all be met, the most used one decides; among alternatives, the least used one.
TEST(Criterion, IsTheBoundThatDecides) {
    const Measured measured = [](const Quantity& q) -> std::optional<double> {
        return q.metric == "max" ? 0.5 : q.metric == "mean" ? 0.1 : 30;
    };
    const auto bound = [](const char* metric, double limit) {
        return Condition{Condition::Kind::bound, {metric, 0}, limit, {}};
    };
    Condition all{Condition::Kind::all, {}, 0, {bound("max", 1), bound("mean", 0.11)}},
        any{Condition::Kind::any, {}, 0, {bound("max", 0.1), bound("psnr", 40)}};
    for (int order = 0; order < 2; ++order) {
        EXPECT_EQ(decidingBound(all, measured)->metric, "mean");
        EXPECT_EQ(decidingBound(all, measured)->limit, 0.11);
        EXPECT_EQ(decidingBound(any, measured)->metric, "psnr");
        EXPECT_EQ(decidingBound(any, measured)->measured, 30);
        EXPECT_TRUE(decidingBound(any, measured)->min);
        for (Condition* condition : {&all, &any}) std::swap(condition->parts[0], condition->parts[1]);
    }
    EXPECT_FALSE(decidingBound({Condition::Kind::all, {}, 0, {}}, measured).has_value());
}

// Lit is judged by unexplained pixels, not by a tolerance fitted to the result.
TEST(Criterion, OfLitIsPixelsThatNothingExplains) {
    std::vector<Frame> frames = bothFrames();
    frames[0].channels.at(Channel::lit).at(1, 2) = frames[1].through_gbuffer.at(Channel::lit).at(1, 2) =
        0.55f;
    for (const bool explained : {true, false}) {
        if (!explained) frames[1].through_gbuffer.at(Channel::lit).at(1, 2) = 0.5f;
        const Report report = reportOf(frames);
        const Criterion& criterion = channelIn(report, Channel::lit).criterion.value();
        EXPECT_EQ(criterion.metric, "pixels unexplained");
        EXPECT_EQ(criterion.measured, explained ? 0 : 1);
        EXPECT_EQ(criterion.limit, 0);
        EXPECT_EQ(criterion.fraction, explained ? 0 : 1) << "of one covered pixel";
        const auto json = nlohmann::json::parse(reportJson(report, nullptr));
        EXPECT_EQ(json["comparisons"][0]["channels"][0]["criterion"],
                  (nlohmann::json{{"figure", "pixels unexplained"},
                                  {"measured", explained ? 0.0 : 1.0},
                                  {"limit", 0.0},
                                  {"pixels_beyond", explained ? 0 : 1},
                                  {"share_beyond", explained ? 0.0 : 1.0}}));
        const std::string table = reportTable(report);
        EXPECT_NE(table.find("pixels unexplained"), std::string::npos) << table;
        EXPECT_EQ(table.find("lit: explained by the encoding: largest error 0.0909, mean 0.0909, FLIP ") !=
                      table.npos,
                  explained)
            << table;
        EXPECT_EQ(table.find("the encoding does not explain the difference at 1 pixel (100 %)") != table.npos,
                  !explained)
            << table;
    }
}

// The message states the fraction of pixels out of tolerance.
TEST(Criterion, CountsThePixelsBeyond) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames)
        for (auto& [mode, image] : frame.channels)
            for (int c = 0; c < image.components; ++c)
                for (int x = 0; x < 4; ++x) image.at(x, 2, c) = image.at(1, 2, c);
    frames[0].channels.at(Channel::metallic).at(0, 2) = 0.6f;
    const Report report = reportOf(frames);
    const ChannelDiff& metallic = channelIn(report, Channel::metallic);
    EXPECT_EQ(metallic.criterion->metric, "max");
    EXPECT_EQ(metallic.criterion->pixels, 1u);
    EXPECT_EQ(metallic.criterion->fraction, 0.25);
    EXPECT_EQ(metallic.reason, "max 0.1 exceeds 0.001961 at 25 % of the pixels");
    const std::string junit = reportJunit(report, layoutOf(report, {}), "out");
    EXPECT_NE(junit.find("max 0.1 exceeds 0.001961 at 25 % of the pixels"), junit.npos) << junit;
}

TEST(VerdictLine, ANanComesFirst) {
    std::vector<Frame> frames = bothFrames();
    frames[1].channels.at(Channel::metallic).at(1, 2) = std::nanf("");
    EXPECT_TRUE(channelIn(reportOf(frames), Channel::metallic)
                    .reason.starts_with("NaN or infinity at 1 pixel of forward_plus; max inf exceeds"))
        << channelIn(reportOf(frames), Channel::metallic).reason;
    CompareOptions options;
    options.rules = rulesFromJson(R"({"rules": [{"channel": "*", "max": 9, "because": "any"}]})", "t.json");
    EXPECT_TRUE(channelIn(reportWith(frames, options), Channel::metallic)
                    .reason.starts_with("NaN or infinite values differ at 1 pixel"));
}

TEST(VerdictLine, CountsWhatFailedAndNamesIt) {
    std::vector<Frame> frames;
    for (const char* scene : {"a.glb", "b.glb", "c.glb"})
        for (Frame& frame : bothFrames(scene)) frames.push_back(std::move(frame));
    frames[0].channels.at(Channel::metallic).at(1, 2) = 0;
    frames[4].channels.at(Channel::metallic).at(1, 2) = 0;
    Report report = reportOf(frames);
    EXPECT_EQ(verdictLine(report),
              "FAIL: 2 of 3 comparisons failed: a.glb, c.glb (metallic beyond tolerance)");
    EXPECT_NE(reportTable(report).find("  FAIL a.glb, metallic: max 0.5 exceeds"), std::string::npos);
    report.errors = {{"d.glb", "d.glb: is cut short"}};
    EXPECT_TRUE(verdictLine(report).starts_with("ERROR: 1 scene could not be rendered: d.glb; FAIL: 2 of 3"));
    EXPECT_NE(reportTable(report).find("\nERROR d.glb: is cut short\n"), std::string::npos);
    const std::string junit = reportJunit(report, layoutOf(report, {}), "out");
    EXPECT_EQ(countOf(junit, "<error type=\"scene\" message=\"d.glb: is cut short\"/>"), 1u) << junit;
    EXPECT_NE(junit.find("errors=\"1\" time"), std::string::npos);
    const auto json = nlohmann::json::parse(reportJson(report, nullptr));
    EXPECT_EQ(json["errors"], (nlohmann::json{{{"scene", "d.glb"}, {"message", "d.glb: is cut short"}}}));
}

TEST(VerdictLine, SaysThatImagesShowNothing) {
    CompareOptions options;
    std::vector<Frame> empty = bothFrames();
    for (Frame& frame : empty) std::ranges::fill(frame.channels.at(Channel::material_id).data, -1.0f);
    std::vector<Frame> dark = bothFrames();
    for (Frame& frame : dark) std::ranges::fill(frame.channels.at(Channel::lit).data, 0.0f);
    dark[1].through_gbuffer.at(Channel::lit) = dark[0].channels.at(Channel::lit);
    const std::pair<std::vector<Frame>, std::string> cases[] = {
        {bothFrames(), ""},
        {empty, ", but both images are empty: no surface is in view"},
        {dark, ", but both images are black: no light reaches a visible surface"}};
    const auto shared = std::ranges::count_if(debugModes(), [](const DebugMode& mode) {
        return mode.supported_by == SupportedBy::both || mode.supported_by == SupportedBy::paths_only;
    });
    const std::string passes = fmt::format(
        "pass: all {} compared channels are within tolerance ({} more exist on one side only)", shared,
        std::ranges::count(debugModes(), SupportedBy::forward_only, &DebugMode::supported_by));
    for (const auto& [frames, words] : cases) {
        EXPECT_EQ(verdictLine(reportWith(frames, {})), passes + words);
        options.allow_empty = true;
        options.strict = false;
        EXPECT_EQ(verdictLine(reportWith(frames, options)), passes);
        options.strict = true;
        EXPECT_TRUE(reportWith(frames, options).passed());
        options.allow_empty = false;
        EXPECT_EQ(reportWith(frames, options).passed(), words.empty());
    }
    const auto json = nlohmann::json::parse(reportJson(reportWith(empty, {}), nullptr));
    EXPECT_EQ(json["comparisons"][0]["emptiness"], "both images are empty: no surface is in view");
}

// Frames of 40 x 5 pixels: those for which `isSet` show the surface in that channel, the others nothing.
std::vector<Frame> wideFrames(const std::function<bool(Channel, int)>& isSet) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) {
        frame.settings.size = {40, 5};
        for (auto* images : {&frame.channels, &frame.through_gbuffer})
            for (auto& [mode, image] : *images) {
                Image wide(40, 5, image.components, mode == Channel::material_id ? -1.0f : 0.0f);
                for (int i = 0; i < 200; ++i)
                    for (int c = 0; c < image.components && isSet(mode, i); ++c)
                        wide.at(i % 40, i / 40, c) = image.at(1, 2, c);
                image = std::move(wide);
            }
    }
    return frames;
}

// A surface on 1 % of the image counts; on less, the background decides every image. Light on 5 % of the
// visible surfaces counts; on less, black decides the verdict.
TEST(VerdictLine, SaysThatHardlyAnythingIsInViewOrLit) {
    const auto emptiness = [](const std::function<bool(Channel, int)>& isSet) {
        return reportWith(wideFrames(isSet), {}).comparisons.at(0).emptiness;
    };
    EXPECT_EQ(emptiness([](Channel, int i) { return i < 1; }), "only 0.5 % of the image shows the scene");
    EXPECT_EQ(emptiness([](Channel, int i) { return i < 2; }), "");
    EXPECT_EQ(emptiness([](Channel mode, int i) { return mode != Channel::lit || i < 9; }),
              "light reaches only 4.5 % of the visible surfaces");
    EXPECT_EQ(emptiness([](Channel mode, int i) { return mode != Channel::lit || i < 10; }), "");
}

TEST(VerdictLine, NotesOfSeveralScenesAreOneLine) {
    std::vector<Frame> frames;
    for (const char* scene : {"a.glb", "b.glb", "c.glb"})
        for (Frame& frame : bothFrames(scene)) frames.push_back(std::move(frame));
    frames[0].notes = {"the same", "it took 1.5 s"};
    frames[2].notes = {"the same", "it took 22 s"};
    frames[4].notes = {"the same", "another"};
    const std::string table = reportTable(reportOf(frames));
    EXPECT_NE(table.find("\nnote, 3 scenes: the same\n"), table.npos) << table;
    EXPECT_NE(table.find("\nnote, a.glb, b.glb, with different numbers: it took 1.5 s\n"), table.npos)
        << table;
    EXPECT_NE(table.find("\nnote, c.glb: another\n"), table.npos) << table;
}

// Within one scene notes stay separate: a fault in three materials is three notes. Equal notes of several
// scenes are merged.
TEST(VerdictLine, NotesOfOneSceneThatDifferInNumbersAreSeveral) {
    std::vector<Frame> frames;
    for (const char* scene : {"a.glb", "b.glb"})
        for (Frame& frame : bothFrames(scene)) frames.push_back(std::move(frame));
    frames[0].notes = {"material 1: roughness 2", "material 2: roughness 3", "material 3: roughness 4"};
    frames[2].notes = {"material 2: roughness 3", "material 4: roughness 5"};
    const std::string table = reportTable(reportOf(frames));
    EXPECT_NE(table.find("\nnote, 2 scenes: material 2: roughness 3\n"), table.npos) << table;
    EXPECT_NE(table.find("\nnote, a.glb: material 3: roughness 4\n"), table.npos) << table;
    EXPECT_NE(table.find("\nnote, 2 scenes, with different numbers: material 1: roughness 2\n"), table.npos)
        << table;
    EXPECT_EQ(countOf(table, "\nnote"), 3u) << table;
}

TEST(DidYouMean, FindsTheNearestWordOrNone) {
    const std::vector<std::string> words{"gallery", "spheres", "furnace", "lit"};
    EXPECT_EQ(didYouMean("galery", words), "; did you mean gallery?");
    EXPECT_EQ(nearestWord("shperes", words), "spheres") << "two letters exchanged";
    EXPECT_EQ(nearestWord("Furnace", words), "furnace");
    EXPECT_EQ(nearestWord("lut", words), "lit");
    EXPECT_EQ(nearestWord("normals", words), "");
    EXPECT_EQ(nearestWord("", words), "");
    EXPECT_EQ(nearestWord(std::string(100000, 'x'), words), "");
}

}  // namespace
}  // namespace diptych
