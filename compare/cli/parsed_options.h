// SPDX-License-Identifier: MIT
// Options as the parser stores them.
#pragma once

#include "compare/cli/options.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych::cli {

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
    std::string bench_table = "modes", kernels = "off", keep = "all", twice = "lit";
    std::optional<int> runs;
    double max_ms = 2000;
    std::string max_bytes;
    std::vector<std::string> require;  // audit: NAME=MAGNITUDE
};

}  // namespace diptych::cli
