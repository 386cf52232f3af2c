// SPDX-License-Identifier: MIT
// Which path is closer to the reference, on a terminal and on the page.
#include "compare/output/writers.h"
#include "compare/report/document.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

struct CloserMade {
    Report report;
    ReportLayout layout;
    CloserPath& closer;
    CloserMade() : report(ofThree()), closer(report.closer_paths[0]) {
        layout.closer_paths = {{"lit.nearer.png", ""}};
    }

    static Report ofThree() {
        Report report;
        report.device.name = "a CPU";
        for (const char* name : {"the <ref>", "one", "<two>"}) {
            Frame& frame = report.frames.emplace_back();
            frame.name = name;
            frame.scene = "scene";
        }
        CloserPath& of = report.closer_paths.emplace_back(CloserPath{0, {1, 2}, {}});
        for (const Channel mode : {Channel::lit, Channel::lit_diffuse}) {
            CloserPathChannel& channel = of.channels.emplace_back();
            channel.mode = &debugMode(mode);
            double value = mode == Channel::lit ? 1 : 11;
            for (PathError* error : {&channel.paths[0], &channel.paths[1], &channel.between}) {
                error->stats = {
                    .max = value + 3, .mean = value, .rmse = 0, .p99 = value + 1, .p999 = value + 2};
                error->relative_rmse = value + 4;
                error->flip = value + 5;
                value += 100;
            }
            channel.error_difference = Image(1, 1, 1, 0.25f);
        }
        of.channels[1].paths[1].stats.mean = 1;  // the second is better here
        of.channels[1].paths[1].flip = 16;       // and as good here
        of.channels[1].between.flip.reset();
        of.channels[0].closer = 0;
        of.channels[0].by = 101;
        of.channels[0].materials = {
            {3, "gold<", 7, {0.5, 0.25}}, {4, "", 8, {0.125, 0.75}}, {5, "", 9, {1, 1}}};
        return report;
    }
    std::string page() const { return output::inHtml(closerPathBlocks(report, &layout, 0, false)); }
};

std::string metricRow(const std::string& name, const std::string& first, const std::string& second,
                      const std::string& between) {
    return "<tr><td class=\"soft wide\">" + name + "</td><td class=\"n\">" + first + "</td><td class=\"n\">" +
           second + "</td><td class=\"n\">" + between + "</td></tr>\n";
}
std::string metricHead(const std::string& name) {
    return "<tr class=\"head\"><td class=\"soft wide\">" + name +
           "</td><td class=\"n\"></td><td class=\"n\"></td>"
           "<td class=\"n\"></td></tr>\n";
}

TEST(CloserPathPage, IsWhole) {
    CloserMade made;
    const CloserPath& closer = made.closer;
    std::string lines;
    for (const CloserPathChannel& channel : closer.channels)
        lines += "<li>" + output::inHtml(output::Text(closerPathLine(closer, channel, made.report.frames))) +
                 "</li>";
    const std::string image =
        "<figure><img loading=\"lazy\" src=\"lit.nearer.png\" alt=\"which path is closer, pixel by pixel\">"
        "<figcaption><i class=\"swatch first\"></i>one closer<i class=\"swatch second\"></i>&lt;two&gt; "
        "closer<span "
        "class=\"soft\">lit: brightness is the difference of the errors, full at "
        "0.25</span></figcaption></figure>\n";
    const auto material = [](const std::string& name, const char* pixels, const char* first,
                             const char* second) {
        return "<tr><td class=\"wide\">" + name + "</span></td><td class=\"n\">" + pixels +
               "</td><td class=\"n\">" + first + "</td><td class=\"n\">" + second + "</td></tr>\n";
    };
    const std::string materials =
        "<div class=\"scroll\"><table><thead><tr><th class=\"wide\">lit by material</th><th "
        "class=\"n\">pixels</th>"
        "<th class=\"n\">one</th><th class=\"n\">&lt;two&gt;</th></tr></thead>\n<tbody>" +
        material("3 <span class=\"soft\">gold&lt;", "7", "0.5", "<b>0.25</b>") +
        material("4 <span class=\"soft\">", "8", "<b>0.125</b>", "0.75") +
        material("5 <span class=\"soft\">", "9", "1", "1") +
        "</tbody></table><p class=\"soft small\">Mean errors. The materials that add most to the difference "
        "of the "
        "paths (mean times pixels) come first.</p>\n</div>\n";
    const std::string metrics =
        "<div><div class=\"scroll\"><table><thead><tr><th class=\"soft wide\">errors</th><th "
        "class=\"n\">one</th>"
        "<th class=\"n\">&lt;two&gt;</th><th class=\"n\">between them</th></tr></thead>\n<tbody>" +
        metricHead("lit") + metricRow("mean", "<b>1</b>", "101", "201") +
        metricRow("p99", "<b>2</b>", "102", "202") + metricRow("p99.9", "<b>3</b>", "103", "203") +
        metricRow("max", "<b>4</b>", "104", "204") + metricRow("relative RMSE", "<b>5</b>", "105", "205") +
        metricRow("FLIP", "<b>6</b>", "106", "206") + metricHead("lit_<wbr>diffuse") +
        metricRow("mean", "11", "<b>1</b>", "211") + metricRow("p99", "<b>12</b>", "112", "212") +
        metricRow("p99.9", "<b>13</b>", "113", "213") + metricRow("max", "<b>14</b>", "114", "214") +
        metricRow("relative RMSE", "<b>15</b>", "115", "215") + metricRow("FLIP", "16", "16", "0") +
        "</tbody></table><p class=\"soft small\">Each path&#39;s error against the the &lt;ref&gt;; the "
        "smaller one in "
        "bold. Between them: &lt;two&gt; against one.</p>\n</div>\n</div>\n</div>\n";
    const auto whole = [&](const std::string& left) {
        return "<ul>" + lines + "</ul><div class=\"columns\"><div>" + left + "</div>\n" + metrics;
    };
    EXPECT_EQ(made.page(), whole(image + materials));
    made.layout.closer_paths[0][0] = "";  // --keep none
    EXPECT_EQ(made.page(), whole(materials));
    made.closer.channels[0].materials.clear();
    EXPECT_EQ(made.page(), whole(""));
    made.closer.channels[0].materials = {{3, "gold", 7, {0.5, 0.25}}};
    made.closer.channels[0].closer = -1;
    lines = "<li>" +
            output::inHtml(output::Text(closerPathLine(closer, closer.channels[0], made.report.frames))) +
            lines.substr(lines.find("</li>"));
    EXPECT_EQ(made.page(), whole("")) << "both are equally close";
    made.closer.channels.clear();
    EXPECT_EQ(made.page(), "");
}

TEST(CloserPathPage, ATerminalHasItsLines) {
    CloserMade made;
    std::string lines;
    for (const CloserPathChannel& channel : made.closer.channels)
        lines += "  " + closerPathLine(made.closer, channel, made.report.frames) + "\n";
    EXPECT_EQ(output::inText(closerPathBlocks(made.report, nullptr, 0, false)), lines);
    EXPECT_EQ(output::inText(closerPathBlocks(made.report, nullptr, 0, true)),
              "scene, default view:\n" + lines);
}

}  // namespace
}  // namespace diptych
