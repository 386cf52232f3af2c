// SPDX-License-Identifier: MIT
// Numbers that are read beside each other.
#pragma once

#include <fmt/format.h>

#include <string>

namespace diptych {

// `value` with this many significant digits, and as many more as it takes to differ from `other`.
inline std::string distinguishingDigits(double value, double other, int digits = 3) {
    while (digits < 17 && value != other &&
           fmt::format("{:.{}g}", value, digits) == fmt::format("{:.{}g}", other, digits))
        ++digits;
    return fmt::format("{:.{}g}", value, digits);
}

}  // namespace diptych
