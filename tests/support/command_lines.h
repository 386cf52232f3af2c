// SPDX-License-Identifier: MIT
// Options of a parsed command line.
#pragma once

#include "compare/cli/command_line.h"

#include <string>
#include <vector>

namespace diptych {

// `Options`: the command's own (DiffLine), or a group that it has (SceneGroup).
template <class Options>
Options parsedAs(const std::vector<std::string>& words) {
    return dynamic_cast<const Options&>(*cli::parseCommandLine(words).command.line);
}

}  // namespace diptych
