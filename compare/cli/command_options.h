// SPDX-License-Identifier: MIT
// Names and options of every command, for the parser.
#pragma once

#include "compare/cli/parsed_options.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace diptych::cli {

struct Command {
    std::string name, does, example;
    std::string most_used{};  // options that --help prints, at most ten; empty: all
};
std::span<const Command> allCommands();
// Hides all but the most used options from the command's help. Returns how many it hid.
std::size_t hideSeldomUsed(CLI::App& app, const Command& command);

// Default of --runs. Low where times only accompany images or verdicts.
constexpr int defaultRuns(std::string_view command) {
    return command == "bench" || command == "tradeoff" ? 5 : 2;
}

// Adds all options of `command` to `app`. Parsing fills `options` and `parsed`.
void describe(CLI::App& app, const std::string& command, Options& options, ParsedOptions& parsed);

}  // namespace diptych::cli
