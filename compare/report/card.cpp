// SPDX-License-Identifier: MIT
// A channel's card: images, difference, wipe, values, reason.
#include "compare/image/heat.h"
#include "compare/report/document.h"
#include "compare/report/titles.h"
#include "compare/run/command_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace diptych {

using output::Block;
using output::Box;
using output::Paragraph;
using output::Span;
using output::Text;
using page::markup;
using page::number;
using page::unitOf;

namespace {

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
          images_(layout.images[comparison][static_cast<std::size_t>(
              &channel - report.comparisons[comparison].channels.data())]),
          id_(cardId(layout.ids[comparison], *channel.mode)) {}

    Box box(bool open) const {
        const DebugMode& mode = *channel_.mode;
        const std::string_view verdict = nameOf(channel_.verdict);
        const bool compared = isCompared(channel_.verdict);
        Box body{"body", {}};
        if (!channel_.warning.empty())
            body.blocks.emplace_back(Paragraph{"Warning: " + channel_.warning, "warning"});
        if (compared) body.blocks.emplace_back(Paragraph{findingOf(channel_, id_), "finding"});
        if (!images_.kept)
            body.blocks.emplace_back(Paragraph{
                layout_.keep == Keep::none ? "--keep none: no pictures are kept"
                                           : "--keep failing: pictures of passing channels are not kept",
                "equal"});
        else
            body.blocks.emplace_back(output::Drawing{
                compared ? "<div class=\"pictures\">" + pair() + difference() + "</div>\n" : single()});
        if (compared)
            body.blocks.emplace_back(more());
        else
            body.blocks.emplace_back(Paragraph{channel_.tolerance.because, "because"});
        return {fmt::format("box card {}", verdict),
                {body},
                id_,
                {Span(mode.name, Span::title),
                 Span(fmt::format("{} \u00b7 {} \u00b7 {}", channelIndex(mode.channel),
                                  nameOf(mode.error_kind), mode.shows),
                      Span::plain, "soft"),
                 Span(verdict, Span::verdict, verdict)},
                open || (compared && channel_.stats.different > 0)};
    }

private:
    // Numbers, worst pixels, and commands of a failure.
    Box more() const {
        Box box{"more", commands()};
        box.summary =
            box.blocks.empty() ? "Numbers, worst pixels" : "Numbers, worst pixels, commands to reproduce it";
        box.blocks.insert(box.blocks.end(),
                          {numbers(), output::Drawing{errorMetrics(channel_, images_, id_)}});
        if (!channel_.metrics.empty()) box.blocks.emplace_back(allMetrics());
        return box;
    }

    // An image that can be panned and zoomed; without a name, the left side's. `over` is drawn on top of
    // it at a fixed size.
    std::string panel(const std::string& image, const std::string& alt, const std::string& over = "") const {
        return fmt::format(
            "<div class=\"panel\" tabindex=\"-1\"><img loading=\"lazy\" width=\"{}\" height=\"{}\" {} "
            "alt=\"{}\">{}</div>",
            left_.settings.size.width, left_.settings.size.height,
            image.empty() ? "data-same" : fmt::format("src=\"{}\"", layout_.source(image)), markup(alt),
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
        if (!isHeat(*channel_.mode)) return "<span>" + markup(images_.scale.text) + "</span>";
        std::string stops;
        for (int i = 0; i <= 10; ++i) stops += ", " + hex(heatColor(i / 10.0));
        return fmt::format(
            "<div class=\"legend\"><span class=\"title\">lights evaluated per pixel</span><div "
            "class=\"ramp\" style=\"background:linear-gradient(90deg{})\"></div><div class=\"ends "
            "mono\"><span>0</span><span>{:g}</span><span>{:g} lights</span></div></div>",
            stops, images_.scale.high / 2, images_.scale.high);
    }

    static std::string zoomButtons() {
        return "<span class=\"buttons\"><button data-do=\"out\" aria-label=\"zoom out\" "
               "title=\"-\">\u2212</button><button data-do=\"fit\" title=\"0\">fit</button><button "
               "data-do=\"in\" aria-label=\"zoom in\" title=\"+\">+</button></span>";
    }

    // The script labels rows with the names of the Frames that have the channel.
    std::string readout() const {
        if (images_.values.empty())
            return fmt::format("<p class=\"readout\">{}</p>",
                               layout_.single_file
                                   ? "a single-file report has no values under the cursor"
                                   : "pictures of this size have values only in the EXR files");
        nlohmann::json names = nlohmann::json::array();
        if (!images_.baseline.empty()) names.push_back(left_.name);
        if (!images_.test.empty()) names.push_back(right_.name);
        return fmt::format(
            "<p class=\"readout\" data-values=\"{}\" data-names=\"{}\" data-unit=\"{}\">the values under the "
            "cursor appear here</p>",
            markup(images_.values),
            markup(names.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)),
            unitOf(*channel_.mode));
    }

