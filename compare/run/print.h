// SPDX-License-Identifier: MIT
// The one place where the program writes to stdout and stderr. What it says holds text from outside, so that
// everything passes shownText() or messageLine(), JSON too. Only colours and the line of progress, which are
// our own, are put around the text afterwards.
#pragma once

#include "compare/run/color.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace diptych {

class InputFile;

// On stdout; lines end where the text says so.
void printText(std::string_view text, ColorChoice color = ColorChoice::off);

// The whole of a file, in pieces of about 64 KiB.
void printFile(InputFile& file);

template <typename... Values>
void printOut(fmt::format_string<Values...> format, Values&&... values) {
    printText(fmt::format(format, std::forward<Values>(values)...));
}

// On stderr, in one write: "diptych: ", the message, the end of the line.
void printMessage(std::string_view message);

}  // namespace diptych
