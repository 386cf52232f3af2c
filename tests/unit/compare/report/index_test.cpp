// SPDX-License-Identifier: MIT
// Several comparisons in one report: one line each, failing ones first, the rest loaded on request.
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// `failing` lists the comparisons whose roughness differs.
Report manyOf(std::size_t count, const std::set<std::size_t>& failing = {}) {
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<Frame> pair = withOnly({Channel::roughness, Channel::metallic, Channel::material_id},
                                           bothFrames(fmt::format("scenes/{}.glb", i)));
        if (failing.contains(i)) pair[1].channels[Channel::roughness].at(1, 2) = 0.75f;
        std::ranges::move(pair, std::back_inserter(frames));
    }
    return reportOf(std::move(frames));
}

TEST(ReportIndex, FailingOnesComeFirst) {
    const fs::path out = folder() / "report";
    const nlohmann::json json = nlohmann::json::parse(writeReport(manyOf(7, {3, 6}), out, {}));
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    std::vector<std::string> lines, sections;
    for (std::size_t at = page.find("<tr data-comparison=\""); at != std::string::npos;
         at = page.find("<tr data-comparison=\"", at + 1))
        lines.push_back(page.substr(at + 21, 1));
    for (std::size_t at = page.find("class=\"comparison\" id=\"s"); at != std::string::npos;
         at = page.find("class=\"comparison\" id=\"s", at + 1))
        sections.push_back(page.substr(at + 24, 1));
    EXPECT_EQ(lines, (std::vector<std::string>{"3", "6", "0", "1", "2", "4", "5"}));
    EXPECT_EQ(sections, (std::vector<std::string>{"3", "6", "0", "1"})) << "the others wait";
    EXPECT_NE(page.find("<a href=\"#c3-roughness\">roughness</a></td>"), std::string::npos)
        << "the worst channel leads to its card";
    // A section loaded on request is a file that the report lists and its line names.
    for (const char* waiting : {"2-98a010/comparison.section.js", "4-da208a/comparison.section.js",
                                "5-2cc931/comparison.section.js"}) {
        EXPECT_EQ(std::ranges::count(json["files"], waiting), 1) << waiting;
        EXPECT_NE(page.find("data-section=\"" + std::string(waiting) + "\""), std::string::npos);
    }
    const std::string section = contentsOf(out / "2-98a010/comparison.section.js");
    ASSERT_TRUE(section.starts_with("diptychSection(2,\"<div ") && section.ends_with("\");\n"))
        << section.substr(0, 80);
    const std::string html = nlohmann::json::parse(section.substr(17, section.size() - 20));
    EXPECT_EQ(markupFault(html, htmlVoids), "");
    EXPECT_EQ(countOf(html, "<details class=\"box card"), json["comparisons"][2]["channels"].size());
    EXPECT_EQ(filesIn(out), json["files"].get<std::vector<std::string>>());
}

// Image files have no times, and --runs 0 measures none.
TEST(ReportIndex, TimesHaveColumnsWhereFramesWereTimed) {
    for (const bool timed : {true, false}) {
        Report report = manyOf(2);
        if (!timed)
            for (Frame& frame : report.frames) frame.time = {};
        const std::string page = pageOf(report);
        const std::string index = page.substr(page.find("<div class=\"index\">"));
        const auto table = index.substr(0, index.find("</table>"));
        EXPECT_EQ(countOf(table, ", ms</button></th>"), timed ? 2 : 0);
        EXPECT_EQ(countOf(table, "<th"), countOf(table, "<td") / 2 + 1) << "and <thead>";
    }
}

TEST(ReportIndex, ASinglePageBringsAllAsText) {
    const fs::path out = folder() / "report";
    ReportOptions options;
    options.single_file = true;
    writeReport(manyOf(6), out, options);
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, htmlVoids), "");
    EXPECT_EQ(countOf(page, "<script type=\"text/plain\" id=\"section-"), 2u);
    EXPECT_EQ(countOf(page, "</script>"), 4u) << "no text ends its element early";
    EXPECT_EQ(countOf(page, "class=\"comparison\" id=\"s"), 6u);
    EXPECT_EQ(page.find(".png\""), std::string::npos);
}

TEST(ReportIndex, ALineIsAllThatAnotherComparisonAdds) {
    const Report some = manyOf(30), more = manyOf(50);
    const std::string few = pageOf(some), many = pageOf(more);
    EXPECT_EQ(countOf(many, "<tr data-comparison=\""), 50u);
    EXPECT_EQ(countOf(many, "<img "), countOf(few, "<img ")) << "pictures of the first ones alone";
    EXPECT_LT((many.size() - few.size()) / 20, 1000u) << "bytes a line";
}

TEST(ReportIndex, LongListsSayWhereTheRestIs) {
    std::set<std::size_t> all;
    for (std::size_t i = 0; i < 60; ++i) all.insert(i);
    Report report = manyOf(60, all);
    for (std::size_t i = 0; i < 60; ++i) report.frames[2 * i].notes = {"note " + std::string(i, 'x')};
    const std::string page = pageOf(report);
    EXPECT_NE(page.find("and 20 more: the comparisons below start with the failed ones"), std::string::npos);
    EXPECT_NE(page.find("and 20 more: report.json has all of them"), std::string::npos);
}

}  // namespace
}  // namespace diptych
