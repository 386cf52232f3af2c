// SPDX-License-Identifier: MIT
// A command of the program. Its file holds its words in --help, its options, their checks and the function
// that runs it. The options are a struct XLine, the parsed command line of X, made of groups that commands
// share.
#pragma once

#include "compare/cli/scene_group.h"

#include <functional>
#include <type_traits>

namespace diptych::cli {

struct Command {
    std::string name, does, example;
    std::string most_used{};  // options that --help prints, at most ten; empty: all
    std::string more_help{};  // printed below the example

    std::shared_ptr<const OutputGroup> line{};  // an XLine
    // Takes the words after --, which are another command's; nullptr: they are the command's own.
    std::vector<std::string>* submitted{};
    // Adds the options to the parser, in the order of --help.
    std::function<void(CLI::App&)> describe{};
    // Checks parsed options and combines them. Throws std::runtime_error, one line.
    std::function<void()> resolve{};
    // Prints the result on stdout and returns the exit code. Throws std::runtime_error, one line.
    std::function<int()> run{};
};

// `command`: its text in --help. The functions take a Line&.
template <class Line>
Command makeCommand(Command command, auto describe, auto resolve, auto run) {
    const auto line = std::make_shared<Line>();
    command.line = line;
    if constexpr (requires { line->submitted; }) command.submitted = &line->submitted;
    command.describe = [line, describe](CLI::App& app) { describe(app, *line); };
    command.resolve = [line, resolve] { resolve(*line); };
    command.run = [line, run] {
        if constexpr (std::is_base_of_v<ImageGroup, Line>)
            if (line->list_channels) return listChannels(line->json);
        return run(std::as_const(*line));
    };
    return command;
}

// All commands, in the order of --help, each with new options.
std::vector<Command> allCommands();

}  // namespace diptych::cli
