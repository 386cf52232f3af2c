// SPDX-License-Identifier: MIT
// Names and options of every command, for the parser.
#pragma once

#include "compare/cli/options.h"

#include <CLI/CLI.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::cli {

struct Command {
    std::string name, does, example;
    std::string most_used{};  // options that --help prints, at most ten; empty: all
};
std::span<const Command> allCommands();
// Hides all but the most used options from the command's help. Returns how many it hid.
std::size_t hideSeldomUsed(CLI::App& app, const Command& command);

// Parsed options before resolve() combines them.
struct ParsedOptions {
    std::vector<std::pair<std::string, std::string>> settings;  // in command-line order
    std::vector<std::string> cameras;
    std::string settings_file, channels, debug;
    std::array<std::string, 2> sides;  // by drawn_paths: NAME=VALUE,...
    std::vector<std::string> test;
    std::vector<std::string> renderers;  // NAME=FILE.json
    std::optional<std::string> times;
    std::string baseline = "deferred", crop, metric;
    std::optional<std::string> pixel;
    std::optional<double> tolerance;
    std::optional<int> frames;
    std::optional<double> fps;
    std::string bench_paths, bench_assign, bench_sizes, bench_transparencies, bench_lightings, light_counts;
    std::string bench_axes;
    std::string bench_table = "modes", kernels = "on", keep = "all", twice = "lit";
    std::optional<int> runs;
    double max_ms = 2000;
    std::string max_bytes;
    std::vector<std::string> require;  // audit: NAME=MAGNITUDE
};

// Default of --runs. Low where times only accompany images or verdicts.
constexpr int defaultRuns(std::string_view command) {
    return command == "bench" || command == "tradeoff" ? 5 : 2;
}

// Adds all options of `command` to `app`. Parsing fills `options` and `parsed`.
void describe(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed);

}  // namespace diptych::cli
