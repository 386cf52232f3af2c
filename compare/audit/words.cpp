// SPDX-License-Identifier: MIT
#include "compare/audit/words.h"

#include "compare/output/writers.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace diptych::audit {

using Json = nlohmann::ordered_json;

namespace {

Json jsonOf(const Outcome& outcome) {
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

Json jsonOf(const QuantityAudit& audit) {
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
            const std::optional<bool> agree = agrees(audit, c, s);
            series["predicted"][std::string(criteria[c].name)] = {
                {"down", predicted.down},
                {"up", numberOf(predicted.up)},
                {"because", predicted.because},
                {"at_most", predicted.at_most},
                {"agrees", agree ? Json(*agree) : Json(nullptr)}};
        }
        json["series"].push_back(std::move(series));
    }
    json["left_out"] = audit.left_out;
    json["failures"] = Json::array();
    for (const Failure& failure : audit.failures)
        json["failures"].push_back(
            {{"words", failure.words}, {"scene", failure.scene}, {"command", failure.command}});
    return json;
}

// Text of a range between optional ends.
std::string rangeOf(std::optional<double> from, std::optional<double> to) {
    if (from && to) return magnitudeInWords(*from) + " to " + magnitudeInWords(*to);
    if (to) return "up to " + magnitudeInWords(*to);
    return from ? "down to " + magnitudeInWords(*from) : "whole range";
}

}  // namespace

void addAudited(Json& json, const Audited& audited) {
    const ReportDevice& device = audited.device;
    json["scene"] = audited.scene;
    json["camera"] = audited.camera;
    json["settings"] = parseOrderedJson(diptych::toJson(audited.settings));
    json["device"] = {{"name", device.name}, {"driver", device.driver}, {"type", device.type}};
    json["notes"] = audited.notes;
}

Json jsonOf(const Series& series) {
    Json changes = Json::object();
    for (const Change& change : series.changes) changes[change.option] = change.value;
    return {{"path", nameOf(series.path)}, {"settings", changes}};
}

Json numberOf(double value) {
    return std::isfinite(value) ? Json(value) : Json("infinite");
}

std::string magnitudeInWords(double magnitude) {
    return fmt::format("{:.3g}", magnitude);
}

std::string rangeInWords(const ValidRange& range) {
    if (!range.at_original) return "nowhere";
    return rangeOf(range.down.broken ? std::optional(range.down.last) : std::nullopt,
                   range.up.broken ? std::optional(range.up.last) : std::nullopt);
}

std::string rangeInWords(const Predicted& predicted, const QuantityAudit& audit) {
    if (predicted.because.empty()) return "";
    const double first = audit.steps.front().magnitude, last = audit.steps.back().magnitude;
    const std::string range = rangeOf(predicted.down > first ? std::optional(predicted.down) : std::nullopt,
                                      predicted.up < last ? std::optional(predicted.up) : std::nullopt);
    return predicted.at_most ? "at most " + range : range;
}

std::optional<bool> agrees(const QuantityAudit& audit, std::size_t criterion, std::size_t series) {
    const ValidRange& range = audit.valid_ranges[criterion][series];
    const Predicted& predicted = audit.predicted[criterion][series];
    if (predicted.because.empty()) return {};
    const double first = audit.steps.front().magnitude, last = audit.steps.back().magnitude;
    if (!range.at_original) return {};  // another error is larger
    // An upper bound is only refuted by passing beyond it.
    if (predicted.at_most && range.up.broken && range.up.last <= predicted.up) return {};
    return agrees(range.up, predicted.up, true, last) && agrees(range.down, predicted.down, false, first);
}

