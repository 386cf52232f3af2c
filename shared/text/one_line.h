// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace diptych {

// Makes untrusted text (a name in a file, a library's message) fit for one line of a message: control
// characters and bytes that are not UTF-8 become '?', and text longer than `most` bytes is cut between two
// characters and ends in "...".
std::string oneLine(std::string_view text, std::size_t most = 200);

}  // namespace diptych
