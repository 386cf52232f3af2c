// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace diptych {

// What a file says (a name, a library's complaint about it) as it may stand in a message: control characters
// and bytes that are not UTF-8 become '?', and what is longer than `most` bytes ends in "...", between two
// characters.
std::string oneLine(std::string_view text, std::size_t most = 200);

}  // namespace diptych