std::string inWords(const QuantityAudit& audit) {
    const Quantity& quantity = *audit.quantity;
    const std::string unit = quantity.unit.empty() ? "" : " " + std::string(quantity.unit);
    if (!audit.lacks.empty()) return fmt::format("{}: not varied: {}\n", quantity.name, audit.lacks);
    std::string out =
        fmt::format("{}: {}; {} to {}{}, here {}\n", quantity.name, quantity.what,
                    magnitudeInWords(audit.steps.front().magnitude),
                    magnitudeInWords(audit.steps.back().magnitude), unit, magnitudeInWords(audit.original));
    out += fmt::format("    {:<36} {:<22} {:<22} {:<22} {}\n", "", "error < 1e-3", "error < 1e-2",
                       "not visible", "finite");
    for (std::size_t s = 0; s < audit.series.size(); ++s) {
        const auto range = [&](std::size_t c) { return rangeInWords(audit.valid_ranges[c][s]); };
        out += fmt::format("    {:<36} {:<22} {:<22} {:<22} {}\n", audit.series[s].words(), range(0),
                           range(1), range(2), range(3));
        for (std::size_t c = 0; c < audit.predicted.size(); ++c)
            if (const auto agree = agrees(audit, c, s); agree && !*agree)
                out += fmt::format("        predicted for {}: {}, which differs from the measurement\n",
                                   criteria[c].name, rangeInWords(audit.predicted[c][s], audit));
    }
    for (std::size_t s = 0; s < audit.series.size(); ++s)
        for (const Step& step : audit.steps)
            if (const Outcome& outcome = step.outcomes[s]; outcome.whole(Measure::nonfinite_pixels) > 0) {
                out += fmt::format("    {}: {} NaN or infinite at {}{}, the first at {},{}\n",
                                   audit.series[s].words(),
                                   counted(outcome.whole(Measure::nonfinite_pixels), "pixel"),
                                   magnitudeInWords(step.magnitude), unit, outcome.worst_x, outcome.worst_y);
                break;
            }
    for (std::size_t s = 0; s < audit.series.size(); ++s)
        for (const Step& step : audit.steps)
            if (const Outcome& outcome = step.outcomes[s]; !outcome.failed.empty()) {
                out += fmt::format("    {}: not drawn at {}{}: {}\n", audit.series[s].words(),
                                   magnitudeInWords(step.magnitude), unit, outcome.failed);
                break;
            }
    for (const std::string& left : audit.left_out) out += fmt::format("    no series of its own: {}\n", left);
    for (const Failure& failure : audit.failures) {
        out += "    " + failure.words + "\n";
        if (!failure.command.empty()) out += "        " + failure.command + "\n";
    }
    return out;
}

std::string inWords(const Requirement& requirement) {
    return fmt::format("{}: {} as far as {}{}\n", requirement.met ? "pass" : "FAIL", requirement.quantity,
                       magnitudeInWords(requirement.magnitude),
                       requirement.met ? "" : ": " + requirement.because);
}

Json toJson(const Step& step) {
    Json json{{"magnitude", step.magnitude}, {"rows", Json::array()}};
    for (const Outcome& outcome : step.outcomes) json["rows"].push_back(jsonOf(outcome));
    return json;
}

Step stepFromJson(const Json& given) {
    const JsonAt<Json> json(given);
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
    json["steps_kept"] = audit.kept;
    json["to_come"] = audit.to_come;
    for (const char* key : {"quantities", "requirements"}) json[key] = Json::array();
    for (const QuantityAudit& quantity : audit.quantities) json["quantities"].push_back(jsonOf(quantity));
    for (const Requirement& requirement : audit.requirements)
        json["requirements"].push_back({{"quantity", requirement.quantity},
                                        {"magnitude", requirement.magnitude},
                                        {"met", requirement.met},
                                        {"because", requirement.because}});
    // A row has the Settings that differ from the audit's.
    json["rows"] = Json::array();
    for (const QuantityAudit& quantity : audit.quantities)
        for (const Step& step : quantity.steps)
            for (const Outcome& outcome : step.outcomes) {
                Json& row = json["rows"].emplace_back(jsonOf(outcome));
                Json differing = Json::object();
                for (const auto& [key, value] : row["settings"].items())
                    if (json["settings"].value(key, Json()) != value) differing[key] = value;
                row["settings"] = std::move(differing);
            }
    return json;
}

std::vector<const experiment::Row*> allRows(const Audit& audit) {
    std::vector<const experiment::Row*> rows;
    for (const QuantityAudit& quantity : audit.quantities)
        for (const Step& step : quantity.steps)
            for (const Outcome& outcome : step.outcomes) rows.push_back(&outcome);
    return rows;
}

std::string toCsv(const Audit& audit) {
    output::Table table;
    for (const char* title : {"quantity", "magnitude", "unit", "path", "settings", "error", "light", "depth",
                              "flip", "misplaced", "nonfinite", "failed"})
        table.columns.push_back({title});
    const auto digits = [](double value) { return fmt::format("{:.9g}", value); };
    for (const QuantityAudit& of : audit.quantities)
        for (const Step& step : of.steps)
            for (std::size_t s = 0; s < of.series.size(); ++s) {
                const Outcome& outcome = step.outcomes[s];
                std::vector<std::string> changes;
                for (const Change& change : of.series[s].changes)
                    changes.push_back(fmt::format("{}={}", change.option, change.value));
                table.rows.push_back(
                    {{of.quantity->name, digits(step.magnitude), of.quantity->unit, nameOf(of.series[s].path),
                      fmt::format("{}", fmt::join(changes, " ")), digits(outcome.error()),
                      digits(outcome[Measure::light_p99]), digits(outcome[Measure::depth_p99]),
                      digits(outcome[Measure::flip]),
                      std::to_string(outcome.whole(Measure::misplaced_pixels)),
                      std::to_string(outcome.whole(Measure::nonfinite_pixels)), outcome.failed}});
            }
    return inCsv(table);
}

}  // namespace diptych::audit
