// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"
#include "compare/files/frame_json.h"

namespace diptych::choose {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const std::optional<Settings>& settings) {
    return settings ? jsonOf(*settings) : Json();
}

Json jsonOf(const TimeRatio& of) {
    return {{"ratio", of.ratio}, {"low", of.low}, {"high", of.high}, {"pairs", of.pairs}};
}

template <class Report>
void addCandidate(Json& candidate, const Report& report, std::size_t i) {
    candidate["words"] = report.words[i];
    candidate["command"] = report.commands[i];
    if (report.choice.candidates[i].race) candidate["race"] = jsonOf(*report.choice.candidates[i].race);
}

template <class Report>
void addOutcome(Json& json, const Report& report) {
    const auto& choice = report.choice;
    json["settings"] = jsonOf(chosenSettings(choice));
    json["chosen"] = orNull(choice.chosen);
    json["runner_up"] = orNull(choice.runner_up);
    json["nearest"] = orNull(choice.nearest);
    json["ties"] = choice.ties;
    json["sure"] = choice.significant;
    json["judged"] = choice.evaluated;
    json["frames_timed"] = choice.timings;
    json["seconds"] = report.seconds;
}

Json propertyJson(const PropertySensitivity& sensitivity) {
    const Property& property = sensitivity.property;
    const auto timeJson = [](const TimedValue& at) -> Json {
        return {{"value", at.value},
                {"ms", at.ms[0]},
                {"other_ms", at.ms[1]},
                {"difference", at.difference},
                {"half_interval", at.half_width}};
    };
    Json json{{"name", property.name},
              {"value", property.value},
              {"unit", property.unit},
              {"how", property.how},
              {"times", arrayOf(sensitivity.times, timeJson)}};
    json["open"] = orNull(sensitivity.open);
    if (!property.few_values) json["looked_at"] = {property.min, property.max};
    if (!property.not_varied.empty()) json["not_varied"] = property.not_varied;
    json["crossing"] = Json();
    if (const auto& at = sensitivity.break_even)
        json["crossing"] = {{"value", at->value},
                            {"low", at->low},
                            {"high", at->high},
                            {"extrapolated", at->extrapolated},
                            {"other_is_faster", at->other_above ? "above" : "below"}};
    json["turns_at"] = orNull(sensitivity.reversed_at);
    return json;
}

Json jsonOf(const SensitivityReport& report) {
    return {{"chosen", report.chosen},
            {"other", report.other},
            {"other_fits", report.other_fits},
            {"ms", report.as_is.ms[0]},
            {"other_ms", report.as_is.ms[1]},
            {"frames", report.frames},
            {"properties", arrayOf(report.properties, propertyJson)}};
}

Json sceneJson(const ChoiceReport& report) {
    const Budget& budget = report.budget;
    Json json{
        {"schema", 2},
        {"scene", report.scene},
        {"cameras", report.cameras},
        {"device", jsonOf(report.device)},
        {"figure", named(budget.metric).name},
        {"budget",
         {{"error", orNull(budget.error)}, {"ms", orNull(budget.ms)}, {"bytes", orNull(budget.bytes)}}}};
    addOutcome(json, report);
    json["why"] = whyText(report);
    if (report.sensitivities) json["deciders"] = jsonOf(*report.sensitivities);
    Json rows = Json::array();
    for (std::size_t i = 0; i < report.choice.candidates.size(); ++i) {
        Json& row = rows.emplace_back(experiment::jsonOf(report.choice.candidates[i]));
        row["frames_timed"] = report.choice.candidates[i].timings;
        addCandidate(row, report, i);
    }
    json["unseen_cameras"] = arrayOf(report.held_out, [](const HeldOutCamera& camera) -> Json {
        return {{"camera", camera.camera}, {"error", camera.error}, {"holds", camera.holds}};
    });
    json["notes"] = report.notes;
    json["rows"] = std::move(rows);
    return json;
}

Json jsonOf(const JointReport& report) {
    const JointChoice& choice = report.choice;
    Json json, candidates = Json::array();
    addOutcome(json, report);
    json["left_out"] = choice.omitted;
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const JointCandidate& candidate = choice.candidates[i];
        Json rows = Json::array();
        for (std::size_t scene = 0; scene < candidate.scenes.size(); ++scene) {
            Json& row = rows.emplace_back(experiment::jsonOf(candidate.scenes[scene]));
            if (i == choice.chosen && choice.slower[scene]) row["to_its_own"] = jsonOf(*choice.slower[scene]);
        }
        Json& one = candidates.emplace_back(Json{{"settings", jsonOf(candidate.settings)},
                                                 {"fits", candidate.fits},
                                                 {"proposed_by", candidate.proposed_by},
                                                 {"rows", std::move(rows)}});
        addCandidate(one, report, i);
    }
    json["candidates"] = std::move(candidates);
    return json;
}

}  // namespace

nlohmann::ordered_json toJson(const Choices& choices) {
    if (!choices.all) return sceneJson(choices.scenes.front());
    return {{"schema", 2},
            {"settings", jsonOf(chosenSettings(choices))},
            {"all", jsonOf(*choices.all)},
            {"scenes", arrayOf(choices.scenes, sceneJson)}};
}

}  // namespace diptych::choose
