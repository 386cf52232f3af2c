// SPDX-License-Identifier: MIT
#include "shared/text/json.h"
#include "compare/bench/bench.h"
#include "compare/bench/conclusion.h"
#include "compare/bench/growth.h"
#include "compare/bench/layer_table.h"
#include "compare/bench/sample_table.h"
#include "compare/files/our_files.h"
#include "shared/text/json_text.h"

#include <nlohmann/json.hpp>

namespace diptych::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json jsonOf(const Size& size) {
    return {size.width, size.height};
}

Json jsonOf(const BenchRow& row) {
    Json passes = Json::array();
    for (const PassTime& pass : row.passes) passes.push_back({{"name", pass.name}, {"ms", pass.ms}});
    return {{"name", modeName(row.settings.path, row.settings.assign, row.parts)},
            {"path", nameOf(row.settings.path)},
            {"assign", nameOf(row.settings.assign)},
            {"transparency", nameOf(row.settings.transparency)},
            {"lighting", nameOf(row.settings.lighting)},
            {"samples", row.settings.msaa},
            {"same_picture", !drawsAnotherPicture(row.settings.assign)},
            {"scene", row.scene},
            {"camera", row.camera},
            {"size", jsonOf(row.settings.size)},
            {"light_count", orNull(row.requested_lights)},
            {"settings", parseOrderedJson(toJson(row.settings))},
            {"ms",
             {{"median", row.time.median},
              {"min", row.time.min},
              {"max", row.time.max},
              {"runs", row.time.runs},
              {"all", row.ms}}},
            {"host_ms", {{"record", row.time.record}, {"object_lists", row.time.object_lists}}},
            {"passes", passes},
            {"assign_ms", assignMs(row)},
            {"assign_share", assignShare(row)},
            {"bytes",
             {{"images", row.bytes.images},
              {"buffers", row.bytes.buffers},
              {"gbuffer_per_pixel", row.bytes.gbuffer_per_pixel},
              {"picture_images", row.bytes.picture_images}}},
            {"counters",
             {{"nonfinite_pixels", row.counters.nonfinite_pixels},
              {"overflowed_lists", row.counters.overflowed_lists},
              {"lights", row.counters.lights},
              {"unsorted_fragments", row.counters.unsorted.fragments}}},
            {"notes", row.notes}};
}

Json jsonOf(const BenchSkip& skip) {
    return {{"path", nameOf(skip.path)},
            {"assign", nameOf(skip.assign)},
            {"size", skip.size ? jsonOf(*skip.size) : Json(nullptr)},
            {"light_count", orNull(skip.lights)},
            {"reason", skip.reason}};
}

Json jsonOf(const Conclusion& c) {
    return {{"size", jsonOf(c.faster->settings.size)},
            {"lights", c.faster->counters.lights},
            {"faster", modeName(c.faster->settings.path, c.faster->settings.assign, c.faster->parts)},
            {"slower", modeName(c.slower->settings.path, c.slower->settings.assign, c.slower->parts)},
            {"ratio", c.ratio.median},
            {"interval", {c.ratio.low, c.ratio.high}},
            {"confidence", c.ratio.confidence},
            {"pairs", c.ratio.pairs},
            {"sure", c.ratio.isSure()},
            {"pass", c.pass},
            {"pass_ms", {c.faster_ms, c.slower_ms}},
            {"in_words", c.inWords()}};
}

}  // namespace

std::string benchJson(const Bench& bench, const std::vector<std::string>& files) {
    Json rows = Json::array(), skips = Json::array();
    for (const BenchRow& row : bench.rows) rows.push_back(jsonOf(row));
    for (const BenchSkip& skip : bench.skips) skips.push_back(jsonOf(skip));
    Json conclusions = Json::array();
    for (const Conclusion& conclusion : conclusionsOf(bench)) conclusions.push_back(jsonOf(conclusion));
    const Json json = {
        {"schema", 1},
        {"software", softwareName},
        {"device",
         {{"name", bench.device.name}, {"driver", bench.device.driver}, {"type", bench.device.type}}},
        {"scene", bench.scene},
        {"runs", bench.runs},
        {"max_ms", bench.options.max_ms},
        {"conclusions", conclusions},
        {"frames", rows},
        {"msaa_tables", sampleTablesJson(bench)},
        {"growth", growthJson(bench)},
        {"layers", layersJson(bench)},
        {"skipped", skips},
        {"files", files}};
    return jsonText(json) + "\n";
}

}  // namespace diptych::bench
