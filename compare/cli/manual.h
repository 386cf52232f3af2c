// SPDX-License-Identifier: MIT
// The manual page and the shells' completions, made of the same options that --help prints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace diptych::cli {

// diptych(1) in the man macros: every command with its options, examples and exit codes. `version` as
// --version prints it.
std::string manualPage(const CLI::App& app, const std::string& version);

inline constexpr std::string_view completedShells = "bash|zsh|fish";

// A script that completes commands, options, their values where these are words of a list, the built-in
// scenes and files. `shell` is one of completedShells; throws std::runtime_error naming them where it is not.
std::string completion(const CLI::App& app, const std::string& shell, const std::vector<std::string>& scenes);

}  // namespace diptych::cli
