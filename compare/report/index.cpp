// SPDX-License-Identifier: MIT
// Several comparisons: one line each, failures first.
#include "compare/report/document.h"
#include "compare/report/titles.h"
#include "compare/report/trends.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace diptych {

using output::Cell;
using output::Column;
using output::Span;
using page::markup;
using page::number;

namespace {

bool isTimed(const ReportTexts& texts) {
    return std::ranges::any_of(texts.rows,
                               [](const IndexRow& row) { return row.left_timed || row.right_timed; });
}

// The title of a comparison among others of its scene.
std::string rowTitle(const Report& report, const Comparison& comparison) {
    const Frame& frame = report.baseline(comparison);
    if (!hasMultiplePairs(report)) return viewTitle(report, frame);
    const std::string pair = pairTitle(report, comparison);
    return namesTime(report, frame) ? fmt::format("{}, {} s", pair, frame.settings.time) : pair;
}

// The first metric that moved; a tooltip lists all.
Cell sinceCell(const Trend& trend) {
    std::string all;
    for (const MovedMetric& one : trend.moved) all += (all.empty() ? "" : "; ") + movedText(one);
    output::Text text(trend.kind == TrendKind::same ? "" : nameOf(trend.kind));
    if (!trend.moved.empty())
        text.spans.insert(text.spans.end(), {" ", {movedText(trend.moved[0]), Span::plain, "soft"}});
    return styled(text, "", all);
}

// Six digits, which keep rows small. No value sorts as 0.
Cell rowNumber(double value, const std::string& text) {
    return output::sorted(std::stod(fmt::format("{:.6g}", value)), text);
}

Cell litCell(const IndexRow& row) {
    for (const IndexChannel& channel : row.channels)
        if (channel.name == "lit")
            return rowNumber(channel.max, channel.max < 1e300 ? number(channel.max) : "inf");
    return rowNumber(0, "");
}

// Attributes of the rows, which the page's scripts read.
void addRowData(const Report& report, const ReportLayout& layout, const ReportTexts& texts,
                output::Table& table) {
    const std::vector<Comparison>& all = report.comparisons;
    for (std::size_t at = 0; at < table.rows.size(); ++at) {
        const std::size_t i = layout.order[at];
        auto& data = table.rows[at].data;
        data = {{"comparison", layout.ids[i]}, {"camera", rowTitle(report, all[i])}};
        if (!all[i].passed()) data.emplace_back("scene", report.baseline(all[i]).scene);
        if (!layout.sections[i].empty())
            data.insert(data.end(),
                        {{"section", layout.sections[i]}, {"title", sectionTitle(report, layout, i)}});
        if (texts.since) data.emplace_back("since", nameOf(texts.since->comparisons[i].kind));
        if (!texts.rows[i].cause.empty()) data.emplace_back("cause", texts.rows[i].cause);
    }
}

output::Table tableOf(const Report& report, const ReportLayout& layout, const ReportTexts& texts) {
    const std::vector<Comparison>& all = report.comparisons;
    const bool pairs = hasMultiplePairs(report);
    const bool times =
        std::ranges::any_of(all, [&](const Comparison& c) { return namesTime(report, report.baseline(c)); });
    output::Table table{.columns = {}, .sortable = true, .style = "", .box = "box scroll"};
    const auto add = [&](Column column, const auto& cellOf) {
        addColumn(table, std::move(column), layout.order, cellOf);
    };
    const auto addNumber = [&](const std::string& title, const auto& cellOf) {
        add({.title = title, .kind = Column::number, .style = "optional"},
            [&](std::size_t i) { return cellOf(texts.rows[i]); });
    };
    const auto addTime = [&](const std::string& side, double IndexRow::*ms, bool IndexRow::*timed) {
        addNumber(side + ", ms", [=](const IndexRow& row) {
            return rowNumber(row.*ms, row.*timed ? fmt::format("{:.1f}", row.*ms) : "");
        });
    };
    add({"verdict"}, [&](std::size_t i) {
        const char* const verdict = all[i].passed() ? "pass" : "fail";
        return Span(verdict, Span::verdict, verdict);
    });
    add({.title = "scene", .style = "wide"}, [&](std::size_t i) {
        const std::string& scene = report.baseline(all[i]).scene;
        const Span link(page::inFolder(scene, layout.folder), Span::link, "#s" + layout.ids[i]);
        return styled(link, "", scene);
    });
    add({.title = fmt::format("{}{}", pairs ? "pair" : "camera", times ? ", time" : ""), .style = "wide"},
        [&](std::size_t i) { return rowTitle(report, all[i]); });
    add({"worst channel"}, [&](std::size_t i) {
        const DebugMode* worst = texts.rows[i].worst;
        return worst ? Cell(cardLink(layout.ids[i], *worst)) : Cell();
    });
    addNumber("of its limit", [](const IndexRow& row) {
        const std::string used = row.used < 1e300 ? fmt::format("{:.3g} %", 100 * row.used) : "beyond";
        return row.worst ? rowNumber(row.used, used) : rowNumber(0, "");
    });
    addNumber("lit max", litCell);
    if (isTimed(texts)) {
        addTime(pairs ? "left" : report.baseline(all[0]).name, &IndexRow::left_ms, &IndexRow::left_timed);
        addTime(pairs ? "right" : report.test(all[0]).name, &IndexRow::right_ms, &IndexRow::right_timed);
    }
    if (texts.since)
        add({.title = "since then", .style = "wide"},
            [&](std::size_t i) { return sinceCell(texts.since->comparisons[i]); });
    if (texts.devices.size() > 1)
        add({.title = "device", .style = "wide"}, [&](std::size_t i) { return texts.rows[i].device; });
    add({""}, [&](std::size_t i) {
        return Span(all[i].passed() ? ""
                                    : "<button type=\"button\" data-do=\"accept\" title=\"copies the command "
                                      "that accepts this difference\">accept</button>",
                    Span::drawn);
    });
    addRowData(report, layout, texts, table);
    return table;
}

// The metrics of every comparison by channel, which fill the page's columns: { "lit": [failed, used, max,
// mean, rmse, p99, p999, flip], ... }. Channels equal on both sides are omitted; numbers have four digits.
std::string metricsOf(const ReportLayout& layout, const ReportTexts& texts) {
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
        if (!channels.empty())
            out += fmt::format("{}\"{}\":{{{}}}", out.size() > 1 ? ",\n" : "", layout.ids[i], channels);
    }
    std::string text = out + "}";
    // Escapes "</" so that no text ends the script element early.
    for (std::size_t at = text.find("</"); at != text.npos; at = text.find("</", at + 3))
        text.insert(at + 1, "\\");
    return text;
}