    Box allMetrics() const {
        output::Table table{.columns = {}, .style = "", .box = ""};
        addColumn(table, {""}, channel_.metrics, [](const auto& metric) { return metric.first; });
        addColumn(table, {"", output::Column::number}, channel_.metrics,
                  [](const auto& metric) { return number(metric.second); });
        addColumn(table, {.title = "", .style = "soft wide"}, channel_.metrics, [](const auto& of) {
            const Metric* metric = findMetric(of.first);
            return metric ? metric->meaning : "";
        });
        return {"figures scroll", {table}, "", "All metrics"};
    }

    // The command that reproduces the failure, and the one that shows it in a window.
    std::vector<Block> commands() const {
        if (channel_.verdict != Verdict::fail || command_.empty()) return {};
        const std::string name(channel_.mode->name);
        const auto line = [](const char* what, const std::vector<std::string>& words) {
            return Paragraph{{Span(what, Span::plain, "soft"), Span(shellLine(words), Span::command)},
                             "again"};
        };
        std::vector<Block> lines{
            line("reproduce it, from the same folder", withOption(command_, "--channels", name))};
        std::vector<std::string> view = withOption(command_, "--debug", name);
        if (view.front() != "compare") return lines;
        view.front() = "view";
        // The window needs neither an output folder nor a second device.
        for (const char* option : {"-o", "--against-device"})  // options of a report
            if (const auto out = std::ranges::find(view, option); out != view.end()) view.erase(out, out + 2);
        lines.emplace_back(line("open it in a window, from the same folder", view));
        return lines;
    }

