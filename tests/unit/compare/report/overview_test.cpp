// SPDX-License-Identifier: MIT
// The page's table of channels, and the texts around its index.
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace diptych {
namespace {

std::string rowOf(const std::string& page, const std::string& channel) {
    const std::size_t row = page.find("<tr><td><a href=\"#c0-" + channel + "\">");
    return page.substr(row, page.find("</tr>", row) - row);
}

// One covered pixel; its roughness differs by 0.25.
TEST(ReportOverview, SaysWhatAChannelIsEvaluatedBy) {
    std::vector<Frame> frames = bothFrames();
    frames[1].channels[Channel::roughness].at(1, 2) = 0.75f;
    Report report = reportOf(std::move(frames));
    const std::string page = pageOf(report);
    const std::string roughness = rowOf(page, "roughness"), lit = rowOf(page, "lit");
    // A narrow page keeps these three cells and the fraction of failing pixels.
    EXPECT_NE(roughness.find(
                  "<td class=\"soft by\">max</td><td class=\"n\">0.25</td><td class=\"n\">0.000123</td>"),
              std::string::npos)
        << roughness;
    EXPECT_NE(roughness.find("<span class=\"beyond\">100 % of the pixels</span>"), std::string::npos)
        << roughness;
    EXPECT_NE(
        lit.find("<td class=\"soft by\">pixels unexplained</td><td class=\"n\">0</td><td class=\"n\">0</td>"),
        std::string::npos)
        << lit;
    EXPECT_EQ(lit.find("class=\"beyond\""), std::string::npos);
    // A rule's metric is not the largest error.
    for (ChannelDiff& channel : report.comparisons[0].channels)
        if (channel.mode->name == "roughness")
            channel.criterion = {.metric = "mean", .measured = 0.125, .limit = 0.5};
    EXPECT_NE(rowOf(pageOf(report), "roughness")
                  .find("<td class=\"soft by\">mean</td><td class=\"n\">0.125</td><td class=\"n\">0.5</td>"),
              std::string::npos);
    EXPECT_NE(page.find("<p>FAIL: roughness beyond tolerance</p>"), std::string::npos)
        << "the verdict's line";
}

// Every failing channel and lit; lit is first or second.
TEST(ReportOverview, ImagesOfFailuresAndOfLitLead) {
    Report report = reportOf(bothFrames());
    Comparison& comparison = report.comparisons[0];
    const auto names = [&] {
        std::vector<std::string> out;
        for (const ChannelDiff* channel : leadingChannels(comparison)) out.emplace_back(channel->mode->name);
        return out;
    };
    const auto channel = [&](std::string_view name) -> ChannelDiff& {
        return *std::ranges::find(comparison.channels, name,
                                  [](const ChannelDiff& c) { return c.mode->name; });
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names(), Names{"lit"});
    channel("roughness").verdict = channel("normals").verdict = Verdict::fail;
    EXPECT_EQ(names(), (Names{"normals", "lit", "roughness"}));
    channel("lit").verdict = Verdict::fail;
    EXPECT_EQ(names(), (Names{"lit", "normals", "roughness"}));
    channel("lit").verdict = Verdict::forward_only;
    EXPECT_EQ(names(), (Names{"normals", "roughness"}));
    channel("roughness").verdict = channel("normals").verdict = Verdict::pass;
    EXPECT_EQ(names(), Names{"albedo"}) << "without lit and failures the first that is compared";
}

// Exactly the Settings that differ are coloured.
TEST(ReportOverview, ColoursTheSettingsThatDiffer) {
    Report report = reportOf(bothFrames());
    report.frames[1].settings.light_cutoff = 0.25f;
    const std::string page = pageOf(report);
    for (const char* key : {"path", "light_<wbr>cutoff"})
        EXPECT_NE(page.find(std::string("<tr class=\"differs\"><td>") + key + "</td>"), std::string::npos)
            << key;
    for (const char* key : {"size", "assign", "gbuffer"})
        EXPECT_NE(page.find(std::string("<tr><td>") + key + "</td>"), std::string::npos) << key;
}

// Notes are below the index, each once with its scenes; scenes that could not be rendered are failures.
TEST(ReportOverview, NotesAndErrorsNameTheirScenes) {
    std::vector<Frame> frames;
    for (const char* scene : {"a/x.glb", "a/y.glb", "a/z.glb"})
        for (Frame& frame : bothFrames(scene)) frames.push_back(std::move(frame));
    for (Frame& frame : frames) frame.notes = {"of all"};
    frames[2].notes = {"of all", "took 1 s"};
    frames[4].notes = {"of all", "took 2 s"};
    Report report = reportOf(std::move(frames));
    report.errors = {{"a/bad.glb", "a/bad.glb: is cut short"}};
    const std::string page = pageOf(report);
    EXPECT_NE(page.find("<li><bdi>3 scenes: </bdi><bdi>of all</bdi></li>"), std::string::npos);
    EXPECT_NE(page.find("<li><bdi>y.glb, z.glb, with different numbers: </bdi><bdi>took 1 s</bdi></li>"),
              std::string::npos);
    EXPECT_LT(page.find("<div class=\"index\">"), page.find("<bdi>3 scenes: </bdi>"));
    EXPECT_NE(page.find("<li>a/bad.glb: is cut short</li>"), std::string::npos);
    EXPECT_NE(page.find("<h1><span class=\"verdict fail\">fail</span>"), std::string::npos);
    EXPECT_NE(page.find("<p>ERROR: 1 scene could not be rendered: a/bad.glb; pass"), std::string::npos);
}

// Angles have a unit. The tables have more rows than the verdict counts.
TEST(ReportOverview, AngularErrorsHaveAUnitAndTheVerdictSaysWhatItLeavesOut) {
    const Report report = reportOf(bothFrames());
    const std::string page = pageOf(report);
    EXPECT_NE(page.find(">normals</a>"), std::string::npos);
    EXPECT_NE(page.find("<td class=\"optional soft\">angular, \u00b0</td>"), std::string::npos);
    EXPECT_NE(page.find("<td class=\"optional soft\">relative</td>"), std::string::npos);
    const auto alone =
        std::ranges::count(report.comparisons[0].channels, Verdict::forward_only, &ChannelDiff::verdict);
    ASSERT_GT(alone, 1);
    EXPECT_NE(page.find(fmt::format(" are within tolerance ({} more exist on one side only)", alone)),
              std::string::npos);
}

// A failure without a comparison fails the whole report, and page, JSON and JUnit name it. Without it all
// pass.
TEST(ReportOverview, AnImageThatOneFolderLacksFailsTheReport) {
    Report report = reportOf(bothFrames());
    ASSERT_TRUE(report.passed());
    for (const bool lacking : {false, true}) {
        if (lacking) report.failures = {{"only_a.exr", "is in A only"}};
        EXPECT_EQ(report.passed(), !lacking);
        const std::string page = pageOf(report), json = reportJson(report, nullptr), junit = junitOf(report);
        EXPECT_EQ(countOf(page, "<h1><span class=\"verdict fail\">fail</span>"), lacking);
        EXPECT_EQ(countOf(page, "<p>FAIL: only_a.exr: is in A only</p>"), lacking);
        EXPECT_EQ(countOf(page, "<li>only_a.exr: is in A only</li>"), lacking);
        EXPECT_EQ(countOf(json, "\n  \"verdict\": \"fail\""), lacking);
        EXPECT_EQ(countOf(json, "\"scene\": \"only_a.exr\""), lacking);
        EXPECT_EQ(countOf(junit, "<testsuite name=\"only_a.exr\" tests=\"1\" failures=\"1\" errors=\"0\""),
                  lacking);
        EXPECT_EQ(countOf(junit, "<failure type=\"scene\" message=\"only_a.exr: is in A only\"/>"), lacking);
    }
}

}  // namespace
}  // namespace diptych
