// SPDX-License-Identifier: MIT
// The manual page and shell completions, generated from the options of --help.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace diptych::cli {

// diptych(1) in man macros: commands with options, examples and exit codes. `version`: the text of
// --version.
std::string manualPage(const CLI::App& app, const std::string& version);

inline constexpr std::string_view completedShells = "bash|zsh|fish";

// A script that completes commands, options, enumerated values, built-in scenes and files. `shell` is one
// of completedShells; otherwise throws std::runtime_error listing them.
std::string completion(const CLI::App& app, const std::string& shell, const std::vector<std::string>& scenes);

}  // namespace diptych::cli
