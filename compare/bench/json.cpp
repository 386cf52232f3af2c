// SPDX-License-Identifier: MIT
#include "compare/bench/findings.h"
#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"

namespace diptych::bench {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const Size& size) {
    return {size.width, size.height};
}

Json timesOf(const BenchRow& row) {
    return {{"median", row[Measure::ms]}, {"min", row[Measure::ms_min]}, {"max", row[Measure::ms_max]}};
}

Json rowJson(const BenchRow& row) {
    Json json = experiment::jsonOf(row);
    json.update({{"name", row.name()},
                 {"assign", nameOf(row.settings.assign)},
                 {"transparency", nameOf(row.settings.transparency)},
                 {"lighting", nameOf(row.settings.lighting)},
                 {"same_picture", !drawsAnotherImage(row.settings.assign)},
                 {"size", jsonOf(row.settings.size)},
                 {"light_count", orNull(row.requested_lights)},
                 {"assign_ms", passMs(row, "assign")},
                 {"assign_share", assignFraction(row)}});
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

Json conclusionJson(const Conclusion& c) {
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
            {"in_words", c.describe()}};
}

Json samplesJson(const Bench& bench) {
    const auto cellOf = [](const auto& cell) -> Json {
        const BenchRow& row = *cell.second;
        return {{"samples", cell.first},
                {"ms", timesOf(row)},
                {"lighting_ms", passMs(row, "shade")},
                {"image_mib", imageMib(row)},
                {"bytes_per_pixel", row.whole(Measure::gbuffer_bytes)},
                {"bytes_per_sample", bytesPerSample(row)}};
    };
    const auto lineOf = [&](const SampleTable::Line& line) -> Json {
        return {{"name", line.name()},
                {"path", nameOf(line.path)},
                {"transparency", nameOf(line.transparency)},
                {"cells", arrayOf(line.cells, cellOf)}};
    };
    return arrayOf(sampleTables(bench), [&](const SampleTable& table) -> Json {
        return {{"scene", table.scene},
                {"size", jsonOf(table.size)},
                {"lights", table.lights},
                {"columns", table.columns},
                {"rows", arrayOf(table.lines, lineOf)},
                {"memory", memoryText(table)}};
    });
}

Json growthJson(const Bench& bench) {
    const auto pointOf = [](const BenchRow* row) -> Json {
        return {{"value", row->growth->value}, {"ms", timesOf(*row)}, {"mib", memoryMib(*row)}};
    };
    const auto lineOf = [&](const GrowthLine& line) -> Json {
        return {{"axis", nameOf(line.axis)},
                {"unit", line.axis == GrowthAxis::textures ? "MiB of textures" : nameOf(line.axis)},
                {"path", nameOf(line.path)},
                {"points", arrayOf(line.rows, pointOf)}};
    };
    return {{"lines", arrayOf(growthLines(bench), lineOf)}, {"words", growthText(bench)}};
}

Json layersJson(const Bench& bench) {
    const auto registersOf = [](const PassRegisters& pass) -> Json {
        return {{"pass", pass.pass}, {"least", pass.min}, {"most", pass.max}};
    };
    const auto rowOf = [&](const LayerRow& row) -> Json {
        Json ways = Json::array();
        for (std::size_t i = 0; i < row.ways.size(); ++i)
            if (const BenchRow* const way = row.ways.at(i))
                ways.push_back({{"name", layerWays.at(i).name()},
                                {"ms", timesOf(*way)},
                                {"bytes_per_pixel", way->whole(Measure::gbuffer_bytes)},
                                {"image_bytes_per_pixel", imageBytesPerPixel(*way)},
                                {"registers", arrayOf(way->registers, registersOf)}});
        return {{"covered", row.cover.kind},     {"percent", row.cover.percent},
                {"lights", row.lights},          {"ways", ways},
                {"fastest", row.fastestNames()}, {"lead", row.lead}};
    };
    return {{"compiler", bench.compiler},
            {"rows", arrayOf(layerRows(bench), rowOf)},
            {"words", layersText(bench)}};
}

}  // namespace

Json benchJson(const Bench& bench) {
    return {{"schema", 2},
            {"software", softwareName},
            {"device", jsonOf(bench.device)},
            {"scene", bench.scene},
            {"runs", bench.runs},
            {"max_ms", bench.options.max_ms},
            {"conclusions", arrayOf(conclusionsOf(bench), conclusionJson)},
            {"rows", arrayOf(bench.rows, rowJson)},
            {"msaa_tables", samplesJson(bench)},
            {"growth", growthJson(bench)},
            {"layers", layersJson(bench)},
            {"skipped", arrayOf(bench.skips, skipJson)}};
}

}  // namespace diptych::bench
