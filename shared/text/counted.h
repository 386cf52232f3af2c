// SPDX-License-Identifier: MIT
// A count and its noun.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace diptych {

// "1 light", "3 lights"; with an irregular plural "1 vertex", "3 vertices".
inline std::string counted(std::uint64_t count, std::string_view what, std::string_view plural = {}) {
    if (count == 1) return fmt::format("1 {}", what);
    return plural.empty() ? fmt::format("{} {}s", count, what) : fmt::format("{} {}", count, plural);
}

}  // namespace diptych
