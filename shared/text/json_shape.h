// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace diptych {

// The cost of parsing a JSON text, computed before parsing. Parsers are recursive, so a few bytes per
// level could overflow the stack. They also need far more memory per value than its text.
struct JsonShape {
    std::size_t depth = 0;  // largest nesting of arrays and objects: 0 for "1", 2 for "[{}]"
    std::size_t objects = 0;
    std::size_t values = 0;  // upper bound: commas, arrays and objects, plus one
};

// Also works for invalid JSON: counts at least what a parser reaches before the error.
JsonShape jsonShape(std::string_view text);

// Deeper than any known file: glTF's own objects end at eight, extensions and extras add a few. Recursive
// code needs less than 1 KiB of stack per level.
inline constexpr std::size_t json_depth = 128;

// A value takes up to about 100 bytes in the tree (16 itself, 48 an empty array, 96 an object member with
// a short key): in total below 2 GiB.
struct JsonLimits {
    std::size_t values = std::size_t(1) << 24;
    std::size_t objects = values;
};

}  // namespace diptych
