// SPDX-License-Identifier: MIT
// One pixel's breakdown as sentences and tables.
#include "compare/explain/pixel_breakdown.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace diptych {

using output::Paragraph;

namespace {

using Numbers = std::span<const double>;

Numbers numbersOf(const glm::dvec3& value) {
    return {&value.x, 3};
}

// Numbers of one row, with enough digits to show that they differ from the first; at least 6.
class Digits {
public:
    explicit Digits(std::span<const Numbers> values) {
        const auto isDistinct = [&](double a, double b) { return a == b || one(a) != one(b); };
        while (digits_ < 9 && !std::ranges::all_of(values, [&](Numbers other) {
                   return values[0].size() != other.size() ||
                          std::ranges::equal(values[0], other, isDistinct);
               }))
            ++digits_;
    }
    std::string operator()(Numbers value) const {
        std::string text;
        for (const double v : value) text += fmt::format("{}{}", text.empty() ? "" : " ", one(v));
        return text.empty() ? "-" : text;
    }

private:
    std::string one(double v) const { return fmt::format("{:.{}g}", v, digits_); }
    int digits_ = 6;
};

// "0.301 against 0.298"
std::string against(Numbers a, Numbers b) {
    const Digits digits(std::array{a, b});
    return fmt::format("{} against {}", digits(b), digits(a));
}

// Names and values of both paths and the reference, and their difference, between these columns.
output::Table tableOf(const PixelBreakdown& breakdown, const char* first, std::vector<output::Column> last) {
    output::Table table{
        .columns = {{first}, {breakdown.names[0]}, {breakdown.names[1]}, {"reference"}, {"difference"}},
        .indent = 2};
    table.columns.insert(table.columns.end(), last.begin(), last.end());
    return table;
}

std::string toleranceText(const PixelStep& step) {
    if (!step.isCompared()) return "-";
    return std::isinf(step.tolerance.max) ? "none" : fmt::format("{:.3g}", step.tolerance.max);
}

std::string differenceText(double difference, bool differs) {
    if (difference == 0) return "0";
    return fmt::format("{:.3g}{}", difference, differs ? "" : " (rounding)");
}

output::Row stepRow(const PixelStep& step) {
    const std::array<Numbers, 3> values{step.values[0], step.values[1], step.values[2]};
    // Uses the digits of the paths if both have a value: the reference is in double.
    const Digits digits({values.data(), step.isCompared() ? 2u : 3u});
    const char* const fails =
        step.explained == false
            ? "FAIL: the encoding does not explain it: forward+ shades the decoded surface differently; "
        : step.beyond ? "FAIL: beyond tolerance: "
                      : "";
    return {{step.mode->name, digits(values[0]), digits(values[1]), digits(values[2]),
             step.isCompared() ? differenceText(step.difference, step.differs) : "-", toleranceText(step),
             fails + step.tolerance.because}};
}

// By PixelTerm::Kind; titleOf() names lights.
constexpr std::array titles{"",
                            "",
                            "environment",
                            "ambient, lightmap",
                            "emission",
                            "times transmittance",
                            "haze",
                            "blended fragments, transmission",
                            "sum of the terms",
                            "lit",
                            "lit minus the sum"};

std::string titleOf(const PixelBreakdown& breakdown, const PixelTerm& term) {
    if (term.kind == PixelTerm::Kind::other_lights)
        return counted(term.lights.size(),
                       term.lights.size() == breakdown.lights.size() ? "light" : "other light");
    if (term.kind != PixelTerm::Kind::light) return titles.at(static_cast<std::size_t>(term.kind));
    const PixelLightProperties& properties = breakdown.lights.at(term.lights.front());
    return fmt::format("light {}, {}{}", term.lights.front(), properties.kind,
                       properties.name.empty() ? "" : fmt::format(" \"{}\"", properties.name));
}

std::string notesOn(const PixelBreakdown& breakdown, const PixelTerm& term) {
    std::vector<std::string> items;
    if (term.kind == PixelTerm::Kind::light) {
        const PixelLightProperties& properties = breakdown.lights.at(term.lights.front());
        if (std::isfinite(properties.distance))
            items.push_back(fmt::format(
                "{:.4g} m away{}", properties.distance,
                std::isfinite(properties.range) ? fmt::format(" (range {:.4g} m)", properties.range) : ""));
        if (properties.casts) items.emplace_back("casts a shadow");
        for (std::size_t side = 0; side < 2; ++side)
            if (const auto& list = breakdown.lists.at(side);
                list && !std::ranges::binary_search(*list, term.lights.front()))
                items.push_back("not in the list of " + breakdown.names.at(side));
    }
    if (term.uncertainty > 0)
        items.push_back(fmt::format("uncertainty of the reference {:.2g}", term.uncertainty));
    return fmt::format("{}", fmt::join(items, ", "));
}

output::Row termRow(const PixelBreakdown& breakdown, const PixelTerm& term) {
    std::array<Numbers, 3> values;
    std::ranges::transform(term.values, values.begin(), numbersOf);
    if (!term.has_reference) values[2] = {};
    // The residual is computed here, so more digits would be meaningless.
    const bool derived = term.kind == PixelTerm::Kind::residual;
    const Digits digits({values.data(), derived ? 1u : 2u});
    return {
        {titleOf(breakdown, term), digits(values[0]), digits(values[1]), digits(values[2]),
         derived ? "" : differenceText(term.difference, term.differs || term.kind == PixelTerm::Kind::sum),
         notesOn(breakdown, term)}};
}

// The lights that the paths evaluate.
output::List listsOf(const PixelBreakdown& breakdown) {
    const bool same = breakdown.lists[0] && breakdown.lists[0] == breakdown.lists[1];
    output::List lines;
    for (std::size_t side = 0; side < (same ? 1u : 2u); ++side) {
        const std::string who = same ? "both paths evaluate" : breakdown.names.at(side) + " evaluates";
        const Assignment assign = breakdown.settings.at(side).assign;
        if (const auto& list = breakdown.lists.at(side))
            lines.items.emplace_back(fmt::format("{} {} of {} (--assign {}){}{}", who, list->size(),
                                                 counted(breakdown.lights.size(), "light"), nameOf(assign),
                                                 list->empty() ? "" : ": ", fmt::join(*list, ", ")));
        else
            lines.items.emplace_back(assign == Assignment::per_object
                                         ? who + " the object's lights (--assign per_object)"
                                         : who +
                                               " an unknown list: the length read differs from light_count");
    }
    return lines;
}

// Why lit is not the sum of its terms, for a path (0, 1) or the reference (2).
std::string residualReason(const PixelBreakdown& breakdown, std::size_t side) {
    const double left = largest(breakdown.terms.back().values.at(side)),
                 rounding = breakdown.residual_rounding.at(side);
    if (left == 0) return "0";
    if (left <= rounding)
        return fmt::format("{:.2g}, within {} ({:.2g} at most)", left,
                           side < 2 ? "the rounding of float32 sums" : "its uncertainty", rounding);
    if (side < 2 && breakdown.settings.at(side).msaa > 1)
        return fmt::format("{:.2g}: lit is the mean of {} samples, the terms are of the first", left,
                           breakdown.settings.at(side).msaa);
    if (side == 2 && breakdown.mode == ReferenceMode::scene)
        return fmt::format("{:.2g}: lit is the mean over the pixel, the terms are of its centre", left);
    return fmt::format("{:.2g}, more than the {:.2g} that rounding explains", left, rounding);
}

std::string howTermsWereMade(const PixelBreakdown& breakdown) {
    const std::size_t all = breakdown.lights.size(), alone = breakdown.drawn_alone;
    if (all == 0) return "no lights";
    for (const Settings& settings : breakdown.settings)
        if (settings.assign == Assignment::per_object)
            return "--assign per_object: spherical harmonics combine all lights, so the lights are one term";
    return fmt::format("{} of {} rendered alone by both paths{}{}{}", alone, counted(all, "light"),
                       alone > 0 ? ", the others black in the same lists and shadow maps" : "",
                       alone == lightsDrawnAlone
                           ? fmt::format(": the {} brightest here by the reference", lightsDrawnAlone)
                       : alone < all ? ": those evaluated here"
                                     : "",
                       alone < all ? fmt::format("; the other {} together", all - alone) : "");
}

// Lights, their terms and the sum.
void addTerms(std::vector<output::Block>& blocks, const PixelBreakdown& breakdown) {
    output::Table table = tableOf(breakdown, "term, W/(sr m^2)", {{""}});
    std::vector<std::size_t> dark;
    for (const PixelTerm& term : breakdown.terms)
        if (term.kind == PixelTerm::Kind::light &&
            std::ranges::all_of(term.values, [](const glm::dvec3& v) { return v == glm::dvec3(0); }))
            dark.push_back(term.lights.front());
        else
            table.rows.push_back(termRow(breakdown, term));
    std::ranges::sort(dark);
    output::List lines = listsOf(breakdown);
    lines.items.emplace_back(howTermsWereMade(breakdown));
    if (!dark.empty())
        lines.items.emplace_back(fmt::format("no contribution in any of the three by {} rendered alone: {}",
                                             counted(dark.size(), "light"), fmt::join(dark, ", ")));
    lines.items.emplace_back(fmt::format("lit minus the sum: {}: {}; {}: {}; reference: {}",
                                         breakdown.names[0], residualReason(breakdown, 0), breakdown.names[1],
                                         residualReason(breakdown, 1), residualReason(breakdown, 2)));
    blocks.insert(blocks.end(), {lines, table});
}

// The material and position, or why there are none.
std::string surfaceOf(const PixelBreakdown& breakdown) {
    if (!breakdown.shown)
        return breakdown.blended ? "background: no opaque surface, only blended fragments"
                                 : "background: no surface";
    const auto ids = std::ranges::find(breakdown.steps, Channel::material_id,
                                       [](const PixelStep& step) { return step.mode->channel; });
    const glm::dvec3& p = breakdown.position;
    return fmt::format(
        "material {}{}{}; at {:.6g}, {:.6g}, {:.6g} m", breakdown.material,
        breakdown.material_name.empty() ? "" : fmt::format(", \"{}\"", breakdown.material_name),
        ids != breakdown.steps.end() && ids->differs
            ? fmt::format(" (missing or different in {})", breakdown.names[1])
            : "",
        p[0], p[1], p[2]);
}

std::vector<std::string_view> namesOf(const PixelBreakdown& breakdown, bool PixelStep::*is) {
    std::vector<std::string_view> names;
    for (const PixelStep& step : breakdown.steps)
        if (step.*is) names.push_back(step.mode->name);
    return names;
}

}  // namespace

