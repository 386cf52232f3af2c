// SPDX-License-Identifier: MIT
// Converts Settings to the command line that selects them.
#pragma once

#include "shared/frame/settings.h"

#include <string>
#include <vector>

namespace diptych {

// Words that parseCommandLine() reads as `command` on `scene` with these Settings, without the program's
// name. Skips default values, and the path for compare, which renders both.
std::vector<std::string> commandArguments(const std::string& command, const std::string& scene,
                                          const Settings& settings);

// Adds one option and its value to `words`.
std::vector<std::string> withOption(std::vector<std::string> words, const std::string& option,
                                    const std::string& value);

// Adds several words to `words`: options and their values.
std::vector<std::string> withArguments(std::vector<std::string> words, const std::vector<std::string>& more);

// Puts a word in single quotes if the shell would interpret any of its characters. Single quotes are
// escaped outside of the quotes, because they cannot occur inside.
std::string shellWord(const std::string& word);

// "diptych" and the words, quoted for a POSIX shell.
std::string shellLine(const std::vector<std::string>& words);

// shellLine(commandArguments(...)).
std::string commandOf(const std::string& command, const std::string& scene, const Settings& settings);

}  // namespace diptych
