// SPDX-License-Identifier: MIT
// Visual checks in the report.
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace diptych {
namespace {

namespace fs = std::filesystem;
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

std::string pageOf(const Report& report, const ReportOptions& options = {}) {
    const fs::path out = folder() / "report";
    writeReport(report, out, options);
    return contentsOf(out / "index.html");
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
        EXPECT_TRUE(unique.contains(target)) << target;
}
// The figure element of check `number` of a comparison.
std::string figureOf(const std::string& page, int number, int comparison = 0) {
    const std::size_t start = page.find(fmt::format("id=\"check-{}-{}\"", comparison, number));
    return start == std::string::npos ? "" : page.substr(start, page.find("</figure>", start) - start);
}

TEST(ReportChecks, JsonTellsEachAndHowManyThereAre) {
    const Json json =
        Json::parse(writeReport(reportOf(bothFrames(), {someChecks()}), folder() / "report", {}));
    const Json& comparison = json["comparisons"][0];
    ASSERT_EQ(comparison["marks"].size(), 3u);
    EXPECT_EQ(comparison["marks"][2], (Json{{"feature", "alpha masks"},
                                            {"what", "cut out"},
                                            {"where", "material 2 \"leaf\", mesh 2"},
                                            {"box", {2, 0, 4, 1}},
                                            {"pixels", 2}}));
    EXPECT_EQ(comparison["marks_found"], (Json{{"texture transforms", 2}, {"alpha masks", 900}}));
}

TEST(ReportChecks, EveryCheckHasALinkAndAFigure) {
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}));
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    expectLinksLead(page);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NE(page.find("href=\"#check-0-" + std::to_string(i) + "\" title="), std::string::npos) << i;
        EXPECT_EQ(countOf(figureOf(page, i), "<svg "), 2u) << "both paths";
    }
    EXPECT_EQ(figureOf(page, 3), "");
    EXPECT_NE(page.find("the 1 largest of 900"), std::string::npos);
    EXPECT_NE(page.find("href=\"#eye-0\">902 places to check by eye</a>"), std::string::npos);
}

// An image of 4 x 3: the region has the image's aspect ratio, at least an eighth of its size, and stays
// inside.
TEST(ReportChecks, AFigureShowsTheBoxEnlarged) {
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}));
    const std::string sign = figureOf(page, 0);  // 1 of 3 pixels high: 0.45 of the image, at (1.5, 2.5)
    EXPECT_EQ(countOf(sign, "viewBox=\"0.6 1.65 1.8 1.35\""), 2u) << sign;
    EXPECT_EQ(countOf(sign, "x=\"1\" y=\"2\" width=\"1\" height=\"1\""), 4u) << "two outlines a panel";
    const std::string leaf = figureOf(page, 2);  // 2 of 4 pixels wide: 0.675, at the top
    EXPECT_EQ(countOf(leaf, "viewBox=\"1.3 0 2.7 2.025\""), 2u) << leaf;
}

TEST(ReportChecks, WhereNoLightFallsTheBaseColourIsShown) {
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}));
    EXPECT_NE(figureOf(page, 0).find("href=\"#eye-0-lit-a\""), std::string::npos);
    EXPECT_EQ(figureOf(page, 0).find("no light"), std::string::npos);
    EXPECT_NE(figureOf(page, 2).find("href=\"#eye-0-albedo-b\""), std::string::npos);
    EXPECT_NE(figureOf(page, 2).find("no light falls there"), std::string::npos);
}

TEST(ReportChecks, WithoutLitAnotherChannelIsShown) {
    std::vector<Frame> frames = bothFrames();
    for (Frame& frame : frames) frame.requested = {Channel::normals};
    const std::string page = pageOf(reportOf(std::move(frames), {someChecks()}));
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    expectLinksLead(page);
    EXPECT_NE(figureOf(page, 0).find("#eye-0-normals-a"), std::string::npos);
}

TEST(ReportChecks, NoPictureIsEncodedOrNamedTwice) {
    const fs::path out = folder() / "report";
    writeReport(reportOf(bothFrames(), {someChecks()}), out / "with", {});
    writeReport(reportOf(bothFrames()), out / "without", {});
    EXPECT_EQ(namesIn(out / "with"), namesIn(out / "without"));
    const std::string page = contentsOf(out / "with" / "index.html");
    EXPECT_EQ(countOf(page, "href=\"lit.png\""), 2u) << "of each side, however many figures use it";
    EXPECT_EQ(contentsOf(out / "without" / "index.html").find("To check by eye"), std::string::npos);
}

TEST(ReportChecks, ASinglePageHoldsThem) {
    ReportOptions options;
    options.single_file = true;
    const std::string page = pageOf(reportOf(bothFrames(), {someChecks()}), options);
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_EQ(page.find(".png\""), std::string::npos);
    EXPECT_EQ(countOf(page, "href=\"data:image/png;base64,"), 4u) << "lit and base colour of both paths";
}

TEST(ReportChecks, SeveralComparisonsHaveTheirOwn) {
    std::vector<Frame> frames = bothFrames("one.glb");
    for (Frame& frame : bothFrames("two.glb")) frames.push_back(std::move(frame));
    const std::string page = pageOf(reportOf(std::move(frames), {someChecks(), someChecks()}));
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    expectLinksLead(page);
    for (int i = 0; i < 6; ++i) EXPECT_NE(figureOf(page, i % 3, i / 3), "") << i;
    EXPECT_NE(figureOf(page, 0, 1).find("#eye-1-lit-a"), std::string::npos);
    EXPECT_EQ(figureOf(page, 0, 1).find(">previous<"), std::string::npos) << "another scene's";
}

TEST(ReportChecks, NamesOfFilesAreEscaped) {
    std::vector<FeatureChecks> checks = someChecks();
    VisualCheck& check = checks[0].checks[0];
    check.name = check.where = check.what = "\"><script>alert(1)</script>&'\x01\xff";
    const Report report = reportOf(bothFrames(), {checks});
    const fs::path out = folder() / "escaped";
    writeReport(report, out, {});
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_TRUE(Json::accept(contentsOf(out / "report.json")));
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