    std::string pair() const {
        // An embedded image that is equal on both sides is in the page once: the script copies it.
        const bool once =
            layout_.single_file && layout_.source(images_.baseline) == layout_.source(images_.test);
        const auto stage = [&](const char* side, const Frame& frame, const std::string& image) {
            return fmt::format("<div class=\"stage {}\">{}<span class=\"tag\">{}</span></div>", side,
                               panel(once && &frame == &right_ ? "" : image,
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
            stage("left", left_, images_.baseline), stage("right", right_, images_.test),
            markup(channel_.mode->name), markup(left_.name), markup(right_.name), scaleLegend(),
            zoomButtons(), readout());
    }

    std::string difference() const {
        if (images_.difference.empty()) return "<p class=\"equal\">no difference at any pixel</p>\n";
        std::string stops;
        for (int i = 0; i <= 12; ++i) stops += ", " + hex(errorColor(i / 12.0));
        const bool toLimit = images_.error_limit && *images_.error_limit > 0;
        const char* const limit = channel_.rule.empty() ? "tolerance" : "limit";
        std::string beyond;
        const auto swatch = [&](const auto& color, const std::string& word) {
            beyond += fmt::format("<span><i class=\"swatch\" style=\"background:{}\"></i>{}</span>",
                                  hex(color), word);
        };
        if (toLimit && !images_.worst.empty() && images_.worst.front().error > *images_.error_limit)
            swatch(beyondColor, fmt::format("beyond {}, fading to white at {:g} times that",
                                            channel_.rule.empty() ? "tolerance" : "the limit", farBeyond));
        if (channel_.stats.infinite > 0) swatch(nonfiniteColor, "infinite");
        return fmt::format(
            "<figure><div class=\"stage\">{}<span class=\"tag\">difference</span></div><figcaption><div "
            "class=\"legend\"><span class=\"title\">{}</span><div class=\"ramp\" "
            "style=\"background:linear-gradient(90deg{})\"></div><div class=\"ends "
            "mono\"><span>0</span><span>{}</span><span>{} ({})</span></div></div><span>black: "
            "{}</span>{}</figcaption></figure>\n",
            panel(images_.difference, fmt::format("difference of {}", channel_.mode->name), worstRing()),
            errorTitle(), stops, number(images_.error_top / 4), number(images_.error_top),
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
        if (channel_.shown_error && channel_.shown_error_name != nameOf(ErrorKind::relative))
            return markup(channel_.shown_error_name);
        switch (channel_.shown_error ? ErrorKind::relative : channel_.mode->error_kind) {
            case ErrorKind::relative:
                return "relative error, |a-b| / |b|";
            case ErrorKind::angular:
                return "angle between the two, degrees";
            case ErrorKind::axial:
                return "angle between the two lines, degrees";
            case ErrorKind::exact:
                return "1 where the two differ";
            case ErrorKind::absolute:
                break;
        }
        return "absolute error, |a-b|";
    }

    output::Terms numbers() const {
        const ChannelStats& s = channel_.stats;
        output::Terms terms;
        const auto row = [&](const std::string& name, const std::string& value) {
            terms.items.emplace_back(name, value);
        };
        const char* unit = unitOf(*channel_.mode);
        for (const auto& [name, value] :
             {std::pair{"max", s.max}, {"mean", s.mean}, {"rmse", s.rmse}, {"p99", s.p99}, {"p99.9", s.p999}})
            row(name, number(value) + unit);
        if (channel_.certain_p999) row("p99.9 of the excess", number(*channel_.certain_p999));
        for (const ApproximationError& each : channel_.approximation_errors)
            row(fmt::format("granted to {}, mean and p99.9{}", each.name,
                            each.setting.empty() ? "" : "; removed by " + each.setting),
                fmt::format("{} and {}", percentText(each.mean), percentText(each.p999)));
        if (channel_.flip) row("FLIP, mean", number(*channel_.flip));
        row("pixels that differ", fmt::format("{}", s.different));
        if (s.worst_x >= 0)
            for (const Frame* frame : {&left_, &right_}) {
                const Image& pixels = frame->channels.at(channel_.mode->channel);
                const float* values =
                    pixels.pixel(static_cast<std::size_t>(s.worst_y * pixels.width + s.worst_x));
                row(fmt::format("{} at {},{}", frame->name, s.worst_x, s.worst_y),
                    fmt::format("{}", fmt::join(values, values + pixels.components, " ")));
            }
        if (channel_.unexplained_pixels)
            row("pixels unexplained by the encoding", fmt::format("{}", *channel_.unexplained_pixels));
        if (const auto& f = channel_.footprints) {
            row("pixels with smooth surroundings, each with a bound",
                fmt::format("{} px, largest error {:.3g} times its bound", f->smooth, f->used));
            if (f->detailed > 0)
                row("pixels with detail, judged by FLIP", fmt::format("{} px, {:.3g}", f->detailed, f->flip));
            if (f->edges > 0) row("pixels at edges, not judged", fmt::format("{} px", f->edges));
        }
        for (const auto& [name, use] : {std::pair{"its pixel's bound", &channel_.encoding_use},
                                        {"both devices' precision", &channel_.device_use}})
            if (*use && (*use)->x >= 0)
                row(fmt::format("largest error as a share of {}", name),
                    fmt::format("{:.3g} % at {},{}", 100 * (*use)->used, (*use)->x, (*use)->y));
        if (s.nonfinite_baseline + s.nonfinite_test > 0)
            row("NaN or infinite pixels", fmt::format("{} | {}", s.nonfinite_baseline, s.nonfinite_test));
        return terms;
    }

    // A forward-only channel has one image and no verdict.
    std::string single() const {
        const std::string& image = images_.baseline.empty() ? images_.test : images_.baseline;
        return fmt::format(
            "<div class=\"pictures one\"><figure><div "
            "class=\"stage\">{}</div><figcaption>{}{}</figcaption>{}</figure></div>",
            panel(image, std::string(channel_.mode->name)), zoomButtons(), scaleLegend(), readout());
    }

    const ReportLayout& layout_;
    const Frame &left_, &right_;
    const std::vector<std::string>& command_;
    const ChannelDiff& channel_;
    const ChannelImages& images_;
    std::string id_;
};

}  // namespace

Block cardOf(const Report& report, const ReportLayout& layout, std::size_t index, const ChannelDiff& channel,
             bool open) {
    return Card(report, layout, index, channel).box(open);
}

}  // namespace diptych
