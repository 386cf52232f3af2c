// SPDX-License-Identifier: MIT
// Several comparisons: one line each, failures first.
#include "compare/report/html.h"
#include "compare/report/titles.h"
#include "compare/report/trends.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace diptych {

using page::markup;
using page::number;

namespace {

std::string worstCell(const IndexRow& row, const std::string& id) {
    if (!row.worst) return "<td></td><td class=\"n optional\" data-value=\"0\"></td>";
    return fmt::format("<td>{}</td><td class=\"n optional\" data-value=\"{:.6g}\">{}</td>",
                       cardLink(id, *row.worst), row.used,
                       row.used < 1e300 ? fmt::format("{:.3g} %", 100 * row.used) : "beyond");
}

std::string numberCell(double value, const std::string& text) {
    return fmt::format("<td class=\"n optional\" data-value=\"{:.6g}\">{}</td>", std::min(value, 1e300),
                       text);
}

std::string litCell(const IndexRow& row) {
    for (const IndexChannel& channel : row.channels)
        if (channel.name == "lit")
            return numberCell(channel.max, channel.max < 1e300 ? number(channel.max) : "inf");
    return numberCell(0, "");
}

bool isTimed(const ReportTexts& texts) {
    return std::ranges::any_of(texts.rows,
                               [](const IndexRow& row) { return row.left_timed || row.right_timed; });
}

std::string timeCell(double ms, bool timed) {
    return numberCell(ms, timed ? fmt::format("{:.1f}", ms) : "");
}

// The title of a comparison among others of its scene.
std::string rowTitle(const Report& report, const Comparison& comparison) {
    const Frame& frame = report.baseline(comparison);
    if (!hasMultiplePairs(report)) return viewTitle(report, frame);
    const std::string pair = pairTitle(report, comparison);
    return saysTime(report, frame) ? fmt::format("{}, {} s", pair, frame.settings.time) : pair;
}

// The first metric that moved; a tooltip lists all.
std::string sinceCell(const Trend& trend) {
    std::string all;
    for (const MovedFigure& one : trend.moved) all += (all.empty() ? "" : "; ") + movedText(one);
    const std::string first = trend.moved.empty() ? ""
                                                  : fmt::format(" <span class=\"soft\">{}</span>",
                                                                markup(movedText(trend.moved[0])));
    return fmt::format("<td class=\"wide\" title=\"{}\">{}{}</td>", markup(all),
                       trend.kind == TrendKind::same ? "" : nameOf(trend.kind), first);
}

std::string line(const Report& report, const ReportLayout& layout, const ReportTexts& texts,
                 std::size_t index) {
    const Comparison& comparison = report.comparisons[index];
    const IndexRow& row = texts.rows[index];
    const Frame& left = report.baseline(comparison);
    const char* verdict = comparison.passed() ? "pass" : "fail";
    const std::string& file = layout.sections[index];
    const std::string camera = rowTitle(report, comparison);
    std::string data = fmt::format(" data-camera=\"{}\"", markup(camera));
    if (!file.empty())
        data += fmt::format(" data-section=\"{}\" data-title=\"{}\"", markup(file),
                            sectionTitle(report, layout, index));
    if (texts.since) data += fmt::format(" data-since=\"{}\"", nameOf(texts.since->comparisons[index].kind));
    if (!row.cause.empty()) data += fmt::format(" data-cause=\"{}\"", markup(row.cause));
    std::string cells = fmt::format(
        "<td><span class=\"verdict {0}\">{0}</span></td><td class=\"wide\"><a href=\"#s{1}\" "
        "title=\"{2}\">{3}</a></td><td class=\"wide\">{4}</td>{5}{6}",
        verdict, layout.ids[index], markup(left.scene), markup(page::inFolder(left.scene, layout.folder)),
        markup(camera), worstCell(row, layout.ids[index]), litCell(row));
    if (isTimed(texts))
        cells += timeCell(row.left_ms, row.left_timed) + timeCell(row.right_ms, row.right_timed);
    if (texts.since) cells += sinceCell(texts.since->comparisons[index]);
    if (texts.devices.size() > 1) cells += fmt::format("<td class=\"wide\">{}</td>", markup(row.device));
    if (!comparison.passed())
        cells += fmt::format(
            "<td><button type=\"button\" data-do=\"accept\" data-scene=\"{}\" title=\"copies the command "
            "that accepts this difference\">accept</button></td>",
            markup(left.scene));
    else
        cells += "<td></td>";
    return fmt::format("<tr data-comparison=\"{}\"{}>{}</tr>\n", layout.ids[index], data, cells);
}

// The metrics of every comparison by channel, which fill the page's columns: { "lit": [failed, used, max,
// mean, rmse, p99, p999, flip], ... }. Channels equal on both sides are omitted; numbers have four digits.
std::string figuresOf(const ReportLayout& layout, const ReportTexts& texts) {
    std::string out = "{";
    for (std::size_t i = 0; i < texts.rows.size(); ++i) {
        const IndexRow& row = texts.rows[i];
        std::string channels;
        for (const IndexChannel& c : row.channels) {
            if (c.max == 0 && c.verdict == "pass") continue;
            channels += fmt::format(
                "{}{}:[{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}]", channels.empty() ? "" : ",",
                nlohmann::json(c.name).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace),
                c.verdict == "fail" ? 1 : 0, c.used, c.max, c.mean, c.rmse, c.p99, c.p999, c.flip);
        }
        if (channels.empty() && row.cause.empty()) continue;
        out += fmt::format(
            "{}\"{}\":{{\"cause\":{},\"channels\":{{{}}}}}", out.size() > 1 ? ",\n" : "", layout.ids[i],
            nlohmann::json(row.cause).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace),
            channels);
    }
    std::string text = out + "}";
    // Escapes "</" so that no text ends the script element early.
    for (std::size_t at = text.find("</"); at != text.npos; at = text.find("</", at + 3))
        text.insert(at + 1, "\\");
    return text;
}

