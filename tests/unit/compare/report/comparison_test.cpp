// SPDX-License-Identifier: MIT
// One comparison on a terminal and on the page: its table, findings, and the order of its parts.
#include "compare/output/writers.h"
#include "compare/report/document.h"
#include "compare/report/titles.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

namespace diptych {
namespace {

ChannelDiff diffOf(Channel channel, Verdict verdict, double largest) {
    ChannelDiff diff;
    diff.mode = &debugMode(channel);
    diff.verdict = verdict;
    diff.stats.max = largest;
    diff.stats.mean = largest / 2;
    diff.stats.rmse = largest * 0.75;
    diff.stats.p999 = largest * 0.875;
    diff.stats.different = largest > 0 ? 3 : 0;
    diff.tolerance = {0.5, "of <bits>"};
    return diff;
}

// A channel of each kind. Numbers that would look equal have more digits.
Report everyKind() {
    Report report;
    report.device = {"a CPU", "1.0", "cpu"};
    for (const Path path : {Path::deferred, Path::forward_plus}) {
        Frame& frame = report.frames.emplace_back();
        frame.name = std::string(nameOf(path));
        frame.scene = "builtin:one";
        frame.settings.path = path;
        frame.settings.size = {4, 3};
    }
    Comparison& one = report.comparisons.emplace_back();
    one.test = 1;
    ChannelDiff lit = diffOf(Channel::lit, Verdict::pass, 0.25),
                albedo = diffOf(Channel::albedo, Verdict::fail, 8),
                normals = diffOf(Channel::normals, Verdict::fail, 12.345),
                metallic = diffOf(Channel::metallic, Verdict::pass, 0.0625),
                emission = diffOf(Channel::emission, Verdict::informative, 1);
    lit.rule = "t.json, rule 1";
    lit.criterion = {.metric = "max", .measured = 0.25, .limit = 0.3};
    lit.warning = "near its limit";
    albedo.criterion = {.metric = "psnr",
                        .measured = 39.9999,
                        .limit = 40,
                        .min = true,
                        .pixels = 3,
                        .fraction = 0.25,
                        .differing = true};
    albedo.metrics = {{"max", 8}, {"psnr", 39.9999}, {"ssim", 0.5}};
    normals.criterion = {
        .metric = "p99.9 of the excess", .measured = 0.50001, .limit = 0.5, .pixels = 2, .fraction = 0.125};
    metallic.criterion = {.metric = "ssim", .measured = 0.96, .limit = 0.72, .min = true};
    one.channels = {lit,
                    albedo,
                    normals,
                    metallic,
                    emission,
                    diffOf(Channel::occlusion, Verdict::pass, 0),
                    diffOf(Channel::texcoords, Verdict::forward_only, 9)};
    return report;
}

TEST(ComparisonTable, HasARowForEachKindOfChannel) {
    const Report report = everyKind();
    EXPECT_EQ(
        output::inText(channelTable(report.comparisons[0], "7", false)),
        "  channel    metric       max    mean   p99.9  judged by            measured    limit  verdict\n"
        "  albedo     absolute       8       4       7  psnr                  39.9999    >= 40  FAIL\n"
        "  normals    angular     12.3    6.17    10.8  p99.9 of the excess   0.50001      0.5  FAIL\n"
        "  emission   relative       1     0.5   0.875  nothing                     -        -  informative\n"
        "  lit        relative    0.25   0.125   0.219  max                      0.25      0.3  pass\n"
        "  metallic   absolute  0.0625  0.0312  0.0547  ssim                     0.96  >= 0.72  pass\n"
        "  occlusion  absolute       0       0       0  nothing                     -        -  pass\n"
        "  texcoords  absolute       -       -       -  -                           -        -  "
        "forward-only\n");
    EXPECT_EQ(
        output::inText(channelTable(report.comparisons[0], "7", true), 0, 2),
        "  channel    metric       max    mean    rmse   p99.9  psnr  ssim  judged by            measured    "
        "limit  verdict\n"
        "  albedo     absolute       8       4       6       7    40   0.5  psnr                  39.9999    "
        ">= 40  FAIL\n");
    EXPECT_NE(output::inText(channelTable(report.comparisons[0], "7", true))
                  .find("  lit        relative    0.25   0.125   0.188   0.219     -     -  max "),
              std::string::npos);
}

TEST(ComparisonTable, APageAddsLinksBarsAndFractions) {
    const Report report = everyKind();
    const auto row = [](const std::string& channel, const std::string& judged, const std::string& metric,
                        const std::vector<std::string>& numbers, const std::string& by,
                        const std::string& measured, const std::string& limit, const std::string& used,
                        const std::string& verdict) {
        std::string out = fmt::format(
            "<tr><td><a href=\"#c7-{0}\">{0}</a>{1}</td><td class=\"optional soft\">{2}</td>", channel,
            judged.empty() ? "" : "<span class=\"soft judged\">" + judged + "</span>", metric);
        for (const std::string& number : numbers) out += "<td class=\"n optional\">" + number + "</td>";
        return out + fmt::format(
                         "<td class=\"soft by\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
                         "<td class=\"optional\">{}</td><td>{}</td></tr>\n",
                         by, measured, limit, used, verdict);
    };
    const auto meter = [](const char* verdict, const char* width) {
        return fmt::format("<span class=\"meter {}\"><i style=\"width:{}%\"></i></span>", verdict, width);
    };
    const auto verdict = [](const std::string& name, const std::string& beyond = "") {
        return fmt::format("<span class=\"verdict {0}\">{0}</span>{1}", name,
                           beyond.empty() ? "" : "<span class=\"beyond\">" + beyond + "</span>");
    };
    const std::string dash = "\u2013";
    EXPECT_EQ(
        output::inHtml(channelTable(report.comparisons[0], "7", false)),
        "<div class=\"box scroll\"><table class=\"overview\"><thead><tr><th>channel</th>"
        "<th class=\"optional soft\">metric</th><th class=\"n optional\">max</th><th class=\"n "
        "optional\">mean"
        "</th><th class=\"n optional\">p99.9</th><th class=\"soft by\">judged by</th><th class=\"n\">measured"
        "</th><th class=\"n\">limit</th><th "
        "class=\"optional\">used</th><th>verdict</th></tr></thead>\n<tbody>" +
            row("albedo", "psnr", "absolute", {"8", "4", "7"}, "psnr", "39.9999", "\u2265 40",
                meter("fail", "100.0"), verdict("fail", "25 % of the pixels differ")) +
            row("normals", "p99.9 of the excess", "angular, \u00b0", {"12.3", "6.17", "10.8"},
                "p99.9 of the excess", "0.50001", "0.5", meter("fail", "100.0"),
                verdict("fail", "12.5 % of the pixels")) +
            row("emission", "", "relative", {"1", "0.5", "0.875"}, "nothing", "", "",
                meter("informative", "0.0"), verdict("informative")) +
            row("lit", "max", "relative", {"0.25", "0.125", "0.219"}, "max", "0.25", "0.3",
                "<span class=\"soft wide\">t.json, rule 1</span>", verdict("pass")) +
            row("metallic", "ssim", "absolute", {"0.0625", "0.0312", "0.0547"}, "ssim", "0.96", "\u2265 0.72",
                meter("pass", "75.0"), verdict("pass")) +
            row("occlusion", "", "absolute", {"0", "0", "0"}, "nothing", "", "",
                "<span class=\"soft\">equal</span>", verdict("pass")) +
            row("texcoords", "", "absolute", {dash, dash, dash}, "", dash, dash, "",
                verdict("forward-only")) +
            "</tbody></table><p class=\"soft small\">Measured and limit belong to the metric in the column "
            "judged by. max: the largest error. p99.9: the 99.9th percentile of the error. Used: measured "
            "divided by the limit; for pixels unexplained, the largest error divided by its pixel&#39;s "
            "bound.</p>\n"
            "</div>\n");
    Comparison failing = report.comparisons[0];
    failing.channels[1].criterion->pixels = 0;
    EXPECT_EQ(output::inHtml(channelTable(failing, "7", false)).find("of the pixels differ"),
              std::string::npos);
}

TEST(ComparisonFinding, SaysWhatDecidedWhereAndWhy) {
    const auto finding = [](const auto& change) {
        ChannelDiff channel = diffOf(Channel::roughness, Verdict::pass, 0.25);
        channel.stats.worst_x = 1;
        channel.stats.worst_y = 2;
        channel.criterion = {.metric = "max", .measured = 0.25, .limit = 0.5};
        change(channel);
        return output::inHtml(findingOf(channel, "card"));
    };
    const std::string place = ", worst at <a href=\"#card@1,2\">1,2</a>",
                      because = ", because of &lt;bits&gt;)</span>", start = "<span class=\"soft\"> (",
                      limit = start + "tolerance 0.5" + because;
    EXPECT_EQ(finding([](auto&) {}), "max 0.25, at most 0.5 allowed" + place + limit);
    EXPECT_EQ(
        finding([](auto& c) { c.criterion = {.metric = "psnr", .measured = 45, .limit = 40, .min = true}; }),
        "psnr 45, at least 40 allowed" + place + limit);
    EXPECT_EQ(finding([](auto& c) { c.criterion->limit = 0.25; }),
              "max 0.25, at most 0.25 allowed" + place + limit)
        << "the limit itself passes, and equal numbers need no digits";
    EXPECT_EQ(
        finding([](auto& c) { c.criterion = {.metric = "psnr", .measured = 40, .limit = 40, .min = true}; }),
        "psnr 40, at least 40 allowed" + place + limit);
    EXPECT_EQ(finding([](auto& c) { c.criterion.reset(); }), "differs" + place + limit);
    EXPECT_EQ(finding([](auto& c) { c.reason = "max <2> exceeds 1"; }),
              "<b>max &lt;2&gt; exceeds 1</b>" + place + limit);
    EXPECT_EQ(finding([](auto& c) { c.stats.different = 0; }), "equal at every pixel" + limit);
    EXPECT_EQ(finding([](auto& c) { c.stats.worst_x = -1; }), "max 0.25, at most 0.5 allowed" + limit);
    EXPECT_EQ(finding([](auto& c) { c.stats.worst_x = 0; }),
              "max 0.25, at most 0.5 allowed, worst at <a href=\"#card@0,2\">0,2</a>" + limit);
    EXPECT_EQ(finding([](auto& c) { c.tolerance.because = ""; }),
              "max 0.25, at most 0.5 allowed" + place + start + "tolerance 0.5)</span>");
    EXPECT_EQ(finding([](auto& c) { c.verdict = Verdict::informative; }),
              "max 0.25, at most 0.5 allowed" + place + start + "informative" + because);
    const auto explained = [](auto& c) { c.unexplained_pixels = 0; };
    const std::string all = "explained by the encoding: largest error 0.25, mean 0.125";
    EXPECT_EQ(finding(explained), all + place + limit);
    EXPECT_EQ(finding([&](auto& c) {
                  explained(c);
                  c.flip = 0.0123456;
                  c.encoding_use = {.used = 0.5};
              }),
              all + ", FLIP 0.0123, at most 50 % of a pixel&#39;s bound" + place + start +
                  "tolerance per pixel, at most 0.5" + because);
    const auto by_rule = [&](auto& c) {
        explained(c);
        c.encoding_use = {.used = 0.5};
        c.rule = "t.json, rule 1";
    };
    EXPECT_EQ(finding(by_rule), "max 0.25, at most 0.5 allowed" + place + start + "t.json, rule 1" + because);
    EXPECT_EQ(finding([](auto& c) { c.device_use = {.used = 0.5}; }),
              "max 0.25, at most 0.5 allowed" + place + start + "tolerance per pixel, at most 0.5" + because);
}

// The terminal: Frames, table, glossary, findings of what fails, warns or needs words, causes, checks.
TEST(ComparisonText, IsWhole) {
    Report report = everyKind();
    Comparison& one = report.comparisons[0];
    one.failures = {"the frames differ"};
    ChannelDiff explained = diffOf(Channel::roughness, Verdict::pass, 0.25);
    explained.unexplained_pixels = 0;
    explained.criterion = {.metric = "pixels unexplained"};
    one.channels = {one.channels[0], one.channels[2], explained, one.channels[5]};
    one.explained = Explained{{output::Paragraph{"explained: shadows"}}, "{}", {}};
    one.visual_checks = {{"skins", 3, {}}};
    const auto blocks = [&] { return output::inText(comparisonBlocks(report, nullptr, 0)); };
    const std::string frames =
        "builtin:one, default view, 4x3: forward_plus against deferred\n"
        "  deferred, 0 bytes per pixel of G-buffer and depth\n"
        "  forward_plus, 0 bytes per pixel of depth\n";
    const std::string
        excess =
            "  excess: the error minus the reference's uncertainty and the G-buffer's quantization bound\n",
        unexplained =
            "  pixels unexplained: pixels whose difference the G-buffer's encoding does "
            "not explain; the limit is 0\n";
    const auto table = [&] { return output::inText(channelTable(one, "", false)); };
    const std::string normals =
                          "  FAIL builtin:one, normals: p99.9 of the excess 0.50001, at most 0.5 allowed "
                          "(tolerance 0.5, because of <bits>)\n",
                      lit =
                          "  lit: max 0.25, at most 0.3 allowed (t.json, rule 1, because of <bits>)\n"
                          "  warning builtin:one, lit: near its limit (t.json, rule 1)\n",
                      roughness = "  roughness: explained by the encoding: largest error 0.25, mean 0.125\n",
                      checks = "explained: shadows\n  3 places to check by eye: skins 3\n";
    EXPECT_EQ(blocks(), frames + table() + excess + unexplained + "  FAIL builtin:one: the frames differ\n" +
                            normals + lit + roughness + checks);
    // Two files have more metrics and no Frames.
    report.device = {};
    report.frames[0].origin.file = "a.exr";
    report.frames[1].origin.file = "b.exr";
    EXPECT_TRUE(blocks().starts_with("b.exr against a.exr, 4x3\n" +
                                     output::inText(channelTable(one, "", true)) + excess))
        << blocks();
    report.device = {"a CPU", "1.0", "cpu"};
    report.frames[0].origin.file = report.frames[1].origin.file = "";
    // What passes needs no words: an equal channel, one by a rule that is equal, one that nothing explains.
    one.failures.clear();
    one.explained.reset();
    one.visual_checks.clear();
    one.channels[0].stats.different = 0;
    one.channels[0].warning.clear();
    one.channels[1].verdict = Verdict::pass;
    one.channels[1].criterion.reset();
    one.channels[2].stats.max = 0;
    EXPECT_EQ(blocks(), frames + table() + unexplained);
    // By a rule, an explained channel keeps the rule's limit.
    one.channels[2].stats.max = 0.25;
    one.channels[2].rule = "t.json, rule 2";
    EXPECT_EQ(blocks(),
              frames + table() + unexplained +
                  "  roughness: pixels unexplained 0, at most 0 allowed (t.json, rule 2, because of "
                  "<bits>)\n");
}

// Cards of failures and lit lead; then the table, causes, other cards, checks, Frames and files.
TEST(ComparisonPage, ItsPartsStandInOrder) {
    Report report = everyKind();
    Comparison& one = report.comparisons[0];
    one.channels = {one.channels[0], one.channels[1], one.channels[3], one.channels[6]};
    one.explained = Explained{{output::Heading{2, "Causes"}}, "{}", Image8{}};
    one.visual_checks = {{"skins", 3, {{"right", "name", "where", {0, 0, 1, 1}, 1}}}};
    ReportLayout layout;
    layout.ids = {"7"};
    layout.images = {std::vector<ChannelImages>(4)};
    layout.cause_maps = {"causes.png"};
    layout.exr = {"deferred.exr", "forward.exr"};
    const auto parts = [&] {
        const std::string page = output::inHtml(comparisonBlocks(report, &layout, 0));
        static const std::regex part(
            "<h2>[^<]*</h2>|id=\"[^\"]*\"( open)?|<img [^>]*causes[^>]*>|<p class=\"soft "
            "camera\">Every.*?</p>|class=\"box says\"|class=\"overview\"");
        std::vector<std::string> all;
        for (std::sregex_iterator i(page.begin(), page.end(), part), none; i != none; ++i)
            all.push_back((*i)[0]);
        return all;
    };
    using Parts = std::vector<std::string>;
    const std::string map =
                          "<img loading=\"lazy\" src=\"causes.png\" alt=\"the largest cause at each pixel\">",
                      files = "<p class=\"soft camera\">Every channel as float32:";
    EXPECT_EQ(
        parts(),
        (Parts{
            "<h2></h2>", "id=\"c7-albedo\" open", "id=\"c7-lit\" open", "<h2>Channels</h2>",
            "class=\"overview\"", "<h2>Causes</h2>", map, "id=\"c7-metallic\" open", "id=\"c7-texcoords\"",
            "id=\"eye-7\"", "<h2>To check by eye</h2>", "<h2>What was compared</h2>", "class=\"box says\"",
            files +
                " <a href=\"deferred.exr\">deferred.exr</a> <a href=\"forward.exr\">forward.exr</a></p>"}));
    // Without the map and files; a part of a report has its title later.
    layout.part = true;
    layout.cause_maps = {""};
    layout.exr = {"", "forward.exr"};
    one.channels[2].stats.different = 0;
    EXPECT_EQ(parts(),
              (Parts{"<h2>\x02</h2>", "id=\"c7-albedo\" open", "id=\"c7-lit\" open", "<h2>Channels</h2>",
                     "class=\"overview\"", "<h2>Causes</h2>", "id=\"c7-metallic\"", "id=\"c7-texcoords\"",
                     "id=\"eye-7\"", "<h2>To check by eye</h2>", "<h2>What was compared</h2>",
                     "class=\"box says\"", files + " <a href=\"forward.exr\">forward.exr</a></p>"}));
    layout.exr = {"", ""};
    EXPECT_EQ(parts().back(), "class=\"box says\"");
}

}  // namespace
}  // namespace diptych
