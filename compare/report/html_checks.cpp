// SPDX-License-Identifier: MIT
// The visual checks: a table of links, and for each a detail of the report's images.
#include "compare/report/html.h"
#include "compare/report/titles.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {

using page::markup;

namespace {

// Part of an image, in pixels.
struct Region {
    double x, y, width, height;
};

// The region around the box with a margin of a third, with the image's aspect ratio and inside it; zoomed
// at most eight times.
Region regionAround(const PixelBox& box, const Size& size) {
    const double width = size.width, height = size.height;
    const double share =
        std::clamp(1.35 * std::max((box.x1 - box.x0) / width, (box.y1 - box.y0) / height), 1.0 / 8, 1.0);
    const Region region{0, 0, share * width, share * height};
    const auto place = [](int from, int to, double extent, double most) {
        return std::clamp(0.5 * (from + to) - 0.5 * extent, 0.0, most - extent);
    };
    return {place(box.x0, box.x1, region.width, width), place(box.y0, box.y1, region.height, height),
            region.width, region.height};
}

class Section {
public:
    Section(const Report& report, const ReportLayout& layout, std::size_t index)
        : comparison_(report.comparisons[index]),
          left_(report.baseline(comparison_)),
          right_(report.test(comparison_)),
          layout_(layout),
          pictures_(layout.pictures[index]),
          id_(layout.ids[index]),
          lit_(channelOr(Channel::lit, anyChannel())),
          dark_(channelOr(Channel::albedo, lit_)) {}

    std::string html() const {
        if (comparison_.visual_checks.empty()) return {};
        std::string views, rows;
        std::size_t number = 0;
        for (const FeatureChecks& feature : comparison_.visual_checks) {
            rows += rowsOf(feature, number);
            for (const VisualCheck& check : feature.checks) views += view(feature, check, number++);
        }
        return fmt::format(
            "<section class=\"checks\" id=\"eye-{}\"><h2>To check by eye</h2>\n"
            "<p class=\"soft\">Here both paths can be wrong in the same way, and no comparison shows "
            "it.{}</p>\n{}<div "
            "class=\"views\">{}</div>\n"
            "<div class=\"box scroll\"><table><tr><th>feature</th><th>right "
            "if</th><th>places</th></tr>\n{}</table>"
            "</div></section>\n",
            id_, lit_ == npos ? "" : " Each link leads to its picture.", sources(), views, rows);
    }

private:
    static std::size_t countOf(const Comparison& comparison) {
        std::size_t count = 0;
        for (const FeatureChecks& feature : comparison.visual_checks) count += feature.checks.size();
        return count;
    }

    bool hasBoth(std::size_t channel) const {
        return !pictures_[channel].baseline.empty() && !pictures_[channel].test.empty();
    }
    // The channel with this number, or `other` if it was not compared.
    std::size_t channelOr(Channel mode, std::size_t other) const {
        for (std::size_t i = 0; i < pictures_.size(); ++i)
            if (comparison_.channels[i].mode->channel == mode && hasBoth(i)) return i;
        return other;
    }
    std::size_t anyChannel() const {
        for (std::size_t i = 0; i < pictures_.size(); ++i)
            if (hasBoth(i)) return i;
        return npos;
    }

    // Base colour replaces lit where no light falls.
    std::size_t channelFor(const VisualCheck& check) const { return isDark(check.box) ? dark_ : lit_; }

    // Whether less than a tenth of the box reaches a hundredth of white in the image of lit.
    bool isDark(const PixelBox& box) const {
        const auto lit = left_.channels.find(Channel::lit);
        if (lit == left_.channels.end()) return false;
        const double least = 0.01 / pictures_[lit_].scale.exposure.factor;
        // About a thousand pixels suffice
        const auto step = [](int extent) { return std::max(extent / 32, 1); };
        int bright = 0, looked = 0;
        for (int y = box.y0; y < box.y1; y += step(box.y1 - box.y0))
            for (int x = box.x0; x < box.x1; x += step(box.x1 - box.x0), ++looked)
                bright += std::max({lit->second.at(x, y, 0), lit->second.at(x, y, 1),
                                    lit->second.at(x, y, 2)}) >= least;
        return bright * 10 < looked;
    }

    // The images as SVG definitions, each once; every view refers to them.
    std::string sources() const {
        if (lit_ == npos) return {};
        std::string images;
        const auto add = [&](std::size_t channel) {
            for (const char side : {'a', 'b'})
                images += fmt::format(
                    "<image id=\"{}\" width=\"{}\" height=\"{}\" href=\"{}\"/>", idOf(channel, side),
                    left_.settings.size.width, left_.settings.size.height,
                    layout_.source(side == 'a' ? pictures_[channel].baseline : pictures_[channel].test));
        };
        add(lit_);
        if (dark_ != lit_) add(dark_);
        return fmt::format(
            "<svg class=\"sources\" width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>{}</defs></svg>\n",
            images);
    }
    std::string idOf(std::size_t channel, char side) const {
        return fmt::format("eye-{}-{}-{}", id_, comparison_.channels[channel].mode->name, side);
    }

