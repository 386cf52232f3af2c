// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace diptych {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                       inf = std::numeric_limits<float>::infinity();

}  // namespace diptych
