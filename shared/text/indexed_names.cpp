// SPDX-License-Identifier: MIT
#include "shared/text/indexed_names.h"

#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace diptych {

std::string indexedNames(std::span<const std::string> names) {
    constexpr std::size_t shown = 20;  // about one screen
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), shown); ++i)
        list += fmt::format("{}{}{}", i ? ", " : "", i,
                            names[i].empty() ? "" : fmt::format(" \"{}\"", oneLine(names[i])));
    if (names.size() > shown) list += fmt::format(" and {} more", names.size() - shown);
    return list;
}

}  // namespace diptych
