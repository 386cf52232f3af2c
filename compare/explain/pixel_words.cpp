// SPDX-License-Identifier: MIT
#include "compare/explain/pixel_words.h"

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

// Numbers of one row, with enough digits to show that they differ; at least 6.
class Digits {
public:
    explicit Digits(std::span<const std::span<const double>> values) {
        for (; digits_ < 9; ++digits_) {
            bool told = true;
            for (std::size_t i = 1; i < values.size() && told; ++i)
                for (std::size_t c = 0; c < values[i].size() && told; ++c)
                    told = values[0].size() != values[i].size() || values[0][c] == values[i][c] ||
                           one(values[0][c]) != one(values[i][c]);
            if (told) break;
        }
    }
    std::string operator()(std::span<const double> value) const {
        if (value.empty()) return "-";
        std::string text;
        for (const double v : value) text += fmt::format("{}{}", text.empty() ? "" : " ", one(v));
        return text;
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
    std::vector<std::span<const double>> values;
    for (const PixelValue* value : {&step.values[0], &step.values[1], &step.reference})
        values.emplace_back(*value);
    // Uses the digits of the paths if both have a value: the reference is in double.
    const std::span all(values);
    const Digits digits(all.first(step.isCompared() ? 2 : 3));
    std::string because = step.tolerance.because;
    if (step.explained == false)
        because = fmt::format(
            "FAIL: the encoding does not explain it: forward+ shades the decoded surface differently; {}",
            step.tolerance.because);
    else if (step.beyond)
        because = fmt::format("FAIL: beyond tolerance: {}", step.tolerance.because);
    return {{step.mode->name, digits(values[0]), digits(values[1]), digits(values[2]),
             step.isCompared() ? differenceText(step.difference, step.differs) : "-", toleranceText(step),
             because}};
}

std::string lightTitle(const PixelBreakdown& breakdown, std::size_t light) {
    const PixelLightFacts& facts = breakdown.lights.at(light);
    return fmt::format("light {}, {}{}", light, facts.kind,
                       facts.name.empty() ? "" : fmt::format(" \"{}\"", facts.name));
}

std::string titleOf(const PixelBreakdown& breakdown, const PixelTerm& term) {
    switch (term.kind) {
        case PixelTerm::Kind::light:
            return lightTitle(breakdown, term.lights.front());
        case PixelTerm::Kind::other_lights:
            return counted(term.lights.size(),
                           term.lights.size() == breakdown.lights.size() ? "light" : "other light");
        case PixelTerm::Kind::environment:
            return "environment";
        case PixelTerm::Kind::ambient:
            return "ambient, lightmap";
        case PixelTerm::Kind::emission:
            return "emission";
        case PixelTerm::Kind::transmittance:
            return "times transmittance";
        case PixelTerm::Kind::haze:
            return "haze";
        case PixelTerm::Kind::blended:
            return "blended fragments, transmission";
        case PixelTerm::Kind::sum:
            return "sum of the terms";
        case PixelTerm::Kind::lit:
            return "lit";
        case PixelTerm::Kind::residual:
            return "lit minus the sum";
    }
    return {};
}

bool isNothing(const PixelTerm& term) {
    const auto dark = [](const std::array<double, 3>& v) {
        return std::ranges::all_of(v, [](double c) { return c == 0; });
    };
    return dark(term.values[0]) && dark(term.values[1]) && (!term.reference || dark(*term.reference));
}

std::string lightWords(const PixelBreakdown& breakdown, const PixelTerm& term) {
    const PixelLightFacts& facts = breakdown.lights.at(term.lights.front());
    std::string words;
    const auto say = [&](const std::string& what) {
        words += fmt::format("{}{}", words.empty() ? "" : ", ", what);
    };
    if (std::isfinite(facts.distance))
        say(fmt::format("{:.4g} m away{}", facts.distance,
                        std::isfinite(facts.range) ? fmt::format(" (range {:.4g} m)", facts.range) : ""));
    if (facts.casts) say("casts a shadow");
    for (std::size_t side = 0; side < 2; ++side)
        if (breakdown.lists_known.at(side) && !facts.listed.at(side))
            say(fmt::format("not in the list of {}", breakdown.names.at(side)));
    return words;
}

output::Row termRow(const PixelBreakdown& breakdown, const PixelTerm& term) {
    std::vector<std::span<const double>> values{term.values[0], term.values[1]};
    if (term.reference) values.emplace_back(*term.reference);
    // The residual is computed here, so more digits would be meaningless.
    const bool derived = term.kind == PixelTerm::Kind::residual;
    const Digits digits(derived ? std::span(values).first(1) : std::span(values).first(2));
    std::string words = term.kind == PixelTerm::Kind::light ? lightWords(breakdown, term) : "";
    if (term.uncertainty > 0)
        words +=
            fmt::format("{}uncertainty of the reference {:.2g}", words.empty() ? "" : ", ", term.uncertainty);
    return {
        {titleOf(breakdown, term), digits(values[0]), digits(values[1]),
         values.size() > 2 ? digits(values[2]) : "-",
         derived ? "" : differenceText(term.difference, term.differs || term.kind == PixelTerm::Kind::sum),
         words}};
}

std::vector<std::size_t> listOf(const PixelBreakdown& breakdown, std::size_t side) {
    std::vector<std::size_t> listed;
    for (std::size_t i = 0; i < breakdown.lights.size(); ++i)
        if (breakdown.lights[i].listed.at(side)) listed.push_back(i);
    return listed;
}

std::string listWords(const PixelBreakdown& breakdown) {
    const std::array known{breakdown.lists_known[0], breakdown.lists_known[1]};
    const std::array lists{listOf(breakdown, 0), listOf(breakdown, 1)};
    const bool same = known[0] && known[1] && lists[0] == lists[1];
    std::string text;
    for (std::size_t side = 0; side < (same ? 1u : 2u); ++side) {
        const Settings& settings = breakdown.settings.at(side);
        if (known.at(side))
            text += fmt::format("{} {} of {} (--assign {}){}{}\n",
                                same ? "both paths evaluate" : breakdown.names.at(side) + " evaluates",
                                lists.at(side).size(), counted(breakdown.lights.size(), "light"),
                                nameOf(settings.assign), lists.at(side).empty() ? "" : ": ",
                                fmt::join(lists.at(side), ", "));
        else if (settings.assign == Assignment::per_object)
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
        if (term.kind == PixelTerm::Kind::light && isNothing(term))
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

double worstOf(const std::array<double, 3>& v) {
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

// Why lit is not the sum of its terms, for a path (0, 1) or the reference (2).
std::string residualReason(const PixelBreakdown& breakdown, std::size_t side, const PixelTerm& residual) {
    const double left = worstOf(side < 2 ? residual.values.at(side) : residual.reference.value());
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
    const PixelTerm& residual = breakdown.terms.back();
    return fmt::format("lit minus the sum: {}: {}; {}: {}; reference: {}\n", breakdown.names[0],
                       residualReason(breakdown, 0, residual), breakdown.names[1],
                       residualReason(breakdown, 1, residual), residualReason(breakdown, 2, residual));
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

const PixelStep* stepOf(const PixelBreakdown& breakdown, Channel mode) {
    for (const PixelStep& step : breakdown.steps)
        if (step.mode->channel == mode) return &step;
    return nullptr;
}

std::string headline(const PixelBreakdown& breakdown) {
    std::string text =
        fmt::format("{}{}{}: pixel {},{} of {}x{}, {} against {}\n", breakdown.scene,
                    breakdown.camera.empty() ? "" : ", ", breakdown.camera, breakdown.x, breakdown.y,
                    breakdown.size.width, breakdown.size.height, breakdown.names[1], breakdown.names[0]);
    if (!breakdown.shown)
        return text + (breakdown.blended ? "background: no opaque surface, only blended fragments\n"
                                         : "background: no surface\n");
    const PixelStep* const ids = stepOf(breakdown, Channel::material_id);
    text +=
        fmt::format("material {}{}", breakdown.material,
                    breakdown.material_name.empty() ? "" : fmt::format(", \"{}\"", breakdown.material_name));
    if (ids && ids->differs) text += fmt::format(" (missing or different in {})", breakdown.names[1]);
    const auto& p = breakdown.position;
    return text + fmt::format("; at {:.6g}, {:.6g}, {:.6g} m\n", p[0], p[1], p[2]);
}

// "0.301 against 0.298"
std::string against(std::span<const double> a, std::span<const double> b) {
    const std::array values{a, b};
    const Digits digits(values);
    return fmt::format("{} against {}", digits(b), digits(a));
}

std::string verdictLine(const PixelBreakdown& breakdown) {
    std::vector<std::string> beyond;
    std::size_t compared = 0;
    for (const PixelStep& step : breakdown.steps) {
        compared += step.isCompared();
        if (step.isCompared() && step.beyond) beyond.emplace_back(step.mode->name);
    }
    return beyond.empty()
               ? fmt::format("pass: at this pixel all {} shared channels are within tolerance\n", compared)
               : fmt::format("FAIL: at this pixel beyond tolerance: {}\n", fmt::join(beyond, ", "));
}

Json numbersJson(std::span<const double> values) {
    Json list = Json::array();
    for (const double v : values) list.push_back(finiteOrNull(v));
    return list;
}

Json stepsJson(const PixelBreakdown& breakdown) {
    const auto orNull = [](const PixelValue& value) {
        return value.empty() ? Json(nullptr) : numbersJson(value);
    };
    Json steps = Json::array();
    for (const PixelStep& step : breakdown.steps) {
        Json one{{"number", channelNumber(step.mode->channel)},
                 {"name", step.mode->name},
                 {"metric", nameOf(step.mode->metric)},
                 {"baseline", orNull(step.values[0])},
                 {"test", orNull(step.values[1])},
                 {"reference", orNull(step.reference)}};
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
        for (std::size_t side = 0; side < 2; ++side)
            one[side == 0 ? "in_baseline_list" : "in_test_list"] =
                breakdown.lists_known.at(side) ? Json(facts.listed.at(side)) : Json(nullptr);
        lights.push_back(std::move(one));
    }
    return lights;
}

Json termsJson(const PixelBreakdown& breakdown) {
    Json terms = Json::array();
    for (const PixelTerm& term : breakdown.terms)
        terms.push_back({{"kind", nameOf(term.kind)},
                         {"lights", term.lights},
                         {"baseline", numbersJson(term.values[0])},
                         {"test", numbersJson(term.values[1])},
                         {"reference", term.reference ? numbersJson(*term.reference) : Json(nullptr)},
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
            titleOf(breakdown, *term), against(term->values[0], term->values[1]), term->difference);
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
    std::vector<std::string_view> differing;
    for (const PixelStep& step : breakdown.steps)
        if (step.differs) differing.push_back(step.mode->name);
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
        {"size", {breakdown.size.width, breakdown.size.height}},
        {"baseline", breakdown.names[0]},
        {"test", breakdown.names[1]},
        {"settings",
         {parseOrderedJson(toJson(breakdown.settings[0])), parseOrderedJson(toJson(breakdown.settings[1]))}},
        {"background", !breakdown.shown},
        {"blended", breakdown.blended},
        {"material", breakdown.shown ? Json{{"id", breakdown.material}, {"name", breakdown.material_name}}
                                     : Json(nullptr)},
        {"position", breakdown.shown ? numbersJson(breakdown.position) : Json(nullptr)},
        {"steps", stepsJson(breakdown)},
        {"lights", lightsJson(breakdown)},
        {"drawn_alone", breakdown.drawn_alone},
        {"terms", termsJson(breakdown)},
        {"residual_rounding", numbersJson(breakdown.residual_rounding)},
        {"first_difference", std::move(first)},
        {"summary", firstDifference(breakdown)}};
}

}  // namespace diptych
