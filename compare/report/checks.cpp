// SPDX-License-Identifier: MIT
// The visual checks: a table of places. A link shows its place enlarged in a channel's card.
#include "compare/report/document.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych {

using output::Block;
using output::Span;
using output::Text;

namespace {

// Whether less than a tenth of the box reaches a hundredth of white in the image of lit.
bool isDark(const Image& lit, const PixelBox& box, double exposure) {
    const double min = 0.01 / exposure;
    // About a thousand pixels suffice
    const auto step = [](int extent) { return std::max(extent / 32, 1); };
    int bright = 0, looked = 0;
    for (int y = box.y0; y < box.y1; y += step(box.y1 - box.y0))
        for (int x = box.x0; x < box.x1; x += step(box.x1 - box.x0), ++looked)
            bright += std::max({lit.at(x, y, 0), lit.at(x, y, 1), lit.at(x, y, 2)}) >= min;
    return bright * 10 < looked;
}

// The channels whose cards show the places.
class Links {
public:
    Links(const Report& report, const ReportLayout& layout, std::size_t index)
        : comparison_(report.comparisons[index]),
          left_(report.baseline(comparison_)),
          images_(layout.images[index]),
          id_(layout.ids[index]),
          lit_(channelOr(Channel::lit, anyChannel())),
          dark_(channelOr(Channel::albedo, lit_)) {}

    bool exist() const { return lit_ != npos; }

    // "#c0-lit@30,20?zoom=4&at=30,19.5": the box with a margin of a third, at most eight times enlarged.
    std::string to(const PixelBox& box) const {
        const Size& size = left_.settings.size;
        const double width = box.x1 - box.x0, height = box.y1 - box.y0,
                     fraction = 1.35 * std::max(width / size.width, height / size.height);
        const DebugMode& mode = *comparison_.channels[channelFor(box)].mode;
        return fmt::format("#{}@{},{}?zoom={:.3g}&at={},{}", cardId(id_, mode), (box.x0 + box.x1) / 2,
                           (box.y0 + box.y1) / 2, 1 / std::clamp(fraction, 1.0 / 8, 1.0),
                           0.5 * (box.x0 + box.x1 - 1), 0.5 * (box.y0 + box.y1 - 1));
    }

private:
    // Base colour replaces lit where no light falls.
    std::size_t channelFor(const PixelBox& box) const {
        const Image* const lit = findChannel(left_, Channel::lit);
        return lit && isDark(*lit, box, images_[lit_].scale.exposure.factor) ? dark_ : lit_;
    }
    bool hasBoth(std::size_t channel) const {
        return !images_[channel].baseline.empty() && !images_[channel].test.empty();
    }
    // The channel with this number, or `other` if it was not compared.
    std::size_t channelOr(Channel mode, std::size_t other) const {
        for (std::size_t i = 0; i < images_.size(); ++i)
            if (comparison_.channels[i].mode->channel == mode && hasBoth(i)) return i;
        return other;
    }
    std::size_t anyChannel() const {
        for (std::size_t i = 0; i < images_.size(); ++i)
            if (hasBoth(i)) return i;
        return npos;
    }

    const Comparison& comparison_;
    const Frame& left_;
    const std::vector<ChannelImages>& images_;  // per channel
    const std::string& id_;                     // the comparison's id in the page
    static constexpr std::size_t npos = ~std::size_t{0};
    std::size_t lit_, dark_;  // dark_: the channel shown where lit is black
};

// A row for all checks of a feature with the same sentence. Numbers distinguish places with the same name.
void addRows(output::Table& table, const FeatureChecks& feature, const Links& links) {
    const std::string found = feature.found > feature.checks.size()
                                  ? fmt::format("the {} largest of {}", feature.checks.size(), feature.found)
                                  : fmt::format("{}", feature.found);
    std::vector<std::string> sentences, names;  // sentences: of the rows
    const std::size_t first = table.rows.size();
    for (const VisualCheck& check : feature.checks) {
        const auto known = std::ranges::find(sentences, check.what) - sentences.begin();
        const std::size_t row = first + static_cast<std::size_t>(known);
        if (row == table.rows.size()) {
            const Text head{Span(feature.feature, Span::strong), " ", Span(found, Span::plain, "soft")};
            table.rows.push_back(
                {{row == first ? head : Text(), check.what, Text()}, row == first ? "" : "more"});
            sentences.push_back(check.what);
        }
        names.push_back(check.what + '\n' + check.name);
        const auto same = std::ranges::count(names, names.back());
        output::Cell& places = table.rows[row].cells[2];
        std::vector<Span>& spans = places.text.spans;
        if (!spans.empty()) spans.emplace_back(same > 1 ? " " : ", ");
        const std::string text = same > 1 ? fmt::format("{}", same) : check.name;
        if (links.exist())
            spans.emplace_back(text, Span::link, links.to(check.box));
        else
            spans.emplace_back(text, Span::foreign);
        places.means += (places.means.empty() ? "" : "; ") + check.where;
    }
}

}  // namespace

void addVisualChecks(std::vector<Block>& blocks, const Report& report, const ReportLayout& layout,
                     std::size_t index) {
    const Comparison& comparison = report.comparisons[index];
    if (comparison.visual_checks.empty()) return;
    const Links links(report, layout, index);
    output::Table table{.columns = {{"feature"},
                                    {.title = "right if", .style = "wide"},
                                    {.title = "places", .style = "wide"}},
                        .style = "",
                        .box = "box scroll"};
    for (const FeatureChecks& feature : comparison.visual_checks) addRows(table, feature, links);
    blocks.emplace_back(output::Box{
        "checks",
        {output::Heading{2, "To check by eye"},
         output::Paragraph{
             fmt::format("Here both paths can be wrong in the same way, and no comparison shows it.{}",
                         links.exist() ? " Each link shows its place enlarged; where no light falls, in the "
                                         "base colour."
                                       : ""),
             "soft"},
         table},
        "eye-" + layout.ids[index]});
}

}  // namespace diptych
