// SPDX-License-Identifier: MIT
#include "compare/report/json.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/report/trends.h"
#include "shared/text/json.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using Json = nlohmann::ordered_json;

Json valuesAt(const Frame& frame, const ChannelDiff& channel) {
    Json values = Json::array();
    const Image& image = frame.channels.at(channel.mode->channel);
    for (int c = 0; c < image.components; ++c)
        values.push_back(finiteOrNull(double{image.at(channel.stats.worst_x, channel.stats.worst_y, c)}));
    return values;
}

Json jsonOf(const Criterion& criterion) {
    return {{"figure", criterion.metric},
            {"measured", finiteOrNull(criterion.measured)},
            {criterion.min ? "least" : "limit", finiteOrNull(criterion.limit)},
            {criterion.differing ? "differing_pixels" : "pixels_beyond", criterion.pixels},
            {criterion.differing ? "differing_share" : "share_beyond", criterion.fraction}};
}

Json jsonOf(const std::vector<ApproximationError>& errors) {
    return arrayOf(errors, [](const ApproximationError& each) -> Json {
        return {{"approximation", each.name},
                {"mean", each.mean},
                {"p999", each.p999},
                {"setting", orNull(each.setting)}};
    });
}

Json jsonOf(const BoundUse& use) {
    return {{"used", finiteOrNull(use.used)},
            {"beyond_pixels", use.beyond},
            {"most", finiteOrNull(use.max)},
            {"mean", finiteOrNull(use.mean)},
            {"pixel", {use.x, use.y}}};
}

Json jsonOf(const Report& report, const Comparison& comparison, const ChannelDiff& channel) {
    Json json{{"number", channelIndex(channel.mode->channel)},
              {"name", channel.mode->name},
              {"metric", nameOf(channel.mode->error_kind)}};
    const ChannelStats& s = channel.stats;
    const bool compared = isCompared(channel.verdict), anywhere = compared && s.worst_x >= 0;
    for (const auto& [name, value] : s.byName()) json[name] = compared ? finiteOrNull(value) : Json(nullptr);
    json["flip"] = channel.flip ? finiteOrNull(*channel.flip) : Json(nullptr);
    json["worst_pixel"] = anywhere ? Json{s.worst_x, s.worst_y} : Json(nullptr);
    json["tolerance"] = compared ? finiteOrNull(channel.tolerance.max) : Json(nullptr);
    json["because"] = channel.tolerance.because;
    json["verdict"] = nameOf(channel.verdict);
    if (!channel.rule.empty()) json["rule"] = channel.rule;
    if (!channel.warning.empty()) json["warning"] = channel.warning;
    if (!compared) return json;
    if (!channel.reason.empty()) json["reason"] = channel.reason;
    json["criterion"] = channel.criterion ? jsonOf(*channel.criterion) : Json(nullptr);
    Json metrics = Json::object();
    for (const auto& [name, value] : channel.metrics) metrics[name] = finiteOrNull(value);
    json["figures"] = metrics;
    json["different_pixels"] = s.different;
    json["infinite_pixels"] = s.infinite;
    json["nonfinite_pixels"] = {{"baseline", s.nonfinite_baseline}, {"test", s.nonfinite_test}};
    if (!channel.approximation_errors.empty()) json["granted"] = jsonOf(channel.approximation_errors);
    json["unexplained_pixels"] = orNull(channel.unexplained_pixels);
    if (const auto& f = channel.footprints)
        json["footprints"] = {{"smooth", f->smooth},   {"beyond", f->beyond}, {"used", finiteOrNull(f->used)},
                              {"pixel", {f->x, f->y}}, {"most", f->max},      {"detailed", f->detailed},
                              {"flip", f->flip},       {"edges", f->edges}};
    if (channel.encoding_use) json["encoding"] = jsonOf(*channel.encoding_use);
    if (channel.device_use) json["across_devices"] = jsonOf(*channel.device_use);
    if (anywhere)
        json["worst_values"] = {{"baseline", valuesAt(report.baseline(comparison), channel)},
                                {"test", valuesAt(report.test(comparison), channel)}};
    return json;
}

