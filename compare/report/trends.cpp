// SPDX-License-Identifier: MIT
#include "compare/report/trends.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/page/text.h"
#include "compare/report/titles.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using JsonValue = JsonAt<nlohmann::json>;

// A comparison in the earlier report.
struct Earlier {
    std::string scene, verdict;
    std::map<std::string, std::map<std::string, double>> channels;  // metrics by name
};

struct EarlierReport {
    std::string device;
    std::map<std::string, Earlier> comparisons;
    std::map<std::string, double> noise;  // by scene and channel: twice the largest of any frame
};

constexpr std::pair<const char*, double IndexChannel::*> evaluated[] = {{"max", &IndexChannel::max},
                                                                        {"mean", &IndexChannel::mean},
                                                                        {"rmse", &IndexChannel::rmse},
                                                                        {"p99", &IndexChannel::p99},
                                                                        {"p999", &IndexChannel::p999}};

// Large members of a report that are not needed here; skipping them keeps reports of thousands readable.
bool isOmitted(const std::string& key) {
    static const std::set<std::string> names{
        "settings", "passes",     "figures", "explanation",  "marks", "notes", "marks_found",
        "because",  "criterion",  "command", "worst_values", "truth", "files", "encoding",
        "counters", "footprints", "origin",  "host_ms",      "bytes"};
    return names.contains(key);
}

// JSON has null for infinity.
double metricIn(const JsonValue& json, const char* name) {
    return json.has(name) && json.at(name).json().is_number() ? json.at(name).number() : 1e300;
}

void addComparison(EarlierReport& report, std::map<std::string, int>& again, const JsonValue& json) {
    std::string key = rowKey(json.textOr("scene", ""), json.textOr("baseline", ""), json.textOr("test", ""),
                             jsonOf(cameraFrom(json.at("camera"))).dump());
    key += fmt::format("\n{}", ++again[key]);
    Earlier& earlier = report.comparisons[key];
    earlier.scene = json.textOr("scene", "");
    earlier.verdict = json.textOr("verdict", "");
    for (const JsonValue& channel : json.at("channels").each()) {
        const std::string verdict = channel.textOr("verdict", "");
        if (verdict != "pass" && verdict != "fail") continue;
        auto& metrics = earlier.channels[channel.textOr("name", "")];
        for (const auto& [name, member] : evaluated) metrics[name] = metricIn(channel, name);
    }
}

void addNoise(EarlierReport& report, const JsonValue& frame) {
    if (!frame.has("noise")) return;
    const JsonValue noise = frame.at("noise");
    for (const auto& [channel, of] : noise.json().items()) {
        double& max = report.noise[frame.textOr("scene", "") + "\n" + channel];
        max = std::max(max, 2 * metricIn(JsonValue(of), "max"));
    }
}

EarlierReport readEarlier(const fs::path& where) {
    return named("--since " + where.string(), [&] {
        const nlohmann::json json = parseJson(textIn(reportFile(where), json_bytes),
                                              [](int, const std::string& key) { return !isOmitted(key); });
        const JsonValue top(json);
        if (top.textOr("software", "") != softwareName || !top.has("comparisons"))
            fail("is not a report of compare; give its folder or report.json");
        EarlierReport report;
        const JsonValue device = top.at("device");
        report.device = device.textOr("name", "") + ", " + device.textOr("driver", "");
        std::map<std::string, int> again;
        for (const JsonValue& comparison : top.at("comparisons").each())
            addComparison(report, again, comparison);
        for (const JsonValue& frame : top.at("frames").each()) addNoise(report, frame);
        return report;
    });
}

std::vector<MovedMetric> movedSince(const Earlier& earlier, const EarlierReport& report,
                                    const IndexRow& row) {
    std::vector<MovedMetric> moved;
    for (const IndexChannel& channel : row.channels) {
        const auto then = earlier.channels.find(channel.name);
        if (then == earlier.channels.end()) continue;
        const auto noise = report.noise.find(earlier.scene + "\n" + channel.name);
        const double max = channel.noise + (noise == report.noise.end() ? 0 : noise->second);
        for (const auto& [name, member] : evaluated) {
            const double from = then->second.at(name), to = channel.*member;
            if (std::abs(to - from) > max) moved.push_back({channel.name, name, from, to, max});
        }
    }
    return moved;
}

