// SPDX-License-Identifier: MIT
#include "compare/choose/report.h"
#include "compare/experiment/pareto.h"
#include "compare/files/listed_folder.h"
#include "compare/output/writers.h"
#include "compare/page/text.h"
#include "compare/plot/plot.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace diptych::choose {

using experiment::cellOf;
using experiment::columnOf;
using output::Block;
using output::Heading;
using output::Paragraph;
using output::Span;
using output::Table;

namespace {

using Sentences = std::vector<output::Text>;

template <class Report>
constexpr bool isJoint = std::same_as<Report, JointReport>;

std::string_view titleOf(Measure measure) {
    return named(measure).title;
}

// "takes 3.1 % longer (-0.5 % to +6.8 %)", "takes 0.5 % less time (-1.2 % to +0.3 %)"
std::string longerText(const TimeRatio& of) {
    return fmt::format("takes {:.1f} % {} ({:+.1f} % to {:+.1f} %)", 100 * std::abs(of.ratio - 1),
                       of.ratio < 1 ? "less time" : "longer", 100 * (of.low - 1), 100 * (of.high - 1));
}

// "the fastest with FLIP at most 0.01"
std::string goalText(const Budget& budget) {
    std::vector<std::string> limits;
    if (budget.error)
        limits.push_back(fmt::format("{} at most {:.4g}", titleOf(budget.metric), *budget.error));
    if (budget.ms) limits.push_back(fmt::format("at most {:.4g} ms", *budget.ms));
    if (budget.bytes) limits.push_back(fmt::format("at most {}", page::bytes(*budget.bytes)));
    return fmt::format("the {} with {}", budget.isForSpeed() ? "fastest" : "most accurate",
                       fmt::join(limits, " and "));
}

// "4.5 ms, FLIP 0.0125, 3 MiB"
std::string metricsText(const experiment::Row& row, Measure metric) {
    std::string text =
        row.measured.has(Measure::ms) ? fmt::format("{:.4g} ms", row[Measure::ms]) : "not timed";
    if (row.measured.has(Measure::memory))
        text += fmt::format(", {} {:.4g}, {}", titleOf(metric), row[metric],
                            page::bytes(row.whole(Measure::memory)));
    return text;
}

Sentences missesText(const experiment::Row& row, const Budget& budget) {
    Sentences lines;
    const auto gap = [&](double value, double limit, const char* what, const std::string& limit_text) {
        if (value > limit)
            lines.emplace_back(fmt::format("{} over the {} budget of {}", page::percent(value / limit - 1),
                                           what, limit_text));
    };
    if (budget.error) gap(row[budget.metric], *budget.error, "error", fmt::format("{:.4g}", *budget.error));
    if (budget.ms) gap(row[Measure::ms], *budget.ms, "time", fmt::format("{:.4g} ms", *budget.ms));
    if (budget.bytes)
        gap(row[Measure::memory], static_cast<double>(*budget.bytes), "memory", page::bytes(*budget.bytes));
    return lines;
}

template <class Report>
void addFinalists(Sentences& lines, const Report& report) {
    const auto& choice = report.choice;
    const char* const over = isJoint<Report> ? " over all scenes" : "";
    const auto add = [&](const char* what, std::size_t i) {
        lines.emplace_back(
            fmt::format("{}: {}:{} {}", what, report.words[i], over, longerText(*choice.candidates[i].race)));
    };
    if (choice.runner_up && std::ranges::count(choice.ties, *choice.runner_up) == 0)
        add("runner-up", *choice.runner_up);
    for (const std::size_t i : choice.ties) add("not measurably slower", i);
    if (choice.significant)
        lines.emplace_back(
            fmt::format("significant: every other finalist is slower{}, at {:.0f} % confidence", over,
                        100 * rankingConfidence));
}

void addHeldOut(Sentences& lines, const ChoiceReport& report) {
    if (report.held_out.empty())
        lines.emplace_back("not checked from another camera: the scene has no other");
    for (const HeldOutCamera& camera : report.held_out)
        lines.emplace_back(
            fmt::format("checked from camera {}, which the choice did not use: {} {:.4g}{}", camera.camera,
                        titleOf(report.budget.metric), camera.error,
                        camera.holds ? "" : ", over the budget: name both cameras with --camera"));
}

// Four significant digits, or all digits of larger whole numbers.
std::string numberText(double value) {
    return std::abs(value) >= 1e4 && std::abs(value) < 1e8 ? fmt::format("{:.0f}", value)
                                                           : fmt::format("{:.4g}", value);
}

// The times at each of a few values.
std::string describeTimes(const PropertySensitivity& sensitivity, const SensitivityReport& report) {
    std::vector<std::string> words;
    for (const TimedValue& at : sensitivity.times)
        if (at.value != sensitivity.property.value)
            words.push_back(fmt::format("at {:.4g}, {} takes {:.4g} ms and {} {:.4g} ms{}", at.value,
                                        report.chosen_path, at.ms[0], report.other_path, at.ms[1],
                                        !at.isSignificant() ? ", not measurably different"
                                        : at.difference < 0 ? ": faster there"
                                                            : ": not faster there either"));
    return fmt::format("{}", fmt::join(words, "; "));
}

std::string sensitivityText(const PropertySensitivity& sensitivity, const SensitivityReport& report) {
    const Property& property = sensitivity.property;
    std::string text = fmt::format("{}: {} {}; ", property.name, numberText(property.value), property.unit);
    if (!property.not_varied.empty() || sensitivity.times.size() < 2)
        return text + (property.not_varied.empty() ? "its variations change nothing" : property.not_varied);
    if (property.few_values)
        text += describeTimes(sensitivity, report);
    else if (const auto& at = sensitivity.break_even)
        text += fmt::format("{} is faster {} {} ({} to {}), {}", report.other_path,
                            at->other_above ? "above" : "below", numberText(at->value), numberText(at->low),
                            numberText(at->high), at->extrapolated ? "extrapolated" : "interpolated");
    else
        text += fmt::format("no value between {} and {} reverses the choice{}", numberText(property.min),
                            numberText(property.max),
                            sensitivity.open ? fmt::format(" significantly; a value between {} and {} may",
                                                           numberText(sensitivity.open->first),
                                                           numberText(sensitivity.open->second))
                                             : "");
    std::vector<std::string> measured;
    for (const TimedValue& time : sensitivity.times) measured.push_back(numberText(time.value));
    return text + fmt::format(" (measured at {}: {})", fmt::join(measured, ", "), property.how);
}

void addSensitivities(std::vector<Block>& blocks, const SensitivityReport& report) {
    const TimedValue& here = report.as_is;
    blocks.emplace_back(
        Heading{3,
                fmt::format("Properties that decide between {} and {}{}: here {:.4g} ms against {:.4g} ms{}",
                            report.chosen_path, report.other,
                            report.other_fits ? "" : ", which does not fit and is compared by time only",
                            here.ms[0], here.ms[1], here.isSignificant() ? "" : ", not measurably different"),
                "part"});
    constexpr std::size_t listed = 3;  // sorted by relevance; JSON has all
    output::List list{{}, "box says"};
    for (const PropertySensitivity& each : report.properties)
        if (list.items.size() < listed) list.items.emplace_back(sensitivityText(each, report));
    blocks.emplace_back(list);
}

Span swatchOf(const Settings& settings) {
    return {"", Span::swatch, nameOf(settings.path)};
}

template <class Report>
Span verdictOf(const Report& report) {
    const bool fits = report.choice.chosen.has_value();
    return {fits ? "fits" : "nothing fits", Span::verdict, fits ? "pass" : "fail"};
}

// The chosen or nearest Settings, why, and the command. `metrics`: their text; empty: none.
template <class Report>
output::Box outcomeBox(const Report& report, const std::string& metrics, const Sentences& lines) {
    const auto& choice = report.choice;
    output::Text title("no candidate could be drawn");
    const std::string nearest =
        fmt::format("nothing fits{}; the nearest is ", isJoint<Report> ? " all scenes" : "");
    if (const std::optional<std::size_t> shown = choice.shown())
        title = {swatchOf(choice.candidates[*shown].settings), choice.chosen ? "" : nearest,
                 report.words[*shown]};
    output::Box box{"box", {Heading{3, title}}};
    if (!metrics.empty()) box.blocks.emplace_back(Paragraph{metrics, "figures mono"});
    box.blocks.emplace_back(output::List{lines});
    if (choice.chosen)
        box.blocks.emplace_back(Paragraph{Span(report.commands[*choice.chosen], Span::command), "again"});
    return box;
}

// The chosen candidate first, then raced ones, then evaluated ones; each group by time.
Table candidateTable(const ChoiceReport& report) {
    const SettingsChoice& choice = report.choice;
    std::vector<std::size_t> order(choice.candidates.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
        const Candidate& candidate = choice.candidates[i];
        return std::tuple(i != choice.chosen, !candidate.race, !candidate.isEvaluated(), candidate.log_ms);
    });
    Table table;
    table.sortable = true;
    const auto measure = [&](Measure of) {
        addColumn(table, columnOf(of), order, [&](std::size_t i) {
            return choice.candidates[i].measured.has(of)
                       ? cellOf(choice.candidates[i], of)
                       : output::sorted(std::numeric_limits<double>::infinity(), "");
        });
    };
    addColumn(table, {"settings", output::Column::prose}, order, [&](std::size_t i) {
        return output::Text{swatchOf(choice.candidates[i].settings), report.words[i]};
    });
    measure(Measure::ms);
    measure(report.budget.metric);
    measure(Measure::memory);
    addColumn(table, {"result"}, order, [&](std::size_t i) {
        return i == choice.chosen                       ? "chosen"
               : std::ranges::count(choice.ties, i) > 0 ? "tied with the best"
                                                        : choice.candidates[i].statusName().text;
    });
    if (choice.chosen) table.rows.front().style = "chosen";
    return table;
}

