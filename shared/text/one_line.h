// SPDX-License-Identifier: MIT
// Text from outside (names of files, layers and materials, arguments, what other programs said) as it may be
// shown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace diptych {

struct Character {
    char32_t code = 0;
    std::size_t size = 0;  // bytes; 0: the bytes are no UTF-8 (RFC 3629, 4)
};

// The character that `text`, which is not empty, begins with.
Character characterAt(std::string_view text);

// Whether a terminal obeys the character, or shows the text after it in another order or on another line:
// C0 and C1 controls and DEL (ECMA-48), line and paragraph separators, and the characters that set the
// direction of text (Unicode Standard Annex 9, 2).
bool isControl(char32_t code);

// For one line of a message: controls and bytes that are not UTF-8 become '?', and text longer than `most`
// bytes is cut between two characters and ends in "...".
std::string oneLine(std::string_view text, std::size_t most = 200);

// A whole message, whose line breaks become spaces. Of one that is too long the beginning, which says what
// and where, and the end, which says what to do, with "..." between them.
std::string messageLine(std::string_view text);

// Lines as a terminal may show them, JSON too: controls other than the end of a line are written like
// "\u001b", as strings of JSON have them, and bytes that are not UTF-8 become '?'.
std::string shownText(std::string_view text);

// Throws std::runtime_error where the name of a file has a line break: printed, it would pass for two lines.
void refuseLineBreak(std::string_view name);

}  // namespace diptych
