// SPDX-License-Identifier: MIT
// Detects a common factor between two lit images: exposure, which no surface channel contains.
#pragma once

#include "shared/image/image.h"

#include <optional>

namespace diptych {

// The median ratio of `lit` to `expected`, both W x H x 3, if at least half of the components have it to
// within 0.1 %, twice the rounding of a half-float file. Components of `expected` under a thousandth of
// its mean are ignored. Empty without such a factor or without bright components.
std::optional<double> commonFactor(const Image& lit, const Image& expected);

// How many times brighter `test` is than `baseline`, from their common factors. Empty if a factor is
// missing or both are equal.
std::optional<double> exposureBetween(std::optional<double> baseline, std::optional<double> test);

}  // namespace diptych