std::string firstDifference(const PixelBreakdown& breakdown) {
    const auto [step, term] = breakdown.first();
    if (step)
        return fmt::format(
            "the first step that differs by more than rounding: {} ({}, {:.3g} in its metric, {}, "
            "tolerance {}: {})",
            step->mode->name, against(step->values[0], step->values[1]), step->difference,
            nameOf(step->mode->error_kind), toleranceText(*step), step->tolerance.because);
    if (term)
        return fmt::format(
            "the first step that differs by more than rounding: {} ({} W/(sr m^2), relative difference "
            "{:.3g}; the surfaces are the same)",
            titleOf(breakdown, *term), against(numbersOf(term->values[0]), numbersOf(term->values[1])),
            term->difference);
    return "no step differs by more than rounding";
}

std::vector<output::Block> blocksOf(const PixelBreakdown& breakdown) {
    const Size& size = breakdown.settings[0].size;
    output::Table steps = tableOf(breakdown, "step", {{"tolerance"}, {"because", output::Column::prose}});
    for (const PixelStep& step : breakdown.steps)
        // In the background only lit and material_id have meaning.
        if (const Channel mode = step.mode->channel;
            breakdown.shown || isAfterTerms(mode) || mode == Channel::material_id)
            steps.rows.push_back(stepRow(step));
    std::vector<output::Block> blocks{
        Paragraph{fmt::format("{}{}{}: pixel {},{} of {}x{}, {} against {}", breakdown.scene,
                              breakdown.camera.empty() ? "" : ", ", breakdown.camera, breakdown.x,
                              breakdown.y, size.width, size.height, breakdown.names[1], breakdown.names[0])},
        Paragraph{surfaceOf(breakdown)}, steps};
    if (breakdown.shown) addTerms(blocks, breakdown);
    const auto addParagraph = [&](const std::string& text) { blocks.emplace_back(Paragraph{text}); };
    addParagraph(firstDifference(breakdown));
    if (const auto differing = namesOf(breakdown, &PixelStep::differs); differing.size() > 1)
        addParagraph(fmt::format("{} channels differ: {}", differing.size(), fmt::join(differing, ", ")));
    const auto beyond = namesOf(breakdown, &PixelStep::beyond);
    addParagraph(beyond.empty()
                     ? fmt::format("pass: at this pixel all {} shared channels are within tolerance",
                                   std::ranges::count_if(breakdown.steps, &PixelStep::isCompared))
                     : fmt::format("FAIL: at this pixel beyond tolerance: {}", fmt::join(beyond, ", ")));
    return blocks;
}

}  // namespace diptych
