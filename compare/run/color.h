// SPDX-License-Identifier: MIT
// Colours and columns of a terminal.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace diptych {

enum class ColorChoice { automatic, on, off };

// Automatic: only a terminal that can show them, and not where NO_COLOR is set to anything (no-color.org).
bool hasColor(ColorChoice choice, std::FILE* stream);

// How many columns the terminal has that `stream` writes to; 0: it is none.
std::size_t terminalColumns(std::FILE* stream);

// The text with SGR codes (ECMA-48, 8.3.117) around its verdicts: FAIL and ERROR red, pass green, warning
// yellow, where they begin or end a line.
std::string colored(std::string_view text);

}  // namespace diptych
