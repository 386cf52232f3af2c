// SPDX-License-Identifier: MIT
// Parses the words of the command line into Options.
#pragma once

#include "compare/cli/options.h"

#include <string>
#include <vector>

namespace diptych::cli {

// `words` as the shell gives them, without the program's name. Every option of the tool's contract parses;
// throws std::runtime_error, one line, for a usage error and for what is not built yet.
Options parseCommandLine(const std::vector<std::string>& words);

// The words that a report has of a comparison ("compare ..."), as those of `view`. Anyone may have written
// them: only scene, Settings and what influences a verdict are taken. Where the report went and other
// renderers are left out; any other option throws std::runtime_error naming it.
Options parseReported(const std::vector<std::string>& words);

}  // namespace diptych::cli
