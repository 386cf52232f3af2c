// SPDX-License-Identifier: MIT
#include "compare/bench/findings.h"
#include "compare/files/frame_json.h"
#include "compare/files/our_files.h"

namespace diptych::bench {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const Size& size) {
    return {size.width, size.height};
}

Json timesOf(const BenchRow& row) {
    return {{"median", row[Measure::ms]}, {"min", row[Measure::ms_min]}, {"max", row[Measure::ms_max]}};
}

Json jsonOf(const BenchRow& row) {
    Json json = experiment::jsonOf(row);
    json.update({{"name", row.name()},
                 {"assign", nameOf(row.settings.assign)},
                 {"transparency", nameOf(row.settings.transparency)},
                 {"lighting", nameOf(row.settings.lighting)},
                 {"same_picture", !drawsAnotherPicture(row.settings.assign)},
                 {"size", jsonOf(row.settings.size)},
                 {"light_count", orNull(row.requested_lights)},
                 {"assign_ms", passMs(row, "assign")},
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

Json samplesJson(const Bench& bench) {
    Json all = Json::array();
    for (const SampleTable& table : sampleTables(bench)) {
        Json lines = Json::array();
        for (const SampleTable::Line& line : table.lines) {
            Json cells = Json::array();
            for (const auto& [samples, row] : line.cells)
                cells.push_back({{"samples", samples},
                                 {"ms", timesOf(*row)},
                                 {"lighting_ms", passMs(*row, "shade")},
                                 {"image_mib", imageMib(*row)},
                                 {"bytes_per_pixel", row->whole(Measure::gbuffer_bytes)},
                                 {"bytes_per_sample", bytesPerSample(*row)}});
            lines.push_back({{"name", line.name()},
                             {"path", nameOf(line.path)},
                             {"transparency", nameOf(line.transparency)},
                             {"cells", cells}});
        }
        all.push_back({{"scene", table.scene},
                       {"size", jsonOf(table.size)},
                       {"lights", table.lights},
                       {"columns", table.columns},
                       {"rows", lines},
                       {"memory", memoryInWords(table)}});
    }
    return all;
}

Json growthJson(const Bench& bench) {
    Json lines = Json::array();
    for (const GrowthLine& line : growthLines(bench)) {
        Json points = Json::array();
        for (const BenchRow* row : line.rows)
            points.push_back(
                {{"value", row->growth->value}, {"ms", timesOf(*row)}, {"mib", memoryMib(*row)}});
        lines.push_back({{"axis", nameOf(line.axis)},
                         {"unit", line.axis == GrowthAxis::textures ? "MiB of textures" : nameOf(line.axis)},
                         {"path", nameOf(line.path)},
                         {"points", points}});
    }
    return {{"lines", lines}, {"words", growthInWords(bench)}};
}

Json layersJson(const Bench& bench) {
    Json rows = Json::array();
    for (const LayerRow& row : layerRows(bench)) {
        Json ways = Json::array();
        for (std::size_t i = 0; i < row.ways.size(); ++i) {
            const BenchRow* const way = row.ways.at(i);
            if (way == nullptr) continue;
            Json registers = Json::array();
            for (const PassRegisters& pass : way->registers)
                registers.push_back({{"pass", pass.pass}, {"least", pass.least}, {"most", pass.most}});
            ways.push_back({{"name", layerWays.at(i).name()},
                            {"ms", timesOf(*way)},
                            {"bytes_per_pixel", way->whole(Measure::gbuffer_bytes)},
                            {"image_bytes_per_pixel", imageBytesPerPixel(*way)},
                            {"registers", registers}});
        }
        rows.push_back({{"covered", row.cover.kind},
                        {"percent", row.cover.percent},
                        {"lights", row.lights},
                        {"ways", ways},
                        {"fastest", row.fastestNames()},
                        {"lead", row.lead}});
    }
    return {{"compiler", bench.compiler}, {"rows", rows}, {"words", layersInWords(bench)}};
}

}  // namespace

Json benchJson(const Bench& bench) {
    Json rows = Json::array(), skips = Json::array();
    for (const BenchRow& row : bench.rows) rows.push_back(jsonOf(row));
    for (const BenchRow& skip : bench.skips) skips.push_back(skipJson(skip));
    Json conclusions = Json::array();
    for (const Conclusion& conclusion : conclusionsOf(bench)) conclusions.push_back(jsonOf(conclusion));
    return {{"schema", 2},
            {"software", softwareName},
            {"device", jsonOf(bench.device)},
            {"scene", bench.scene},
            {"runs", bench.runs},
            {"max_ms", bench.options.max_ms},
            {"conclusions", conclusions},
            {"rows", rows},
            {"msaa_tables", samplesJson(bench)},
            {"growth", growthJson(bench)},
            {"layers", layersJson(bench)},
            {"skipped", skips}};
}

}  // namespace diptych::bench
