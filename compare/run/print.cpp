// SPDX-License-Identifier: MIT
#include "compare/run/print.h"

#include "shared/text/one_line.h"

#include <cstdio>
#include <string>

namespace diptych {

void printText(std::string_view text, ColorChoice color) {
    const std::string shown = shownText(text);
    const std::string out = hasColor(color, stdout) ? colored(shown) : shown;
    std::fwrite(out.data(), 1, out.size(), stdout);
}

void printMessage(std::string_view message) {
    const std::string line = "diptych: " + messageLine(message) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace diptych
