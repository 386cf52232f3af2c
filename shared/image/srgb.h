// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace diptych {

// IEC 61966-2-1, in double: encoded 0 to 1 to linear 0 to 1, and back.
inline double linearFromSrgb(double s) {
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
inline double encodedBySrgb(double l) {
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

}  // namespace diptych
