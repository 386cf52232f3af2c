// SPDX-License-Identifier: MIT
#include "compare/report/html.h"

#include "compare/report/page_style.h"
#include "compare/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace diptych {
namespace {

std::string titleOf(const Report& report, const Comparison& comparison) {
    const Frame& frame = report.baseline(comparison);
    return fmt::format("{} \u00b7 {}", frame.scene, cameraTitle(frame));
}

std::string header(const Report& report) {
    const char* verdict = report.passed() ? "pass" : "fail";
    const std::size_t count = report.comparisons.size();
    const std::string title =
        count == 1 ? pairTitle(report, report.comparisons[0]) : fmt::format("{} comparisons", count);
    std::string drawn;
    if (count == 1) {
        const Frame& frame = report.baseline(report.comparisons[0]);
        drawn = fmt::format("{} \u00b7 {}\u00d7{} \u00b7 {} G-buffer \u00b7 ",
                            titleOf(report, report.comparisons[0]), frame.settings.size.width,
                            frame.settings.size.height, nameOf(frame.settings.gbuffer));
    }
    drawn += fmt::format("{} ({}), {}", report.device.name, report.device.type, report.device.driver);
    return fmt::format(
        "<header><p class=\"brand\">Diptych</p><h1><span class=\"verdict {0}\">{0}</span>{1}</h1>"
        "<p class=\"soft\">{2}</p></header>\n",
        verdict, markup(title), markup(drawn));
}

std::string listBox(const char* style, const char* heading, const std::string& items) {
    return items.empty() ? ""
                         : fmt::format("<section class=\"box {}\"><h4>{}</h4><ul>{}</ul></section>\n", style,
                                       heading, items);
}

// Where to look first, over all comparisons.
std::string failures(const Report& report) {
    std::string items;
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        const Comparison& comparison = report.comparisons[i];
        const std::string where =
            report.comparisons.size() > 1 ? markup(titleOf(report, comparison)) + ": " : "";
        for (const std::string& failure : comparison.failures)
            items += fmt::format("<li>{}{}</li>", where, markup(failure));
        for (const ChannelDiff& channel : comparison.channels)
            if (channel.verdict == Verdict::fail)
                items += fmt::format("<li>{}<a href=\"#c{}-{}\">{}</a>: {}</li>", where, i,
                                     channel.mode->name, channel.mode->name, markup(channel.reason));
    }
    return listBox("failures", "Failures", items);
}

// A note that several frames share is said once.
std::string notes(const Report& report) {
    std::set<std::string> seen;
    std::string items;
    const auto add = [&](const std::string& note) {
        if (seen.insert(note).second) items += fmt::format("<li>{}</li>", markup(note));
    };
    for (const Comparison& comparison : report.comparisons)
        for (const std::string& note : comparison.notes) add(note);
    for (const Frame& frame : report.frames)
        for (const std::string& note : frame.notes) add(note);
    return listBox("notes", "Notes", items);
}

// Where to look last: what passes may still be wrong in both paths.
std::string marksLinks(const Report& report) {
    std::string items;
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        const Comparison& comparison = report.comparisons[i];
        const std::string line = marksLine(comparison);
        if (line.empty()) continue;
        const std::string where =
            report.comparisons.size() > 1 ? markup(titleOf(report, comparison)) + ": " : "";
        const std::size_t colon = line.find(':');
        items += fmt::format("<li>{}<a href=\"#eye-{}\">{}</a><span class=\"soft\">{}</span></li>", where, i,
                             markup(line.substr(0, colon)), markup(line.substr(colon)));
    }
    return listBox("notes", "Both paths may be wrong alike", items);
}

std::string used(const ChannelDiff& channel) {
    if (channel.stats.different == 0) return "<span class=\"soft\">equal</span>";
    // There max meets the tolerance by construction, and a full meter would read as "just barely".
    if (channel.unexplained_pixels)
        return fmt::format("<span class=\"soft\">explained by the encoding, {} pixels left over</span>",
                           *channel.unexplained_pixels);
    const double share =
        channel.tolerance.max > 0 ? std::min(channel.stats.max / channel.tolerance.max, 1.0) : 1.0;
    return fmt::format("<span class=\"meter {}\"><i style=\"width:{:.1f}%\"></i></span>",
                       nameOf(channel.verdict), 100 * share);
}

std::string overview(const Comparison& comparison, std::size_t index) {
    std::string out =
        "<div class=\"box scroll\"><table><tr><th>channel</th><th class=\"optional\">metric</th><th "
        "class=\"n\">max</th>"
        "<th class=\"n optional\">mean</th><th class=\"n optional\">p99.9</th><th class=\"n\">tolerance</th>"
        "<th class=\"optional\">max of tolerance</th><th>verdict</th></tr>";
    for (const ChannelDiff* channel : failuresFirst(comparison)) {
        const ChannelStats& s = channel->stats;
        out += fmt::format("<tr><td><a href=\"#c{}-{}\">{}</a></td><td class=\"optional soft\">{}</td>",
                           index, channel->mode->name, channel->mode->name, nameOf(channel->mode->metric));
        if (channel->verdict == Verdict::forward_only)
            out +=
                "<td class=\"n\">\u2013</td><td class=\"n optional\">\u2013</td><td class=\"n "
                "optional\">\u2013</td>"
                "<td class=\"n\">\u2013</td><td class=\"optional\"></td>";
        else
            out += fmt::format(
                "<td class=\"n\">{}</td><td class=\"n optional\">{}</td><td class=\"n optional\">{}</td>"
                "<td class=\"n\">{}</td><td class=\"optional\">{}</td>",
                number(s.max), number(s.mean), number(s.p999), number(channel->tolerance.max),
                used(*channel));
        out += fmt::format("<td><span class=\"verdict {0}\">{0}</span></td></tr>", nameOf(channel->verdict));
    }
    return out + "</table></div>\n";
}

std::string footer(const Report& report, const ReportLayout& layout) {
    std::string links;
    for (const std::string& file : layout.files())
        if (!file.ends_with(".png") && file != "index.html")
            links += fmt::format("<a href=\"{0}\">{0}</a>", file);
    return fmt::format(
        "<footer><p>{}</p><p>compared in {:.0f} ms, pictures and EXRs encoded in {:.0f} ms. Numbers are of "
        "linear float32 channels; colour maps come after. Background pixels are outside every "
        "statistic; percentiles are by nearest rank.</p></footer>\n",
        links, report.diff_ms, layout.encode_ms);
}

}  // namespace

std::string reportHtml(const Report& report, const ReportLayout& layout) {
    std::string body = header(report) + failures(report) + notes(report) + marksLinks(report);
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        const Comparison& comparison = report.comparisons[i];
        body += fmt::format("<section><h2>{}</h2>\n",
                            report.comparisons.size() > 1 ? markup(titleOf(report, comparison)) : "Channels");
        body += overview(comparison, i) + channelCards(report, layout, i) + marksSection(report, layout, i);
        body += "<h2>What was drawn</h2>\n" + frameTables(report, comparison) + "</section>\n";
    }
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: {}</title>\n<style>{}</style>"
        "</head>\n<body>\n{}{}<script>{}</script>\n</body></html>\n",
        markup(verdictLine(report)), pageStyle, body, footer(report, layout), pageScript);
}

}  // namespace diptych
