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
    Json json = experiment::jsonOf(row);
    json.update({{"name", row.name()},
                 {"assign", nameOf(row.settings.assign)},
                 {"transparency", nameOf(row.settings.transparency)},
                 {"lighting", nameOf(row.settings.lighting)},
                 {"samples", row.settings.msaa},
                 {"same_picture", !drawsAnotherPicture(row.settings.assign)},
                 {"size", jsonOf(row.settings.size)},
                 {"light_count", orNull(row.requested_lights)},
                 {"assign_ms", assignMs(row)},
                 {"assign_share", assignShare(row)}});
    return json;
}

Json skipJson(const BenchRow& skip) {
    const Size& size = skip.settings.size;
    return {{"path", nameOf(skip.settings.path)},
            {"assign", nameOf(skip.settings.assign)},
            {"size", size.width > 0 ? jsonOf(size) : Json(nullptr)},
            {"light_count", orNull(skip.requested_lights)},
            {"reason", skip.failed}};
}

Json jsonOf(const Conclusion& c) {
    return {{"size", jsonOf(c.faster->settings.size)},
            {"lights", c.faster->whole(Measure::lights)},
            {"faster", c.faster->name()},
            {"slower", c.slower->name()},
            {"ratio", c.ratio.ratio},
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
    for (const BenchRow& skip : bench.skips) skips.push_back(skipJson(skip));
    Json conclusions = Json::array();
    for (const Conclusion& conclusion : conclusionsOf(bench)) conclusions.push_back(jsonOf(conclusion));
    const Json json = {
        {"schema", 2},
        {"software", softwareName},
        {"device",
         {{"name", bench.device.name}, {"driver", bench.device.driver}, {"type", bench.device.type}}},
        {"scene", bench.scene},
        {"runs", bench.runs},
        {"max_ms", bench.options.max_ms},
        {"conclusions", conclusions},
        {"rows", rows},
        {"msaa_tables", sampleTablesJson(bench)},
        {"growth", growthJson(bench)},
        {"layers", layersJson(bench)},
        {"skipped", skips},
        {"files", files}};
    return jsonText(json) + "\n";
}

}  // namespace diptych::bench
