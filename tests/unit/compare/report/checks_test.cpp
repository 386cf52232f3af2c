// SPDX-License-Identifier: MIT
// Visual checks in the report.
#include "compare/output/writers.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
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

// A row for each sentence of a feature. Places of one name are numbered; each has its link and tooltip.
TEST(ReportChecks, TheTableIsWhole) {
    const std::vector<FeatureChecks> checks{{"skins",
                                             9,
                                             {{"bent <a>", "arm", "mesh <0>", litBox, 1},
                                              {"bent <b>", "arm", "mesh 1", litBox, 1},
                                              {"bent <a>", "leg", "mesh 2", litBox, 1},
                                              {"bent <a>", "arm", "mesh 3", litBox, 1}}},
                                            {"masks", 1, {{"cut", "leaf", "mesh 4", litBox, 1}}}};
    const auto blocksOf = [&](Keep keep) {
        const Report report = reportOf(bothFrames(), {checks});
        ReportOptions options;
        options.keep = keep;
        std::vector<output::Block> blocks;
        addVisualChecks(blocks, report, layoutOf(report, options), 0);
        return output::inHtml(blocks);
    };
    const auto table = [](const std::string& more, const auto& place) {
        const auto row = [](const std::string& style, const std::string& feature, const std::string& what,
                            const std::string& where, const std::string& places) {
            return "<tr" + style + "><td>" + feature + "</td><td class=\"wide\">" + what +
                   "</td><td class=\"wide\" title=\"" + where + "\">" + places + "</td></tr>\n";
        };
        return "<div class=\"checks\" id=\"eye-0\"><h2>To check by eye</h2>\n<p class=\"soft\">Here both "
               "paths can be "
               "wrong in the same way, and no comparison shows it." +
               more +
               "</p>\n<div class=\"box scroll\"><table><thead><tr><th>feature</th><th class=\"wide\">right "
               "if</th>"
               "<th class=\"wide\">places</th></tr></thead>\n<tbody>" +
               row("", "<b>skins</b> <span class=\"soft\">the 4 largest of 9</span>", "bent &lt;a&gt;",
                   "mesh &lt;0&gt;; mesh 2; mesh 3", place("arm") + ", " + place("leg") + " " + place("2")) +
               row(" class=\"more\"", "", "bent &lt;b&gt;", "mesh 1", place("arm")) +
               row("", "<b>masks</b> <span class=\"soft\">1</span>", "cut", "mesh 4", place("leaf")) +
               "</tbody></table></div>\n</div>\n";
    };
    EXPECT_EQ(blocksOf(Keep::all),
              table(" Each link shows its place enlarged; where no light falls, in the base colour.",
                    [](const std::string& name) {
                        return "<a href=\"#c0-lit@1,2?zoom=2.22&amp;at=1,2\">" + name + "</a>";
                    }));
    EXPECT_EQ(blocksOf(Keep::none),
              table("", [](const std::string& name) { return "<bdi>" + name + "</bdi>"; }));
}

// A place is dark if less than a tenth of it reaches a hundredth of white.
TEST(ReportChecks, ADarkPlaceIsShownInItsBaseColour) {
    const auto shown = [](int bright, float light, int component) {
        std::vector<Frame> frames = bothFrames();
        for (Frame& frame : frames) {
            frame.settings.size = {20, 1};
            for (auto* images : {&frame.channels, &frame.through_gbuffer})
                for (auto& [mode, image] : *images)
                    image = Image(20, 1, image.components, mode == Channel::material_id ? 3.0f : 0.0f);
            for (int x = 0; x < bright; ++x) frame.channels.at(Channel::lit).at(x, 0, component) = light;
        }
        Report report =
            reportOf(std::move(frames), {{{"skins", 1, {{"what", "name", "where", {0, 0, 20, 1}, 1}}}}});
        ReportLayout layout = layoutOf(report, {});
        for (ChannelImages& images : layout.images[0]) images.scale.exposure.factor = 4;
        std::vector<output::Block> blocks;
        addVisualChecks(blocks, report, layout, 0);
        return linkOf(output::inHtml(blocks), "name");
    };
    const std::string albedo = "#c0-albedo@10,0?zoom=1&amp;at=9.5,0",
                      lit = "#c0-lit@10,0?zoom=1&amp;at=9.5,0";
    constexpr float enough = 0.01f / 4;
    EXPECT_EQ(shown(2, std::nextafter(enough, 1.0f), 0), lit);
    EXPECT_EQ(shown(2, std::nextafter(enough, 0.0f), 0), albedo);
    EXPECT_EQ(shown(1, 1, 0), albedo);
    for (const int component : {1, 2}) EXPECT_EQ(shown(2, 1, component), lit) << "the largest component";
}

// The margin is a third of the box; no place is enlarged more than eight times.
TEST(ReportChecks, PlacesAreEnlargedEightTimesAtMost) {
    const auto zoom = [](const PixelBox& box) {
        std::vector<Frame> frames = bothFrames();
        for (Frame& frame : frames) {
            frame.settings.size = {100, 50};
            for (auto* images : {&frame.channels, &frame.through_gbuffer})
                for (auto& [mode, image] : *images) image = Image(100, 50, image.components, 1.0f);
        }
        const std::string link =
            linkOf(pageOf(reportOf(std::move(frames), {{{"skins", 1, {{"what", "name", "where", box, 1}}}}})),
                   "name");
        return link.substr(link.find('@'));
    };
    EXPECT_EQ(zoom({10, 20, 20, 22}), "@15,21?zoom=7.41&amp;at=14.5,20.5") << "a tenth wide: 10 / 1.35";
    EXPECT_EQ(zoom({10, 20, 12, 25}), "@11,22?zoom=7.41&amp;at=10.5,22") << "a tenth high";
    EXPECT_EQ(zoom({10, 20, 12, 21}), "@11,20?zoom=8&amp;at=10.5,20");
    EXPECT_EQ(zoom({0, 0, 100, 50}), "@50,25?zoom=1&amp;at=49.5,24.5");
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
