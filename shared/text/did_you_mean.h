// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace diptych {

// The candidate that is nearest to a mistyped word, by the least number of letters that are inserted,
// removed, replaced or exchanged with their neighbour (Damerau 1964); upper and lower case are the same.
// Empty where the nearest is further than a third of the word's letters.
std::string_view nearestWord(std::string_view word, std::span<const std::string> candidates);

// "; did you mean albedo?", or empty.
std::string didYouMean(std::string_view word, std::span<const std::string> candidates);

}  // namespace diptych