// One candidate of the joint choice in each scene.
Table sceneTable(const JointReport& report, std::size_t candidate) {
    const std::vector<experiment::Row>& rows = report.choice.candidates[candidate].scenes;
    Table table;
    table.sortable = true;
    addColumn(table, {"scene"}, report.scenes,
              [](const std::string& scene) { return Span(scene, Span::name); });
    for (const Measure measure : {Measure::ms, report.budget.metric, Measure::memory})
        addColumn(table, columnOf(measure), rows,
                  [&](const experiment::Row& row) { return cellOf(row, measure); });
    if (report.choice.chosen)
        addColumn(table, {"against its own choice", output::Column::prose}, report.choice.slower,
                  [](const std::optional<TimeRatio>& slower) -> output::Cell {
                      if (!slower) return "the scene has no choice of its own";
                      return output::sorted(slower->ratio, slower->low == slower->high ? "its own choice"
                                                                                       : longerText(*slower));
                  });
    return table;
}

// One end of the confidence interval of a finalist's time, ms; its time if the end is not known.
double endOf(const Candidate& candidate, double TimeRatio::*end) {
    if (!candidate.race || !std::isfinite((*candidate.race).*end)) return candidate.ms();
    return candidate.ms() / candidate.race->ratio * (*candidate.race).*end;
}

