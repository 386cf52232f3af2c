// SPDX-License-Identifier: MIT
#include "compare/tradeoff/row.h"

#include "shared/text/json.h"
#include "shared/text/json_at.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace diptych::tradeoff {
namespace {

using Json = nlohmann::ordered_json;
using Place = JsonAt<Json>;

// Upper limit of bytes and pixels in a row, so that sums of rows stay exact.
constexpr std::uint64_t most_counted = std::uint64_t(1) << 48;

template <class Value>
double mean(const TradeoffRow& row, Value&& value) {
    double sum = 0;
    for (const CameraRow& camera : row.cameras) sum += value(camera);
    return row.cameras.empty() ? 0 : sum / static_cast<double>(row.cameras.size());
}

// `figures`: errorFigures, shadowFigures or sampleFigures. Infinity becomes null.
template <class Figures, class Values>
Json jsonOf(const Figures& figures, const Values& values) {
    Json json = Json::object();
    for (std::size_t i = 0; i < values.size(); ++i)
        json[std::string(figures[i].name)] = std::isfinite(values[i]) ? Json(values[i]) : Json(nullptr);
    return json;
}

template <class Figures>
std::array<double, std::tuple_size_v<Figures>> figuresFrom(const Figures& figures, const Place& json) {
    std::array<double, std::tuple_size_v<Figures>> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Place value = json.at(std::string(figures[i].name).c_str());
        values[i] = value.json().is_null() ? std::numeric_limits<double>::infinity() : value.number();
    }
    return values;
}

template <class Figures, class Values>
Json jsonOf(const Figures& figures, const std::optional<Values>& values) {
    return values ? jsonOf(figures, *values) : Json(nullptr);
}

template <class Figures>
std::optional<std::array<double, std::tuple_size_v<Figures>>> figuresIfAny(const Figures& figures,
                                                                           const Place& json) {
    if (json.json().is_null()) return {};
    return figuresFrom(figures, json);
}

// Mean over the cameras; empty if a camera has no value.
template <class Values>
std::optional<Values> meanOf(const TradeoffRow& row, std::optional<Values> CameraRow::*figures) {
    const auto known = [&](const CameraRow& camera) { return (camera.*figures).has_value(); };
    if (row.cameras.empty() || !std::ranges::all_of(row.cameras, known)) return {};
    Values means{};
    for (std::size_t i = 0; i < means.size(); ++i)
        means[i] = mean(row, [&](const CameraRow& camera) { return (*(camera.*figures))[i]; });
    return means;
}

Json jsonOf(const std::vector<PassTime>& passes) {
    Json json = Json::array();
    for (const PassTime& pass : passes) json.push_back({{"name", pass.name}, {"ms", pass.ms}});
    return json;
}

Json jsonOf(const FrameTime& time) {
    return {{"median", time.median}, {"min", time.min}, {"max", time.max}, {"runs", time.runs}};
}

Json jsonOf(const CameraRow& camera) {
    Json blocks = Json::array();
    for (const FrameTime& block : camera.blocks) blocks.push_back(jsonOf(block));
    return {{"camera", camera.camera},
            {"ms", jsonOf(timeOf(camera))},
            {"visits", blocks},
            {"passes", jsonOf(camera.passes)},
            {"bytes",
             {{"images", camera.bytes.images},
              {"buffers", camera.bytes.buffers},
              {"gbuffer_per_pixel", camera.bytes.gbuffer_per_pixel}}},
            {"errors", jsonOf(errorFigures, camera.errors)},
            {"shadow", jsonOf(shadowFigures, camera.shadow)},
            {"samples", jsonOf(sampleFigures, camera.samples)},
            {"pixels", camera.pixels}};
}

FrameTime timeFrom(const Place& json) {
    return {json.at("median").number(), json.at("min").number(), json.at("max").number(),
            json.at("runs").whole<int>(0, 1'000'000)};
}

CameraRow cameraFrom(const Place& json) {
    CameraRow camera;
    camera.camera = json.at("camera").text();
    for (const Place& block : json.at("visits").each()) camera.blocks.push_back(timeFrom(block));
    for (const Place& pass : json.at("passes").each())
        camera.passes.push_back({pass.at("name").text(), pass.at("ms").number()});
    const auto counted = [](const Place& of, const char* name) {
        return of.at(name).whole<std::uint64_t>(0, most_counted);
    };
    const Place bytes = json.at("bytes");
    camera.bytes = {counted(bytes, "images"), counted(bytes, "buffers"), counted(bytes, "gbuffer_per_pixel")};
    camera.errors = figuresFrom(errorFigures, json.at("errors"));
    camera.shadow = figuresIfAny(shadowFigures, json.at("shadow"));
    camera.samples = figuresIfAny(sampleFigures, json.at("samples"));
    camera.pixels = counted(json, "pixels");
    return camera;
}

}  // namespace

