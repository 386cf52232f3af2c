// SPDX-License-Identifier: MIT
// Makes external text (names, arguments, messages of other programs) safe to print.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace diptych {

struct Character {
    char32_t code = 0;
    std::size_t size = 0;  // bytes; 0: invalid UTF-8 (RFC 3629, 4)
};

// The first character of `text`, which must not be empty.
Character characterAt(std::string_view text);

// Whether the character controls a terminal, or moves the text after it to another line or direction: C0
// and C1 controls and DEL (ECMA-48), line and paragraph separators, and bidirectional formatting
// characters (Unicode Standard Annex 9, 2).
bool isControl(char32_t code);

// For one line of a message. Controls and invalid UTF-8 become '?'. Text longer than `max` bytes is cut
// between characters and ends in "...".
std::string oneLine(std::string_view text, std::size_t max = 200);

// A whole message, with line breaks replaced by spaces. If it is too long, the middle becomes "..."; the
// beginning (what, where) and the end (what to do) remain.
std::string messageLine(std::string_view text);

// Lines for a terminal, also for JSON. Controls except line ends are escaped as in JSON strings, like
// "\u001b"; invalid UTF-8 becomes '?'.
std::string escapeControls(std::string_view text);

// Throws std::runtime_error if a file's name has a line break, because it would print as two lines.
void refuseLineBreak(std::string_view name);

}  // namespace diptych
