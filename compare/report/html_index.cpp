// SPDX-License-Identifier: MIT
// Several comparisons: one line each, failures first.
#include "compare/report/html.h"
#include "compare/report/titles.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace diptych {

using page::markup;
using page::number;

namespace {

// The failing channel that uses most of its tolerance; if none fails, the passing one that does, except
// channels judged by what the encoding explains, whose tolerance is each pixel's own.
const ChannelDiff* worstOf(const Comparison& comparison) {
    const ChannelDiff* worst = nullptr;
    for (const bool failing : {true, false}) {
        for (const ChannelDiff& channel : comparison.channels) {
            if ((channel.verdict == Verdict::fail) != failing || !isCompared(channel.verdict)) continue;
            if (!failing && channel.unexplained_pixels) continue;  // their largest error equals the tolerance
            if (!worst || usedShare(channel) > usedShare(*worst)) worst = &channel;
        }
        if (worst) return worst;
    }
    return nullptr;
}

std::string worstCell(const Comparison& comparison, std::size_t index) {
    const ChannelDiff* worst = worstOf(comparison);
    if (!worst) return "<td></td><td class=\"n optional\" data-value=\"0\"></td>";
    const double share = usedShare(*worst);
    return fmt::format(
        "<td>{}</td><td class=\"n optional\" data-value=\"{:.6g}\">{}</td>", cardLink(index, *worst->mode),
        share < std::numeric_limits<double>::infinity() ? share : 1e300,
        share < std::numeric_limits<double>::infinity() ? fmt::format("{:.3g} %", 100 * share) : "beyond");
}

std::string numberCell(double value, const std::string& text) {
    return fmt::format("<td class=\"n optional\" data-value=\"{:.6g}\">{}</td>", std::min(value, 1e300),
                       text);
}

std::string litCell(const Comparison& comparison) {
    for (const ChannelDiff& channel : comparison.channels)
        if (channel.mode->name == "lit") return numberCell(channel.stats.max, number(channel.stats.max));
    return numberCell(0, "");
}

bool isTimed(const Report& report) {
    return std::ranges::any_of(report.frames, [](const Frame& frame) { return frame.time.runs > 0; });
}

std::string timeCell(const Frame& frame) {
    return numberCell(frame.time.median, frame.time.runs > 0 ? fmt::format("{:.1f}", frame.time.median) : "");
}

// Of a comparison among others of its scene.
std::string rowTitle(const Report& report, const Comparison& comparison) {
    const Frame& frame = report.baseline(comparison);
    if (!hasSeveralPairs(report)) return viewTitle(report, frame);
    const std::string pair = pairTitle(report, comparison);
    return saysTime(report, frame) ? fmt::format("{}, {} s", pair, frame.settings.time) : pair;
}

std::string line(const Report& report, const ReportLayout& layout, std::size_t index) {
    const Comparison& comparison = report.comparisons[index];
    const Frame &left = report.baseline(comparison), &right = report.test(comparison);
    const char* verdict = comparison.passed() ? "pass" : "fail";
    const std::string& file = layout.sections[index];
    return fmt::format(
        "<tr data-comparison=\"{0}\"{1}><td><span class=\"verdict {2}\">{2}</span></td><td class=\"wide\"><a "
        "href=\"#s{0}\" title=\"{8}\">{3}</a></td><td class=\"wide\">{4}</td>{5}{6}{7}</tr>\n",
        index, file.empty() ? "" : fmt::format(" data-section=\"{}\"", markup(file)), verdict,
        markup(page::inFolder(left.scene, layout.folder)), markup(rowTitle(report, comparison)),
        worstCell(comparison, index), litCell(comparison),
        isTimed(report) ? timeCell(left) + timeCell(right) : "", markup(left.scene));
}

}  // namespace

std::string indexTable(const Report& report, const ReportLayout& layout) {
    if (report.comparisons.size() < 2) return {};
    std::string lines;
    for (const std::size_t i : layout.order) lines += line(report, layout, i);
    const Comparison& first = report.comparisons[0];
    const bool pairs = hasSeveralPairs(report);
    const bool times = std::ranges::any_of(
        report.comparisons, [&](const Comparison& c) { return saysTime(report, report.baseline(c)); });
    std::vector<std::pair<std::string, bool>> columns{
        {"verdict", false},
        {"scene", false},
        {fmt::format("{}{}", pairs ? "pair" : "camera", times ? ", time" : ""), false},
        {"worst channel", false},
        {"of its limit", true},
        {"lit max", true}};
    if (isTimed(report)) {
        columns.emplace_back((pairs ? "left" : report.baseline(first).name) + ", ms", true);
        columns.emplace_back((pairs ? "right" : report.test(first).name) + ", ms", true);
    }
    std::string heads;
    for (const auto& [name, isNumber] : columns)
        heads += fmt::format("<th{}><button type=\"button\">{}</button></th>",
                             isNumber ? " class=\"n optional\"" : "", markup(name));
    return fmt::format(
        "<section class=\"index\"><h2>Comparisons <span class=\"shown soft\"></span></h2>"
        "<p><input type=\"search\" placeholder=\"filter: scene, camera, time, channel, fail\" "
        "aria-label=\"filter\"></p>"
        "<div class=\"box scroll\"><table><thead><tr>{}</tr></thead>\n<tbody>{}</tbody>"
        "</table></div></section>\n",
        heads, lines);
}

}  // namespace diptych
