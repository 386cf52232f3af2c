// SPDX-License-Identifier: MIT
#include "compare/audit/report.h"
#include "compare/files/frame_json.h"
#include "shared/frame/debug_modes.h"

#include <cmath>

namespace diptych::audit {

using Json = nlohmann::ordered_json;

namespace {

// A number, or the string "infinite", which JSON numbers cannot express.
Json numberOf(double value) {
    return std::isfinite(value) ? Json(value) : Json("infinite");
}

// Scene, camera, Settings, device and notes.
void addAudited(Json& json, const Audited& audited) {
    json["scene"] = audited.scene;
    json["camera"] = audited.camera;
    json["settings"] = diptych::jsonOf(audited.settings);
    json["device"] = diptych::jsonOf(audited.device);
    json["notes"] = audited.notes;
}

// Path and changed Settings.
Json jsonOf(const Series& series) {
    Json changes = Json::object();
    for (const Change& change : series.changes) changes[change.option] = change.value;
    return {{"path", nameOf(series.path)}, {"settings", changes}};
}

Json outcomeJson(const Outcome& outcome) {
    Json json = experiment::jsonOf(outcome);
    json["error"] = numberOf(outcome.error());
    json["worst"] = {outcome.worst_x, outcome.worst_y};
    return json;
}

Json jsonOf(const BreakingPoint& point) {
    return {{"last", point.last}, {"first_beyond", point.broken ? Json(point.first) : Json(nullptr)}};
}

Json jsonOf(const ValidRange& range) {
    if (!range.at_original) return nullptr;
    return {{"down", jsonOf(range.down)}, {"up", jsonOf(range.up)}};
}

Json quantityJson(const QuantityAudit& audit) {
    const Quantity& quantity = *audit.quantity;
    Json json{{"quantity", quantity.name}, {"unit", quantity.unit}, {"what", quantity.what}};
    if (!audit.lacks.empty()) {
        json["not_pushed"] = audit.lacks;
        return json;
    }
    json["usual"] = audit.original;
    json["series"] = Json::array();
    for (std::size_t s = 0; s < audit.series.size(); ++s) {
        Json series = jsonOf(audit.series[s]);
        for (std::size_t c = 0; c < criterionCount; ++c)
            series["holds"][std::string(criteria[c].name)] = jsonOf(audit.valid_ranges[c][s]);
        for (std::size_t c = 0; c < audit.predicted.size(); ++c) {
            const Predicted& predicted = audit.predicted[c][s];
            if (predicted.because.empty()) continue;
            series["predicted"][std::string(criteria[c].name)] = {{"down", predicted.down},
                                                                  {"up", numberOf(predicted.up)},
                                                                  {"because", predicted.because},
                                                                  {"at_most", predicted.at_most},
                                                                  {"agrees", orNull(agrees(audit, c, s))}};
        }
        json["series"].push_back(std::move(series));
    }
    json["left_out"] = audit.omitted;
    json["failures"] = arrayOf(audit.failures, [](const Failure& failure) -> Json {
        return {{"words", failure.text}, {"scene", failure.scene}, {"command", failure.command}};
    });
    return json;
}

Json jsonOf(const SeriesResult& of, const Relation& relation) {
    Json json = jsonOf(of.series);
    json["verdict"] = verdictOf(of);
    if (!of.lacks.empty()) {
        json["because"] = of.lacks;
        return json;
    }
    if (!of.comparison.failed.empty()) json["failed"] = of.comparison.failed;
    json["tolerance"] = of.tolerance.describe();
    json["pixels"] = {{"covered", of.comparison.covered},
                      {"set_aside", of.comparison.excluded},
                      {"most_set_aside", of.comparison.max_excluded},
                      {"filtered_otherwise", of.comparison.filtered},
                      {"most_filtered_otherwise", of.comparison.max_filtered}};
    json["channels"] = arrayOf(of.comparison.channels, [](const ChannelResult& channel) -> Json {
        return {{"name", debugMode(channel.mode).name},  {"error", numberOf(channel.error)},
                {"allowed", numberOf(channel.allowed)},  {"used", numberOf(channel.used)},
                {"worst_pixel", {channel.x, channel.y}}, {"pixels_beyond", channel.beyond}};
    });
    if (of.changed)
        for (const char* shown : {"given", "changed", "used"})
            json["pictures"].push_back(imageName(relation, of.series, shown));
    return json;
}

}  // namespace

Json toJson(const Step& step) {
    return {{"magnitude", step.magnitude}, {"rows", arrayOf(step.outcomes, outcomeJson)}};
}

Step stepFromJson(const Json& original) {
    const JsonAt<Json> json(original);
    Step step{json.at("magnitude").number(), {}};
    for (const JsonAt<Json>& one : json.at("rows").each()) {
        Outcome& outcome = step.outcomes.emplace_back(Outcome{experiment::rowFrom(one)});
        outcome.worst_x = one.at("worst")[0].whole<int>(-1, 1 << 20);
        outcome.worst_y = one.at("worst")[1].whole<int>(-1, 1 << 20);
    }
    return step;
}

Json toJson(const Audit& audit) {
    Json json{{"schema", 2}};
    addAudited(json, audit);
    json["steps_kept"] = audit.resumed;
    json["to_come"] = audit.to_come;
    json["quantities"] = arrayOf(audit.quantities, quantityJson);
    json["requirements"] = arrayOf(audit.requirements, [](const Requirement& requirement) -> Json {
        return {{"quantity", requirement.quantity},
                {"magnitude", requirement.magnitude},
                {"met", requirement.met},
                {"because", requirement.because}};
    });
    // A row has the Settings that differ from the audit's.
    json["rows"] = Json::array();
    for (const QuantityAudit& quantity : audit.quantities)
        for (const Step& step : quantity.steps)
            for (const Outcome& outcome : step.outcomes) {
                Json& row = json["rows"].emplace_back(outcomeJson(outcome));
                Json differing = Json::object();
                for (const auto& [key, value] : row["settings"].items())
                    if (json["settings"].value(key, Json()) != value) differing[key] = value;
                row["settings"] = std::move(differing);
            }
    return json;
}

Json toJson(const RelationAudit& audit) {
    Json json{{"schema", 1}, {"verdict", audit.passes() ? "pass" : "fail"}};
    addAudited(json, audit);
    json["relations"] = Json::array();
    for (const RelationResult& of : audit.relations) {
        const Relation& relation = *of.relation;
        Json one{{"name", relation.name},
                 {"changes", relation.changes},
                 {"alike", nameOf(relation.equality)},
                 {"because", relation.because},
                 {"verdict", verdictOf(of)}};
        if (!of.lacks.empty()) one["lacks"] = of.lacks;
        if (const std::string blame = blameText(of, audit.device); !blame.empty()) one["blame"] = blame;
        one["series"] =
            arrayOf(of.series, [&](const SeriesResult& series) { return jsonOf(series, relation); });
        json["relations"].push_back(std::move(one));
    }
    return json;
}

}  // namespace diptych::audit
