// SPDX-License-Identifier: MIT
// Visual checks in the report.
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace diptych {
namespace {

using Json = nlohmann::json;

// The only covered pixel of the frames, (1, 2), and an unlit one.
const PixelBox litBox{1, 2, 2, 3}, darkBox{2, 0, 4, 1};

std::vector<FeatureChecks> someChecks() {
    return {{"texture transforms",
             2,
             {{"offset", "sign", "material 0 \"sign\", mesh 0", litBox, 1},
              {"turned", "arrow", "material 1 \"arrow\", mesh 1", litBox, 1}}},
            {"alpha masks", 900, {{"cut out", "leaf", "material 2 \"leaf\", mesh 2", darkBox, 2}}}};
}

// All texts between `before` and the next quote.
std::vector<std::string> quotedAfter(const std::string& text, const std::string& before) {
    std::vector<std::string> all;
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
        const std::size_t start = at + before.size();
        all.push_back(text.substr(start, text.find('"', start) - start));
    }
    return all;
}
// Every link within the page leads to exactly one element.
void expectLinksLead(const std::string& page) {
    const std::vector<std::string> ids = quotedAfter(page, " id=\"");
    const std::set<std::string> unique(ids.begin(), ids.end());
    EXPECT_EQ(ids.size(), unique.size()) << "an id stands twice";
    for (const std::string& target : quotedAfter(page, "href=\"#"))
        EXPECT_TRUE(unique.contains(target.substr(0, target.find('@')))) << target;
}
// The address of the place with this name.
std::string linkOf(const std::string& page, const std::string& name) {
    const std::size_t end = page.find("\">" + name + "</a>"), start = page.rfind("<a href=\"", end);
    return end == std::string::npos ? "" : page.substr(start + 9, end - start - 9);
}

TEST(ReportChecks, JsonTellsEachAndHowManyThereAre) {
    const Json json = Json::parse(reportJson(reportOf(bothFrames(), {someChecks()}), nullptr));
    const Json& comparison = json["comparisons"][0];
    ASSERT_EQ(comparison["marks"].size(), 3u);
    EXPECT_EQ(comparison["marks"][2], (Json{{"feature", "alpha masks"},
                                            {"what", "cut out"},
                                            {"where", "material 2 \"leaf\", mesh 2"},
                                            {"box", {2, 0, 4, 1}},
                                            {"pixels", 2}}));
    EXPECT_EQ(comparison["marks_found"], (Json{{"texture transforms", 2}, {"alpha masks", 900}}));
}

TEST(ReportChecks, EveryCheckHasALink) {
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}));
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    expectLinksLead(page);
    EXPECT_NE(page.find("the 1 largest of 900"), std::string::npos);
    EXPECT_NE(page.find("href=\"#eye-0\">902 places to check by eye</a>"), std::string::npos);
    EXPECT_NE(page.find("title=\"material 0 &quot;sign&quot;, mesh 0\""), std::string::npos);
}

// An image of 4 x 3: the place's pixel, enlarged so that the box has a margin of a third; where no light
// falls, in the base colour.
TEST(ReportChecks, ALinkShowsTheBoxEnlarged) {
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}));
    EXPECT_EQ(linkOf(page, "sign"), "#c0-lit@1,2?zoom=2.22&amp;at=1,2") << "1 of 3 pixels high";
    EXPECT_EQ(linkOf(page, "leaf"), "#c0-albedo@3,0?zoom=1.48&amp;at=2.5,0") << "2 of 4 pixels wide";
}

TEST(ReportChecks, WithoutLitAnotherChannelIsShown) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) frame.requested = {Channel::normals};
    const std::string page = pageOf(reportOf(std::move(frames), {someChecks()}));
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    expectLinksLead(page);
    EXPECT_TRUE(linkOf(page, "sign").starts_with("#c0-normals@1,2")) << linkOf(page, "sign");
}

TEST(ReportChecks, NoImageIsEncodedOrNamedTwice) {
    const Report with = reportOf(bothFrames(), {someChecks()}), without = reportOf(bothFrames());
    EXPECT_EQ(layoutOf(with, {}).files(), layoutOf(without, {}).files());
    EXPECT_EQ(pageOf(without).find("To check by eye"), std::string::npos);
}

TEST(ReportChecks, WithoutImagesPlacesAreNamed) {
    ReportOptions options;
    options.keep = Keep::none;
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}), options);
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_NE(page.find("<bdi>sign</bdi>"), std::string::npos);
}

TEST(ReportChecks, SeveralComparisonsHaveTheirOwn) {
    std::vector<Frame> frames = bothFrames("one.glb");
    for (Frame& frame : bothFrames("two.glb")) frames.push_back(std::move(frame));
    const std::string page = pageOf(reportOf(std::move(frames), {someChecks(), someChecks()}));
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    expectLinksLead(page);
    for (const char* comparison : {"0", "1"})
        EXPECT_EQ(countOf(page, "href=\"#c" + std::string(comparison) + "-lit@1,2?zoom=2.22&amp;at=1,2\""),
                  2u);
}

TEST(ReportChecks, NamesOfFilesAreEscaped) {
    std::vector<FeatureChecks> checks = someChecks();
    VisualCheck& check = checks[0].checks[0];
    check.name = check.where = check.what = "\"><script>alert(1)</script>&'\x01\xff";
    const Report report = reportOf(bothFrames(), {checks});
    const std::string page = pageOf(report);
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_TRUE(Json::accept(reportJson(report, nullptr)));
}

TEST(ReportChecks, OneLineOnATerminal) {
    const Report report = reportOf(bothFrames(), {someChecks()});
    EXPECT_EQ(checksLine(report.comparisons[0]),
              "902 places to check by eye: texture transforms 2, alpha masks 900");
    EXPECT_EQ(countOf(reportTable(report), "  902 places to check by eye: "), 1u);
    EXPECT_EQ(reportTable(reportOf(bothFrames())).find("by eye"), std::string::npos);
    EXPECT_EQ(checksLine(reportOf(bothFrames(), {{{"skins", 1, {}}}}).comparisons[0]),
              "1 place to check by eye: skins 1");
}

// A pair keeps its checks, whichever path is the left image.
TEST(ReportChecks, TheyStandWithTheirPair) {
    const Report report =
        makeReport({{bothFrames("one.glb")}, {bothFrames("two.glb"), {}, someChecks()}}, {},
                   {.baseline = Path::forward_plus, .rules = {}, .selection = {}, .words = {}});
    EXPECT_TRUE(report.comparisons[0].visual_checks.empty());
    ASSERT_EQ(report.comparisons[1].visual_checks.size(), 2u);
    EXPECT_EQ(report.baseline(report.comparisons[1]).name, "forward_plus");
}

}  // namespace
}  // namespace diptych
