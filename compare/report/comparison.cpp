// SPDX-License-Identifier: MIT
// One comparison, for the terminal and the page.
#include "compare/report/document.h"
#include "compare/report/folders.h"
#include "compare/report/titles.h"
#include "shared/text/digits.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {

using output::Block;
using output::Cell;
using output::Column;
using output::either;
using output::Heading;
using output::List;
using output::Paragraph;
using output::Span;
using output::Text;

namespace {

// Prints `value`, the measured one or its limit; of a criterion that fails, with the digits that tell it from
// `other`.
std::string beside(const Criterion& c, double value, double other) {
    return distinguishingDigits(value, (c.min ? c.measured < c.limit : c.measured > c.limit) ? other : value);
}

std::string explainedText(const ChannelDiff& channel) {
    std::string sentence = fmt::format("explained by the encoding: largest error {}, mean {}",
                                       page::number(channel.stats.max), page::number(channel.stats.mean));
    if (channel.flip) sentence += fmt::format(", FLIP {}", page::number(*channel.flip));
    if (channel.encoding_use)
        sentence += fmt::format(", at most {} of a pixel's bound", percentText(channel.encoding_use->used));
    return sentence;
}

// The deciding metric is below the name on pages too narrow for its column.
Cell channelCell(const ChannelDiff& channel, const std::string& id) {
    Text page = cardLink(id, *channel.mode);
    if (channel.criterion) page.spans.emplace_back(channel.criterion->metric, Span::plain, "soft judged");
    return either(channel.mode->name, page);
}

// "angle, \u00b0": pixel error and unit of the channel's row.
Cell metricCell(const DebugMode& mode) {
    const std::string unit = page::unitOf(mode), errorKind(nameOf(mode.error_kind));
    return either(errorKind, errorKind + (unit.empty() ? "" : ", " + unit));
}

Cell usedCell(const ChannelDiff& channel) {
    if (!isCompared(channel.verdict)) return "";
    if (channel.stats.different == 0) return Span("equal", Span::plain, "soft");
    if (!channel.rule.empty()) return Span(channel.rule, Span::plain, "soft wide");
    return Span(fmt::format("<span class=\"meter {}\"><i style=\"width:{:.1f}%\"></i></span>",
                            nameOf(channel.verdict), 100 * std::min(usedFraction(channel), 1.0)),
                Span::drawn);
}

// A failing channel has the fraction of pixels that fail, or that differ if the metric covers all pixels.
Cell verdictCell(const ChannelDiff& channel) {
    const std::string_view verdict = nameOf(channel.verdict);
    Text page = Span(verdict, Span::verdict, verdict);
    if (channel.verdict == Verdict::fail && channel.criterion && channel.criterion->pixels > 0)
        page.spans.emplace_back(fmt::format("{} of the pixels{}", percentText(channel.criterion->fraction),
                                            channel.criterion->differing ? " differ" : ""),
                                Span::plain, "beyond");
    return either(channel.verdict == Verdict::fail ? "FAIL" : verdict, page);
}

}  // namespace

std::string cardId(const std::string& comparison, const DebugMode& mode) {
    return fmt::format("c{}-{}", comparison, nameOfFile(mode.name));
}

Span cardLink(const std::string& comparison, const DebugMode& mode) {
    return {mode.name, Span::link, "#" + cardId(comparison, mode)};
}

