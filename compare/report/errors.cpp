// SPDX-License-Identifier: MIT
// The distribution of a channel's errors: a histogram, and links to the worst pixels.
#include "compare/page/text.h"
#include "compare/report/document.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {

using page::markup;
using page::number;
using page::unitOf;

namespace {

// The bars are stretched over the figure's width; labels are placed at percentages of it.
class Histogram {
public:
    Histogram(const ChannelDiff& channel, const ChannelPictures& pictures)
        : channel_(channel),
          mode_(*channel.mode),
          limit_(pictures.error_limit),
          beyond_(limit_ && !pictures.worst.empty() && pictures.worst.front().error > *limit_),
          errors_(pictures.histogram) {}

    std::string html() const {
        if (errors_.bins.empty()) return {};
        return fmt::format(
            "<figure class=\"histogram\"><div class=\"plot{}\"><svg viewBox=\"0 0 {} 100\" "
            "preserveAspectRatio=\"none\" role=\"img\" aria-label=\"histogram of error\">{}</svg>{}</div>"
            "<div class=\"axis\">{}</div><figcaption>{}</figcaption></figure>\n",
            limit_ ? "" : " unbounded", errors_.bins.size(), bars(), limit(), axis(), markup(words()));
    }

private:
    std::string size(double error) const { return number(error) + unitOf(mode_); }

    // If an error exceeds the limit, the bin that contains the limit is split at it. The right part is
    // coloured as out of tolerance.
    std::string bars() const {
        const std::uint64_t most = std::ranges::max(errors_.bins);
        const double line = drawn() ? binAt(*limit_) : 0;
        std::string out;
        for (std::size_t i = 0; i < errors_.bins.size(); ++i) {
            const std::uint64_t count = errors_.bins[i];
            if (count == 0) continue;
            const double height =
                100 * std::log1p(static_cast<double>(count)) / std::log1p(static_cast<double>(most));
            const auto left = static_cast<double>(i),
                       cut = beyond_ ? std::clamp(line, left, left + 1) : left + 1;
            const std::string title = fmt::format(
                "{} to {}: {}{}", size(errors_.edge(i)), size(errors_.edge(i + 1)), counted(count, "pixel"),
                i == 0 && errors_.smaller > 0 ? fmt::format(", {} of them below", errors_.smaller) : "");
            out += bar("", left, cut, height, title) + bar(" class=\"beyond\"", cut, left + 1, height, title);
        }
        return out;
    }

    static std::string bar(const char* style, double from, double to, double height,
                           const std::string& title) {
        if (!(from < to)) return {};
        return fmt::format(
            "<rect{} x=\"{:.5g}\" y=\"{:.1f}\" width=\"{:.3g}\" height=\"{:.1f}\"><title>{}</title></rect>",
            style, from, 100 - height, to - from, height, title);
    }

    double binAt(double error) const {
        return (std::log10(error) - errors_.first_decade) * errors_.bins_per_decade;
    }
    double percent(double error) const {
        return 100 * binAt(error) / static_cast<double>(errors_.bins.size());
    }

    // Whether a logarithmic axis can show the limit.
    bool drawn() const { return limit_ && *limit_ > 0; }

    // A limit outside the plot is marked at its edge; words() states its value.
    std::string limit() const {
        if (!drawn()) return {};
        return fmt::format("<i class=\"limit\" style=\"left:{:.2f}%\"></i>",
                           std::clamp(percent(*limit_), 0.0, 100.0));
    }

    std::string axis() const {
        const int decades = static_cast<int>(errors_.bins.size()) / errors_.bins_per_decade,
                  step = (decades + 4) / 5;  // at most six labels fit on a phone
        std::string out;
        for (int d = 0; d <= decades; d += step)
            out += fmt::format("<span style=\"left:{:.2f}%\">{}</span>", 100.0 * d / decades,
                               size(std::pow(10.0, errors_.first_decade + d)));
        return out;
    }

    std::string words() const {
        std::uint64_t all = errors_.equal + errors_.infinite;
        for (const std::uint64_t count : errors_.bins) all += count;
        std::string out =
            fmt::format("pixels by {}; bar height is the logarithm of their number; {} of {} are equal",
                        kind(), errors_.equal, all);
        if (errors_.infinite > 0) out += fmt::format("; {} have an infinite error", errors_.infinite);
        if (drawn())
            out +=
                fmt::format("; line: {} {}{}", channel_.rule.empty() ? "tolerance" : "limit", size(*limit_),
                            percent(*limit_) > 100 ? ", beyond the right edge"
                            : percent(*limit_) < 0 ? ", beyond the left edge"
                                                   : "");
        if (!limit_ && channel_.criterion)
            out += fmt::format("; the limit applies to {}, not to these errors", channel_.criterion->figure);
        return out;
    }

    // The kind of error, in a word or two.
    std::string kind() const {
        if (channel_.shown_error && channel_.shown_error_name != nameOf(Metric::relative))
            return channel_.shown_error_name;
        if (channel_.shown_error) return "relative error";
        return isAngle(mode_.metric) ? "angle" : fmt::format("{} error", nameOf(mode_.metric));
    }

    const ChannelDiff& channel_;
    const DebugMode& mode_;
    const std::optional<double> limit_;
    const bool beyond_;
    const ErrorHistogram& errors_;
};

std::string worstList(const ChannelDiff& channel, const ChannelPictures& pictures, const std::string& id) {
    std::string items;
    for (const WorstPixel& pixel : pictures.worst) {
        const std::string place =
            !pictures.kept ? fmt::format("<span>{}, {}</span> ", pixel.x, pixel.y)
                           : fmt::format("<a href=\"#{0}@{1},{2}\" data-pixel=\"{1},{2}\">{1}, {2}</a>", id,
                                         pixel.x, pixel.y);
        items +=
            fmt::format("<li>{}<span>{}{}</span></li>", place, number(pixel.error), unitOf(*channel.mode));
    }
    return fmt::format(
        "<div class=\"worst\"><h4>Worst pixels{}</h4><ol>{}</ol><p class=\"soft\">at least {} pixels "
        "apart</p></div>\n",
        channel.shown_error ? ", by " + markup(channel.shown_error_name) : "", items, worstApart);
}

}  // namespace

std::string errorFigures(const ChannelDiff& channel, const ChannelPictures& pictures, const std::string& id) {
    if (pictures.worst.empty()) return {};
    const std::string histogram =
        channel.mode->metric == Metric::exact ? "" : Histogram(channel, pictures).html();
    return "<div class=\"spread\">" + histogram + worstList(channel, pictures, id) + "</div>\n";
}

}  // namespace diptych
