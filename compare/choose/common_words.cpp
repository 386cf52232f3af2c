// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"
#include "compare/page/text.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::choose {

using Json = nlohmann::ordered_json;

namespace {

// Time, error and memory in one scene.
std::string figuresIn(const CommonCandidate& candidate, std::size_t scene, const ChoiceReport& first) {
    const experiment::Row& in = candidate.scenes[scene];
    return fmt::format("{}{} {:.4g}, {}",
                       in.measured.has(Measure::ms) ? fmt::format("{:.4g} ms, ", in[Measure::ms]) : "",
                       first.figure(), in[first.budget.figure], page::bytes(in.whole(Measure::memory)));
}

std::string slowdownInWords(const std::optional<TimeRatio>& slower) {
    if (!slower) return "; the scene has no choice of its own";
    if (slower->low == slower->high) return "; its own choice";
    return "; against its own choice: " + longerInWords(*slower);
}

std::string commonFinalist(const CommonReport& report, std::size_t i) {
    return fmt::format("{}: over all scenes {}", report.words[i],
                       longerInWords(*report.choice.candidates[i].race));
}

nlohmann::ordered_json commonJson(const CommonReport& report) {
    const CommonChoice& choice = report.choice;
    const auto place = [](const std::optional<std::size_t>& i) { return i ? Json(*i) : Json(); };
    Json candidates = Json::array();
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const CommonCandidate& candidate = choice.candidates[i];
        Json scenes = Json::array();
        for (std::size_t scene = 0; scene < candidate.scenes.size(); ++scene) {
            Json one = experiment::jsonOf(candidate.scenes[scene]);
            if (i == choice.chosen && choice.slower[scene]) one["to_its_own"] = jsonOf(*choice.slower[scene]);
            scenes.push_back(std::move(one));
        }
        Json json{{"settings", parseOrderedJson(toJson(candidate.settings))},
                  {"words", report.words[i]},
                  {"command", report.commands[i]},
                  {"fits", candidate.fits},
                  {"proposed_by", candidate.proposed_by},
                  {"rows", std::move(scenes)}};
        if (candidate.race) json["race"] = jsonOf(*candidate.race);
        candidates.push_back(std::move(json));
    }
    Json json{{"chosen", place(choice.chosen)},   {"runner_up", place(choice.runner_up)},
              {"nearest", place(choice.nearest)}, {"ties", choice.ties},
              {"sure", choice.significant},       {"left_out", choice.left_out},
              {"judged", choice.judged},          {"frames_timed", choice.timings},
              {"seconds", report.seconds}};
    json["settings"] =
        choice.chosen ? parseOrderedJson(toJson(choice.candidates[*choice.chosen].settings)) : Json();
    json["candidates"] = std::move(candidates);
    return json;
}

}  // namespace

std::vector<const experiment::Row*> allRows(const Choices& choices) {
    std::vector<const experiment::Row*> rows;
    const auto add = [&](const auto& more) {
        for (const experiment::Row& row : more) rows.push_back(&row);
    };
    for (const ChoiceReport& report : choices.scenes) add(report.choice.candidates);
    if (choices.all)
        for (const CommonCandidate& candidate : choices.all->choice.candidates) add(candidate.scenes);
    return rows;
}

std::optional<Settings> chosenSettings(const Choices& choices) {
    if (choices.all) {
        const CommonChoice& choice = choices.all->choice;
        return choice.chosen ? std::optional(choice.candidates[*choice.chosen].settings) : std::nullopt;
    }
    const Choice& choice = choices.scenes.front().choice;
    return choice.chosen ? std::optional(choice.candidates[*choice.chosen].settings) : std::nullopt;
}

std::vector<std::string> reasonsInWords(const CommonReport& report, const ChoiceReport& first) {
    const CommonChoice& choice = report.choice;
    std::vector<std::string> lines;
    if (choice.nearest) {
        const CommonCandidate& nearest = choice.candidates[*choice.nearest];
        const double miss = missOf(nearest.scenes[choice.nearest_scene].measured, first.budget);
        lines.push_back(fmt::format("{}: {}, {:.1f} % over the budget", report.scenes[choice.nearest_scene],
                                    figuresIn(nearest, choice.nearest_scene, first), 100 * miss));
    }
    if (choice.chosen) {
        if (choice.runner_up && std::ranges::count(choice.ties, *choice.runner_up) == 0)
            lines.push_back("runner-up: " + commonFinalist(report, *choice.runner_up));
        for (const std::size_t i : choice.ties)
            lines.push_back("not measurably slower: " + commonFinalist(report, i));
        if (choice.significant)
            lines.push_back(fmt::format(
                "significant: every other finalist is slower over all scenes, at {:.0f} % confidence",
                100 * rankingConfidence));
    }
    const auto fit = std::ranges::count(choice.candidates, true, &CommonCandidate::fits);
    lines.push_back(fmt::format(
        "{} from the scenes' choices, {} within all budgets{}; {} compared and {} timed in addition, {:.1f} "
        "s",
        counted(choice.candidates.size(), "candidate"), fit,
        choice.left_out > 0 ? fmt::format("; {} proposed by fewer scenes left out", choice.left_out) : "",
        counted(choice.judged, "picture"), counted(choice.timings, "frame"), report.seconds));
    return lines;
}

std::string inWords(const CommonReport& report, const ChoiceReport& first) {
    const CommonChoice& choice = report.choice;
    std::string text = fmt::format("all {} scenes, {}x{}: {} in each\n", report.scenes.size(),
                                   first.given.size.width, first.given.size.height, goalInWords(first));
    if (choice.chosen) {
        text += report.words[*choice.chosen] + "\n";
        for (std::size_t scene = 0; scene < report.scenes.size(); ++scene)
            text += fmt::format("    {}: {}{}\n", report.scenes[scene],
                                figuresIn(choice.candidates[*choice.chosen], scene, first),
                                slowdownInWords(choice.slower[scene]));
    } else if (choice.nearest) {
        text += fmt::format("nothing fits all scenes; the nearest is {}\n", report.words[*choice.nearest]);
    } else {
        text += "no scene proposed a candidate for all\n";
    }
    for (const std::string& line : reasonsInWords(report, first)) text += "  " + line + "\n";
    if (choice.chosen) text += report.commands[*choice.chosen] + "\n";
    return text;
}

nlohmann::ordered_json toJson(const Choices& choices) {
    if (!choices.all) return toJson(choices.scenes.front());
    Json scenes = Json::array();
    for (const ChoiceReport& report : choices.scenes) scenes.push_back(toJson(report));
    const std::optional<Settings> settings = chosenSettings(choices);
    Json json{{"schema", 2}};
    json["settings"] = settings ? parseOrderedJson(toJson(*settings)) : Json();
    json["all"] = commonJson(*choices.all);
    json["scenes"] = std::move(scenes);
    return json;
}

}  // namespace diptych::choose