    std::string panel(std::size_t channel, char which, const Frame& frame, const VisualCheck& check) const {
        const Region r = regionAround(check.box, frame.settings.size);
        const auto edge = [&](const char* style) {
            return fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", style,
                               check.box.x0, check.box.y0, check.box.x1 - check.box.x0,
                               check.box.y1 - check.box.y0);
        };
        return fmt::format(
            "<div class=\"stage {}\"><svg viewBox=\"{:.7g} {:.7g} {:.7g} {:.7g}\" role=\"img\" "
            "aria-label=\"{}\">"
            "<use href=\"#{}\"/>{}{}</svg><span class=\"tag\">{}</span></div>",
            which == 'a' ? "left" : "right", r.x, r.y, r.width, r.height,
            markup(frame.name + ": " + check.name), idOf(channel, which), edge("under"), edge("edge"),
            markup(channel == lit_
                       ? frame.name
                       : fmt::format("{} \u00b7 {}", frame.name, comparison_.channels[channel].mode->name)));
    }

    std::string checkId(std::size_t number) const { return fmt::format("check-{}-{}", id_, number); }

    std::string step(std::size_t number, const char* word) const {
        return number < countOf(comparison_) ? fmt::format("<a href=\"#{}\">{}</a>", checkId(number), word)
                                             : "";
    }

    std::string view(const FeatureChecks& feature, const VisualCheck& check, std::size_t number) const {
        if (lit_ == npos) return {};
        const std::size_t channel = channelFor(check);
        // In a panel of half the page such a region is enlarged more than twice, so pixels are shown as
        // squares.
        const bool near = regionAround(check.box, left_.settings.size).width < 320;
        return fmt::format(
            "<figure class=\"box view{}\" id=\"{}\"><div class=\"pair side\">{}{}</div>"
            "<figcaption><span><b>{}</b> {}</span><span class=\"walk\">{} {}</span>"
            "<span class=\"legend mono\">{} \u00b7 pixels {}, {} to {}, {}{}</span></figcaption></figure>\n",
            near ? " near" : "", checkId(number), panel(channel, 'a', left_, check),
            panel(channel, 'b', right_, check), feature.feature, markup(check.what),
            number > 0 ? step(number - 1, "previous") : "", step(number + 1, "next"), markup(check.where),
            check.box.x0, check.box.y0, check.box.x1 - 1, check.box.y1 - 1,
            channel == lit_ ? "" : " \u00b7 no light falls there, so its base colour is shown");
    }

    // Numbers distinguish links of one row with the same name.
    struct Place {
        std::string name, links;
        int count = 0;
    };
    struct Row {
        std::string what;
        std::vector<Place> places;
    };

    std::string link(const VisualCheck& check, std::size_t number, const std::string& text) const {
        return lit_ != npos ? fmt::format("<a href=\"#{}\" title=\"{}\">{}</a>", checkId(number),
                                          markup(check.where), markup(text))
                            : fmt::format("<span title=\"{}\">{}</span>", markup(check.where), markup(text));
    }

    // One row for all checks of a feature with the same sentence.
    std::string rowsOf(const FeatureChecks& feature, std::size_t number) const {
        std::vector<Row> rows;
        for (const VisualCheck& check : feature.checks) {
            auto row = std::ranges::find(rows, check.what, &Row::what);
            if (row == rows.end()) row = rows.insert(row, {check.what, {}});
            auto place = std::ranges::find(row->places, check.name, &Place::name);
            if (place == row->places.end()) place = row->places.insert(place, {check.name, {}});
            place->links +=
                link(check, number++, ++place->count == 1 ? check.name : std::to_string(place->count));
        }
        std::string head =
            fmt::format("<tr><td><b>{}</b><br><span class=\"soft\">{}</span></td>", feature.feature,
                        feature.found > feature.checks.size()
                            ? fmt::format("the {} largest of {}", feature.checks.size(), feature.found)
                            : fmt::format("{}", feature.found));
        std::string out;
        for (const Row& row : rows) {
            std::string places;
            for (const Place& place : row.places)
                places += "<span class=\"place\">" + place.links + "</span> ";
            out += fmt::format("{}<td class=\"wide\">{}</td><td class=\"wide places\">{}</td></tr>\n", head,
                               markup(row.what), places);
            head = "<tr class=\"more\"><td></td>";
        }
        return out;
    }

    const Comparison& comparison_;
    const Frame &left_, &right_;
    const ReportLayout& layout_;
    const std::vector<ChannelPictures>& pictures_;  // per channel
    const std::string& id_;                         // the comparison's id in the page
    std::size_t lit_, dark_;                        // dark_: the channel shown where lit is black
    static constexpr std::size_t npos = ~std::size_t{0};
};

}  // namespace

std::string checksSection(const Report& report, const ReportLayout& layout, std::size_t index) {
    return Section(report, layout, index).html();
}

}  // namespace diptych
