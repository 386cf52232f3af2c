// SPDX-License-Identifier: MIT
#include "shared/text/one_line.h"

#include <algorithm>

namespace diptych {

namespace {

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}

// Length in bytes of the UTF-8 character that `text` begins with; 0 if it is invalid (RFC 3629, 4).
std::size_t characterAt(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t size = byte(0) < 0x80   ? 1
                             : byte(0) < 0xc2 ? 0
                             : byte(0) < 0xe0 ? 2
                             : byte(0) < 0xf0 ? 3
                             : byte(0) < 0xf5 ? 4
                                              : 0;
    if (size > text.size()) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if (!continues(text[i])) return 0;
    if (size < 3) return size;
    // Overlong encodings, surrogates, and code points beyond U+10FFFF.
    const bool wrong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
                       (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f);
    return wrong ? 0 : size;
}

}  // namespace

std::string oneLine(std::string_view text, std::size_t most) {
    const bool cut = text.size() > most;
    if (cut) {
        while (most > 0 && continues(text[most])) --most;
        text = text.substr(0, most);
    }
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        const std::size_t size = characterAt(text);
        const auto first = static_cast<unsigned char>(text[0]);
        if (size == 0 || first < 0x20 || first == 0x7f)
            line += '?';
        else
            line += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return cut ? line + "..." : line;
}

}  // namespace diptych
