// SPDX-License-Identifier: MIT
// Errors of what a file or an option says: one line that says what is wrong, where and what to do.
#pragma once

#include <stdexcept>
#include <string>

namespace diptych {

[[noreturn]] inline void fail(const std::string& what) {
    throw std::runtime_error(what);
}
// Names the part that is at fault first: "WHO: WHY".
[[noreturn]] inline void fail(const std::string& who, const std::string& why) {
    throw std::runtime_error(who + ": " + why);
}

}  // namespace diptych
