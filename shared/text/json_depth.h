// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace diptych {

// How deep JSON nests its arrays and objects: 0 for "1", 2 for "[{}]". Read before parsing, because parsers
// and what walks their trees recurse, and a few bytes a level overflow the stack. Text that is no JSON has a
// depth, too, no lower than what a parser can reach before it finds that out.
std::size_t jsonDepth(std::string_view text);

// Deeper than any file in use (glTF's own objects end at eight, extensions and extras add a few); a level
// costs the recursive walks less than 1 KiB of stack.
inline constexpr std::size_t json_depth = 128;

}  // namespace diptych
