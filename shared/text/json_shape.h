// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace diptych {

// What parsing a JSON text will cost, computed before it is parsed. Parsers and code that walks their trees
// recurse, so that a few bytes for each level could overflow the stack; and they use far more memory for a
// value than its text has.
struct JsonShape {
    std::size_t depth = 0;  // largest number of open arrays and objects: 0 for "1", 2 for "[{}]"
    std::size_t objects = 0;
    std::size_t values = 0;  // upper bound: the number of commas, arrays and objects, plus one
};

// Text that is not JSON also has a shape: at least what a parser reaches before it finds the error.
JsonShape jsonShape(std::string_view text);

// Deeper than any file in use (glTF's own objects end at eight, extensions and extras add a few); a level
// takes less than 1 KiB of stack in recursive code.
inline constexpr std::size_t json_depth = 128;

// A value takes at most some 100 bytes of the tree (16 itself, 48 an empty array, 96 a member of an object
// with a short key): together below 2 GiB.
struct JsonLimits {
    std::size_t values = std::size_t(1) << 24;
    std::size_t objects = values;
};

}  // namespace diptych
