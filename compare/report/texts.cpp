// SPDX-License-Identifier: MIT
#include "compare/report/texts.h"

#include "compare/files/frame_json.h"
#include "shared/frame/debug_modes.h"
#include "shared/text/json.h"

#include <algorithm>
#include <cmath>

namespace diptych {
namespace {

using Json = nlohmann::ordered_json;

double sortable(double value) {
    return std::isfinite(value) ? value : 1e300;
}

// The failing channel that uses the largest fraction of its tolerance. If none fails, the passing one,
// except channels evaluated by encoding attribution, which have a tolerance per pixel.
const ChannelDiff* worstOf(const Comparison& comparison) {
    const ChannelDiff* worst = nullptr;
    for (const bool failing : {true, false}) {
        for (const ChannelDiff& channel : comparison.channels) {
            if ((channel.verdict == Verdict::fail) != failing || !isCompared(channel.verdict)) continue;
            // Their largest error equals the tolerance
            if (!failing && channel.unexplained_pixels) continue;
            if (!worst || usedFraction(channel) > usedFraction(*worst)) worst = &channel;
        }
        if (worst) return worst;
    }
    return nullptr;
}

// The causes are ranked; returns the first.
std::string firstCause(const Comparison& comparison) {
    if (!comparison.explained) return {};
    const Json json = parseOrderedJson(comparison.explained->json);
    if (!json.is_object() || !json.contains("causes") || json["causes"].empty()) return {};
    return json["causes"][0].value("name", "");
}

double noiseOf(const Frame& frame, const ChannelDiff& channel) {
    const auto found = frame.noise.find(channel.mode->channel);
    return found == frame.noise.end() ? 0 : sortable(found->second.max);
}

}  // namespace

IndexRow indexRowOf(const Report& report, const Comparison& comparison) {
    IndexRow row;
    if (const ChannelDiff* worst = worstOf(comparison)) {
        row.worst = worst->mode;
        row.used = sortable(usedFraction(*worst));
    }
    const Frame &left_frame = report.baseline(comparison), &right_frame = report.test(comparison);
    const FrameTime &left = left_frame.time, &right = right_frame.time;
    row.key = rowKey(left_frame.scene, left_frame.name, right_frame.name, jsonOf(left_frame.camera).dump());
    row.left_ms = left.median;
    row.right_ms = right.median;
    row.left_timed = left.runs > 0;
    row.right_timed = right.runs > 0;
    row.cause = firstCause(comparison);
    row.device = report.device.name;
    for (const ChannelDiff& channel : comparison.channels) {
        if (!isCompared(channel.verdict)) continue;
        const ChannelStats& s = channel.stats;
        row.channels.push_back({std::string(channel.mode->name), std::string(nameOf(channel.verdict)),
                                sortable(usedFraction(channel)), sortable(s.max), sortable(s.mean),
                                sortable(s.rmse), sortable(s.p99), sortable(s.p999),
                                channel.flip ? sortable(*channel.flip) : -1,
                                noiseOf(left_frame, channel) + noiseOf(right_frame, channel)});
    }
    return row;
}

Json jsonOf(const IndexRow& row) {
    Json channels = Json::array();
    for (const IndexChannel& c : row.channels)
        channels.push_back(
            {c.name, c.verdict, c.used, c.max, c.mean, c.rmse, c.p99, c.p999, c.flip, c.noise});
    return {{"worst", row.worst ? Json(channelIndex(row.worst->channel)) : Json(nullptr)},
            {"used", row.used},
            {"ms", {row.left_ms, row.right_ms}},
            {"timed", {row.left_timed, row.right_timed}},
            {"cause", row.cause},
            {"device", row.device},
            {"key", row.key},
            {"channels", channels}};
}

const DebugMode& debugModeFrom(const JsonAt<nlohmann::json>& index) {
    const DebugMode* mode = findDebugMode(std::to_string(index.whole(0, 1 << 20)));
    if (!mode) index.fail("is not a channel index");
    return *mode;
}

IndexRow indexRowFrom(const JsonAt<nlohmann::json>& json) {
    IndexRow row;
    if (!json.at("worst").json().is_null()) row.worst = &debugModeFrom(json.at("worst"));
    row.used = json.at("used").number();
    row.left_ms = json.at("ms")[0].number();
    row.right_ms = json.at("ms")[1].number();
    row.left_timed = json.at("timed")[0].flag();
    row.right_timed = json.at("timed")[1].flag();
    row.cause = json.at("cause").text();
    row.device = json.at("device").text();
    row.key = json.at("key").text();
    for (const auto& c : json.at("channels").each())
        row.channels.push_back({c[0].text(), c[1].text(), c[2].number(), c[3].number(), c[4].number(),
                                c[5].number(), c[6].number(), c[7].number(), c[8].number(), c[9].number()});
    return row;
}

std::string rowKey(const std::string& scene, const std::string& baseline, const std::string& test,
                   const std::string& camera_json) {
    return scene + "\n" + baseline + "\n" + test + "\n" + camera_json;
}

DrawnOn drawnOn(const Report& report, const ReportLayout* layout) {
    return {report.device, report.comparisons.size(), report.diff_ms, layout ? layout->encode_ms : 0};
}

}  // namespace diptych
