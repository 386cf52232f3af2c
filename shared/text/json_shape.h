// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace diptych {

// What JSON will ask of a parser, counted before it is parsed: parsers and what walks their trees recurse, so
// that a few bytes a level overflow the stack, and they spend far more bytes on a value than its text has.
struct JsonShape {
    std::size_t depth = 0;  // arrays and objects that are open at once: 0 for "1", 2 for "[{}]"
    std::size_t objects = 0;
    std::size_t values = 0;  // at most so many: one more than commas, arrays and objects
};

// Text that is no JSON has a shape, too, no less than what a parser can reach before it finds that out.
JsonShape jsonShape(std::string_view text);

// Deeper than any file in use (glTF's own objects end at eight, extensions and extras add a few); a level
// costs the recursive walks less than 1 KiB of stack.
inline constexpr std::size_t json_depth = 128;

}  // namespace diptych