// SVG of error over time for all evaluated and timed candidates. Shows time intervals of raced candidates,
// the budget and the Pareto front. Both axes are logarithmic; errors of 0 and infinity get their own lanes.
std::string plotOf(const ChoiceReport& report, PlotTarget target) {
    const SettingsChoice& choice = report.choice;
    const std::string_view metric = titleOf(report.budget.metric);
    PlotPanel panel{.across = {"time of a frame, ms"},
                    .up = {fmt::format("{} against the reference", metric)}};
    if (const auto& max = report.budget.error)
        panel.limits.push_back({.y = max, .name = fmt::format("at most {:.4g}", *max)});
    if (const auto& max = report.budget.ms)
        panel.limits.push_back({.x = max, .name = fmt::format("at most {:.4g} ms", *max)});
    std::string interval;
    std::vector<experiment::TimeError> points;
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const Candidate& candidate = choice.candidates[i];
        if (!candidate.isEvaluated() || candidate.timings == 0) continue;
        const double ms = candidate.ms(), error = candidate[report.budget.metric];
        const bool raced = candidate.status == CandidateStatus::raced;
        if (raced) interval = "finalist, 99 % interval";
        points.push_back({ms, error});
        panel.pointsOf(std::string(nameOf(candidate.settings.path)), candidate.settings.path, false)
            .push_back({.x = ms,
                        .y = error,
                        .text = fmt::format("{}; {:.4g} ms, {} {:.4g}; {}", report.words[i], ms, metric,
                                            error, candidate.statusName().text),
                        .across = {endOf(candidate, &TimeRatio::low), endOf(candidate, &TimeRatio::high)},
                        .row = i + 1,
                        .best = raced,
                        .label = i == choice.chosen      ? "chosen"
                                 : i == choice.runner_up ? "runner-up"
                                 : i == choice.nearest   ? "nearest"
                                                         : ""});
    }
    for (const std::size_t i : experiment::paretoFront(points))
        panel.front.emplace_back(points[i].time, points[i].error);
    return svgOf({.title = fmt::format("{} over time of the measured candidates, {}", metric, report.scene),
                  .panels = {panel},
                  .interval = interval},
                 target);
}

}  // namespace

std::string whyText(const ChoiceReport& report) {
    const SettingsChoice& choice = report.choice;
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
        line += fmt::format(", {} {:.3g} against {:.3g}", titleOf(report.budget.metric),
                            other[report.budget.metric], chosen[report.budget.metric]);
    for (std::size_t i = 0; i < parts.size(); ++i)
        line += (i == 0 ? "; passes, ms: " : ", ") + parts[i].second;
    return line;
}