FrameTime timeOf(const CameraRow& camera) {
    if (camera.blocks.empty()) return {};
    FrameTime time = camera.blocks.front();
    time.median = 0;
    time.runs = 0;
    for (const FrameTime& block : camera.blocks) {
        time.median += block.median / static_cast<double>(camera.blocks.size());
        time.min = std::min(time.min, block.min);
        time.max = std::max(time.max, block.max);
        time.runs += block.runs;
    }
    return time;
}

Spread timeOf(const TradeoffRow& row) {
    return {mean(row, [](const CameraRow& c) { return timeOf(c).median; }),
            mean(row, [](const CameraRow& c) { return timeOf(c).min; }),
            mean(row, [](const CameraRow& c) { return timeOf(c).max; })};
}

Spread errorOf(const TradeoffRow& row, std::size_t figure) {
    Spread spread{row.errors[figure], row.errors[figure], row.errors[figure]};
    for (const CameraRow& camera : row.cameras) {
        spread.low = std::min(spread.low, camera.errors[figure]);
        spread.high = std::max(spread.high, camera.errors[figure]);
    }
    return spread;
}

std::vector<PassTime> passesOf(const TradeoffRow& row) {
    std::vector<PassTime> passes;
    for (const CameraRow& camera : row.cameras)
        for (const PassTime& pass : camera.passes) {
            const double share = pass.ms / static_cast<double>(row.cameras.size());
            const auto known = std::ranges::find(passes, pass.name, &PassTime::name);
            if (known != passes.end())
                known->ms += share;
            else
                passes.push_back({pass.name, share});
        }
    return passes;
}

FrameBytes bytesOf(const TradeoffRow& row) {
    FrameBytes most;
    for (const CameraRow& camera : row.cameras)
        if (camera.bytes.images + camera.bytes.buffers >= most.images + most.buffers) most = camera.bytes;
    return most;
}

std::uint64_t memoryOf(const TradeoffRow& row) {
    const FrameBytes bytes = bytesOf(row);
    return bytes.images + bytes.buffers;
}

std::optional<ShadowErrors> shadowOf(const TradeoffRow& row) {
    return meanOf(row, &CameraRow::shadow);
}

std::optional<SampleShares> samplesOf(const TradeoffRow& row) {
    return meanOf(row, &CameraRow::samples);
}

Json jsonOf(const TradeoffRow& row) {
    Json cameras = Json::array();
    for (const CameraRow& camera : row.cameras) cameras.push_back(jsonOf(camera));
    const Spread time = timeOf(row);
    const FrameBytes bytes = bytesOf(row);
    return {{"settings", parseOrderedJson(toJson(row.settings))},
            {"renderer", row.renderer.empty() ? Json(nullptr) : Json(row.renderer)},
            {"ms", {{"median", time.value}, {"min", time.low}, {"max", time.high}}},
            {"passes", jsonOf(passesOf(row))},
            {"bytes",
             {{"images", bytes.images},
              {"buffers", bytes.buffers},
              {"gbuffer_per_pixel", bytes.gbuffer_per_pixel}}},
            {"errors", jsonOf(errorFigures, row.errors)},
            {"shadow", jsonOf(shadowFigures, shadowOf(row))},
            {"samples", jsonOf(sampleFigures, samplesOf(row))},
            {"cameras", cameras},
            {"drawing_ms", row.drawing_ms},
            {"picture", row.picture},
            {"error_picture", row.errors_map},
            {"warnings", row.warnings}};
}

TradeoffRow tradeoffRowFrom(const Json& given) {
    const Place json(given);
    TradeoffRow row;
    row.settings = settingsFromJson(json.at("settings").json().dump());
    for (const Place& camera : json.at("cameras").each()) row.cameras.push_back(cameraFrom(camera));
    row.errors = figuresFrom(errorFigures, json.at("errors"));
    row.drawing_ms = json.at("drawing_ms").number();
    row.picture = json.at("picture").text();
    row.errors_map = json.at("error_picture").text();
    row.warnings = json.at("warnings").texts();
    return row;
}

}  // namespace diptych::tradeoff