std::string numberOf(double value) {
    return value >= 1e300 ? "inf" : page::number(value);
}

Json finite(double value) {
    return value >= 1e300 ? Json(nullptr) : Json(value);
}

}  // namespace

std::string_view nameOf(TrendKind kind) {
    constexpr std::string_view names[] = {"same", "new failure", "mended", "moved", "new"};
    return names[static_cast<std::size_t>(kind)];
}

Trends trendsSince(const fs::path& where, const Report& report, const std::vector<IndexRow>& rows) {
    EarlierReport earlier = readEarlier(where);
    Trends trends;
    trends.report = where.string();
    const std::string here = report.device.name + ", " + report.device.driver;
    if (earlier.device != here) trends.device = earlier.device;
    std::map<std::string, int> again;
    std::set<std::string> met;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Trend& trend = trends.comparisons.emplace_back();
        const std::string key = rows[i].key + fmt::format("\n{}", ++again[rows[i].key]);
        const auto then = earlier.comparisons.find(key);
        const bool fails = !report.comparisons[i].passed();
        if (then == earlier.comparisons.end()) {
            trend.kind = TrendKind::fresh;
            continue;
        }
        met.insert(key);
        trend.moved = movedSince(then->second, earlier, rows[i]);
        const bool failed = then->second.verdict == "fail";
        trend.kind = fails && !failed      ? TrendKind::fails_now
                     : !fails && failed    ? TrendKind::mended
                     : trend.moved.empty() ? TrendKind::same
                                           : TrendKind::moved;
    }
    for (const auto& [key, of] : earlier.comparisons)
        if (!met.contains(key) && std::ranges::count(trends.gone, of.scene) == 0)
            trends.gone.push_back(of.scene);
    return trends;
}

std::string movedText(const MovedMetric& moved) {
    return fmt::format("{} {} {} -> {}", moved.channel, moved.metric, numberOf(moved.from),
                       numberOf(moved.to));
}

Json jsonOf(const Trends& trends, const Report& report) {
    const auto movedJson = [](const MovedMetric& one) -> Json {
        return {{"channel", one.channel},
                {"figure", one.metric},
                {"from", finite(one.from)},
                {"to", finite(one.to)},
                {"noise", one.noise}};
    };
    Json comparisons = Json::array();
    for (std::size_t i = 0; i < trends.comparisons.size(); ++i) {
        const Trend& trend = trends.comparisons[i];
        if (trend.kind == TrendKind::same) continue;
        comparisons.push_back({{"comparison", i},
                               {"scene", report.baseline(report.comparisons[i]).scene},
                               {"kind", nameOf(trend.kind)},
                               {"moved", arrayOf(trend.moved, movedJson)}});
    }
    return {{"report", trends.report},
            {"device", orNull(trends.device)},
            {"comparisons", comparisons},
            {"gone", trends.gone}};
}

std::vector<std::string> trendLines(const Trends& trends, const Report& report) {
    std::vector<std::string> lines;
    if (!trends.device.empty())
        lines.push_back(fmt::format(
            "the earlier report is from another device ({}): numbers may differ by rounding", trends.device));
    for (const TrendKind kind :
         {TrendKind::fails_now, TrendKind::mended, TrendKind::moved, TrendKind::fresh}) {
        std::vector<std::string> places;
        for (std::size_t i = 0; i < trends.comparisons.size(); ++i) {
            const Trend& trend = trends.comparisons[i];
            if (trend.kind != kind) continue;
            std::string location = viewLabel(report, report.comparisons[i]);
            if (!trend.moved.empty())
                location += fmt::format(
                    " ({}{})", movedText(trend.moved.front()),
                    trend.moved.size() == 1 ? "" : fmt::format(", {} more metrics", trend.moved.size() - 1));
            places.push_back(std::move(location));
        }
        if (!places.empty())
            lines.push_back(fmt::format("{} {}: {}", places.size(), nameOf(kind), listed(places, 8)));
    }
    if (!trends.gone.empty())
        lines.push_back(fmt::format("{} gone: {}", trends.gone.size(), listed(trends.gone, 8)));
    if (lines.empty()) lines.emplace_back("nothing has changed");
    return lines;
}

}  // namespace diptych
