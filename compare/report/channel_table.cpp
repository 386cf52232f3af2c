// SPDX-License-Identifier: MIT
#include "compare/report/channel_table.h"

#include "compare/report/folders.h"
#include "compare/report/titles.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {
namespace {

using output::Cell;
using output::Column;
using output::either;
using output::Span;

// The deciding metric is below the name on pages too narrow for its column.
Cell channelCell(const ChannelDiff& channel, const std::string& id) {
    output::Text page = Span(channel.mode->name, Span::link, "#" + cardId(id, *channel.mode));
    if (channel.criterion) page.spans.emplace_back(channel.criterion->figure, Span::words, "soft judged");
    return either(channel.mode->name, page);
}

// "angle, \u00b0": pixel error and unit of the channel's row.
Cell metricCell(const DebugMode& mode) {
    const std::string unit = page::unitOf(mode), metric(nameOf(mode.metric));
    return either(metric, metric + (unit.empty() ? "" : ", " + unit));
}

Cell usedCell(const ChannelDiff& channel) {
    if (!isCompared(channel.verdict)) return "";
    if (channel.stats.different == 0) return Span("equal", Span::words, "soft");
    if (!channel.rule.empty()) return Span(channel.rule, Span::words, "soft wide");
    return Span(fmt::format("<span class=\"meter {}\"><i style=\"width:{:.1f}%\"></i></span>",
                            nameOf(channel.verdict), 100 * std::min(usedShare(channel), 1.0)),
                Span::drawn);
}

// A failing channel has the fraction of pixels that fail, or that differ if the metric covers all pixels.
Cell verdictCell(const ChannelDiff& channel) {
    const std::string_view verdict = nameOf(channel.verdict);
    output::Text page = Span(verdict, Span::verdict, verdict);
    if (channel.verdict == Verdict::fail && channel.criterion && channel.criterion->pixels > 0)
        page.spans.emplace_back(fmt::format("{} of the pixels{}", percentText(channel.criterion->share),
                                            channel.criterion->differing ? " differ" : ""),
                                Span::words, "beyond");
    return either(channel.verdict == Verdict::fail ? "FAIL" : verdict, page);
}

}  // namespace

std::string cardId(const std::string& comparison, const DebugMode& mode) {
    return fmt::format("c{}-{}", comparison, nameOfFile(mode.name));
}

output::Table channelTable(const Comparison& comparison, const std::string& id) {
    output::Table table{
        .columns = {},
        .style = "overview",
        .box = "box scroll",
        .note =
            "Measured and limit belong to the metric in the column judged by. max: the largest error. "
            "p99.9: the 99.9th percentile of the error. Excess: the error minus the reference's "
            "uncertainty and the G-buffer's quantization bound. Pixels unexplained: pixels whose "
            "difference the G-buffer's encoding does not explain; the limit is 0. Used: measured divided "
            "by the limit; for pixels unexplained, the largest error divided by its pixel's bound.",
        .indent = 2};
    const auto add = [&, channels = failuresFirst(comparison)](Column column, const auto& cellOf) {
        addColumn(table, std::move(column), channels, cellOf);
    };
    const auto addStatistic = [&](const char* title, double ChannelStats::*value) {
        add({.title = title, .kind = Column::number, .style = "optional"}, [=](const ChannelDiff* channel) {
            return isCompared(channel->verdict) ? Cell(page::number(channel->stats.*value))
                                                : either("-", "\u2013");
        });
    };
    // A value of the criterion; compared channels without one show `otherwise`.
    const auto addCriterion = [&](Column column, const Cell& otherwise, const auto& cellOf) {
        const Cell none = either("-", column.kind == Column::number ? "\u2013" : "");
        add(std::move(column), [&](const ChannelDiff* channel) -> Cell {
            if (!isCompared(channel->verdict)) return none;
            return channel->criterion ? Cell(cellOf(*channel->criterion)) : otherwise;
        });
    };
    add({"channel"}, [&](const ChannelDiff* channel) { return channelCell(*channel, id); });
    add({.title = "metric", .style = "optional soft"},
        [](const ChannelDiff* channel) { return metricCell(*channel->mode); });
    addStatistic("max", &ChannelStats::max);
    addStatistic("mean", &ChannelStats::mean);
    addStatistic("p99.9", &ChannelStats::p999);
    addCriterion({.title = "judged by", .style = "soft by"}, "nothing",
                 [](const Criterion& criterion) { return criterion.figure; });
    addCriterion({"measured", Column::number}, either("-", ""),
                 [](const Criterion& criterion) { return page::number(criterion.measured); });
    addCriterion({"limit", Column::number}, either("-", ""), [](const Criterion& criterion) {
        const std::string limit = page::number(criterion.limit);
        return either((criterion.least ? ">= " : "") + limit, (criterion.least ? "\u2265 " : "") + limit);
    });
    add({.title = "used", .where = Column::page, .style = "optional"},
        [](const ChannelDiff* channel) { return usedCell(*channel); });
    add({"verdict"}, [](const ChannelDiff* channel) { return verdictCell(*channel); });
    return table;
}

}  // namespace diptych
