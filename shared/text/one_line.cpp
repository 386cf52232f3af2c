// SPDX-License-Identifier: MIT
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace {

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}

}  // namespace

Character characterAt(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t size = byte(0) < 0x80   ? 1
                             : byte(0) < 0xc2 ? 0
                             : byte(0) < 0xe0 ? 2
                             : byte(0) < 0xf0 ? 3
                             : byte(0) < 0xf5 ? 4
                                              : 0;
    if (size == 0 || size > text.size()) return {};
    char32_t code = size == 1 ? byte(0) : byte(0) & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if (!continues(text[i])) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    // Overlong encodings, surrogates and code points beyond U+10FFFF.
    const bool wrong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000) ||
                       (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
    return wrong ? Character{} : Character{code, size};
}

bool isControl(char32_t code) {
    constexpr std::pair<char32_t, char32_t> ranges[] = {{0x00, 0x1f},     {0x7f, 0x9f},     {0x061c, 0x061c},
                                                        {0x200e, 0x200f}, {0x2028, 0x202e}, {0x2066, 0x2069}};
    return std::ranges::any_of(
        ranges, [&](const auto& range) { return range.first <= code && code <= range.second; });
}

std::string oneLine(std::string_view text, std::size_t max) {
    const bool cut = text.size() > max;
    if (cut) {
        while (max > 0 && continues(text[max])) --max;
        text = text.substr(0, max);
    }
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        const auto [code, size] = characterAt(text);
        if (size == 0 || isControl(code))
            line += '?';
        else
            line += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return cut ? line + "..." : line;
}

std::string messageLine(std::string_view text) {
    // The program's longest message, a list of all names, has about 1,500 bytes. A screen of 24 x 80
    // characters shows 1,920.
    constexpr std::size_t head = 1400, tail = 500;
    const auto spaced = [](std::string_view part) {
        std::string line(part);
        std::ranges::replace(line, '\n', ' ');
        return line;
    };
    if (text.size() <= head + tail) return oneLine(spaced(text), head + tail);
    std::size_t from = text.size() - tail;
    while (from < text.size() && continues(text[from])) ++from;
    return oneLine(spaced(text.substr(0, head + 1)), head) + oneLine(spaced(text.substr(from)), tail);
}

std::string escapeControls(std::string_view text) {
    std::string shown;
    shown.reserve(text.size());
    const auto isPlain = [](char c) { return (c >= ' ' && c < '\x7f') || c == '\n'; };
    while (!text.empty()) {
        const auto plain = std::ranges::find_if_not(text, isPlain) - text.begin();
        shown += text.substr(0, static_cast<std::size_t>(plain));
        text.remove_prefix(static_cast<std::size_t>(plain));
        if (text.empty()) break;
        const auto [code, size] = characterAt(text);
        if (size == 0)
            shown += '?';
        else if (isControl(code))
            shown += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(code));
        else
            shown += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return shown;
}

void refuseLineBreak(std::string_view name) {
    if (name.find('\n') != name.npos)
        throw std::runtime_error(oneLine(name) + ": has a line break in its name; rename it");
}

}  // namespace diptych
