// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace diptych {

// The candidate closest to a mistyped word: the fewest letters inserted, removed, replaced or swapped with
// their neighbour (Damerau 1964), ignoring case. Empty if the distance exceeds a third of the word's
// length.
std::string_view nearestWord(std::string_view word, std::span<const std::string> candidates);

// "; did you mean albedo?", or empty.
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace diptych
