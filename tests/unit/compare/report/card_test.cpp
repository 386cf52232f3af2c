// SPDX-License-Identifier: MIT
// A channel's card: pictures, scales, values, numbers, commands.
#include "compare/image/heat.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/report/document.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>

namespace diptych {
namespace {

// One channel of two Frames of 4 x 3 pixels; nothing of it is known yet.
struct CardMade {
    Report report;
    ReportLayout layout;
    ChannelDiff& channel;
    ChannelImages& images;

    explicit CardMade(Channel of = Channel::roughness)
        : report(reportWithout(of)),
          channel(report.comparisons[0].channels[0]),
          images(emptyImages(layout)) {}

    static Report reportWithout(Channel of) {
        Report report;
        report.device = {"a CPU", "1.0", "cpu"};
        for (const char* name : {"left<", "right>"}) {
            Frame& frame = report.frames.emplace_back();
            frame.name = name;
            frame.settings.size = {4, 3};
            Image& image = frame.channels[of] = Image(4, 3, debugMode(of).width, 0.5f);
            if (frame.name == "right>") image.at(1, 2) = 0.75f;
        }
        Comparison& one = report.comparisons.emplace_back();
        one.test = 1;
        one.channels.emplace_back().mode = &debugMode(of);
        return report;
    }
    static ChannelImages& emptyImages(ReportLayout& layout) {
        layout.ids = {"7"};
        layout.images = {std::vector<ChannelImages>(1)};
        ChannelImages& images = layout.images[0][0];
        images.baseline = "a.png";
        images.test = "b.png";
        images.values = "v.values.js";
        images.scale.text = "grey, <0 to 1";
        return images;
    }
    std::string html(bool open = false) const {
        return output::inHtml(diptych::cardOf(report, layout, 0, channel, open));
    }
};

std::string panelOf(const std::string& source, const std::string& alt) {
    return "<div class=\"panel\" tabindex=\"-1\"><img loading=\"lazy\" width=\"4\" height=\"3\" " + source +
           " alt=\"" + alt + "\">";
}
const std::string zoomButtons =
    "<span class=\"buttons\"><button data-do=\"out\" aria-label=\"zoom out\" title=\"-\">\u2212</button>"
    "<button data-do=\"fit\" title=\"0\">fit</button><button data-do=\"in\" aria-label=\"zoom in\" "
    "title=\"+\">+</button></span>";
std::string readoutOf(const std::string& names, const std::string& unit = "") {
    return "<p class=\"readout\" data-values=\"v.values.js\" data-names=\"" + names + "\" data-unit=\"" +
           unit + "\">the values under the cursor appear here</p>";
}
std::string pairOf(const std::string& right = "src=\"b.png\"") {
    return "<figure><div class=\"pair side\" data-mode=\"side\" style=\"--w:100%\"><div class=\"stage "
           "left\">" +
           panelOf("src=\"a.png\"", "roughness of left&lt;") +
           "</div><span class=\"tag\">left&lt;</span></div><div class=\"stage right\">" +
           panelOf(right, "roughness of right&gt;") +
           "</div><span class=\"tag\">right&gt;</span></div><input type=\"range\" min=\"0\" max=\"100\" "
           "step=\"0.1\" value=\"50\" aria-label=\"wipe roughness\"><i "
           "class=\"divider\"></i></div><figcaption>"
           "<span class=\"buttons\"><button data-show=\"side\" title=\"s\" class=\"on\">side by side</button>"
           "<button data-show=\"wipe\" title=\"w\">wipe</button><button data-show=\"left\" "
           "title=\"1\">left&lt;"
           "</button><button data-show=\"right\" title=\"2\">right&gt;</button><button data-show=\"flicker\" "
           "title=\"f\">flicker</button></span>" +
           zoomButtons + "<span>grey, &lt;0 to 1</span></figcaption>" +
           readoutOf("[&quot;left&lt;&quot;,&quot;right&gt;&quot;]") + "</figure>\n";
}
std::string startOf(const std::string& verdict, bool open, const std::string& about) {
    return fmt::format(
        "<details class=\"box card {0}\" id=\"c7-roughness\"{1}><summary><h3>roughness</h3><span "
        "class=\"soft\">4 \u00b7 absolute \u00b7 perceptual roughness, 0 to 1</span><span "
        "class=\"verdict {0}\">{0}</span></summary><div class=\"body\">{2}",
        verdict, open ? " open" : "", about);
}
std::string terms(const std::vector<std::pair<std::string, std::string>>& all) {
    std::string out;
    for (const auto& [name, value] : all) out += "<dt>" + name + "</dt><dd>" + value + "</dd>";
    return "<dl>" + out + "</dl>";
}
const std::string equalPictures = "<p class=\"equal\">no difference at any pixel</p>\n";

TEST(ReportCard, OfAnEqualChannelIsClosed) {
    CardMade card;
    const std::string
        rest =
            "<p class=\"finding\">equal at every pixel<span class=\"soft\"> (tolerance 0)</span>"
            "</p>\n<div class=\"pictures\">" +
            pairOf() + equalPictures + "</div>\n",
        more = "<details class=\"more\"><summary>Numbers, worst pixels</summary>" +
               terms({{"max", "0"},
                      {"mean", "0"},
                      {"rmse", "0"},
                      {"p99", "0"},
                      {"p99.9", "0"},
                      {"pixels that differ", "0"}}) +
               "</details>\n</div>\n</details>\n";
    EXPECT_EQ(card.html(), startOf("pass", false, "") + rest + more);
    EXPECT_EQ(card.html(true), startOf("pass", true, "") + rest + more);
    card.channel.stats.different = 1;
    EXPECT_TRUE(card.html().starts_with(startOf("pass", true, "")));
    card.channel.stats.different = 0;
    // One file embedded once, and pictures that are left out.
    card.layout.single_file = true;
    card.images.test = "a.png";
    EXPECT_NE(card.html().find(pairOf("data-same")), std::string::npos);
    card.images.values = "";
    EXPECT_NE(
        card.html().find("<p class=\"readout\">a single-file report has no values under the cursor</p>"),
        std::string::npos);
    card.layout.single_file = false;
    EXPECT_NE(
        card.html().find("<p class=\"readout\">pictures of this size have values only in the EXR files</p>"),
        std::string::npos);
    EXPECT_NE(card.html().find(panelOf("src=\"a.png\"", "roughness of right&gt;")), std::string::npos);
    card.images.kept = false;
    for (const auto& [keep, why] :
         {std::pair{Keep::none, "--keep none: no pictures are kept"},
          {Keep::failing, "--keep failing: pictures of passing channels are not kept"}}) {
        card.layout.keep = keep;
        const std::string start = rest.substr(0, rest.find("<div class"));
        EXPECT_EQ(card.html(),
                  startOf("pass", false, "") + start + "<p class=\"equal\">" + why + "</p>\n" + more);
    }
}

// A channel of one side has one picture and no numbers.
TEST(ReportCard, OfOneSideHasOnePicture) {
    CardMade card;
    card.channel.verdict = Verdict::forward_only;
    card.channel.tolerance.because = "no <G-buffer>";
    card.channel.stats.different = 1;
    const auto expected = [&](const std::string& image, const std::string& name) {
        return startOf("forward-only", false, "") +
               "<div class=\"pictures one\"><figure><div class=\"stage\">" +
               panelOf("src=\"" + image + "\"", "roughness") + "</div></div><figcaption>" + zoomButtons +
               "<span>grey, &lt;0 to 1</span></figcaption>" + readoutOf("[&quot;" + name + "&quot;]") +
               "</figure></div><p class=\"because\">no &lt;G-buffer&gt;</p>\n</div>\n</details>\n";
    };
    card.images.baseline = "";
    EXPECT_EQ(card.html(), expected("b.png", "right&gt;"));
    card.images.baseline = "a.png";
    card.images.test = "";
    EXPECT_EQ(card.html(), expected("a.png", "left&lt;"));
}

TEST(ReportCard, OfAFailureHasAllNumbersAndCommands) {
    CardMade card;
    ChannelDiff& c = card.channel;
    c.verdict = Verdict::fail;
    c.warning = "w<";
    c.reason = "max 2 exceeds 1";
    c.tolerance = {0.125, "be<cause"};
    c.stats = {.max = 0.5,
               .mean = 0.25,
               .rmse = 0.375,
               .p99 = 0.4,
               .p999 = 0.45,
               .worst_x = 1,
               .worst_y = 2,
               .different = 3,
               .infinite = 0,
               .nonfinite_baseline = 1,
               .nonfinite_test = 4};
    c.flip = 0.0123456;
    c.unexplained_pixels = 6;
    c.certain_p999 = 0.0625;
    c.approximation_errors = {{"split IBL", "--ibl sampled", 0.25, 0.5}, {"haze", "", 0.125, 0.75}};
    c.footprints = Footprints{.smooth = 10, .used = 1.23456, .detailed = 7, .flip = 0.034567, .edges = 8};
    c.encoding_use = BoundUse{.used = 0.56789, .x = 3, .y = 1};
    c.device_use = BoundUse{.used = 0.25, .x = 0, .y = 0};
    c.metrics = {{"max", 0.5}, {"unknown", 0.123456}};
    card.report.comparisons[0].command = {"compare", "a b", "--against-device", "1",
                                          "-o",      "out", "--size",           "4x3"};
    card.images.worst = {{1, 2, 0.5}};
    const auto again = [](const std::string& what, const std::string& line) {
        return "<p class=\"again\"><span class=\"soft\">" + what +
               ", from the same folder</span><span class=\""
               "again\"><code>" +
               line + "</code><button type=\"button\" data-do=\"copy\">copy</button></span></p>\n";
    };
    const std::string reproduce = again("reproduce it",
                                        "diptych compare --channels roughness &#39;a b&#39; "
                                        "--against-device 1 -o out --size 4x3"),
                      view = again("open it in a window",
                                   "diptych view --debug roughness &#39;a b&#39; --size 4x3");
    const std::vector<std::pair<std::string, std::string>> numbers{
        {"max", "0.5"},
        {"mean", "0.25"},
        {"rmse", "0.375"},
        {"p99", "0.4"},
        {"p99.9", "0.45"},
        {"p99.9 of the excess", "0.0625"},
        {"granted to split IBL, mean and p99.9; removed by --ibl sampled", "25 % and 50 %"},
        {"granted to haze, mean and p99.9", "12.5 % and 75 %"},
        {"FLIP, mean", "0.0123"},
        {"pixels that differ", "3"},
        {"left&lt; at 1,2", "0.5"},
        {"right&gt; at 1,2", "0.75"},
        {"pixels unexplained by the encoding", "6"},
        {"pixels with smooth surroundings, each with a bound", "10 px, largest error 1.23 times its bound"},
        {"pixels with detail, judged by FLIP", "7 px, 0.0346"},
        {"pixels at edges, not judged", "8 px"},
        {"largest error as a share of its pixel&#39;s bound", "56.8 % at 3,1"},
        {"largest error as a share of both devices&#39; precision", "25 % at 0,0"},
        {"NaN or infinite pixels", "1 | 4"}};
    const std::string metrics =
        "<details class=\"figures scroll\"><summary>All metrics</summary><table><tbody><tr><td>max</td><td "
        "class=\"n\">0.5</td><td class=\"soft wide\">" +
        page::markup(findMetric("max")->meaning) +
        "</td></tr>\n<tr><td>unknown</td><td class=\"n\">0.123</td><td class=\"soft wide\"></td></tr>\n"
        "</tbody></table></details>\n";
    const auto expected = [&](const std::string& commands, const auto& all) {
        return startOf("fail", true, "<p class=\"warning\">Warning: w&lt;</p>\n<p class=\"finding\">") +
               output::inHtml(findingOf(c, "c7-roughness")) + "</p>\n<div class=\"pictures\">" + pairOf() +
               equalPictures + "</div>\n<details class=\"more\"><summary>Numbers, worst pixels" +
               (commands.empty() ? "" : ", commands to reproduce it") + "</summary>" + commands + terms(all) +
               errorMetrics(c, card.images, "c7-roughness") + metrics + "</details>\n</div>\n</details>\n";
    };
    EXPECT_EQ(card.html(), expected(reproduce + view, numbers));
    // Commands of diff open no window; without a command there is none.
    card.report.comparisons[0].command = {"diff", "a.exr", "b.exr"};
    EXPECT_EQ(card.html(),
              expected(again("reproduce it", "diptych diff --channels roughness a.exr b.exr"), numbers));
    card.report.comparisons[0].command.clear();
    EXPECT_EQ(card.html(), expected("", numbers));
    // Rows of what is not there, or nowhere, are left out.
    c.footprints->detailed = c.footprints->edges = 0;
    c.encoding_use->x = -1;
    c.stats.nonfinite_baseline = 0;
    std::vector<std::pair<std::string, std::string>> fewer = numbers;
    fewer.back().second = "0 | 4";
    for (const std::size_t i : {16, 15, 14}) fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_EQ(card.html(), expected("", fewer));
    c.stats.nonfinite_test = 0;
    c.stats.worst_x = -1;
    fewer.pop_back();
    fewer.erase(fewer.begin() + 10, fewer.begin() + 12);
    EXPECT_EQ(card.html(), expected("", fewer));
}

std::string hexOf(const std::array<std::uint8_t, 3>& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

TEST(ReportCard, TheDifferenceHasALegendOfItsErrors) {
    CardMade card;
    ChannelDiff& c = card.channel;
    c.stats.different = 1;
    c.stats.worst_x = 1;
    c.stats.worst_y = 2;
    card.images.difference = "d.png";
    card.images.error_top = 0.5;
    const auto figure = [&] {
        const std::string html = card.html();
        const std::size_t at = html.find("<figure><div class=\"stage\">");
        return html.substr(at, html.find("</figure>", at) + 9 - at);
    };
    std::string stops;
    for (int i = 0; i <= 12; ++i) stops += ", " + hexOf(errorColor(i / 12.0));
    const std::string ring =
        "<i class=\"ring\" style=\"--u:0.37500;--v:0.83333\"></i>";  // 1.5 of 4, 2.5 of 3
    const auto expected = [&](const std::string& over, const std::string& title, const std::string& end,
                              const std::string& zero, const std::string& beyond, const std::string& mode) {
        return "<figure><div class=\"stage\">" + panelOf("src=\"d.png\"", "difference of " + mode) + over +
               "</div><span class=\"tag\">difference</span></div><figcaption><div class=\"legend\"><span "
               "class=\"title\">" +
               title + "</span><div class=\"ramp\" style=\"background:linear-gradient(90deg" + stops +
               ")\"></div><div class=\"ends mono\"><span>0</span><span>0.125</span><span>0.5 (" + end +
               ")</span></div></div><span>black: " + zero + "</span>" + beyond + "</figcaption></figure>";
    };
    const std::string absolute = "absolute error, |a-b|", rough = "roughness";
    EXPECT_EQ(figure(), expected(ring, absolute, "max", "equal", "", rough));
    c.stats.worst_x = -1;
    EXPECT_EQ(figure(), expected("", absolute, "max", "equal", "", rough)) << "nowhere";
    c.stats.worst_x = 0;
    c.stats.worst_y = 0;
    EXPECT_EQ(figure(), expected("<i class=\"ring\" style=\"--u:0.12500;--v:0.16667\"></i>", absolute, "max",
                                 "equal", "", rough));
    c.stats.worst_x = -1;
    // The map ends at the tolerance or the rule's limit; larger errors and infinity have colours.
    const auto swatch = [](const std::string& color, const std::string& text) {
        return "<span><i class=\"swatch\" style=\"background:" + color + "\"></i>" + text + "</span>";
    };
    card.images.error_limit = 0.5;
    EXPECT_EQ(figure(), expected("", absolute, "tolerance", "equal", "", rough));
    card.images.worst = {{1, 2, 0.5}};
    EXPECT_EQ(figure(), expected("", absolute, "tolerance", "equal", "", rough))
        << "the limit itself is allowed";
    card.images.worst[0].error = 0.75;
    const std::string beyond = hexOf(beyondColor);
    EXPECT_EQ(figure(),
              expected("", absolute, "tolerance", "equal",
                       swatch(beyond, "beyond tolerance, fading to white at 1000 times that"), rough));
    c.rule = "t.json, rule 1";
    c.stats.infinite = 1;
    EXPECT_EQ(figure(), expected("", absolute, "limit", "equal",
                                 swatch(beyond, "beyond the limit, fading to white at 1000 times that") +
                                     swatch(hexOf(nonfiniteColor), "infinite"),
                                 rough));
    c.rule = "";
    c.stats.infinite = 0;
    card.images.error_limit = 0;
    EXPECT_EQ(figure(), expected("", absolute, "max", "equal", "", rough)) << "a limit of 0 ends no map";
    // What is shown instead of the channel's own error.
    c.shown_error = std::make_shared<Image>(4, 3, 1);
    c.shown_error_name = "F<LIP";
    EXPECT_EQ(figure(), expected("", "F&lt;LIP", "F&lt;LIP", "equal", "", rough));
    c.shown_error_name = "relative";
    EXPECT_EQ(figure(), expected("", "relative error, |a-b| / |b|", "relative", "equal", "", rough));
    c.certain_p999 = 1;
    EXPECT_EQ(figure(), expected("",
                                 "excess: relative error minus the reference's uncertainty and the "
                                 "G-buffer's quantization bound",
                                 "relative", "no excess", "", rough))
        << figure();
    c.shown_error.reset();
    EXPECT_EQ(figure(), expected("", absolute, "max", "equal", "", rough));
    for (const auto& [channel, title] :
         {std::pair{Channel::lit, "relative error, |a-b| / |b|"},
          {Channel::normals, "angle between the two, degrees"},
          {Channel::anisotropy_direction, "angle between the two lines, degrees"},
          {Channel::material_id, "1 where the two differ"},
          {Channel::albedo, "absolute error, |a-b|"}}) {
        CardMade other(channel);
        other.images.difference = "d.png";
        const std::string html = other.html();
        EXPECT_NE(html.find(fmt::format("<span class=\"title\">{}</span>", title)), std::string::npos)
            << title;
    }
}

// Counts of lights have a colour bar with their number at its middle and end.
TEST(ReportCard, HeatMapsHaveABar) {
    CardMade card(Channel::light_count);
    card.images.scale.high = 25;
    std::string stops;
    for (int i = 0; i <= 10; ++i) stops += ", " + hexOf(heatColor(i / 10.0));
    EXPECT_NE(
        card.html().find("<div class=\"legend\"><span class=\"title\">lights evaluated per pixel</span><div "
                         "class=\"ramp\" style=\"background:linear-gradient(90deg" +
                         stops +
                         ")\"></div><div class=\"ends mono\"><span>0</span><span>12.5</span><span>25 lights"
                         "</span></div></div>"),
        std::string::npos)
        << card.html();
}

}  // namespace
}  // namespace diptych
