// SPDX-License-Identifier: MIT
#include "compare/run/color.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>

namespace diptych {
namespace {

constexpr std::string_view reset = "\033[0m", red = "\033[1;31m", green = "\033[32m", yellow = "\033[33m";
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> words{
    {{"FAIL", red}, {"ERROR", red}, {"pass", green}, {"warning", yellow}, {"warn", yellow}}};

bool isLetter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string coloredLine(std::string_view line) {
    const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
    for (const auto& [word, code] : words) {
        const std::size_t end = start + word.size();
        const bool first =
            line.substr(start).starts_with(word) && (end == line.size() || !isLetter(line[end]));
        const bool last = line.ends_with(word) && line.size() > word.size() &&
                          !isLetter(line[line.size() - word.size() - 1]);
        if (!first && !last) continue;
        const std::size_t at = first ? start : line.size() - word.size();
        std::string result(line.substr(0, at));
        return result.append(code).append(word).append(reset).append(line.substr(at + word.size()));
    }
    return std::string(line);
}

}  // namespace

std::size_t terminalColumns(std::FILE* stream) {
    winsize size{};
    return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool hasColor(ColorChoice choice, std::FILE* stream) {
    if (choice != ColorChoice::automatic) return choice == ColorChoice::on;
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string_view(value ? value : "");
    };
    return variable("NO_COLOR").empty() && !variable("TERM").empty() && variable("TERM") != "dumb" &&
           isatty(fileno(stream)) == 1;
}

std::string colored(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        result += coloredLine(text.substr(0, end));
        if (end < text.size()) result += '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

}  // namespace diptych
