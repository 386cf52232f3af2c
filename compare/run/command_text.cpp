// SPDX-License-Identifier: MIT
#include "compare/run/command_text.h"

#include <algorithm>
#include <cctype>

namespace diptych {
namespace {

bool isPlain(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-+=:,./@%").find(c) != std::string_view::npos;
}

}  // namespace

std::string shellWord(const std::string& word) {
    if (!word.empty() && std::ranges::all_of(word, isPlain)) return word;
    std::string quoted = "'";
    for (const char c : word)
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    return quoted + "'";
}

std::vector<std::string> commandArguments(const std::string& command, const std::string& scene,
                                          const Settings& settings) {
    std::vector<std::string> words{command};
    const Settings defaults;
    for (const Field& field : settingFields()) {
        const std::string value = settings.valueOf(field.option);
        if (value == defaults.valueOf(field.option) || (command == "compare" && field.option == "path"))
            continue;
        const std::string option = "--" + std::string(field.option);
        if (value.starts_with('-'))
            words.push_back(option + "=" + value);
        else
            words.insert(words.end(), {option, value});
    }
    if (scene.starts_with('-')) words.emplace_back("--");  // a file name may look like an option
    words.push_back(scene);
    return words;
}

std::vector<std::string> withOption(std::vector<std::string> words, const std::string& option,
                                    const std::string& value) {
    words.insert(words.begin() + 1, {option, value});  // after the command: "--" may end the options
    return words;
}

std::vector<std::string> withArguments(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.begin() + 1, more.begin(), more.end());
    return words;
}

std::string shellLine(const std::vector<std::string>& words) {
    std::string line = "diptych";
    for (const std::string& word : words) line.append(" ").append(shellWord(word));
    return line;
}

std::string commandOf(const std::string& command, const std::string& scene, const Settings& settings) {
    return shellLine(commandArguments(command, scene, settings));
}

}  // namespace diptych
