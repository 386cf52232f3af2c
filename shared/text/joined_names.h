// SPDX-License-Identifier: MIT
// The names of a table's rows, in its order, as a message or --help lists them.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// "flip, relative_rmse"
std::string joinedNames(const auto& rows, std::string_view separator = ", ") {
    std::vector<std::string_view> names;
    for (const auto& row : rows) names.push_back(row.name);
    return fmt::format("{}", fmt::join(names, separator));
}

}  // namespace diptych
