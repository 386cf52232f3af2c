// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// The names with their indices, for a message: `0 "walk", 1, 2 "run"`. A name may be empty. Names after
// the first 20 are only counted.
std::string indexedNames(std::span<const std::string> names);

// Whether `choice` is an integer.
bool isIndex(const std::string& choice);

// The item that `choice` names: an integer is an index, another text one of the item's names. Empty if there
// is none. Throws std::runtime_error, "WHO: ...", if several have the name.
std::optional<std::size_t> indexOfNamed(const std::string& choice,
                                        std::span<const std::vector<std::string>> names,
                                        std::string_view who);
std::optional<std::size_t> indexOfNamed(const std::string& choice, std::span<const std::string> names,
                                        std::string_view who);

}  // namespace diptych
