// SPDX-License-Identifier: MIT
// The output of diff for scripts.
#include "compare/report/image_diff_json.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/files/image_folders.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace diptych {

namespace {

using Json = nlohmann::ordered_json;

std::vector<const ImageChannelDiff*> failuresFirst(const ImageDiff& diff) {
    std::vector<const ImageChannelDiff*> channels;
    for (const auto& channel : diff.channels) channels.push_back(channel.get());
    std::ranges::stable_sort(channels, std::greater(), [](const auto* c) { return c->decision.level; });
    return channels;
}

// The rule's bound, if it has a single one.
const Condition* singleBound(const ImageChannelDiff& channel) {
    return channel.rule.fail.kind == Condition::Kind::bound ? &channel.rule.fail : nullptr;
}

Json flipJson(const HdrFlipResult& flip, bool display) {
    Json json{{"mean", flip.mean},
              {"weighted_median", flip.weighted_median},
              {"weighted_first_quartile", flip.weighted_first_quartile},
              {"weighted_third_quartile", flip.weighted_third_quartile},
              {"min", flip.min},
              {"max", flip.max},
              {"kind", display ? "LDR" : "HDR"}};
    if (!display) {
        json["start_exposure"] = flip.start_exposure;
        json["stop_exposure"] = flip.stop_exposure;
        json["exposures"] = flip.exposures;
    }
    return json;
}

Json metricsJson(const ImageChannelDiff& channel) {
    Json json = Json::object();
    for (const auto& [name, value] : channel.measurement->all()) json[name] = finiteOrNull(value);
    return json;
}

Json channelJson(const ImageChannelDiff* of) {
    const ImageChannelDiff& channel = *of;
    const Measurement& m = *channel.measurement;
    const ChannelStats& s = m.stats();
    Json json{{"name", channel.pair.name},
              {"channels", channel.pair.channels},
              {"reference_type", channel.pair.reference_type},
              {"test_type", channel.pair.test_type},
              {"metric", nameOf(channel.pair.error_kind)}};
    for (const auto& [name, value] : s.byName()) json[name] = finiteOrNull(value);
    const HdrFlipResult* flip = m.flip();
    json["flip"] = flip ? Json(flip->mean) : Json(nullptr);
    json["worst_pixel"] = channel.worst_x >= 0 ? Json{channel.worst_x, channel.worst_y} : Json(nullptr);
    const Condition* bound = singleBound(channel);
    json["tolerance"] = bound ? finiteOrNull(bound->limit) : Json(nullptr);
    if (const auto& c = channel.decision.criterion)
        json["criterion"] = {{"figure", c->metric},
                             {"measured", finiteOrNull(c->measured)},
                             {c->differing ? "differing_share" : "share_beyond", c->fraction}};
    json["rule"] = fmt::format("{}: {}", channel.rule.origin, conditionText(channel.rule.fail));
    json["because"] = channel.rule.because;
    json["verdict"] = channel.decision.level == Level::fail ? "fail" : "pass";
    if (channel.decision.level == Level::warn) json["warning"] = channel.decision.reason;
    if (channel.decision.level == Level::fail) json["reason"] = channel.decision.reason;
    json["different_pixels"] = s.different;
    json["infinite_pixels"] = s.infinite;
    json["nonfinite_pixels"] = {{"reference", s.nonfinite_baseline}, {"test", s.nonfinite_test}};
    json["metrics"] = metricsJson(channel);
    if (flip) json["flip_pooled"] = flipJson(*flip, channel.display);
    return json;
}

Json jsonOf(const ImageDiff& diff) {
    const ImageChannelDiff& first = *failuresFirst(diff).front();
    return {{"schema", 1},
            {"software", softwareName},
            {"verdict", diff.passed() ? "pass" : "fail"},
            {"reference", diff.reference},
            {"test", diff.test},
            {"reference_format", diff.reference_format},
            {"test_format", diff.test_format},
            {"size", {diff.width, diff.height}},
            {"pixels", diff.coverage->count},
            {"metrics", metricsJson(first)},
            {"emptiness", orNull(diff.emptiness)},
            {"failures", diff.failures},
            {"notes", diff.notes},
            {"channels", arrayOf(failuresFirst(diff), channelJson)}};
}

std::string linesOf(const Json& json) {
    return jsonText(json) + "\n";
}

}  // namespace

std::string imageDiffJson(const ImageDiff& diff) {
    return linesOf(jsonOf(diff));
}

bool FolderDiff::passed() const {
    return reference_alone.empty() && test_alone.empty() && std::ranges::all_of(images, &ImageDiff::passed);
}

std::vector<SceneError> FolderDiff::failures() const {
    std::vector<SceneError> all;
    const auto add = [&](const std::vector<std::string>& names, const std::string& folder,
                         const std::vector<std::string>& others) {
        for (const std::string& name : names)
            all.push_back({name, fmt::format("is in {} only{}", folder,
                                             otherForm(name, others).empty()
                                                 ? ""
                                                 : "; the other folder seems to have it in another Unicode "
                                                   "form (composed or decomposed); rename one")});
    };
    add(reference_alone, reference, test_alone);
    add(test_alone, test, reference_alone);
    return all;
}

std::string folderDiffJson(const FolderDiff& diff) {
    const auto imageJson = [](const ImageDiff& image) {
        Json json = jsonOf(image);
        json["name"] = image.name;
        return json;
    };
    const auto errorJson = [](const SceneError& error) -> Json {
        return {{"name", error.scene}, {"message", error.message}};
    };
    return linesOf({{"schema", 1},
                    {"software", softwareName},
                    {"verdict", diff.passed() && diff.errors.empty() ? "pass" : "fail"},
                    {"reference", diff.reference},
                    {"test", diff.test},
                    {"pictures", arrayOf(diff.images, imageJson)},
                    {"reference_alone", diff.reference_alone},
                    {"test_alone", diff.test_alone},
                    {"errors", arrayOf(diff.errors, errorJson)}});
}

}  // namespace diptych
