// SPDX-License-Identifier: MIT
#include "compare/audit/words.h"
#include "compare/page/text.h"
#include "shared/frame/debug_modes.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::audit {

using Json = nlohmann::ordered_json;

namespace {

Json jsonOfSeries(const SeriesResult& of, const Relation& relation) {
    Json json = jsonOf(of.series);
    json["verdict"] = verdictOf(of);
    if (!of.lacks.empty()) {
        json["because"] = of.lacks;
        return json;
    }
    if (!of.comparison.failed.empty()) json["failed"] = of.comparison.failed;
    json["tolerance"] = of.tolerance.inWords();
    json["pixels"] = {{"covered", of.comparison.covered},
                      {"set_aside", of.comparison.aside},
                      {"most_set_aside", of.comparison.most_aside},
                      {"filtered_otherwise", of.comparison.filtered},
                      {"most_filtered_otherwise", of.comparison.most_filtered}};
    json["channels"] = Json::array();
    for (const ChannelResult& channel : of.comparison.channels)
        json["channels"].push_back({{"name", debugMode(channel.mode).name},
                                    {"error", numberOf(channel.error)},
                                    {"allowed", numberOf(channel.allowed)},
                                    {"used", numberOf(channel.used)},
                                    {"worst_pixel", {channel.x, channel.y}},
                                    {"pixels_beyond", channel.beyond}});
    if (of.changed)
        for (const char* shown : {"given", "changed", "used"})
            json["pictures"].push_back(fmt::format("{}-{}.png", pictureStem(relation, of), shown));
    return json;
}

std::string asideInWords(const SeriesResult& of) {
    std::string out;
    if (of.comparison.aside > 0)
        out += fmt::format("; {} at edges excluded (at most {})", counted(of.comparison.aside, "pixel"),
                           of.comparison.most_aside);
    if (of.comparison.filtered > 0)
        out += fmt::format("; {} filtered differently (at most {})", counted(of.comparison.filtered, "pixel"),
                           of.comparison.most_filtered);
    return out;
}

}  // namespace

bool RelationAudit::passes() const {
    return std::ranges::all_of(relations, [](const RelationResult& of) { return of.passes(); });
}

std::string_view verdictOf(const RelationResult& result) {
    if (std::ranges::all_of(result.series, [](const SeriesResult& of) { return !of.lacks.empty(); }))
        return "does not apply";
    return result.passes() ? "holds" : "broken";
}

std::string_view verdictOf(const SeriesResult& result) {
    return !result.lacks.empty() ? "does not apply" : result.comparison.passes() ? "holds" : "broken";
}

std::string blameInWords(const RelationResult& result, const ReportDevice& device) {
    if (result.passes()) return {};
    for (const SeriesResult& of : result.series)
        if (isReference(of.series.path) && of.lacks.empty() && !of.comparison.passes())
            return "the double-precision reference breaks it too: the changed scene is read differently, or "
                   "the relation does not hold for this scene; most likely a bug of Diptych";
    return device.bitExact()
               ? fmt::format("holds in double precision, and {} is a CPU: most likely a bug of Diptych",
                             device.name)
               : fmt::format("holds in double precision: a bug of the driver or of Diptych, on {} with {}",
                             device.name, device.driver);
}

std::string seriesInWords(const SeriesResult& result) {
    return isReference(result.series.path) ? "reference, double precision" : result.series.words();
}

std::string worstInWords(const SeriesResult& result) {
    if (!result.comparison.failed.empty()) return "not drawn: " + result.comparison.failed;
    const ChannelResult* const worst = result.comparison.worst();
    if (!worst) return "equal";
    return fmt::format("{} {}{}, allowed {}, at {},{}", debugMode(worst->mode).name,
                       page::number(worst->error), result.tolerance.equality == Equality::bits ? " ULP" : "",
                       page::number(worst->allowed), worst->x, worst->y);
}

std::string inWords(const RelationResult& result, const ReportDevice& device) {
    const Relation& relation = *result.relation;
    const std::string_view verdict = verdictOf(result);
    if (verdict == "does not apply")
        return fmt::format("{:<19} does not apply: {}\n", relation.name,
                           result.lacks.empty() ? "neither path reads the changed input" : result.lacks);
    if (verdict == "holds") {
        const SeriesResult& worst = *std::ranges::max_element(result.series, {}, [](const SeriesResult& of) {
            return of.lacks.empty() && !isReference(of.series.path) ? of.comparison.used() : -1;
        });
        return fmt::format(
            "{:<19} holds: {}{}\n", relation.name, worstInWords(worst),
            worst.comparison.used() > 0 ? ", " + worst.series.words() + asideInWords(worst) : "");
    }
    std::string out =
        fmt::format("{:<19} BROKEN: {}; {}\n", relation.name, relation.changes, relation.because);
    for (const SeriesResult& of : result.series) {
        if (!of.lacks.empty()) continue;
        out += fmt::format("    {}: {}: {}{}\n", seriesInWords(of), verdictOf(of), worstInWords(of),
                           asideInWords(of));
        for (const ChannelResult& channel : of.comparison.channels)
            if (channel.beyond > 0)
                out += fmt::format("        {}: {} out of tolerance, the worst at {},{}: {}, allowed {}\n",
                                   debugMode(channel.mode).name, counted(channel.beyond, "pixel"), channel.x,
                                   channel.y, page::number(channel.error), page::number(channel.allowed));
    }
    return out + fmt::format("    {}\n", blameInWords(result, device));
}

std::string inWords(const RelationAudit& audit) {
    const auto count = [&](std::string_view verdict) {
        return std::ranges::count(audit.relations, verdict,
                                  [](const RelationResult& of) { return verdictOf(of); });
    };
    return fmt::format("{}: {} of {} relations hold, {} broken, {} not applicable\n",
                       audit.passes() ? "pass" : "FAIL", count("holds"), audit.relations.size(),
                       count("broken"), count("does not apply"));
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
        if (const std::string blame = blameInWords(of, audit.device); !blame.empty()) one["blame"] = blame;
        one["series"] = Json::array();
        for (const SeriesResult& series : of.series) one["series"].push_back(jsonOfSeries(series, relation));
        json["relations"].push_back(std::move(one));
    }
    return json;
}

std::string pictureStem(const Relation& relation, const SeriesResult& result) {
    std::string stem = fmt::format("{}-{}", relation.name, nameOf(result.series.path));
    for (const Change& change : result.series.changes)
        if (change.option == "gbuffer") stem += fmt::format("-{}", change.value);
    return stem;
}

}  // namespace diptych::audit
