// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

namespace diptych {

// The names with their indices, for a message: `0 "walk", 1, 2 "run"`. A name may be empty. Names after
// the first 20 are only counted.
std::string indexedNames(std::span<const std::string> names);

}  // namespace diptych
