// SPDX-License-Identifier: MIT
// Cards of one comparison: images, difference, wipe, values, reason.
#include "compare/picture/heat.h"
#include "compare/report/channel_table.h"
#include "compare/report/html.h"
#include "compare/report/titles.h"
#include "compare/run/command_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace diptych {

using page::markup;
using page::number;
using page::unitOf;

namespace {

constexpr int loupeRadius = 8, loupeZoom = 8;  // 17 x 17 pixels, each 8 wide: .loupe of the style

std::string hex(const std::array<std::uint8_t, 3>& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

class Card {
public:
    Card(const Report& report, const ReportLayout& layout, std::size_t comparison, const ChannelDiff& channel)
        : layout_(layout),
          left_(report.baseline(report.comparisons[comparison])),
          right_(report.test(report.comparisons[comparison])),
          command_(report.comparisons[comparison].command),
          channel_(channel),
          pictures_(layout.pictures[comparison][static_cast<std::size_t>(
              &channel - report.comparisons[comparison].channels.data())]),
          id_(cardId(layout.ids[comparison], *channel.mode)),
          leads_(std::ranges::count(leadingChannels(report.comparisons[comparison]), &channel) > 0) {}

    std::string html() const {
        const DebugMode& mode = *channel_.mode;
        const bool compared = isCompared(channel_.verdict);
        const bool open = leads_ || (compared && channel_.stats.different > 0);
        std::string out = fmt::format(
            "<details class=\"box card {0}\" id=\"{1}\"{2}><summary><h3>{3}</h3><span class=\"soft\">{4} "
            "\u00b7 {5} \u00b7 {6}</span><span class=\"verdict {0}\">{0}</span></summary><div "
            "class=\"body\">\n",
            nameOf(channel_.verdict), id_, open ? " open" : "", markup(mode.name),
            channelNumber(mode.channel), nameOf(mode.metric), markup(mode.shows));
        if (!channel_.warning.empty())
            out += fmt::format("<p class=\"warning\">Warning: {}</p>\n", markup(channel_.warning));
        if (!compared) return out + single() + "</div></details>\n";
        out += finding();
        out += pictures_.kept ? "<div class=\"pictures\">" + pair() + difference() + "</div>\n" : notKept();
        const std::string commands = again();
        return out +
               fmt::format("<details class=\"more\"><summary>Numbers, worst pixels{}</summary>",
                           commands.empty() ? "" : ", commands to reproduce it") +
               commands + numbers() + loupes() + errorFigures(channel_, pictures_, id_) + allFigures() +
               "</details></div></details>\n";
    }

private:
    // The channel's largest difference and its pixel, the deciding criterion, and the reason of its
    // tolerance.
    std::string finding() const {
        const ChannelStats& s = channel_.stats;
        std::string text = channel_.reason.empty() ? "" : "<b>" + markup(channel_.reason) + ".</b> ";
        if (s.different == 0)
            text += "Equal at every pixel. ";
        else if (s.worst_x >= 0)
            text += fmt::format("Largest {0} {1}{2}, at pixel <a href=\"#{3}@{4},{5}\">{4}, {5}</a>. ",
                                channel_.shown_error ? markup(channel_.shown_error_name) : "error",
                                number(largestShown()), channel_.shown_error ? "" : unitOf(*channel_.mode),
                                id_, s.worst_x, s.worst_y);
        if (const auto& decided = channel_.criterion; decided && channel_.reason.empty() && s.different > 0)
            text += fmt::format("Judged by {}: {}, {} {} allowed. ", markup(decided->figure),
                                number(decided->measured), decided->least ? "at least" : "at most",
                                number(decided->limit));
        return "<p class=\"finding\">" + text + because() + "</p>\n";
    }

    // The largest of the displayed errors.
    double largestShown() const {
        return pictures_.worst.empty() ? channel_.stats.max : pictures_.worst.front().error;
    }

    std::string notKept() const {
        return fmt::format("<p class=\"equal\">{}</p>\n",
                           layout_.keep == Keep::none
                               ? "--keep none: no pictures are kept"
                               : "--keep failing: pictures of passing channels are not kept");
    }

    // An image that can be panned and zoomed; without a name, the left side's. `over` is drawn on top of
    // it at a fixed size.
    std::string panel(const std::string& picture, const std::string& alt,
                      const std::string& over = "") const {
        return fmt::format(
            "<div class=\"panel\" tabindex=\"-1\"><img loading=\"lazy\" width=\"{}\" height=\"{}\" {} "
            "alt=\"{}\">{}</div>",
            left_.settings.size.width, left_.settings.size.height,
            picture.empty() ? "data-same" : fmt::format("src=\"{}\"", layout_.source(picture)), markup(alt),
            over);
    }

    std::string worstRing() const {
        const ChannelStats& s = channel_.stats;
        if (s.worst_x < 0) return {};
        return fmt::format("<i class=\"ring\" style=\"--u:{:.5f};--v:{:.5f}\"></i>",
                           (s.worst_x + 0.5) / left_.settings.size.width,
                           (s.worst_y + 0.5) / left_.settings.size.height);
    }

    // Legend of the images' colours.
    std::string scaleLegend() const {
        if (!isHeat(*channel_.mode)) return "<span>" + markup(pictures_.scale.words) + "</span>";
        std::string stops;
        for (int i = 0; i <= 10; ++i) stops += ", " + hex(heatColor(i / 10.0));
        return fmt::format(
            "<div class=\"legend\"><span class=\"title\">lights evaluated per pixel</span><div "
            "class=\"ramp\" style=\"background:linear-gradient(90deg{})\"></div><div class=\"ends "
            "mono\"><span>0</span><span>{:g}</span><span>{:g} lights</span></div></div>",
            stops, pictures_.scale.high / 2, pictures_.scale.high);
    }

    static std::string zoomButtons() {
        return "<span class=\"buttons\"><button data-do=\"out\" aria-label=\"zoom out\" "
               "title=\"-\">\u2212</button><button data-do=\"fit\" title=\"0\">fit</button><button "
               "data-do=\"in\" aria-label=\"zoom in\" title=\"+\">+</button></span>";
    }

    // The script labels rows with the names of the Frames that have the channel.
    std::string readout() const {
        if (pictures_.values.empty())
            return fmt::format("<p class=\"readout\">{}</p>",
                               layout_.single_file
                                   ? "a single-file report has no values under the cursor"
                                   : "pictures of this size have values only in the EXR files");
        nlohmann::json names = nlohmann::json::array();
        if (!pictures_.baseline.empty()) names.push_back(left_.name);
        if (!pictures_.test.empty()) names.push_back(right_.name);
        return fmt::format(
            "<p class=\"readout\" data-values=\"{}\" data-names=\"{}\" data-unit=\"{}\">the values under the "
            "cursor appear here</p>",
            markup(pictures_.values),
            markup(names.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)),
            unitOf(*channel_.mode));
    }

    std::string allFigures() const {
        if (channel_.figures.empty()) return {};
        std::string rows;
        for (const auto& [name, value] : channel_.figures) {
            const Figure* figure = findFigure(name);
            rows +=
                fmt::format("<tr><td>{}</td><td class=\"n mono\">{}</td><td class=\"soft wide\">{}</td></tr>",
                            name, number(value), figure ? markup(figure->meaning) : "");
        }
        return "<details class=\"figures\"><summary>All metrics</summary><div class=\"scroll\"><table>" +
               rows + "</table></div></details>\n";
    }

    // Whether there is a finite bound; a rule need not bound the largest error.
    bool hasTolerance() const { return std::isfinite(channel_.tolerance.max); }

    std::string because() const {
        const std::string decides =
            channel_.verdict == Verdict::informative ? std::string("Informative")
            : !channel_.rule.empty()                 ? fmt::format("Rule of {}", markup(channel_.rule))
            : channel_.encoding_use || channel_.device_use
                ? fmt::format("Tolerance per pixel, at most {}", number(channel_.tolerance.max))
                : fmt::format("Tolerance {}", number(channel_.tolerance.max));
        if (channel_.tolerance.because.empty()) return decides + ".";
        return fmt::format("{} <span class=\"soft\">because</span> {}.", decides,
                           markup(channel_.tolerance.because));
    }

    // The command that reproduces the failure, and the one that shows it in a window.
    std::string again() const {
        if (channel_.verdict != Verdict::fail || command_.empty()) return {};
        const std::string name(channel_.mode->name);
        const auto line = [](const char* what, const std::vector<std::string>& words) {
            return fmt::format(
                "<p class=\"again\"><span class=\"soft\">{}, from the same folder</span> "
                "<code>{}</code><button data-do=\"copy\">copy</button></p>\n",
                what, markup(shellLine(words)));
        };
        std::string text = line("reproduce it", withOption(command_, "--channels", name));
        std::vector<std::string> view = withOption(command_, "--debug", name);
        if (view.front() != "compare") return text;
        view.front() = "view";
        // The window needs neither an output folder nor a second device.
        for (const char* option : {"-o", "--against-device"})  // options of a report
            if (const auto out = std::ranges::find(view, option); out != view.end()) view.erase(out, out + 2);
        return text + line("open it in a window", view);
    }

    std::string pair() const {
        // An embedded image that is equal on both sides is in the page once: the script copies it.
        const bool once =
            layout_.single_file && layout_.source(pictures_.baseline) == layout_.source(pictures_.test);
        const auto stage = [&](const char* side, const Frame& frame, const std::string& picture) {
            return fmt::format("<div class=\"stage {}\">{}<span class=\"tag\">{}</span></div>", side,
                               panel(once && &frame == &right_ ? "" : picture,
                                     fmt::format("{} of {}", channel_.mode->name, frame.name)),
                               markup(frame.name));
        };
        return fmt::format(
            "<figure><div class=\"pair side\" data-mode=\"side\" style=\"--w:100%\">{0}{1}<input "
            "type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" aria-label=\"wipe {2}\"><i "
            "class=\"divider\"></i></div><figcaption><span class=\"buttons\"><button data-show=\"side\" "
            "title=\"s\" class=\"on\">side by side</button><button data-show=\"wipe\" "
            "title=\"w\">wipe</button><button data-show=\"left\" title=\"1\">{3}</button><button "
            "data-show=\"right\" title=\"2\">{4}</button><button data-show=\"flicker\" "
            "title=\"f\">flicker</button></span>{6}{5}</figcaption>{7}</figure>\n",
            stage("left", left_, pictures_.baseline), stage("right", right_, pictures_.test),
            markup(channel_.mode->name), markup(left_.name), markup(right_.name), scaleLegend(),
            zoomButtons(), readout());
    }

    std::string difference() const {
        if (pictures_.difference.empty()) return "<p class=\"equal\">no difference at any pixel</p>\n";
        std::string stops;
        for (int i = 0; i <= 12; ++i) stops += ", " + hex(errorColor(i / 12.0));
        const bool toLimit = pictures_.error_limit && *pictures_.error_limit > 0;
        const char* const limit = channel_.rule.empty() ? "tolerance" : "limit";
        std::string beyond;
        const auto swatch = [&](const auto& color, const std::string& word) {
            beyond += fmt::format("<span><i class=\"swatch\" style=\"background:{}\"></i>{}</span>",
                                  hex(color), word);
        };
        if (toLimit && !pictures_.worst.empty() && pictures_.worst.front().error > *pictures_.error_limit)
            swatch(beyondColor, fmt::format("beyond {}, fading to white at {:g} times that",
                                            channel_.rule.empty() ? "tolerance" : "the limit", farBeyond));
        if (channel_.stats.infinite > 0) swatch(nonfiniteColor, "infinite");
        return fmt::format(
            "<figure><div class=\"stage\">{}<span class=\"tag\">difference</span></div><figcaption><div "
            "class=\"legend\"><span class=\"title\">{}</span><div class=\"ramp\" "
            "style=\"background:linear-gradient(90deg{})\"></div><div class=\"ends "
            "mono\"><span>0</span><span>{}</span><span>{} ({})</span></div></div><span>black: "
            "{}</span>{}</figcaption></figure>\n",
            panel(pictures_.difference, fmt::format("difference of {}", channel_.mode->name), worstRing()),
            errorTitle(), stops, number(pictures_.error_top / 4), number(pictures_.error_top),
            toLimit                ? limit
            : channel_.shown_error ? markup(channel_.shown_error_name)
                                   : "max",
            channel_.certain_p999 && channel_.shown_error ? "no excess" : "equal", beyond);
    }

    // Meaning and unit of the error map's colours.
    std::string errorTitle() const {
        if (channel_.certain_p999 && channel_.shown_error)
            return "excess: relative error minus the reference's uncertainty and the G-buffer's quantization "
                   "bound";
        if (channel_.shown_error && channel_.shown_error_name != nameOf(Metric::relative))
            return markup(channel_.shown_error_name);
        switch (channel_.shown_error ? Metric::relative : channel_.mode->metric) {
            case Metric::relative:
                return "relative error, |a-b| / |b|";
            case Metric::angular:
                return "angle between the two, degrees";
            case Metric::axial:
                return "angle between the two lines, degrees";
            case Metric::exact:
                return "1 where the two differ";
            case Metric::absolute:
                break;
        }
        return "absolute error, |a-b|";
    }

    std::string numbers() const {
        const ChannelStats& s = channel_.stats;
        std::string out = "<dl>";
        const auto row = [&](const char* name, const std::string& value) {
            out += fmt::format("<dt>{}</dt><dd>{}</dd>", name, value);
        };
        const char* unit = unitOf(*channel_.mode);
        for (const auto& [name, value] :
             {std::pair{"max", s.max}, {"mean", s.mean}, {"rmse", s.rmse}, {"p99", s.p99}, {"p99.9", s.p999}})
            row(name, number(value) + unit);
        if (channel_.certain_p999) row("p99.9 of the excess", number(*channel_.certain_p999));
        for (const Granted& each : channel_.granted)
            row(fmt::format("granted to {}, mean and p99.9{}", each.name,
                            each.setting.empty() ? "" : "; removed by " + each.setting)
                    .c_str(),
                fmt::format("{} and {}", percentText(each.mean), percentText(each.p999)));
        if (channel_.flip) row("FLIP, mean", number(*channel_.flip));
        if (hasTolerance())
            row(channel_.encoding_use || channel_.device_use ? "tolerance, at most" : "tolerance",
                number(channel_.tolerance.max) + unit);
        row("pixels that differ", fmt::format("{}", s.different));
        if (channel_.unexplained_pixels)
            row("pixels unexplained by the encoding", fmt::format("{}", *channel_.unexplained_pixels));
        if (const auto& f = channel_.footprints) {
            row("pixels with smooth surroundings, each with a bound",
                fmt::format("{} px, largest error {:.3g} times its bound", f->smooth, f->used));
            if (f->detailed > 0)
                row("pixels with detail, judged by FLIP", fmt::format("{} px, {:.3g}", f->detailed, f->flip));
            if (f->edges > 0) row("pixels at edges, not judged", fmt::format("{} px", f->edges));
        }
        if (const auto& use = channel_.encoding_use; use && use->x >= 0)
            row("largest error as a share of its pixel's bound",
                fmt::format("{:.3g} % at {},{}", 100 * use->used, use->x, use->y));
        if (const auto& use = channel_.device_use; use && use->x >= 0)
            row("largest error as a share of both devices' precision",
                fmt::format("{:.3g} % at {},{}", 100 * use->used, use->x, use->y));
        if (s.nonfinite_baseline + s.nonfinite_test > 0)
            row("NaN or infinite pixels", fmt::format("{} | {}", s.nonfinite_baseline, s.nonfinite_test));
        return out + "</dl>\n";
    }

    // Magnified surroundings of the worst pixel, and its values.
    std::string loupes() const {
        const int x = channel_.stats.worst_x, y = channel_.stats.worst_y;
        if (x < 0) return {};
        const auto values = [&](const Frame& frame) {
            std::string out;
            const Image& pixels = frame.channels.at(channel_.mode->channel);
            for (int c = 0; c < pixels.components; ++c) out += fmt::format(" {:.6g}", pixels.at(x, y, c));
            return out;
        };
        const auto loupe = [&](const std::string& picture, const std::string& caption,
                               const std::string& text) {
            std::string glass;
            if (!layout_.single_file && !picture.empty())
                glass = fmt::format(
                    "<span class=\"loupe\"><img loading=\"lazy\" src=\"{}\" alt=\"\" "
                    "style=\"width:{}px;height:{}px;left:{}px;top:{}px\"></span>",
                    picture, left_.settings.size.width * loupeZoom, left_.settings.size.height * loupeZoom,
                    (loupeRadius - x) * loupeZoom, (loupeRadius - y) * loupeZoom);
            return fmt::format(
                "<figure>{}<figcaption>{}<br><span class=\"values\">{}</span></figcaption></figure>", glass,
                caption, text);
        };
        const bool isDrawn = !pictures_.worst.empty();  // else the displayed errors are 0 everywhere
        const std::string there =
            fmt::format("worst pixel {}, {}{}", x, y,
                        isDrawn && channel_.shown_error ? ", by " + markup(channel_.shown_error_name) : "");
        return "<div class=\"loupes\">" + loupe(pictures_.baseline, markup(left_.name), values(left_)) +
               loupe(pictures_.test, markup(right_.name), values(right_)) +
               loupe(pictures_.difference, there, fmt::format(" {}", number(largestShown()))) + "</div>\n";
    }

    // A forward-only channel has one image and no verdict.
    std::string single() const {
        const std::string why =
            fmt::format("<p class=\"because\">{}</p>\n", markup(channel_.tolerance.because));
        if (!pictures_.kept) return notKept() + why;
        const std::string& picture = pictures_.baseline.empty() ? pictures_.test : pictures_.baseline;
        return fmt::format(
            "<div class=\"pictures one\"><figure><div "
            "class=\"stage\">{}</div><figcaption>{}{}</figcaption>{}</figure></div>{}",
            panel(picture, std::string(channel_.mode->name)), zoomButtons(), scaleLegend(), readout(), why);
    }

    const ReportLayout& layout_;
    const Frame &left_, &right_;
    const std::vector<std::string>& command_;
    const ChannelDiff& channel_;
    const ChannelPictures& pictures_;
    std::string id_;
    bool leads_;
};

}  // namespace

std::string leadingCards(const Report& report, const ReportLayout& layout, std::size_t index) {
    std::string out;
    for (const ChannelDiff* channel : leadingChannels(report.comparisons[index]))
        out += Card(report, layout, index, *channel).html();
    return out;
}

std::string otherCards(const Report& report, const ReportLayout& layout, std::size_t index) {
    const std::vector<const ChannelDiff*> leading = leadingChannels(report.comparisons[index]);
    std::string out;
    for (const ChannelDiff* channel : failuresFirst(report.comparisons[index]))
        if (std::ranges::count(leading, channel) == 0) out += Card(report, layout, index, *channel).html();
    return out;
}

}  // namespace diptych
