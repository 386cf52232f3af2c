// SPDX-License-Identifier: MIT
// The page around the comparisons: its head, lists and their order; and the table of comparisons.
#include "compare/output/writers.h"
#include "compare/report/report.h"
#include "compare/report/titles.h"
#include "compare/report/trends.h"
#include "tests/support/report_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace diptych {
namespace {

// Comparisons of roughness without images.
Report pageOfScenes(const std::vector<std::string>& scenes) {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    for (const std::string& scene : scenes) {
        Comparison& one = report.comparisons.emplace_back();
        one.baseline = report.frames.size();
        one.test = one.baseline + 1;
        for (const char* name : {"deferred", "forward_plus"}) {
            Frame& frame = report.frames.emplace_back();
            frame.name = name;
            frame.scene = scene;
            frame.settings.size = {4, 3};
        }
        one.channels.emplace_back().mode = &debugMode(Channel::roughness);
    }
    return report;
}

ReportTexts shortTexts(const Report& report) {
    ReportTexts texts;
    texts.devices = {{report.device, report.comparisons.size(), 1, 2}};
    texts.rows.resize(report.comparisons.size());
    texts.section = [](std::size_t index) { return fmt::format("[section {}]", index); };
    return texts;
}

// Without styles, scripts, the list of keys and the table of comparisons.
std::string bodyOf(const Report& report, const ReportOptions& options, const ReportTexts& texts) {
    const std::string page = reportHtml(report, layoutOf(report, options), texts);
    const std::size_t start = page.find("<body>\n") + 7, end = page.find("</footer>");
    std::string body = page.substr(start, end - start);
    const auto cut = [&](const std::string& from, const std::string& to) {
        const std::size_t at = body.find(from);
        if (at != body.npos) body.erase(at, body.find(to, at) + to.size() - at);
    };
    cut("<details class=\"keys box\">", "</details>\n");
    cut("<div class=\"index\">", "</script></div>\n");
    return body;
}
std::string headerOf(const Report& report, const ReportTexts& texts) {
    const std::string body = bodyOf(report, {}, texts), start = "<p class=\"brand\">Diptych</p>";
    const std::size_t at = body.find(start) + start.size();
    return body.substr(at, body.find("</header>") - at);
}
std::string headerOf(const Report& report) {
    return headerOf(report, shortTexts(report));
}
std::string header(const std::string& verdict, const std::string& heading, const std::string& line,
                   const std::string& about) {
    return fmt::format(
        "<h1><span class=\"verdict {0}\">{0}</span>{1}</h1><p>{2}</p><p class=\"soft\">{3}</p>", verdict,
        heading, line, about);
}
std::string box(const std::string& style, const std::string& title, const std::string& items) {
    return fmt::format("<div class=\"box {}\"><h4>{}</h4>\n<ul>{}</ul></div>\n", style, title, items);
}

TEST(ReportPage, ItsHeadNamesWhatWasCompared) {
    Report report = pageOfScenes({"x/<a>.glb"});
    const std::string passes = "pass: the one compared channel is within tolerance";
    EXPECT_EQ(headerOf(report), header("pass", "forward_plus against deferred", passes,
                                       "<bdi>&lt;a&gt;.glb \u00b7 default view</bdi> \u00b7 4\u00d73 \u00b7 "
                                       "standard G-buffer \u00b7 a CPU (cpu), 1.0"));
    // The Frame that was rendered names the view; a title has the pair if there are several.
    report.frames[0].origin.file = "b.exr";
    report.frames[0].settings.camera = "of the file";
    report.frames[1].settings.camera = "door";
    EXPECT_NE(
        headerOf(report).find("<bdi>&lt;a&gt;.glb \u00b7 door \u00b7 forward_plus against deferred</bdi>"),
        std::string::npos);
    report.frames[0].origin.file = "";
    report.frames[1].origin.file = "b.exr";
    EXPECT_NE(headerOf(report).find("<bdi>&lt;a&gt;.glb \u00b7 of the file \u00b7 forward_plus against "
                                    "deferred</bdi>"),
              std::string::npos);
    // Two files have neither devices nor a G-buffer.
    report.device = {};
    report.frames[0].origin.file = "y/one.exr";
    report.frames[1].origin.file = "y/two.exr";
    EXPECT_EQ(headerOf(report), header("pass", "forward_plus against deferred", passes,
                                       "<bdi>two.exr against one.exr</bdi> \u00b7 4\u00d73"));
}

TEST(ReportPage, ItsHeadNamesEveryDeviceAndTheVerdict) {
    Report report = pageOfScenes({"a", "b"});
    ReportTexts texts = shortTexts(report);
    const std::string passes = "pass: all 2 compared channels of 2 comparisons are within tolerance";
    EXPECT_EQ(headerOf(report, texts), header("pass", "2 comparisons", passes, "a CPU (cpu), 1.0"));
    texts.devices.push_back({{}, 0, 0, 0});
    texts.devices.push_back({{"a GPU", "2.0", "gpu"}, 1, 0, 0});
    report.against = {"b CPU", "3.0", "cpu"};
    EXPECT_EQ(headerOf(report, texts), header("pass", "2 comparisons", passes,
                                              "a CPU (cpu), 1.0; a GPU (gpu), 2.0; and b CPU (cpu), 3.0"));
    report.errors = {{"c", "is cut short"}};
    EXPECT_TRUE(headerOf(report, texts).starts_with("<h1><span class=\"verdict fail\">fail</span>2 comp"));
    report.errors.clear();
    report.comparisons[1].failures = {"differs"};
    EXPECT_TRUE(headerOf(report, texts).starts_with("<h1><span class=\"verdict fail\">fail</span>2 comp"));
}

TEST(ReportPage, ItsListsStandInOrder) {
    Report report = pageOfScenes({"x/a.glb", "x/b.glb"});
    report.first_notes = {"an <important> note", "and another"};
    report.errors = {{"c.glb", "is cut short"}, {"d.glb", "d.glb: failed", "<cycles>", "said <this>"}};
    report.failures = {{"e.exr", "is in A only", "other", "said that"}};
    Comparison &passes = report.comparisons[0], &fails = report.comparisons[1];
    passes.channels[0].warning = "near its <limit>";
    passes.visual_checks = {{"skins", 2, {}}};
    passes.notes = {"a <note>"};
    fails.failures = {"the frames differ"};
    fails.channels[0].verdict = Verdict::fail;
    fails.channels[0].reason = "max 2 exceeds 1";
    report.closer_paths = {{0, {0, 1}, {}}, {2, {2, 3}, {}}};
    ReportTexts texts = shortTexts(report);
    texts.closer_boxes = {"[closer 0]", "[closer 1]"};
    texts.since = std::make_shared<Trends>(Trends{"<old>", "", {{}, {}}, {}});
    const std::string pair = " \u00b7 default view \u00b7 forward_plus against deferred</bdi>: ",
                      a = "<li><bdi>a.glb" + pair, b = "<li><bdi>b.glb" + pair;
    const auto said = [](const std::string& who, const std::string& what) {
        return "<details class=\"said\"><summary>output of <bdi>" + who + "</bdi></summary><p><bdi>" + what +
               "</bdi></p>\n</details>\n";
    };
    const std::string start = "<a class=\"skip\" href=\"#sections\">Skip to the results</a><header>";
    const std::string body = bodyOf(report, {}, texts);
    EXPECT_TRUE(body.starts_with(start)) << body;
    EXPECT_EQ(
        body.substr(body.find("</header>")),
        "</header>\n" + box("notes", "Read first", "<li>an &lt;important&gt; note</li><li>and another</li>") +
            box("failures", "Failures",
                "<li>c.glb: is cut short</li><li>d.glb: failed</li><li>e.exr: is in A only</li>" + b +
                    "the frames differ</li>" + b +
                    "<a href=\"#c1-roughness\">roughness</a>: max 2 exceeds 1</li>") +
            said("&lt;cycles&gt;", "said &lt;this&gt;") + said("other", "said that") +
            box("notes since", "Since &lt;old&gt;", "<li>nothing has changed</li>") +
            box("notes", "Warnings",
                a + "<a href=\"#c0-roughness\">roughness</a>: near its &lt;limit&gt;</li>") +
            "<h2>Against the reference</h2>\n"
            "<div class=\"box closer\"><h3><bdi>a.glb</bdi> \u00b7 <bdi>default view</bdi></h3>\n[closer "
            "0]</div>\n"
            "<div class=\"box closer\"><h3><bdi>b.glb</bdi> \u00b7 <bdi>default view</bdi></h3>\n[closer "
            "1]</div>\n"
            "<div id=\"sections\">[section 1][section 0]</div>\n" +
            box("notes", "Both paths may be wrong in the same way",
                a + "<a href=\"#eye-0\">2 places to check by eye</a>: skins 2</li>") +
            box("notes", "Notes", "<li><bdi>a.glb: </bdi><bdi>a &lt;note&gt;</bdi></li>") +
            // the page, junit.xml, report.json, four EXRs, two values
            "<p class=\"soft small\">9 files. Statistics are computed on linear float32 channels, before any "
            "colour map. They exclude background pixels. Percentiles are nearest-rank.</p>\n"
            "<footer><p><a href=\"report.json\">report.json</a> <a href=\"junit.xml\">junit.xml</a> </p>");
}

// Its channels have their cards; a single box needs no title, a note no scene.
TEST(ReportPage, OfOneComparisonIsNotNamedAgain) {
    Report report = pageOfScenes({"a.glb"});
    report.comparisons[0].channels[0].verdict = Verdict::fail;
    report.comparisons[0].channels[0].warning = "near";
    report.comparisons[0].failures = {"differs"};
    report.comparisons[0].notes = {"a note"};
    report.closer_paths = {{0, {0, 1}, {}}};
    ReportTexts texts = shortTexts(report);
    texts.closer_boxes = {"[closer]"};
    const std::string body = bodyOf(report, {}, texts), start = "</header>\n";
    const std::size_t at = body.find(start) + start.size();
    EXPECT_EQ(body.substr(at, body.find("<p class=\"soft small\">") - at),
              box("failures", "Failures", "<li>differs</li>") +
                  box("notes", "Warnings", "<li><a href=\"#c0-roughness\">roughness</a>: near</li>") +
                  "<h2>Against the reference</h2>\n<div class=\"box closer\">[closer]</div>\n"
                  "<div id=\"sections\">[section 0]</div>\n" +
                  box("notes", "Notes", "<li><bdi></bdi><bdi>a note</bdi></li>"));
    EXPECT_EQ(sectionTitle(report, layoutOf(report, {}), 0), "");
}

// The first four, failing ones first; a single file has the others as text.
TEST(ReportPage, FourComparisonsStandInIt) {
    Report report = pageOfScenes({"a", "b", "c", "d", "e", "f"});
    report.comparisons[5].failures = {"differs"};
    const std::string four = "<div id=\"sections\">[section 5][section 0][section 1][section 2]</div>\n",
                      end = "<p class=\"soft small\">";
    const ReportTexts texts = shortTexts(report);
    ReportOptions options;
    EXPECT_NE(bodyOf(report, options, texts).find(four + end), std::string::npos);
    options.single_file = true;
    EXPECT_NE(bodyOf(report, options, texts)
                  .find(four +
                        "<script type=\"text/plain\" id=\"section-3\">[section 3]</script>\n"
                        "<script type=\"text/plain\" id=\"section-4\">[section 4]</script>\n" +
                        end),
              std::string::npos);
    EXPECT_EQ(sectionTitle(report, layoutOf(report, {}), 5), "f \u00b7 default view");
}

// Forty items of a list are shown.
TEST(ReportPage, ListsHaveFortyItems) {
    Report report = pageOfScenes({"a"});
    for (int i = 1; i <= 40; ++i) report.first_notes.push_back(fmt::format("note {}", i));
    std::string body = bodyOf(report, {}, shortTexts(report));
    EXPECT_NE(body.find("<li>note 40</li></ul>"), std::string::npos);
    report.first_notes.emplace_back("note 41");
    body = bodyOf(report, {}, shortTexts(report));
    EXPECT_NE(body.find("<li>note 40</li><li><span class=\"soft\">and 1 more: report.json has all of them"
                        "</span></li></ul>"),
              std::string::npos);
}

std::string indexOf(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    return output::inHtml(indexBlocks(report, layout, texts));
}
std::string choice(const std::string& name, const std::string& options) {
    return fmt::format("<label>{0} <select data-by=\"{0}\"><option></option>{1}</select></label>", name,
                       options);
}
std::string filters(const std::string& choices, const std::string& channels) {
    return "<div class=\"index\"><h2>Comparisons <span class=\"shown soft\"></span></h2>\n<p "
           "class=\"narrow\">"
           "<input type=\"search\" placeholder=\"filter: scene, camera, time, channel, fail\" "
           "aria-label=\"filter\">" +
           choice("verdict", "<option>fail</option><option>pass</option>") + choices +
           choice("channel", channels) +
           "<label>figure <select data-by=\"figure\"><option>max</option><option>mean</option><option>rmse"
           "</option><option>p99</option><option>p99.9</option><option>FLIP</option><option>of its limit"
           "</option></select></label></p>";
}
// The table's head: titles with the classes of their columns.
std::string heads(const std::vector<std::pair<std::string, std::string>>& columns) {
    std::string out = "<div class=\"box scroll\"><table class=\"sortable\"><thead><tr>";
    for (const auto& [title, style] : columns)
        out += fmt::format("<th{}><button type=\"button\">{}</button></th>",
                           style.empty() ? "" : " class=\"" + style + "\"", title);
    return out + "</tr></thead>\n<tbody>";
}

TEST(ReportPage, TheTableOfComparisonsIsWhole) {
    Report report = pageOfScenes({"x/a_b.glb", "x/<c>.glb"});
    report.comparisons[1].failures = {"differs"};
    report.frames[2].camera.name = "<door>";
    ReportLayout layout = layoutOf(report, {});
    layout.sections[0] = "a/comparison.section.js";
    ReportTexts texts = shortTexts(report);
    IndexRow &a = texts.rows[0], &c = texts.rows[1];
    a.worst = &debugMode(Channel::roughness);
    a.used = 0.12345678;
    a.left_ms = 1.5;
    a.right_ms = 2.25;
    a.left_timed = true;
    a.cause = "<shadows>";
    a.device = "a CPU";
    a.channels = {{"roughness", "pass", 0.5, 0, 0.1, 0.1, 0.1, 0.1, -1, 0},
                  {"lit", "pass", 0.123456, 0.234567, 0.345678, 0.456789, 0.567891, 0.678912, 0.789123, 0}};
    c.used = 1e300;
    c.worst = &debugMode(Channel::lit_diffuse);
    c.right_ms = 3.75;
    c.device = "a <GPU>";
    c.channels = {{"lit", "fail", 1e300, 1e300, 0, 0, 0, 0, -1, 0},
                  {"</</\u00fc>", "fail", 2, 0, 0, 0, 0, 0, -1, 0}};
    texts.devices.push_back({});
    texts.since = std::make_shared<Trends>(Trends{
        "old",
        "",
        {{TrendKind::same, {}}, {TrendKind::moved, {{"lit", "max", 1, 2, 0}, {"lit", "p99", 3, 4, 0}}}},
        {}});
    const std::string expected =
        filters(choice("camera", "<option>&lt;door&gt;</option><option>default view</option>") +
                    choice("cause", "<option>&lt;shadows&gt;</option>") +
                    choice("since", "<option>moved</option><option>same</option>"),
                "<option>roughness</option><option>lit</option><option>&lt;/&lt;/\u00fc&gt;</option>") +
        heads({{"verdict", ""},
               {"scene", "wide"},
               {"camera", "wide"},
               {"worst channel", ""},
               {"of its limit", "n optional"},
               {"lit max", "n optional"},
               {"deferred, ms", "n optional"},
               {"forward_plus, ms", "n optional"},
               {"since then", "wide"},
               {"device", "wide"},
               {"", ""}}) +
        "<tr data-comparison=\"1\" data-camera=\"&lt;door&gt;\" data-scene=\"x/&lt;c&gt;.glb\" "
        "data-since=\"moved\">"
        "<td><span class=\"verdict fail\">fail</span></td>"
        "<td class=\"wide\" title=\"x/&lt;c&gt;.glb\"><a href=\"#s1\">&lt;c&gt;.glb</a></td>"
        "<td class=\"wide\">&lt;door&gt;</td><td><a href=\"#c1-lit_diffuse\">lit_<wbr>diffuse</a></td>"
        "<td class=\"n optional\" data-value=\"1e+300\">beyond</td>"
        "<td class=\"n optional\" data-value=\"1e+300\">inf</td>"
        "<td class=\"n optional\" data-value=\"0\"></td><td class=\"n optional\" data-value=\"3.75\"></td>"
        "<td class=\"wide\" title=\"lit max 1 -&gt; 2; lit p99 3 -&gt; 4\">moved <span class=\"soft\">lit "
        "max 1 "
        "-&gt; 2</span></td><td class=\"wide\">a &lt;GPU&gt;</td>"
        "<td><button type=\"button\" data-do=\"accept\" title=\"copies the command that accepts this "
        "difference\">"
        "accept</button></td></tr>\n"
        "<tr data-comparison=\"0\" data-camera=\"default view\" data-section=\"a/comparison.section.js\" "
        "data-title=\"a_b.glb \u00b7 default view\" data-since=\"same\" data-cause=\"&lt;shadows&gt;\">"
        "<td><span class=\"verdict pass\">pass</span></td>"
        "<td class=\"wide\" title=\"x/a_b.glb\"><a href=\"#s0\">a_<wbr>b.glb</a></td>"
        "<td class=\"wide\">default view</td><td><a href=\"#c0-roughness\">roughness</a></td>"
        "<td class=\"n optional\" data-value=\"0.123457\">12.3 %</td>"
        "<td class=\"n optional\" data-value=\"0.234567\">0.235</td>"
        "<td class=\"n optional\" data-value=\"1.5\">1.5</td><td class=\"n optional\" "
        "data-value=\"2.25\"></td>"
        "<td class=\"wide\"></td><td class=\"wide\">a CPU</td><td></td></tr>\n</tbody></table></div>\n"
        "<script type=\"application/json\" id=\"figures\">"
        "{\"0\":{\"lit\":[0,0.1235,0.2346,0.3457,0.4568,0.5679,0.6789,0.7891]},\n"
        "\"1\":{\"lit\":[1,1e+300,1e+300,0,0,0,0,-1],\"<\\/<\\/\\u00fc>\":[1,2,0,0,0,0,0,-1]}}</script></"
        "div>\n";
    EXPECT_EQ(indexOf(report, layout, texts), expected);
}

// One pair per view: cameras. Several: pairs, with left and right. Times where they differ or are not 0.
TEST(ReportPage, TheTableHasTheColumnsThatTellApart) {
    Report report = pageOfScenes({"a", "a"});
    const auto indexWith = [&](bool timed) {
        ReportTexts texts = shortTexts(report);
        texts.rows[1].right_timed = timed;
        return indexOf(report, layoutOf(report, {}), texts);
    };
    using Heads = std::vector<std::pair<std::string, std::string>>;
    const auto headsOf = [](const std::string& which, const Heads& times) {
        Heads all{{"verdict", ""},
                  {"scene", "wide"},
                  {which, "wide"},
                  {"worst channel", ""},
                  {"of its limit", "n optional"},
                  {"lit max", "n optional"}};
        all.insert(all.end(), times.begin(), times.end());
        all.emplace_back();
        return heads(all);
    };
    const std::string none = filters("", "");
    EXPECT_TRUE(indexWith(false).starts_with(none + headsOf("camera", {}))) << indexWith(false);
    EXPECT_TRUE(indexWith(true).starts_with(
        none + headsOf("camera", {{"deferred, ms", "n optional"}, {"forward_plus, ms", "n optional"}})));
    EXPECT_NE(indexWith(true).find("<td class=\"n optional\" data-value=\"0\">0.0</td>"), std::string::npos);
    report.frames[1].settings.time = report.frames[0].settings.time = 0.5;
    const auto cells = [](const char* first, const char* second) {
        return choice("camera", fmt::format("<option>{}</option><option>{}</option>", first, second));
    };
    EXPECT_TRUE(indexWith(false).starts_with(filters(cells("default view, 0 s", "default view, 0.5 s"), "") +
                                             headsOf("camera, time", {})));
    report.frames[2].origin.device = "another";
    report.frames[3].name = "reference";
    EXPECT_TRUE(indexWith(true).starts_with(
        filters(cells("forward_plus against deferred, 0.5 s", "reference against deferred, 0 s"), "") +
        headsOf("pair, time", {{"left, ms", "n optional"}, {"right, ms", "n optional"}})))
        << indexWith(true);
    report.frames[1].settings.time = report.frames[0].settings.time = 0;
    EXPECT_TRUE(indexWith(false).starts_with(
        filters(cells("forward_plus against deferred", "reference against deferred"), "") +
        headsOf("pair", {})));
    EXPECT_TRUE(indexBlocks(pageOfScenes({"a"}), {}, {}).empty());
}

}  // namespace
}  // namespace diptych
