// SPDX-License-Identifier: MIT
#include "compare/tradeoff/tradeoff.h"

#include "compare/experiment/pareto.h"
#include "compare/run/command_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace diptych::tradeoff {
namespace {

// Adds all cameras if there are several.
std::vector<std::string> withCameras(std::vector<std::string> words, const Tradeoff& tradeoff) {
    if (tradeoff.cameras.size() < 2) return words;
    std::vector<std::string> cameras;
    for (const std::string& camera : tradeoff.cameras) {
        cameras.emplace_back("--camera=" + camera);
    }
    return withArguments(std::move(words), cameras);
}

// Settings for a command with the sweep's reference. Choices of the row that would change the reference go
// into the grid instead.
struct AgainstReference {
    Settings settings;
    std::string grid;
    bool sameReference = true;  // the grid is empty
};

AgainstReference againstReference(const Tradeoff& tradeoff, const TradeoffRow& row) {
    AgainstReference against{row.settings, {}, true};
    nlohmann::ordered_json swept = nlohmann::ordered_json::object();
    const Settings& requested = tradeoff.requested;
    for (const Field& field : settingFields()) {
        const std::string value = row.settings.valueOf(field.option);
        Settings other = requested;
        other.set(field.option, value);
        if (referenceSettings(other) == referenceSettings(requested)) continue;
        against.settings.set(field.option, requested.valueOf(field.option));
        if (ignoredBecause(row.settings, field.option).empty()) swept[std::string(field.option)] = value;
    }
    against.sameReference = swept.empty();
    against.grid = nlohmann::ordered_json{{"settings", swept}}.dump();
    if (tradeoff.cameras.size() > 1) against.settings.camera.clear();
    return against;
}

}  // namespace

std::string describe(const TradeoffRow& row, const Settings& requested) {
    return row.renderer.empty() ? describe(changesOf(row.settings, requested))
                                : fmt::format("{}, external renderer", row.renderer);
}

std::vector<std::size_t> rowsOf(const Tradeoff& tradeoff, std::optional<Path> path) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        if (tradeoff.rows[i].renderer.empty() && (!path || tradeoff.rows[i].settings.path == *path))
            rows.push_back(i);
    return rows;
}

std::vector<std::size_t> frontOf(const Tradeoff& tradeoff, std::size_t metric, std::optional<Path> path) {
    const std::vector<std::size_t> rows = rowsOf(tradeoff, path);
    std::vector<experiment::TimeError> points;
    for (const std::size_t i : rows) {
        const TradeoffRow& row = tradeoff.rows[i];
        // Disturbances only slow frames down. Median minus least estimates the noise without depending on
        // one outlier, as the greatest time would.
        points.push_back(
            {row[Measure::ms], row[errorMeasure(metric)], row[Measure::ms] - row[Measure::ms_min]});
    }
    std::vector<std::size_t> front;
    for (const std::size_t i : paretoFront(points)) front.push_back(rows[i]);
    return front;
}

std::optional<CameraRange> driftOf(const Tradeoff& tradeoff) {
    std::vector<double> ratios;
    for (const TradeoffRow& row : tradeoff.rows) {
        if (!row.renderer.empty()) continue;
        double first = 0, second = 0;
        for (const experiment::Row& camera : row.cameras) {
            if (camera.blocks.size() < 2) return {};
            first += camera.blocks[0].median;
            second += camera.blocks[1].median;
        }
        if (first > 0) ratios.push_back(second / first);
    }
    if (ratios.empty()) return {};
    std::ranges::sort(ratios);
    return CameraRange{ratios[ratios.size() / 2], ratios.front(), ratios.back()};
}

std::vector<Path> pathsOf(const Tradeoff& tradeoff) {
    std::vector<Path> paths;
    for (const auto& [path, name] : enumNames<Path>())
        if (!rowsOf(tradeoff, path).empty()) paths.push_back(path);
    return paths;
}

namespace {

// For an external renderer.
std::string commandOfRenderer(const char* command, const Tradeoff& tradeoff, const TradeoffRow& row,
                              const char* option, const char* value) {
    const std::vector<std::string> words = withOption(
        withCameras(commandArguments(command, tradeoff.scene, tradeoff.requested), tradeoff), option, value);
    return shellLine(withOption(words, "--renderer", fmt::format("{}={}", row.renderer, row.renderer_file)));
}

}  // namespace

std::string measuringCommand(const Tradeoff& tradeoff, const TradeoffRow& row) {
    if (!row.renderer.empty())
        return commandOfRenderer("tradeoff", tradeoff, row, "--grid", R"({"settings":{}})");
    const AgainstReference against = againstReference(tradeoff, row);
    std::vector<std::string> words = commandArguments("tradeoff", tradeoff.scene, against.settings);
    words = withOption(withCameras(std::move(words), tradeoff), "--grid", against.grid);
    if (tradeoff.runs != 5) words = withOption(std::move(words), "--runs", fmt::format("{}", tradeoff.runs));
    return shellLine(words);
}

std::string comparingCommand(const Tradeoff& tradeoff, const TradeoffRow& row) {
    if (!row.renderer.empty()) return commandOfRenderer("compare", tradeoff, row, "--baseline", "reference");
    const AgainstReference against = againstReference(tradeoff, row);
    if (!against.sameReference) return {};
    // compare renders both paths: both must support these Settings.
    for (const Path path : drawn_paths) {
        Settings other = row.settings;
        other.path = path;
        if (other.problem()) return {};
    }
    return shellLine(
        withOption(withCameras(commandArguments("compare", tradeoff.scene, against.settings), tradeoff),
                   "--baseline", "reference"));
}

std::string renderingCommand(const Tradeoff& tradeoff, const TradeoffRow& row) {
    if (!row.renderer.empty()) return {};
    Settings settings = row.settings;
    if (tradeoff.cameras.size() > 1) settings.camera.clear();
    return shellLine(withCameras(commandArguments("render", tradeoff.scene, settings), tradeoff));
}

}  // namespace diptych::tradeoff
