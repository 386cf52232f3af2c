// SPDX-License-Identifier: MIT
#include "compare/bench/compiled_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace diptych::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string numberOr(const ShaderCost::Value& value, const char* otherwise) {
    return value ? fmt::format("{:.0f}", *value) : otherwise;
}

// One path's pipelines in a row.
struct Cell {
    int pipelines = 0;
    ShaderCost heaviest;
};
struct Row {
    std::string pass, shader;
    std::vector<Cell> cells;  // by path
};

std::vector<Row> rowsOf(std::span<const CompiledPath> paths) {
    std::vector<Row> rows;
    const auto cellOf = [&](const std::string& pass, const std::string& shader, std::size_t path) -> Cell& {
        auto row =
            std::ranges::find_if(rows, [&](const Row& r) { return r.pass == pass && r.shader == shader; });
        if (row == rows.end()) row = rows.insert(row, {pass, shader, std::vector<Cell>(paths.size())});
        return row->cells[path];
    };
    for (const bool captures : {false, true})
        for (std::size_t path = 0; path < paths.size(); ++path)
            for (const PlannedPipeline& pipeline : paths[path].pipelines)
                for (const CompiledShader& shader : pipeline.compiled.shaders) {
                    if (pipeline.captures != captures) continue;
                    const std::string pass =
                        captures && pipeline.pass != "capture" ? pipeline.pass + ", captured" : pipeline.pass;
                    Cell& cell = cellOf(pass, shader.name, path);
                    if (cell.pipelines++ == 0 || isHeavier(shader.cost, cell.heaviest))
                        cell.heaviest = shader.cost;
                }
    return rows;
}

Json costJson(const ShaderCost& cost) {
    Json json = Json::object();
    for (const ShaderCostRow& row : shaderCostRows())
        if (const ShaderCost::Value value = cost.*row.value) json[std::string(row.name)] = *value;
    return json;
}

Json pipelineJson(const PlannedPipeline& pipeline) {
    Json shaders = Json::array();
    for (const CompiledShader& shader : pipeline.compiled.shaders) {
        Json statistics = Json::object();
        for (const CompilerStatistic& statistic : shader.statistics)
            statistics[statistic.name] = statistic.value;
        shaders.push_back({{"shader", shader.name},
                           {"subgroup_size", shader.subgroup_size},
                           {"cost", costJson(shader.cost)},
                           {"statistics", statistics}});
    }
    Json json{{"pass", pipeline.pass},
              {"captures", pipeline.captures},
              {"name", pipeline.name},
              {"variant", pipeline.variant},
              {"shaders", shaders}};
    if (!pipeline.compiled.error.empty()) json["error"] = pipeline.compiled.error;
    return json;
}

}  // namespace

std::string addedText(const FeatureCost& cost) {
    std::vector<std::string> words;
    for (const ShaderCostRow& row : shaderCostRows()) {
        const ShaderCost::Value with = cost.with.*row.value, without = cost.without.*row.value;
        if (!row.shown || !with || !without || *with == *without) continue;
        words.push_back(row.value == &ShaderCost::occupancy
                            ? fmt::format("occupancy {:.0f} -> {:.0f}", *without, *with)
                            : fmt::format("{:+.0f} {}", *with - *without, row.heading));
    }
    return words.empty() ? "different code, same cost" : fmt::format("{}", fmt::join(words, ", "));
}

std::string compiledText(std::span<const CompiledPath> paths, const DeviceInfo& device) {
    std::string text = fmt::format(
        "  compiled for {} ({}): each shader's heaviest variant (occupancy: waves resident on a SIMD unit)\n",
        device.name, device.driver);
    std::string columns;
    for (const ShaderCostRow& row : shaderCostRows())
        if (row.shown) columns += fmt::format("{:>10}", row.heading);
    text += fmt::format("    {:<24} {:<26}", "", "");
    for (const CompiledPath& path : paths)
        text += fmt::format(" | {:<{}}", nameOf(path.path), 10 + columns.size());
    text += fmt::format("\n    {:<24} {:<26}", "pass", "shader");
    for (std::size_t i = 0; i < paths.size(); ++i) text += fmt::format(" | {:>10}{}", "pipelines", columns);
    text += '\n';
    for (const Row& row : rowsOf(paths)) {
        text += fmt::format("    {:<24} {:<26}", row.pass, row.shader);
        for (const Cell& cell : row.cells) {
            if (cell.pipelines == 0) {
                text += fmt::format(" | {:<{}}", "", 10 + columns.size());
                continue;
            }
            text += fmt::format(" | {:>10}", cell.pipelines);
            for (const ShaderCostRow& cost : shaderCostRows())
                if (cost.shown) text += fmt::format("{:>10}", numberOr(cell.heaviest.*cost.value, "-"));
        }
        while (text.ends_with(' ')) text.pop_back();
        text += '\n';
    }
    for (const CompiledPath& path : paths) {
        if (!path.features.empty())
            text += fmt::format("  cost of each feature in {}'s heaviest pipelines\n", nameOf(path.path));
        for (const FeatureCost& cost : path.features)
            text += fmt::format("    {:<26} {} ({})\n", cost.feature, addedText(cost), cost.shader);
    }
    for (const CompiledPath& path : paths) {
        for (const std::string& line : path.errors) text += fmt::format("  error: {}\n", line);
        for (const std::string& line : path.warnings) text += fmt::format("  warning: {}\n", line);
    }
    return text;
}

Json compiledJson(std::span<const CompiledPath> paths, const DeviceInfo& device) {
    Json all = Json::array();
    for (const CompiledPath& path : paths) {
        Json pipelines = Json::array(), features = Json::array();
        for (const PlannedPipeline& pipeline : path.pipelines) pipelines.push_back(pipelineJson(pipeline));
        for (const FeatureCost& cost : path.features)
            features.push_back({{"feature", cost.feature},
                                {"pass", cost.pass},
                                {"shader", cost.shader},
                                {"with", costJson(cost.with)},
                                {"without", costJson(cost.without)}});
        all.push_back({{"path", nameOf(path.path)},
                       {"pipelines", pipelines},
                       {"features", features},
                       {"errors", path.errors},
                       {"warnings", path.warnings}});
    }
    return {{"device", {{"name", device.name}, {"driver", device.driver}, {"type", device.type}}},
            {"paths", all}};
}

}  // namespace diptych::bench
