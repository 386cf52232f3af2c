// SPDX-License-Identifier: MIT
// From what is asked for back to the words of the command line.
#pragma once

#include "shared/frame/settings.h"

#include <string>
#include <vector>

namespace diptych {

// The words that parseCommandLine() reads as `command` of `scene` with these Settings, without the program's
// name. Only what is not the default is said; the path is not where `command` is compare, which draws both.
std::vector<std::string> commandWords(const std::string& command, const std::string& scene,
                                      const Settings& settings);

// The same with one more option.
std::vector<std::string> withOption(std::vector<std::string> words, const std::string& option,
                                    const std::string& value);

// The same with several words more, options and their values.
std::vector<std::string> withWords(std::vector<std::string> words, const std::vector<std::string>& more);

// "diptych" and the words, quoted so that a POSIX shell reads them back.
std::string shellLine(const std::vector<std::string>& words);

// shellLine(commandWords(...)).
std::string commandOf(const std::string& command, const std::string& scene, const Settings& settings);

}  // namespace diptych