std::vector<Block> blocksOf(const ChoiceReport& report) {
    const SettingsChoice& choice = report.choice;
    std::string metrics;
    Sentences lines;
    if (const std::optional<std::size_t> shown = choice.shown()) {
        const Candidate& candidate = choice.candidates[*shown];
        metrics = metricsText(candidate, report.budget.metric);
        lines = choice.chosen ? Sentences{whyText(report)} : missesText(candidate, report.budget);
    }
    if (choice.chosen) {
        addFinalists(lines, report);
        addHeldOut(lines, report);
    }
    const Block plot{
        output::Box{
            "box",
            {output::Drawing{plotOf(report, PlotTarget::page)},
             Paragraph{"A bar is the 99 % confidence interval of a candidate's time divided by the fastest "
                       "one's. The line is the smallest error that is possible within a time.",
                       "soft small"}}},
        Block::page};
    std::vector<Block> blocks{
        Heading{2,
                {verdictOf(report), " ", Span(report.scene, Span::name),
                 fmt::format(", {}x{}, ", report.requested.size.width, report.requested.size.height),
                 Span(fmt::format("{}", fmt::join(report.cameras, "; ")), Span::foreign),
                 ": " + goalText(report.budget)}},
        output::Box{"choice", {outcomeBox(report, metrics, lines), plot}}};
    if (report.sensitivities) addSensitivities(blocks, *report.sensitivities);
    output::List notes{{}, "box says"};
    for (const std::string& note : report.notes) notes.items.emplace_back("note: " + note);
    blocks.insert(
        blocks.end(),
        {notes, {Heading{3, "Every candidate", "part"}, Block::page}, {candidateTable(report), Block::page}});
    return blocks;
}

std::vector<Block> blocksOf(const JointReport& report) {
    const JointChoice& choice = report.choice;
    std::string metrics;
    Sentences lines;
    if (choice.nearest) {
        const experiment::Row& worst = choice.candidates[*choice.nearest].scenes[choice.nearest_scene];
        metrics = fmt::format("{}: {}", report.scenes[choice.nearest_scene],
                              metricsText(worst, report.budget.metric));
        lines = missesText(worst, report.budget);
    }
    if (choice.chosen) addFinalists(lines, report);
    const auto fit = std::ranges::count(choice.candidates, true, &JointCandidate::fits);
    lines.emplace_back(fmt::format(
        "{} within all budgets{}", counted(static_cast<std::size_t>(fit), "candidate"),
        choice.omitted > 0 ? fmt::format("; {} proposed by fewer scenes left out", choice.omitted) : ""));
    std::vector<Block> blocks{
        Heading{2,
                {verdictOf(report), fmt::format(" all {} scenes, {}x{}: {} in each", report.scenes.size(),
                                                report.requested.size.width, report.requested.size.height,
                                                goalText(report.budget))}},
        outcomeBox(report, metrics, lines)};
    if (const std::optional<std::size_t> shown = choice.shown())
        blocks.emplace_back(sceneTable(report, *shown));
    return blocks;
}

void writeChoice(const Choices& choices, const std::filesystem::path& path, bool force) {
    const ChoiceReport& first = choices.scenes.front();
    const std::string title = choices.all ? fmt::format("{} scenes", choices.scenes.size()) : first.scene;
    output::Document page{.title = "a choice, " + title,
                          .heading = title,
                          .about = fmt::format("{} ({})", first.device.name, first.device.driver),
                          .blocks = {}};
    ListedFolder folder(path, choiceManifest, force);
    std::vector<const experiment::Row*> rows;  // every scene's candidates, then those of the joint choice
    const auto add = [&](const std::vector<Block>& blocks, const auto& candidates) {
        page.blocks.insert(page.blocks.end(), blocks.begin(), blocks.end());
        for (const experiment::Row& row : candidates) rows.push_back(&row);
    };
    const auto put = [&](const std::optional<Settings>& settings, const std::string& name) {
        if (settings) folder.put(name, toJson(*settings) + "\n");
    };
    put(chosenSettings(choices), "settings.json");
    if (choices.all) add(blocksOf(*choices.all), std::span<const experiment::Row>());
    for (const ChoiceReport& report : choices.scenes) {
        const std::string suffix = choices.all ? fmt::format("-{}", &report - &first + 1) : "";
        folder.put(fmt::format("front{}.svg", suffix), plotOf(report, PlotTarget::file));
        if (choices.all) put(chosenSettings(report.choice), fmt::format("settings{}.json", suffix));
        add(blocksOf(report), report.choice.candidates);
    }
    if (choices.all)
        for (const JointCandidate& candidate : choices.all->choice.candidates) add({}, candidate.scenes);
    folder.put(experiment::rowsFile, inCsv(experiment::rowsTable(rows)));
    page.files = folder.files();
    folder.put("index.html", inHtml(page));
    folder.finish(toJson(choices));
}

}  // namespace diptych::choose