Json jsonOf(const FeatureChecks& feature, const VisualCheck& check) {
    const PixelBox& box = check.box;
    return {{"feature", feature.feature},
            {"what", check.what},
            {"where", check.where},
            {"box", {box.x0, box.y0, box.x1, box.y1}},
            {"pixels", check.pixels}};
}

Json jsonOf(const PathError& error) {
    const ChannelStats& s = error.stats;
    return {{"mean", finiteOrNull(s.mean)},
            {"max", finiteOrNull(s.max)},
            {"rmse", finiteOrNull(s.rmse)},
            {"p99", finiteOrNull(s.p99)},
            {"p999", finiteOrNull(s.p999)},
            {"relative_rmse", finiteOrNull(error.relative_rmse)},
            {"flip", error.flip ? finiteOrNull(*error.flip) : Json(nullptr)}};
}

Json jsonOf(const Report& report, const CloserPath& closer) {
    const Frame& reference = report.frames[closer.reference];
    const auto name = [&](std::size_t k) { return report.frames[closer.paths[k]].name; };
    const auto materialJson = [&](const MaterialError& m) -> Json {
        return {{"id", m.id},
                {"name", m.name},
                {"pixels", m.pixels},
                {"mean", {{name(0), finiteOrNull(m.mean[0])}, {name(1), finiteOrNull(m.mean[1])}}}};
    };
    const auto channelJson = [&](const CloserPathChannel& channel) -> Json {
        return {{"name", channel.mode->name},
                {"nearer",
                 channel.closer < 0 ? Json(nullptr) : Json(name(static_cast<std::size_t>(channel.closer)))},
                {"by", finiteOrNull(channel.by)},
                {"error", {{name(0), jsonOf(channel.paths[0])}, {name(1), jsonOf(channel.paths[1])}}},
                {"between", jsonOf(channel.between)},
                {"nearer_pixels",
                 {{name(0), channel.closer_pixels[0]},
                  {name(1), channel.closer_pixels[1]},
                  {"even", channel.even_pixels}}},
                {"materials", arrayOf(channel.materials, materialJson)}};
    };
    return {{"scene", reference.scene},
            {"camera", jsonOf(reference.camera)},
            {"channels", arrayOf(closer.channels, channelJson)}};
}

Json jsonOf(const AfterBlending& blended) {
    return {{"blended_pixels", blended.covered},
            {"pixels_before", blended.before},
            {"pixels", blended.pixels},
            {"pixels_allowed", blended.allowed},
            {"largest", finiteOrNull(blended.largest)},
            {"pixel", {blended.x, blended.y}},
            {"verdict", blended.passed() ? "pass" : "fail"}};
}

Json jsonOf(const Report& report, const Comparison& comparison) {
    const Frame& baseline = report.baseline(comparison);
    Json checks = Json::array(), found = Json::object();
    for (const FeatureChecks& feature : comparison.visual_checks) {
        found[std::string(feature.feature)] = feature.found;
        for (const VisualCheck& check : feature.checks) checks.push_back(jsonOf(feature, check));
    }
    Json differing = Json::object();
    for (const SettingDifference& of : comparison.differing) differing[of.option] = {of.baseline, of.test};
    return {
        {"scene", baseline.scene},
        {"camera", jsonOf(baseline.camera)},
        {"baseline", baseline.name},
        {"test", report.test(comparison).name},
        {"verdict", comparison.passed() ? "pass" : "fail"},
        {"covered_pixels", comparison.coverage.count},
        {"command", comparison.command},
        {"differing_settings", differing},
        {"emptiness", orNull(comparison.emptiness)},
        {"after_blending", comparison.after_blending ? jsonOf(*comparison.after_blending) : Json(nullptr)},
        {"failures", comparison.failures},
        {"notes", comparison.notes},
        {"channels",
         arrayOf(comparison.channels,
                 [&](const ChannelDiff& channel) { return jsonOf(report, comparison, channel); })},
        {"explanation", comparison.explained ? parseOrderedJson(comparison.explained->json) : Json(nullptr)},
        {"marks", checks},
        {"marks_found", found}};
}

