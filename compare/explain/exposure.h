// SPDX-License-Identifier: MIT
// Whether lit of one Frame is another's times a factor: exposure, which no channel of the surface says.
#pragma once

#include "shared/image/image.h"

#include <optional>

namespace diptych {

// What `lit` is of `expected`, W x H x 3 both: the median ratio of their components, where at least half of
// them have it to within 0.1 %, as much as a file of half floats rounds by twice; nothing otherwise, and
// where nothing is bright enough to tell. Components of `expected` under a thousandth of its mean do not
// count.
std::optional<double> commonFactor(const Image& lit, const Image& expected);

// `test` is so many times brighter than `baseline`, both held against what is expected of each; nothing where
// either has no common factor or both the same one.
std::optional<double> exposureBetween(std::optional<double> baseline, std::optional<double> test);

}  // namespace diptych
