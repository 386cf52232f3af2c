// SPDX-License-Identifier: MIT
// The names and options of every command, for the command line's parser.
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
    std::string most_used{};  // options that --help prints, at most ten; empty: all of them
};
std::span<const Command> allCommands();
// Leaves the most used options alone in the command's help; returns how many others it has.
std::size_t hideSeldomUsed(CLI::App& app, const Command& command);

// The options as parsed, before resolve() interprets them together.
struct ParsedOptions {
    std::vector<std::pair<std::string, std::string>> settings;  // in the order of the command line
    std::vector<std::string> cameras;
    std::string settings_file, channels, debug;
    std::array<std::string, 2> sides;  // of drawn_paths: NAME=VALUE,...
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

// Timed frames where --runs does not say otherwise: few where times only stand beside a picture or a verdict.
constexpr int usualRuns(std::string_view command) {
    return command == "bench" || command == "tradeoff" ? 5 : 2;
}

// Adds everything that `command` understands to `app`; parsing fills `options` and `parsed`.
void describe(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed);

}  // namespace diptych::cli