std::string textOf(const Json& json) {
    return jsonText(json);
}

std::string innerJson(const Json& array) {
    if (array.empty()) return {};
    std::string text, all = textOf(array);
    all = all.substr(2, all.size() - 4);  // without the brackets and their lines
    for (const char c : "  " + all) {
        text += c;
        if (c == '\n') text += "  ";
    }
    return text;
}

Json framesJson(const Report& report, const ReportLayout* layout) {
    Json frames = Json::array();
    for (std::size_t i = 0; i < report.frames.size(); ++i) {
        frames.push_back(jsonOf(report.frames[i]));
        const ReportDevice& device = deviceOf(report, report.frames[i]);
        if (report.frames[i].origin.file.empty() && !device.name.empty())
            frames.back()["drawn_on"] = device.name + ", " + device.driver;
        if (layout) frames.back()["exr"] = layout->exr[i];
    }
    return frames;
}

}  // namespace

std::string arrayText(const Report& report, const ReportLayout* layout, std::size_t array) {
    const auto json = [&](const auto& of) { return jsonOf(report, of); };
    return innerJson(array == 0   ? framesJson(report, layout)
                     : array == 1 ? arrayOf(report.comparisons, json)
                                  : arrayOf(report.closer_paths, json));
}

void writeReportJson(const Report& report, const ReportLayout* layout, const std::vector<DrawnOn>& devices,
                     const Trends* since, const GiveArray& give, const JsonSink& out) {
    // Arrays may be text from another machine.
    const JsonSink sink = [&](std::string_view text) { out(escapeControls(text)); };
    Json times = Json::array();
    for (const DrawnOn& one : devices) {
        times.push_back(jsonOf(one.device));
        times.back()["comparisons"] = one.comparisons;
        times.back()["compare_ms"] = one.compare_ms;
        if (layout) times.back()["encode_ms"] = one.encode_ms;
    }
    Json head{{"schema", 1},
              {"software", softwareName},
              {"verdict", report.passed() && report.errors.empty() ? "pass" : "fail"},
              {"device", jsonOf(report.device)},
              {"devices", times},
              {"said_first", report.first_notes}};
    if (!report.against.name.empty()) head["against_device"] = jsonOf(report.against);
    // With several devices, no total time is meaningful.
    const auto only = [&](double DrawnOn::*ms) {
        return devices.size() == 1 ? Json(devices.front().*ms) : Json(nullptr);
    };
    Json tail{{"compare_ms", only(&DrawnOn::compare_ms)}};
    const auto errorJson = [](const SceneError& of) {
        Json one{{"scene", of.scene}, {"message", of.message}};
        if (!of.renderer.empty()) one.update({{"renderer", of.renderer}, {"output", of.output}});
        return one;
    };
    tail["errors"] = arrayOf(report.errors, errorJson);
    tail["failures"] = arrayOf(report.failures, errorJson);
    if (since) tail["since"] = jsonOf(*since, report);
    if (layout) {
        tail["encode_ms"] = only(&DrawnOn::encode_ms);
        tail["files"] = layout->files();
    }
    const std::string first = textOf(head), last = textOf(tail);
    sink(first.substr(0, first.size() - 2));
    for (std::size_t array = 0; array < reportArrays.size(); ++array) {
        sink(fmt::format(",\n  \"{}\": [", reportArrays.at(array)));
        bool any = false;
        give(array, [&](std::string_view inner) {
            if (inner.empty()) return;
            sink(any ? ",\n" : "\n");
            sink(inner);
            any = true;
        });
        sink(any ? "\n  ]" : "]");
    }
    sink(",\n" + last.substr(2) + "\n");
}

std::string reportJson(const Report& report, const ReportLayout* layout, const Trends* since) {
    std::string text;
    writeReportJson(
        report, layout, {drawnOn(report, layout)}, since,
        [&](std::size_t array, const JsonSink& add) { add(arrayText(report, layout, array)); },
        [&](std::string_view piece) { text += piece; });
    return text;
}

}  // namespace diptych
