// SPDX-License-Identifier: MIT
// Turns Settings back into the words of the command line that asks for them.
#pragma once

#include "shared/frame/settings.h"

#include <string>
#include <vector>

namespace diptych {

// The words from which parseCommandLine() reads `command` of `scene` with these Settings, without the
// program's name. Settings with their default value are left out, and so is the path of compare, which draws
// both.
std::vector<std::string> commandWords(const std::string& command, const std::string& scene,
                                      const Settings& settings);

// `words` with one option and its value added.
std::vector<std::string> withOption(std::vector<std::string> words, const std::string& option,
                                    const std::string& value);

// `words` with several words added: options and their values.
std::vector<std::string> withWords(std::vector<std::string> words, const std::vector<std::string>& more);

// Puts a word in single quotes if the shell would interpret any character of it. A single quote cannot stand
// inside single quotes, so it is escaped outside of them.
std::string shellWord(const std::string& word);

// "diptych" and the words, quoted so that a POSIX shell reads them back.
std::string shellLine(const std::vector<std::string>& words);

// shellLine(commandWords(...)).
std::string commandOf(const std::string& command, const std::string& scene, const Settings& settings);

}  // namespace diptych
