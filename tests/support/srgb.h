// SPDX-License-Identifier: MIT
// The curve of sRGB (IEC 61966-2-1), values of 0 to 1.
#pragma once

#include <cmath>

namespace diptych {

inline double decodedSrgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
inline double encodedSrgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace diptych
