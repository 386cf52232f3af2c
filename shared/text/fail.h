// SPDX-License-Identifier: MIT
// Errors in a file or option: one line that says what is wrong, where and what to do.
#pragma once

#include <stdexcept>
#include <string>

namespace diptych {

[[noreturn]] inline void fail(const std::string& what) {
    throw std::runtime_error(what);
}
// "WHO: WHY"; `who` names the faulty part.
[[noreturn]] inline void fail(const std::string& who, const std::string& why) {
    throw std::runtime_error(who + ": " + why);
}

}  // namespace diptych
