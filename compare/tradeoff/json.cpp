// SPDX-License-Identifier: MIT
#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/run/version.h"
#include "compare/tradeoff/tradeoff.h"

#include <span>

namespace diptych::tradeoff {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const std::vector<Change>& choices) {
    Json json = Json::object();
    for (const auto& [option, value] : choices) json[option] = value;
    return json;
}

// Row numbers start at 1, as in the table and on the page.
Json numbersOf(const std::vector<std::size_t>& rows) {
    return arrayOf(rows, [](std::size_t row) { return row + 1; });
}

Json frontsOf(const Tradeoff& tradeoff) {
    Json fronts = Json::array();
    for (std::size_t metric = 0; metric < errorMetrics.size(); ++metric) {
        const auto add = [&](std::optional<Path> path) {
            fronts.push_back({{"error", errorMetrics[metric].name},
                              {"path", path ? Json(nameOf(*path)) : Json(nullptr)},
                              {"rows", numbersOf(frontOf(tradeoff, metric, path))}});
        };
        add({});
        for (const Path path : pathsOf(tradeoff)) add(path);
    }
    return fronts;
}

Json metricsJson(std::span<const experiment::NamedMeasure> metrics) {
    return arrayOf(metrics, [](const experiment::NamedMeasure& metric) -> Json {
        return {{"name", metric.name}, {"title", metric.title}, {"means", metric.means}};
    });
}

}  // namespace

Json jsonOf(const TradeoffRow& row) {
    Json json = experiment::jsonOf(row);
    json["drawing_ms"] = row.drawing_ms;
    json["picture"] = row.image;
    json["error_picture"] = row.errors_map;
    return json;
}

TradeoffRow tradeoffRowFrom(const Json& object) {
    const JsonAt<Json> json(object);
    return {experiment::rowFrom(json), json.at("drawing_ms").number(), json.at("picture").text(),
            json.at("error_picture").text()};
}

Json tradeoffJson(const Tradeoff& tradeoff) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i) {
        const TradeoffRow& row = tradeoff.rows[i];
        Json json{{"row", i + 1},
                  {"differs", row.renderer.empty() ? jsonOf(changesOf(row.settings, tradeoff.requested))
                                                   : Json::object()}};
        json.update(jsonOf(row));
        json["measure"] = measuringCommand(tradeoff, row);
        json["render"] = orNull(renderingCommand(tradeoff, row));
        json["compare"] = orNull(comparingCommand(tradeoff, row));
        rows.push_back(std::move(json));
    }
    const auto skipJson = [](const SweepSkip& skip) -> Json {
        return {{"tried", jsonOf(skip.tried)}, {"reason", skip.reason}};
    };
    const SweepCost& cost = tradeoff.cost;
    const std::optional<CameraRange> drift = driftOf(tradeoff);
    return {{"schema", 1},
            {"software", softwareName},
            {"commit", commitName()},
            {"device", jsonOf(tradeoff.device)},
            {"scene", tradeoff.scene},
            {"cameras", tradeoff.cameras},
            {"runs", tradeoff.runs},
            {"settings", jsonOf(tradeoff.requested)},
            {"reference", {{"settings", jsonOf(tradeoff.reference)}, {"picture", tradeoff.reference_image}}},
            {"errors", metricsJson(errorMetrics)},
            {"shadow_figures", metricsJson(shadowMetrics)},
            {"sample_figures", metricsJson(sampleMetrics)},
            {"rows", rows},
            {"fronts", frontsOf(tradeoff)},
            {"skipped", arrayOf(tradeoff.skips, skipJson)},
            {"notes", tradeoff.notes},
            {"rows_kept", tradeoff.resumed_rows},
            {"second_visit", drift ? Json{{"median", drift->value}, {"min", drift->low}, {"max", drift->high}}
                                   : Json(nullptr)},
            {"cost_ms",
             {{"whole", cost.whole},
              {"reading", cost.reading},
              {"reference", cost.reference},
              {"drawing", cost.drawing},
              {"beyond", cost.beyond()}}}};
}

}  // namespace diptych::tradeoff
