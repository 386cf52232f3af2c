// SPDX-License-Identifier: MIT
// The only place that writes to stdout and stderr. Output contains untrusted text, so all of it, including
// JSON, passes escapeControls() or messageLine(). Only our own colours and progress line bypass them.
#pragma once

#include "compare/run/color.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace diptych {

class InputFile;

// Prints on stdout; adds no newline.
void printText(std::string_view text, ColorChoice color = ColorChoice::off);

// Flushes stdout. Returns 0, or the errno of the first write that failed; later ones need not fail.
int flushText();

// Prints a whole file, in pieces of about 64 KiB.
void printFile(InputFile& file);

template <typename... Values>
void printOut(fmt::format_string<Values...> format, Values&&... values) {
    printText(fmt::format(format, std::forward<Values>(values)...));
}

// Prints on stderr, in one write: "diptych: ", the message, a newline.
void printMessage(std::string_view message);

}  // namespace diptych