std::string optionsOf(const std::vector<std::string>& values) {
    std::string out;
    for (const std::string& value : values)
        out += value.empty() ? "" : fmt::format("<option>{}</option>", markup(value));
    return out;
}

// A selection among the rows' values; empty if they have a single one.
std::string choiceOf(const char* name, std::vector<std::string> values) {
    std::ranges::sort(values);
    values.erase(std::ranges::unique(values).begin(), values.end());
    if (values.size() < 2) return {};
    return fmt::format("<label>{0} <select data-by=\"{0}\"><option></option>{1}</select></label>", name,
                       optionsOf(values));
}

// The selectable channels, in the order of the rows.
std::string channelOptions(const ReportTexts& texts) {
    std::vector<std::string> names;
    for (const IndexRow& row : texts.rows)
        for (const IndexChannel& channel : row.channels)
            if (std::ranges::count(names, channel.name) == 0) names.push_back(channel.name);
    return optionsOf(names);
}

}  // namespace

std::vector<output::Block> indexBlocks(const Report& report, const ReportLayout& layout,
                                       const ReportTexts& texts) {
    if (report.comparisons.size() < 2) return {};
    std::vector<std::string> cameras, causes, kinds;
    if (texts.since)
        for (const Trend& trend : texts.since->comparisons) kinds.emplace_back(nameOf(trend.kind));
    for (std::size_t i = 0; i < texts.rows.size(); ++i) {
        cameras.push_back(rowTitle(report, report.comparisons[i]));
        causes.push_back(texts.rows[i].cause);
    }
    const std::string choices = choiceOf("camera", std::move(cameras)) +
                                choiceOf("cause", std::move(causes)) + choiceOf("since", std::move(kinds));
    const output::Drawing filters{fmt::format(
        "<p class=\"narrow\"><input type=\"search\" placeholder=\"filter: scene, camera, time, channel, "
        "fail\" aria-label=\"filter\"><label>verdict <select "
        "data-by=\"verdict\"><option></option><option>fail</option><option>pass</option>"
        "</select></label>{}<label>channel <select data-by=\"channel\"><option></option>{}</select></label>"
        "<label>figure <select data-by=\"figure\"><option>max</option><option>mean</option>"
        "<option>rmse</option><option>p99</option><option>p99.9</option><option>FLIP</option><option>of its "
        "limit</option></select></label></p>",
        choices, channelOptions(texts))};
    const output::Drawing metrics{fmt::format("<script type=\"application/json\" id=\"figures\">{}</script>",
                                              metricsOf(layout, texts))};
    return {output::Box{"index",
                        {output::Heading{2, {"Comparisons ", Span("", Span::plain, "shown soft")}}, filters,
                         tableOf(report, layout, texts), metrics}}};
}

}  // namespace diptych
