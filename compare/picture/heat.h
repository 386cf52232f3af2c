// SPDX-License-Identifier: MIT
// The light-count heat map: colours, and a legend in the picture itself.
#pragma once

#include "shared/image/png.h"

#include <array>
#include <cstdint>

namespace diptych {

// t in [0, 1]: dark blue, cyan, green, yellow, red, white, its lightness never falling.
std::array<std::uint8_t, 3> heatColor(double t);

// The top of a map whose largest count is `largest`: the next of 1, 2, 5 times a power of ten.
double heatTop(double largest);

// Draws a bar of the colours with the counts at its ends and middle into the lower left corner, on black. A
// picture below 64 x 32 pixels is left alone: it has no room.
void drawHeatLegend(Image8& image, double top);

}  // namespace diptych