// A selection among the rows' values; empty if they have a single one.
std::string choiceOf(const char* name, std::vector<std::string> values) {
    std::ranges::sort(values);
    values.erase(std::ranges::unique(values).begin(), values.end());
    if (values.size() < 2) return {};
    std::string out;
    for (const std::string& value : values)
        out += value.empty() ? "" : fmt::format("<option>{}</option>", markup(value));
    return fmt::format("<label>{0} <select data-by=\"{0}\"><option></option>{1}</select></label>", name, out);
}

// The selectable channels, in the order of the rows.
std::string channelOptions(const ReportTexts& texts) {
    std::vector<std::string> names;
    for (const IndexRow& row : texts.rows)
        for (const IndexChannel& channel : row.channels)
            if (std::ranges::count(names, channel.name) == 0) names.push_back(channel.name);
    std::string out;
    for (const std::string& name : names) out += fmt::format("<option>{}</option>", markup(name));
    return out;
}

}  // namespace

std::string indexTable(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    if (report.comparisons.size() < 2) return {};
    std::string lines;
    for (const std::size_t i : layout.order) lines += line(report, layout, texts, i);
    const Comparison& first = report.comparisons[0];
    const bool pairs = hasMultiplePairs(report);
    const bool times = std::ranges::any_of(
        report.comparisons, [&](const Comparison& c) { return saysTime(report, report.baseline(c)); });
    std::vector<std::pair<std::string, bool>> columns{
        {"verdict", false},
        {"scene", false},
        {fmt::format("{}{}", pairs ? "pair" : "camera", times ? ", time" : ""), false},
        {"worst channel", false},
        {"of its limit", true},
        {"lit max", true}};
    if (isTimed(texts)) {
        columns.emplace_back((pairs ? "left" : report.baseline(first).name) + ", ms", true);
        columns.emplace_back((pairs ? "right" : report.test(first).name) + ", ms", true);
    }
    if (texts.since) columns.emplace_back("since then", false);
    if (texts.devices.size() > 1) columns.emplace_back("device", false);
    columns.emplace_back("", false);
    std::string heads;
    for (const auto& [name, isNumber] : columns)
        heads += fmt::format("<th{}><button type=\"button\">{}</button></th>",
                             isNumber ? " class=\"n optional\"" : "", markup(name));
    std::vector<std::string> cameras, causes, kinds;
    if (texts.since)
        for (const Trend& trend : texts.since->comparisons) kinds.emplace_back(nameOf(trend.kind));
    for (std::size_t i = 0; i < texts.rows.size(); ++i) {
        cameras.push_back(rowTitle(report, report.comparisons[i]));
        causes.push_back(texts.rows[i].cause);
    }
    const std::string choices = choiceOf("camera", std::move(cameras)) +
                                choiceOf("cause", std::move(causes)) + choiceOf("since", std::move(kinds));
    return fmt::format(
        "<section class=\"index\"><h2>Comparisons <span class=\"shown soft\"></span></h2>"
        "<p class=\"narrow\"><input type=\"search\" placeholder=\"filter: scene, camera, time, channel, "
        "fail\" "
        "aria-label=\"filter\">"
        "<label>verdict <select "
        "data-by=\"verdict\"><option></option><option>fail</option><option>pass</option>"
        "</select></label>{}"
        "<label>channel <select data-by=\"channel\"><option></option>{}</select></label>"
        "<label>figure <select "
        "data-by=\"figure\"><option>max</option><option>mean</option><option>rmse</option>"
        "<option>p99</option><option>p99.9</option><option>FLIP</option><option>of its "
        "limit</option></select>"
        "</label></p>"
        "<div class=\"box scroll\"><table><thead><tr>{}</tr></thead>\n<tbody>{}</tbody>"
        "</table></div><script type=\"application/json\" id=\"figures\">{}</script></section>\n",
        choices, channelOptions(texts), heads, lines, figuresOf(layout, texts));
}

}  // namespace diptych
