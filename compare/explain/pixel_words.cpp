// SPDX-License-Identifier: MIT
#include "compare/explain/pixel_breakdown.h"
#include "compare/files/frame_json.h"
#include "compare/output/writers.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace diptych {

namespace {

using Json = nlohmann::ordered_json;

using Numbers = std::span<const double>;

Numbers numbersOf(const glm::dvec3& value) {
    return {&value.x, 3};
}

// Numbers of one row, with enough digits to show that they differ from the first; at least 6.
class Digits {
public:
    explicit Digits(std::span<const Numbers> values) {
        const auto told = [&](double a, double b) { return a == b || one(a) != one(b); };
        while (digits_ < 9 && !std::ranges::all_of(values, [&](Numbers other) {
                   return values[0].size() != other.size() || std::ranges::equal(values[0], other, told);
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

// Left-aligned columns with these heads.
output::Table tableWith(const std::vector<std::string>& heads) {
    output::Table table{.columns = {}, .indent = 2};
    for (const std::string& head : heads) table.columns.push_back({head});
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
    std::string because = step.tolerance.because;
    if (step.explained == false)
        because = fmt::format(
            "FAIL: the encoding does not explain it: forward+ shades the decoded surface differently; {}",
            because);
    else if (step.beyond)
        because = fmt::format("FAIL: beyond tolerance: {}", because);
    return {{step.mode->name, digits(values[0]), digits(values[1]), digits(values[2]),
             step.isCompared() ? differenceText(step.difference, step.differs) : "-", toleranceText(step),
             because}};
}

// The name in JSON and the title of each PixelTerm::Kind; titleOf() names lights.
constexpr std::array<std::array<std::string_view, 2>, 11> kinds{
    {{"light"},
     {"other_lights"},
     {"environment", "environment"},
     {"ambient", "ambient, lightmap"},
     {"emission", "emission"},
     {"transmittance", "times transmittance"},
     {"haze", "haze"},
     {"blended", "blended fragments, transmission"},
     {"sum", "sum of the terms"},
     {"lit", "lit"},
     {"residual", "lit minus the sum"}}};

std::string_view nameOf(PixelTerm::Kind kind) {
    return kinds.at(static_cast<std::size_t>(kind))[0];
}

std::string titleOf(const PixelBreakdown& breakdown, const PixelTerm& term) {
    if (term.kind == PixelTerm::Kind::other_lights)
        return counted(term.lights.size(),
                       term.lights.size() == breakdown.lights.size() ? "light" : "other light");
    if (term.kind != PixelTerm::Kind::light)
        return std::string(kinds.at(static_cast<std::size_t>(term.kind))[1]);
    const PixelLightFacts& facts = breakdown.lights.at(term.lights.front());
    return fmt::format("light {}, {}{}", term.lights.front(), facts.kind,
                       facts.name.empty() ? "" : fmt::format(" \"{}\"", facts.name));
}

std::string notesOn(const PixelBreakdown& breakdown, const PixelTerm& term) {
    std::vector<std::string> words;
    if (term.kind == PixelTerm::Kind::light) {
        const PixelLightFacts& facts = breakdown.lights.at(term.lights.front());
        if (std::isfinite(facts.distance))
            words.push_back(
                fmt::format("{:.4g} m away{}", facts.distance,
                            std::isfinite(facts.range) ? fmt::format(" (range {:.4g} m)", facts.range) : ""));
        if (facts.casts) words.emplace_back("casts a shadow");
        for (std::size_t side = 0; side < 2; ++side)
            if (const auto& list = breakdown.lists.at(side);
                list && !std::ranges::binary_search(*list, term.lights.front()))
                words.push_back("not in the list of " + breakdown.names.at(side));
    }
    if (term.uncertainty > 0)
        words.push_back(fmt::format("uncertainty of the reference {:.2g}", term.uncertainty));
    return fmt::format("{}", fmt::join(words, ", "));
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

std::string listWords(const PixelBreakdown& breakdown) {
    const bool same = breakdown.lists[0] && breakdown.lists[0] == breakdown.lists[1];
    std::string text;
    for (std::size_t side = 0; side < (same ? 1u : 2u); ++side) {
        const Assignment assign = breakdown.settings.at(side).assign;
        if (const auto& list = breakdown.lists.at(side))
            text += fmt::format("{} {} of {} (--assign {}){}{}\n",
                                same ? "both paths evaluate" : breakdown.names.at(side) + " evaluates",
                                list->size(), counted(breakdown.lights.size(), "light"), nameOf(assign),
                                list->empty() ? "" : ": ", fmt::join(*list, ", "));
        else if (assign == Assignment::per_object)
            text += fmt::format("{} evaluates the object's lights (--assign per_object)\n",
                                breakdown.names.at(side));
        else
            text += fmt::format("{}: its light list is unknown: the length read differs from light_count\n",
                                breakdown.names.at(side));
    }
    return text;
}

std::string termsText(const PixelBreakdown& breakdown) {
    output::Table table = tableWith(
        {"term, W/(sr m^2)", breakdown.names[0], breakdown.names[1], "reference", "difference", ""});
    std::vector<std::size_t> dark;
    for (const PixelTerm& term : breakdown.terms) {
        if (term.kind == PixelTerm::Kind::light &&
            std::ranges::all_of(term.values, [](const glm::dvec3& v) { return v == glm::dvec3(0); }))
            dark.push_back(term.lights.front());
        else
            table.rows.push_back(termRow(breakdown, term));
    }
    std::string text = inText(table);
    if (!dark.empty()) {
        std::ranges::sort(dark);
        text += fmt::format("no contribution in any of the three by {} rendered alone: {}\n",
                            counted(dark.size(), "light"), fmt::join(dark, ", "));
    }
    return text;
}

// Why lit is not the sum of its terms, for a path (0, 1) or the reference (2).
std::string residualReason(const PixelBreakdown& breakdown, std::size_t side) {
    const double left = largest(breakdown.terms.back().values.at(side));
    if (left == 0) return "0";
    if (left <= breakdown.residual_rounding.at(side))
        return fmt::format("{:.2g}, within {} ({:.2g} at most)", left,
                           side < 2 ? "the rounding of float32 sums" : "its uncertainty",
                           breakdown.residual_rounding.at(side));
    if (side < 2 && breakdown.settings.at(side).msaa > 1)
        return fmt::format("{:.2g}: lit is the mean of {} samples, the terms are of the first", left,
                           breakdown.settings.at(side).msaa);
    if (side == 2 && breakdown.mode == ReferenceMode::scene)
        return fmt::format("{:.2g}: lit is the mean over the pixel, the terms are of its centre", left);
    return fmt::format("{:.2g}, more than the {:.2g} that rounding explains", left,
                       breakdown.residual_rounding.at(side));
}

std::string residualText(const PixelBreakdown& breakdown) {
    return fmt::format("lit minus the sum: {}: {}; {}: {}; reference: {}\n", breakdown.names[0],
                       residualReason(breakdown, 0), breakdown.names[1], residualReason(breakdown, 1),
                       residualReason(breakdown, 2));
}

std::string howTermsWereMade(const PixelBreakdown& breakdown) {
    const std::size_t all = breakdown.lights.size(), alone = breakdown.drawn_alone;
    if (all == 0) return "no lights\n";
    for (const Settings& settings : breakdown.settings)
        if (settings.assign == Assignment::per_object)
            return "--assign per_object: spherical harmonics combine all lights, so the lights are one "
                   "term\n";
    std::string text = fmt::format("{} of {} rendered alone by both paths", alone, counted(all, "light"));
    if (alone > 0) text += ", the others black in the same lists and shadow maps";
    if (alone == lightsDrawnAlone)
        text += fmt::format(": the {} brightest here by the reference", lightsDrawnAlone);
    else if (alone < all)
        text += ": those evaluated here";
    return text + (alone < all ? fmt::format("; the other {} together\n", all - alone) : "\n");
}

std::string headline(const PixelBreakdown& breakdown) {
    std::string text = fmt::format("{}{}{}: pixel {},{} of {}x{}, {} against {}\n", breakdown.scene,
                                   breakdown.camera.empty() ? "" : ", ", breakdown.camera, breakdown.x,
                                   breakdown.y, breakdown.settings[0].size.width,
                                   breakdown.settings[0].size.height, breakdown.names[1], breakdown.names[0]);
    if (!breakdown.shown)
        return text + (breakdown.blended ? "background: no opaque surface, only blended fragments\n"
                                         : "background: no surface\n");
    const auto ids = std::ranges::find(breakdown.steps, Channel::material_id,
                                       [](const PixelStep& step) { return step.mode->channel; });
    text +=
        fmt::format("material {}{}", breakdown.material,
                    breakdown.material_name.empty() ? "" : fmt::format(", \"{}\"", breakdown.material_name));
    if (ids != breakdown.steps.end() && ids->differs)
        text += fmt::format(" (missing or different in {})", breakdown.names[1]);
    const glm::dvec3& p = breakdown.position;
    return text + fmt::format("; at {:.6g}, {:.6g}, {:.6g} m\n", p[0], p[1], p[2]);
}

// "0.301 against 0.298"
std::string against(Numbers a, Numbers b) {
    const Digits digits(std::array{a, b});
    return fmt::format("{} against {}", digits(b), digits(a));
}

std::vector<std::string_view> namesOf(const PixelBreakdown& breakdown, bool PixelStep::*is) {
    std::vector<std::string_view> names;
    for (const PixelStep& step : breakdown.steps)
        if (step.*is) names.push_back(step.mode->name);
    return names;
}

std::string verdictLine(const PixelBreakdown& breakdown) {
    const std::vector<std::string_view> beyond = namesOf(breakdown, &PixelStep::beyond);
    return beyond.empty()
               ? fmt::format("pass: at this pixel all {} shared channels are within tolerance\n",
                             std::ranges::count_if(breakdown.steps, &PixelStep::isCompared))
               : fmt::format("FAIL: at this pixel beyond tolerance: {}\n", fmt::join(beyond, ", "));
}

// null without values.
Json numbersJson(Numbers values) {
    if (values.empty()) return nullptr;
    Json list = Json::array();
    for (const double v : values) list.push_back(finiteOrNull(v));
    return list;
}

Json stepsJson(const PixelBreakdown& breakdown) {
    Json steps = Json::array();
    for (const PixelStep& step : breakdown.steps) {
        Json one{{"number", channelNumber(step.mode->channel)}, {"name", step.mode->name},
                 {"metric", nameOf(step.mode->metric)},         {"baseline", numbersJson(step.values[0])},
                 {"test", numbersJson(step.values[1])},         {"reference", numbersJson(step.values[2])}};
        if (step.isCompared()) {
            one["difference"] = finiteOrNull(step.difference);
            one["differs"] = step.differs;
            one["tolerance"] = finiteOrNull(step.tolerance.max);
            one["within"] = !step.beyond;
            if (step.explained) one["explained"] = *step.explained;
        }
        one["because"] = step.tolerance.because;
        steps.push_back(std::move(one));
    }
    return steps;
}

Json lightsJson(const PixelBreakdown& breakdown) {
    Json lights = Json::array();
    for (std::size_t i = 0; i < breakdown.lights.size(); ++i) {
        const PixelLightFacts& facts = breakdown.lights[i];
        Json one{{"light", i},
                 {"name", facts.name},
                 {"kind", facts.kind},
                 {"distance", finiteOrNull(facts.distance)},
                 {"range", finiteOrNull(facts.range)},
                 {"casts", facts.casts}};
        for (std::size_t side = 0; side < 2; ++side) {
            const auto& list = breakdown.lists.at(side);
            one[side == 0 ? "in_baseline_list" : "in_test_list"] =
                list ? Json(std::ranges::binary_search(*list, i)) : Json(nullptr);
        }
        lights.push_back(std::move(one));
    }
    return lights;
}

Json termsJson(const PixelBreakdown& breakdown) {
    Json terms = Json::array();
    for (const PixelTerm& term : breakdown.terms)
        terms.push_back(
            {{"kind", nameOf(term.kind)},
             {"lights", term.lights},
             {"baseline", numbersJson(numbersOf(term.values[0]))},
             {"test", numbersJson(numbersOf(term.values[1]))},
             {"reference", numbersJson(term.has_reference ? numbersOf(term.values[2]) : Numbers())},
             {"uncertainty", term.uncertainty},
             {"difference", finiteOrNull(term.difference)},
             {"differs", term.differs}});
    return terms;
}

}  // namespace

std::string firstDifference(const PixelBreakdown& breakdown) {
    const auto [step, term] = breakdown.first();
    if (step)
        return fmt::format(
            "the first step that differs by more than rounding: {} ({}, {:.3g} in its metric, {}, "
            "tolerance {}: {})",
            step->mode->name, against(step->values[0], step->values[1]), step->difference,
            nameOf(step->mode->metric), toleranceText(*step), step->tolerance.because);
    if (term)
        return fmt::format(
            "the first step that differs by more than rounding: {} ({} W/(sr m^2), relative difference "
            "{:.3g}; the surfaces are the same)",
            titleOf(breakdown, *term), against(numbersOf(term->values[0]), numbersOf(term->values[1])),
            term->difference);
    return "no step differs by more than rounding";
}

std::string inWords(const PixelBreakdown& breakdown) {
    output::Table steps = tableWith(
        {"step", breakdown.names[0], breakdown.names[1], "reference", "difference", "tolerance", "because"});
    std::size_t before = 1;  // lines before the lights
    for (const PixelStep& step : breakdown.steps) {
        const Channel mode = step.mode->channel;
        // In the background only lit and material_id have meaning.
        if (!breakdown.shown && !isAfterTerms(mode) && mode != Channel::material_id) continue;
        steps.rows.push_back(stepRow(step));
        before += !isAfterTerms(mode);
    }
    std::string text = headline(breakdown) + inText(steps, 0, before);
    if (breakdown.shown)
        text += listWords(breakdown) + howTermsWereMade(breakdown) + termsText(breakdown) +
                residualText(breakdown);
    text += inText(steps, before);
    const std::vector<std::string_view> differing = namesOf(breakdown, &PixelStep::differs);
    text += fmt::format("{}\n", firstDifference(breakdown));
    if (differing.size() > 1)
        text += fmt::format("{} channels differ: {}\n", differing.size(), fmt::join(differing, ", "));
    return text + verdictLine(breakdown);
}

nlohmann::ordered_json toJson(const PixelBreakdown& breakdown) {
    const auto [step, term] = breakdown.first();
    Json first = nullptr;
    if (step) first = step->mode->name;
    if (term)
        first = term->kind == PixelTerm::Kind::light ? fmt::format("light {}", term->lights.front())
                                                     : std::string(nameOf(term->kind));
    return {
        {"schema", 1},
        {"scene", breakdown.scene},
        {"camera", breakdown.camera},
        {"pixel", {breakdown.x, breakdown.y}},
        {"size", {breakdown.settings[0].size.width, breakdown.settings[0].size.height}},
        {"baseline", breakdown.names[0]},
        {"test", breakdown.names[1]},
        {"settings",
         {parseOrderedJson(toJson(breakdown.settings[0])), parseOrderedJson(toJson(breakdown.settings[1]))}},
        {"background", !breakdown.shown},
        {"blended", breakdown.blended},
        {"material", breakdown.shown ? Json{{"id", breakdown.material}, {"name", breakdown.material_name}}
                                     : Json(nullptr)},
        {"position", numbersJson(breakdown.shown ? numbersOf(breakdown.position) : Numbers())},
        {"steps", stepsJson(breakdown)},
        {"lights", lightsJson(breakdown)},
        {"drawn_alone", breakdown.drawn_alone},
        {"terms", termsJson(breakdown)},
        {"residual_rounding", numbersJson(breakdown.residual_rounding)},
        {"first_difference", std::move(first)},
        {"summary", firstDifference(breakdown)}};
}

}  // namespace diptych
