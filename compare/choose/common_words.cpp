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
    const InScene& in = candidate.scenes[scene];
    return fmt::format("{}{} {:.4g}, {}", in.ms > 0 ? fmt::format("{:.4g} ms, ", in.ms) : "", first.figure,
                       in.judged.error, page::bytes(in.judged.bytes));
}

std::string slowdownInWords(const std::optional<Slowdown>& slower) {
    if (!slower) return "; the scene has no choice of its own";
    if (slower->low == slower->high) return "; its own choice";
    return fmt::format("; against its own choice: {}",
                       longerInWords(slower->ratio, slower->low, slower->high));
}

std::string commonFinalist(const CommonReport& report, std::size_t i) {
    const FinalistTime& race_time = *report.choice.candidates[i].race_time;
    return fmt::format("{}: over all scenes {}", report.words[i],
                       longerInWords(race_time.ratio, race_time.low, race_time.high));
}

nlohmann::ordered_json commonJson(const CommonReport& report) {
    const CommonChoice& choice = report.choice;
    const auto place = [](const std::optional<std::size_t>& i) { return i ? Json(*i) : Json(); };
    Json candidates = Json::array();
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const CommonCandidate& candidate = choice.candidates[i];
        Json scenes = Json::array();
        for (std::size_t scene = 0; scene < candidate.scenes.size(); ++scene) {
            const InScene& in = candidate.scenes[scene];
            Json one{{"scene", report.scenes[scene]}};
            one["error"] = std::isfinite(in.judged.error) ? Json(in.judged.error) : Json();
            one["bytes"] = in.judged.bytes;
            one["ms"] = in.ms > 0 ? Json(in.ms) : Json();
            if (i == choice.chosen && choice.slower[scene])
                one["to_its_own"] = {{"ratio", choice.slower[scene]->ratio},
                                     {"low", choice.slower[scene]->low},
                                     {"high", choice.slower[scene]->high}};
            scenes.push_back(std::move(one));
        }
        Json json{{"settings", parseOrderedJson(toJson(candidate.settings))},
                  {"words", report.words[i]},
                  {"command", report.commands[i]},
                  {"fits", candidate.fits},
                  {"proposed_by", candidate.proposed_by},
                  {"scenes", std::move(scenes)}};
        if (candidate.race_time)
            json["race"] = {{"ratio", candidate.race_time->ratio},
                            {"low", candidate.race_time->low},
                            {"high", candidate.race_time->high},
                            {"rounds", candidate.race_time->rounds}};
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
        const InScene& in = nearest.scenes[choice.nearest_scene];
        const double miss = missOf(in.judged, in.ms > 0 ? std::optional(in.ms) : std::nullopt, first.budget);
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
    Json json{{"schema", 1}};
    json["settings"] = settings ? parseOrderedJson(toJson(*settings)) : Json();
    json["all"] = commonJson(*choices.all);
    json["scenes"] = std::move(scenes);
    return json;
}

}  // namespace diptych::choose
