// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"

#include "compare/page/text.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych::choose {

using Json = nlohmann::ordered_json;

namespace {

std::string percent(double ratio) {
    return fmt::format("{:.1f} %", 100 * (ratio - 1));
}

std::string finalistWords(const ChoiceReport& report, std::size_t i) {
    return fmt::format("{}: {}", report.words[i], longerInWords(*report.choice.candidates[i].race));
}

std::vector<std::string> missesInWords(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    if (!choice.nearest) return {};
    const Candidate& nearest = choice.candidates[*choice.nearest];
    std::vector<std::string> lines;
    const Budget& budget = report.budget;
    const auto gap = [&](double value, double limit, const char* what, const std::string& limit_text) {
        if (value > limit)
            lines.push_back(
                fmt::format("{} over the {} budget of {}", percent(value / limit), what, limit_text));
    };
    if (budget.error)
        gap(nearest[budget.figure], *budget.error, "error", fmt::format("{:.4g}", *budget.error));
    if (budget.ms && nearest.timings > 0)
        gap(choice.ms, *budget.ms, "time", fmt::format("{:.4g} ms", *budget.ms));
    if (budget.bytes)
        gap(nearest[Measure::memory], static_cast<double>(*budget.bytes), "memory",
            page::bytes(*budget.bytes));
    return lines;
}

void addHeldOut(const ChoiceReport& report, std::vector<std::string>& lines) {
    if (report.held_out.empty())
        lines.push_back(std::string("not checked from another camera: the scene has no other"));
    for (const HeldOutCamera& camera : report.held_out)
        lines.push_back(
            fmt::format("checked from camera {}, which the choice did not use: {} {:.4g}{}", camera.camera,
                        report.figure(), camera.error,
                        camera.holds ? "" : ", over the budget: name both cameras with --camera"));
}

// Compares the chosen Settings with the other path's best fitting ones, pass by pass.
std::string whyInWords(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    if (!choice.chosen) return {};
    const Candidate& chosen = choice.candidates[*choice.chosen];
    const bool forSpeed = report.budget.isForSpeed();
    const std::optional<std::size_t> best = bestOfOtherPath(choice, report.budget);
    if (!best) return "the other path: no measured settings fit";
    const Candidate& other = choice.candidates[*best];
    std::map<std::string, std::pair<double, double>> passes;  // chosen, other
    for (const PassTime& pass : chosen.passes) passes[pass.name].first += pass.ms;
    for (const PassTime& pass : other.passes) passes[pass.name].second += pass.ms;
    std::vector<std::pair<double, std::string>> parts;
    constexpr double worthTelling = 0.03;  // fraction of a frame
    for (const auto& [name, ms] : passes)
        if (std::abs(ms.first - ms.second) > worthTelling * other.ms())
            parts.emplace_back(-std::abs(ms.first - ms.second),
                               fmt::format("{} {:.3g} against {:.3g}", name, ms.second, ms.first));
    std::ranges::sort(parts);
    std::string line = fmt::format("the other path: the {} settings that fit are {}, {:.3g} ms",
                                   forSpeed ? "fastest" : "most accurate", report.words[*best], other.ms());
    if (!forSpeed)
        line += fmt::format(", {} {:.3g} against {:.3g}", report.figure(), other[report.budget.figure],
                            chosen[report.budget.figure]);
    for (std::size_t i = 0; i < parts.size(); ++i)
        line += (i == 0 ? "; passes, ms: " : ", ") + parts[i].second;
    return line;
}

// "12 drawn and no better"
std::string fatesInWords(const Choice& choice) {
    std::map<CandidateStatus, std::size_t> counts;
    for (const Candidate& candidate : choice.candidates) ++counts[candidate.status];
    std::vector<std::string> words;
    for (const CandidateStatus status :
         {CandidateStatus::raced, CandidateStatus::fits, CandidateStatus::too_slow, CandidateStatus::misses,
          CandidateStatus::slower})
        if (counts[status] > 0) words.push_back(fmt::format("{} {}", counts[status], statusInWords(status)));
    return fmt::format("{}", fmt::join(words, ", "));
}

nlohmann::ordered_json candidateJson(const ChoiceReport& report, std::size_t i) {
    const Candidate& candidate = report.choice.candidates[i];
    Json json = experiment::jsonOf(candidate);
    json["words"] = report.words[i];
    json["command"] = report.commands[i];
    json["frames_timed"] = candidate.timings;
    if (candidate.race) json["race"] = jsonOf(*candidate.race);
    return json;
}

}  // namespace

const char* nameOf(CandidateStatus status) {
    switch (status) {
        case CandidateStatus::slower:
            return "slower";
        case CandidateStatus::misses:
            return "misses";
        case CandidateStatus::too_slow:
            return "too slow";
        case CandidateStatus::fits:
            return "fits";
        case CandidateStatus::raced:
            return "raced";
    }
    return "";
}

Json jsonOf(const TimeRatio& of) {
    return {{"ratio", of.ratio}, {"low", of.low}, {"high", of.high}, {"pairs", of.pairs}};
}

std::string longerInWords(const TimeRatio& of) {
    return fmt::format("takes {:.1f} % {} ({:+.1f} % to {:+.1f} %)", 100 * std::abs(of.ratio - 1),
                       of.ratio < 1 ? "less time" : "longer", 100 * (of.low - 1), 100 * (of.high - 1));
}

