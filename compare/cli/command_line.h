// SPDX-License-Identifier: MIT
// Parses the words of the command line.
#pragma once

#include "compare/cli/command.h"

namespace diptych::cli {

// A text to print (--help, --version, --manual, --completion), or a command to run.
struct CommandLine {
    std::string help;
    Command command{};
};

// `words` come from the shell, without the program's name. Throws std::runtime_error, one line, for a
// usage error.
CommandLine parseCommandLine(const std::vector<std::string>& words);

}  // namespace diptych::cli
