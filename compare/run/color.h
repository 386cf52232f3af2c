// SPDX-License-Identifier: MIT
// Terminal colours and columns.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace diptych {

enum class ColorChoice { automatic, on, off };

// Automatic: only on terminals that support colour, unless NO_COLOR is set and not empty (no-color.org).
bool hasColor(ColorChoice choice, std::FILE* stream);

// Columns of the terminal behind `stream`; 0: not a terminal.
std::size_t terminalColumns(std::FILE* stream);

// Adds SGR codes (ECMA-48, 8.3.117) around verdicts at the start or end of a line: FAIL and ERROR red,
// pass green, warning yellow.
std::string colored(std::string_view text);

}  // namespace diptych
