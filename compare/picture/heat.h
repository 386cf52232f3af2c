// SPDX-License-Identifier: MIT
// The light-count heat map: colours, and a legend below a picture.
#pragma once

#include "shared/image/png.h"

#include <array>
#include <cstdint>

namespace diptych {

// t in [0, 1]: dark blue, cyan, green, yellow, red, white, its lightness never falling.
std::array<std::uint8_t, 3> heatColor(double t);

// The top of a map whose largest count is `largest`: the next of 1, 2, 5 times a power of ten.
double heatTop(double largest);

// The picture with a strip below it, on black: "LIGHTS PER PIXEL", a bar of the colours, and the counts at
// its ends and middle. Of less than 80 pixels across it has no room, and the picture comes back as it is.
Image8 withHeatLegend(const Image8& picture, double top);

}  // namespace diptych