output::Table channelTable(const Comparison& comparison, const std::string& id, bool files) {
    output::Table table{
        .columns = {},
        .style = "overview",
        .box = "box scroll",
        .note =
            "Measured and limit belong to the metric in the column judged by. max: the largest error. "
            "p99.9: the 99.9th percentile of the error. Used: measured divided by the limit; for pixels "
            "unexplained, the largest error divided by its pixel's bound.",
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
    if (files) addStatistic("rmse", &ChannelStats::rmse);
    addStatistic("p99.9", &ChannelStats::p999);
    for (const char* metric : {"psnr", "ssim"})
        if (files)
            add({.title = metric, .kind = Column::number, .style = "optional"},
                [=](const ChannelDiff* channel) {
                    const auto found =
                        std::ranges::find(channel->metrics, metric, &std::pair<std::string, double>::first);
                    return found == channel->metrics.end() ? either("-", "\u2013")
                                                           : Cell(page::number(found->second));
                });
    addCriterion({.title = "judged by", .style = "soft by"}, "nothing",
                 [](const Criterion& criterion) { return criterion.metric; });
    addCriterion({"measured", Column::number}, either("-", ""), [](const Criterion& criterion) {
        return beside(criterion, criterion.measured, criterion.limit);
    });
    addCriterion({"limit", Column::number}, either("-", ""), [](const Criterion& criterion) {
        const std::string limit = beside(criterion, criterion.limit, criterion.measured);
        return either((criterion.min ? ">= " : "") + limit, (criterion.min ? "\u2265 " : "") + limit);
    });
    add({.title = "used", .where = Column::page, .style = "optional"},
        [](const ChannelDiff* channel) { return usedCell(*channel); });
    add({"verdict"}, [](const ChannelDiff* channel) { return verdictCell(*channel); });
    return table;
}

Text findingOf(const ChannelDiff& channel, const std::string& card) {
    const ChannelStats& s = channel.stats;
    const double largest = channel.tolerance.max;
    const std::string because = channel.tolerance.because;
    Text text;
    if (!channel.reason.empty())
        text.spans.emplace_back(channel.reason, Span::strong);
    else if (s.different == 0)
        text.spans.emplace_back("equal at every pixel");
    else if (channel.unexplained_pixels && channel.rule.empty())
        text.spans.emplace_back(explainedText(channel));
    else if (const auto& c = channel.criterion)
        text.spans.emplace_back(
            fmt::format("{} {}, {} {} allowed", c->metric, beside(*c, c->measured, c->limit),
                        c->min ? "at least" : "at most", beside(*c, c->limit, c->measured)));
    else
        text.spans.emplace_back("differs");
    if (s.different > 0 && s.worst_x >= 0)
        text.spans.insert(text.spans.end(), {", worst at ",
                                             {fmt::format("{},{}", s.worst_x, s.worst_y), Span::link,
                                              fmt::format("#{}@{},{}", card, s.worst_x, s.worst_y)}});
    const std::string limit = channel.verdict == Verdict::informative ? std::string("informative")
                              : !channel.rule.empty()                 ? channel.rule
                              : channel.encoding_use || channel.device_use
                                  ? fmt::format("tolerance per pixel, at most {}", page::number(largest))
                                  : fmt::format("tolerance {}", page::number(largest));
    text.spans.emplace_back(fmt::format(" ({}{}{})", limit, because.empty() ? "" : ", because ", because),
                            Span::plain, "soft");
    return text;
}

namespace {

// The words of the table that not everyone knows.
List glossaryOf(const Comparison& comparison) {
    List list{{}, "soft small"};
    for (const auto& [metric, meaning] :
         {std::pair{"excess",
                    "the error minus the reference's uncertainty and the G-buffer's quantization bound"},
          {"pixels unexplained",
           "pixels whose difference the G-buffer's encoding does not explain; the limit is 0"}})
        if (std::ranges::any_of(comparison.channels, [word = metric](const ChannelDiff& channel) {
                return channel.criterion && channel.criterion->metric.find(word) != std::string::npos;
            }))
            list.items.emplace_back(fmt::format("{}: {}", metric, meaning));
    return list;
}

// Repeats the cards' findings for failures, warnings, rules, and differences that the encoding explains.
List findingsOf(const Report& report, const Comparison& comparison) {
    const std::string location = viewLabel(report, comparison);
    List list;
    const auto add = [&](const std::string& start, Text text) {
        text.spans.insert(text.spans.begin(), Span(start));
        list.items.push_back(std::move(text));
    };
    for (const std::string& failure : comparison.failures) add(fmt::format("FAIL {}: ", location), failure);
    for (const ChannelDiff* channel : failuresFirst(comparison)) {
        const std::string_view name = channel->mode->name;
        const bool explained = channel->unexplained_pixels && channel->stats.max != 0;
        Text finding = findingOf(*channel, "");
        if (channel->verdict == Verdict::fail) {
            add(fmt::format("FAIL {}, {}: ", location, name), finding);
        } else if (explained || (channel->verdict == Verdict::pass && !channel->rule.empty() &&
                                 channel->stats.different > 0)) {
            if (explained && channel->rule.empty())
                finding.spans.pop_back();  // the limit's reason repeats the numbers
            add(fmt::format("{}: ", name), finding);
        }
        if (!channel->warning.empty())
            add(fmt::format("warning {}, {}: ", location, name),
                fmt::format("{} ({})", channel->warning, channel->rule));
    }
    return list;
}

Paragraph exrLinks(const ReportLayout& layout, const Comparison& comparison) {
    Paragraph links{{"Every channel as float32:"}, "soft camera"};
    for (const std::size_t frame : {comparison.baseline, comparison.test})
        if (const std::string& file = layout.exr[frame]; !file.empty())
            links.text.spans.insert(links.text.spans.end(), {" ", {file, Span::link, file}});
    return links;
}

}  // namespace

std::vector<Block> comparisonBlocks(const Report& report, const ReportLayout* layout, std::size_t index) {
    const Comparison& comparison = report.comparisons[index];
    const Frame &baseline = report.baseline(comparison), &test = report.test(comparison);
    std::vector<Block> blocks;
    const auto add = [&](auto block, Block::Where where = Block::everywhere) {
        blocks.emplace_back(std::move(block), where);
    };
    const std::vector<const ChannelDiff*> leading = leadingChannels(comparison);
    const bool files = report.device.name.empty();  // diff
    const std::string size =
        fmt::format("{}x{}", baseline.settings.size.width, baseline.settings.size.height);
    if (files) {
        add(Paragraph{fmt::format("{} against {}, {}", test.origin.file, baseline.origin.file, size)},
            Block::terminal);
    } else {
        add(Paragraph{fmt::format("{}, {}, {}: {}", baseline.scene, viewTitle(report, baseline), size,
                                  pairTitle(report, comparison))},
            Block::terminal);
        add(frameLines(baseline, test), Block::terminal);
    }
    if (layout) {
        const Span title =
            layout->part ? Span(titleLater, Span::drawn) : Span(sectionTitle(report, *layout, index));
        add(Heading{2, title});
        for (const ChannelDiff* channel : leading)
            blocks.push_back(cardOf(report, *layout, index, *channel, true));
        add(Heading{2, "Channels"});
    }
    add(channelTable(comparison, layout ? layout->ids[index] : "", files));
    add(glossaryOf(comparison));
    add(findingsOf(report, comparison), Block::terminal);
    if (comparison.explained) {
        blocks.insert(blocks.end(), comparison.explained->blocks.begin(), comparison.explained->blocks.end());
        if (layout && !layout->cause_maps[index].empty())
            add(causeMap(layout->source(layout->cause_maps[index])));
    }
    if (const std::string checks = checksLine(comparison); !checks.empty())
        add(List{{checks}}, Block::terminal);
    if (!layout) return blocks;
    for (const ChannelDiff* channel : failuresFirst(comparison))
        if (std::ranges::count(leading, channel) == 0)
            blocks.push_back(cardOf(report, *layout, index, *channel, false));
    addVisualChecks(blocks, report, *layout, index);
    add(Heading{2, "What was compared"});
    addFrames(blocks, report, comparison);
    if (const Paragraph links = exrLinks(*layout, comparison); links.text.spans.size() > 1) add(links);
    return blocks;
}

}  // namespace diptych