std::string figuresInWords(const ChoiceReport& report, std::size_t i) {
    const Candidate& candidate = report.choice.candidates[i];
    std::string text = candidate.timings > 0 ? fmt::format("{:.4g} ms", candidate.ms()) : "not timed";
    if (candidate.isJudged())
        text += fmt::format(", {} {:.4g}, {}", report.figure(), candidate[report.budget.figure],
                            page::bytes(candidate.whole(Measure::memory)));
    return text;
}

const char* statusInWords(CandidateStatus status) {
    switch (status) {
        case CandidateStatus::slower:
            return "slower, error not measured";
        case CandidateStatus::misses:
            return "over the error or memory budget";
        case CandidateStatus::too_slow:
            return "too slow";
        case CandidateStatus::fits:
            return "no better";
        case CandidateStatus::raced:
            return "timed against each other";
    }
    return "";
}

std::vector<std::string> reasonsInWords(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    if (!choice.chosen) return missesInWords(report);
    std::vector<std::string> lines{whyInWords(report)};
    if (choice.runner_up && std::ranges::count(choice.ties, *choice.runner_up) == 0)
        lines.push_back("runner-up: " + finalistWords(report, *choice.runner_up));
    for (const std::size_t i : choice.ties)
        lines.push_back("not measurably slower: " + finalistWords(report, i));
    if (choice.significant)
        lines.push_back(fmt::format("significant: every other finalist is slower, at {:.0f} % confidence",
                                    100 * rankingConfidence));
    addHeldOut(report, lines);
    return lines;
}

std::string goalInWords(const ChoiceReport& report) {
    const Budget& budget = report.budget;
    std::vector<std::string> limits;
    if (budget.error) limits.push_back(fmt::format("{} at most {:.4g}", report.figure(), *budget.error));
    if (budget.ms) limits.push_back(fmt::format("at most {:.4g} ms", *budget.ms));
    if (budget.bytes) limits.push_back(fmt::format("at most {}", page::bytes(*budget.bytes)));
    return fmt::format("the {} with {}", budget.isForSpeed() ? "fastest" : "most accurate",
                       fmt::join(limits, " and "));
}

std::string inWords(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    std::string text =
        fmt::format("{}, {}x{}, {}: {}\n", report.scene, report.given.size.width, report.given.size.height,
                    fmt::join(report.cameras, "; "), goalInWords(report));
    if (!choice.chosen && !choice.nearest) text += "no candidate could be drawn\n";
    if (!choice.chosen && choice.nearest)
        text += fmt::format("nothing fits; the nearest is {}\n", report.words[*choice.nearest]);
    if (choice.chosen) text += report.words[*choice.chosen] + "\n";
    if (const auto shown = choice.chosen ? choice.chosen : choice.nearest)
        text += fmt::format("    {}\n", figuresInWords(report, *shown));
    for (const std::string& line : reasonsInWords(report)) text += "  " + line + "\n";
    if (report.sensitivities)
        for (const std::string& line : inWords(*report.sensitivities)) text += "  " + line + "\n";
    text += fmt::format("  {}: {}\n  {} compared, {} timed, {:.1f} s\n",
                        counted(choice.candidates.size(), "candidate"), fatesInWords(choice),
                        counted(choice.judged, "picture"), counted(choice.timings, "frame"), report.seconds);
    for (const std::string& note : report.notes) text += fmt::format("note: {}\n", note);
    if (choice.chosen) text += report.commands[*choice.chosen] + "\n";
    return text;
}

nlohmann::ordered_json toJson(const ChoiceReport& report) {
    const Choice& choice = report.choice;
    Json ties = Json::array(), candidates = Json::array(), held_out = Json::array();
    for (const std::size_t i : choice.ties) ties.push_back(i);
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) candidates.push_back(candidateJson(report, i));
    for (const HeldOutCamera& camera : report.held_out)
        held_out.push_back({{"camera", camera.camera}, {"error", camera.error}, {"holds", camera.holds}});
    const auto place = [](const std::optional<std::size_t>& i) { return i ? Json(*i) : Json(); };
    const auto limit = [](const auto& value) { return value ? Json(*value) : Json(); };
    Json json{
        {"schema", 2},
        {"scene", report.scene},
        {"cameras", report.cameras},
        {"device",
         {{"name", report.device.name}, {"driver", report.device.driver}, {"type", report.device.type}}},
        {"figure", named(report.budget.figure).name},
        {"budget",
         {{"error", limit(report.budget.error)},
          {"ms", limit(report.budget.ms)},
          {"bytes", limit(report.budget.bytes)}}}};
    json["settings"] =
        choice.chosen ? parseOrderedJson(toJson(choice.candidates[*choice.chosen].settings)) : Json();
    json["chosen"] = place(choice.chosen);
    json["runner_up"] = place(choice.runner_up);
    json["nearest"] = place(choice.nearest);
    json["ties"] = std::move(ties);
    json["sure"] = choice.significant;
    json["why"] = whyInWords(report);
    if (report.sensitivities) json["deciders"] = toJson(*report.sensitivities);
    json["unseen_cameras"] = std::move(held_out);
    json["judged"] = choice.judged;
    json["frames_timed"] = choice.timings;
    json["seconds"] = report.seconds;
    json["notes"] = report.notes;
    json["rows"] = std::move(candidates);
    return json;
}

}  // namespace diptych::choose
