// SPDX-License-Identifier: MIT
// The distribution of a channel's errors: a histogram, and links to the worst pixels.
#include "compare/page/text.h"
#include "compare/plot/plot.h"
#include "compare/report/document.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {

using page::markup;
using page::number;
using page::unitOf;

namespace {

// The kind of error, in a word or two.
std::string kindOf(const ChannelDiff& channel) {
    if (channel.shown_error && channel.shown_error_name != nameOf(ErrorKind::relative))
        return channel.shown_error_name;
    if (channel.shown_error) return "relative error";
    const ErrorKind errorKind = channel.mode->error_kind;
    return isAngle(errorKind) ? "angle" : fmt::format("{} error", nameOf(errorKind));
}

// If an error exceeds the limit, the bin that contains the limit is split at it. The right part is coloured
// as out of tolerance.
std::string histogram(const ChannelDiff& channel, const ChannelImages& images) {
    const ErrorHistogram& errors = images.histogram;
    if (errors.bins.empty()) return {};
    const std::string unit = unitOf(*channel.mode);
    const auto size = [&](double error) { return number(error) + unit; };
    const std::optional<double>& limit = images.error_limit;
    const bool beyond = limit && !images.worst.empty() && images.worst.front().error > *limit;
    const double first = errors.edge(0), last = errors.edge(errors.bins.size());
    PlotPanel panel{
        .across = {.name = kindOf(channel) + (unit.empty() ? "" : ", " + unit), .shown = {first, last}},
        .up = {.name = "pixels", .shown = {1}}};
    std::uint64_t all = errors.equal + errors.infinite;
    for (std::size_t i = 0; i < errors.bins.size(); ++i) {
        const std::uint64_t count = errors.bins[i];
        if (count == 0) continue;
        all += count;
        const double left = errors.edge(i), right = errors.edge(i + 1),
                     cut = beyond ? std::clamp(*limit, left, right) : right;
        const PlotRange up{0, static_cast<double>(count)};
        const std::string text = fmt::format(
            "{} to {}: {}{}", size(left), size(right), counted(count, "pixel"),
            i == 0 && errors.smaller > 0 ? fmt::format(", {} of them below", errors.smaller) : "");
        if (left < cut) panel.bars.push_back({{left, cut}, up, limit ? 0 : maxParts - 1, text});
        if (cut < right) panel.bars.push_back({{cut, right}, up, 0, text, true});
    }
    if (limit && *limit > 0)
        panel.limits.push_back(
            {.x = limit,
             .name = fmt::format("{} {}{}", channel.rule.empty() ? "tolerance" : "limit", size(*limit),
                                 *limit > last    ? ", beyond the right edge"
                                 : *limit < first ? ", beyond the left edge"
                                                  : "")});
    std::string text = fmt::format("{} of {} pixels are equal", errors.equal, all);
    if (errors.infinite > 0) text += fmt::format("; {} have an infinite error", errors.infinite);
    if (!limit && channel.criterion)
        text += fmt::format("; the limit applies to {}, not to these errors", channel.criterion->metric);
    return fmt::format(
        "<figure class=\"histogram\">{}<figcaption>{}</figcaption></figure>\n",
        svgOf({.title = "histogram of error", .panels = {panel}, .height = 240}, PlotTarget::page),
        markup(text));
}

std::string worstList(const ChannelDiff& channel, const ChannelImages& images, const std::string& id) {
    std::string items;
    for (const WorstPixel& pixel : images.worst) {
        const std::string location =
            !images.kept ? fmt::format("<span>{}, {}</span> ", pixel.x, pixel.y)
                         : fmt::format("<a href=\"#{0}@{1},{2}\" data-pixel=\"{1},{2}\">{1}, {2}</a>", id,
                                       pixel.x, pixel.y);
        items +=
            fmt::format("<li>{}<span>{}{}</span></li>", location, number(pixel.error), unitOf(*channel.mode));
    }
    return fmt::format(
        "<div class=\"worst\" title=\"at least {} pixels apart\"><h4>Worst pixels{}</h4><ol>{}</ol></div>\n",
        worstPixelSpacing, channel.shown_error ? ", by " + markup(channel.shown_error_name) : "", items);
}

}  // namespace

std::string errorMetrics(const ChannelDiff& channel, const ChannelImages& images, const std::string& id) {
    if (images.worst.empty()) return {};
    const std::string spread = channel.mode->error_kind == ErrorKind::exact ? "" : histogram(channel, images);
    return "<div class=\"spread\">" + spread + worstList(channel, images, id) + "</div>\n";
}

}  // namespace diptych
