// SPDX-License-Identifier: MIT
// Explanations and breakdowns of pixels as JSON.
#include "compare/explain/pixel_breakdown.h"
#include "compare/explain/write.h"
#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace diptych {

namespace {

using Json = nlohmann::ordered_json;

constexpr double namedPart = 0.01;  // of a cause's contribution

// By PixelTerm::Kind.
constexpr std::array kinds{"light", "other_lights", "environment", "ambient", "emission", "transmittance",
                           "haze",  "blended",      "sum",         "lit",     "residual"};

std::string kindOf(const PixelTerm& term) {
    return kinds.at(static_cast<std::size_t>(term.kind));
}

// null without values.
Json numbersJson(std::span<const double> values) {
    if (values.empty()) return nullptr;
    return arrayOf(values, finiteOrNull);
}
Json numbersJson(const glm::dvec3& value) {
    return numbersJson(std::span(&value.x, 3));
}

Json stepsJson(const PixelBreakdown& breakdown) {
    Json steps = Json::array();
    for (const PixelStep& step : breakdown.steps) {
        Json one{{"number", channelIndex(step.mode->channel)}, {"name", step.mode->name},
                 {"metric", nameOf(step.mode->error_kind)},    {"baseline", numbersJson(step.values[0])},
                 {"test", numbersJson(step.values[1])},        {"reference", numbersJson(step.values[2])}};
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
        const PixelLightProperties& properties = breakdown.lights[i];
        Json one{{"light", i},
                 {"name", properties.name},
                 {"kind", properties.kind},
                 {"distance", finiteOrNull(properties.distance)},
                 {"range", finiteOrNull(properties.range)},
                 {"casts", properties.casts}};
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
    return arrayOf(breakdown.terms, [](const PixelTerm& term) -> Json {
        return {{"kind", kindOf(term)},
                {"lights", term.lights},
                {"baseline", numbersJson(term.values[0])},
                {"test", numbersJson(term.values[1])},
                {"reference", term.has_reference ? numbersJson(term.values[2]) : Json(nullptr)},
                {"uncertainty", term.uncertainty},
                {"difference", finiteOrNull(term.difference)},
                {"differs", term.differs}};
    });
}

}  // namespace

nlohmann::ordered_json toJson(const Explanation& e, const ExplainedImages& of) {
    const auto deviceJson = [&](const DeviceContribution& part) -> Json {
        return {{"name", part.name}, {"share", e.fractionOf(part.contribution)}, {"shows", part.description}};
    };
    const auto partsJson = [&](const Cause& cause, const std::vector<CausePart>& parts, const char* index) {
        Json all = Json::array();
        for (const CausePart& part : parts)
            if (std::abs(part.contribution) >= namedPart * std::abs(cause.contribution))
                all.push_back(
                    {{index, part.index}, {"name", part.name}, {"share", e.fractionOf(part.contribution)}});
        return all;
    };
    const auto causeJson = [&](const Cause& cause) -> Json {
        return {{"name", cause.name},
                {"share", e.fractionOf(cause.contribution)},
                {"interval", e.fractionOf(cause.interval)},
                {"where", {cause.worst_x, cause.worst_y}},
                {"shows", cause.description},
                {"alone", e.fractionOf(cause.alone)},
                {"last", e.fractionOf(cause.last)},
                {"dominates", cause.dominates},
                {"flip_share", e.fractionOfFlip(cause.flip)},
                {"materials", partsJson(cause, cause.materials, "id")},
                {"lights", partsJson(cause, cause.lights, "place")}};
    };
    const auto pairJson = [&](const CausePair& pair) -> Json {
        return {{"causes", {e.causes[pair.first].name, e.causes[pair.second].name}},
                {"interaction", e.fractionOf(pair.interaction)}};
    };
    return {{"schema", 1},
            {"software", softwareName},
            {"scene", of.scene},
            {"baseline", of.baseline},
            {"test", of.test},
            {"distance", e.distance},
            {"flip", e.flip},
            {"causes", arrayOf(e.causes, causeJson)},
            {"unexplained", e.fractionOf(e.unexplained)},
            {"flip_unexplained", e.flip_unexplained},
            {"pairs", arrayOf(e.pairs, pairJson)},
            {"devices", arrayOf(e.devices, deviceJson)},
            {"inert", e.without_effect},
            {"reproduction", {e.reproduction[0], e.reproduction[1]}},
            {"shaded", e.subsets},
            {"lights_drawn", e.lights_drawn},
            {"lights_left_out", e.lights_omitted},
            {"nonfinite", e.nonfinite},
            {"drawn", e.frames},
            {"command", of.commands.empty() ? Json(nullptr) : Json(of.commands.front().line)}};
}

nlohmann::ordered_json toJson(const PixelBreakdown& breakdown) {
    const auto [step, term] = breakdown.first();
    Json first = nullptr;
    if (step) first = step->mode->name;
    if (term)
        first = kindOf(*term) +
                (term->kind == PixelTerm::Kind::light ? fmt::format(" {}", term->lights.front()) : "");
    return {{"schema", 1},
            {"scene", breakdown.scene},
            {"camera", breakdown.camera},
            {"pixel", {breakdown.x, breakdown.y}},
            {"size", {breakdown.settings[0].size.width, breakdown.settings[0].size.height}},
            {"baseline", breakdown.names[0]},
            {"test", breakdown.names[1]},
            {"settings", {jsonOf(breakdown.settings[0]), jsonOf(breakdown.settings[1])}},
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
