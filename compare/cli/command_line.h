// SPDX-License-Identifier: MIT
// Parses the words of the command line into Options.
#pragma once

#include "compare/cli/options.h"

#include <string>
#include <vector>

namespace diptych::cli {

// `words` come from the shell, without the program's name. Throws std::runtime_error, one line, for a
// usage error.
Options parseCommandLine(const std::vector<std::string>& words);

// Parses the words of a comparison in a report ("compare ...") as words of `view`. Reports are untrusted
// input: only the scene, Settings and options that influence a verdict are read. Output paths and external
// renderers are skipped. Any other option throws std::runtime_error naming it.
Options parseReported(const std::vector<std::string>& words);

}  // namespace diptych::cli
