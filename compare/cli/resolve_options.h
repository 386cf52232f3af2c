// SPDX-License-Identifier: MIT
// Checks parsed options and combines those that depend on each other.
#pragma once

#include "compare/cli/command_options.h"

namespace diptych::cli {

// `options` as parsed, with its command. Throws std::runtime_error, one line, for a value that is not
// accepted.
void resolve(Options& options, const ParsedOptions& parsed);

}  // namespace diptych::cli
