// SPDX-License-Identifier: MIT
#include "shared/text/one_line.h"

#include <algorithm>

namespace diptych {

std::string oneLine(std::string_view text, std::size_t most) {
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; };
    const bool cut = text.size() > most;
    if (cut) {
        while (most > 0 && continues(text[most])) --most;
        text = text.substr(0, most);
    }
    std::string line(text);
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return cut ? line + "..." : line;
}

}  // namespace diptych
