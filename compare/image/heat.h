// SPDX-License-Identifier: MIT
// The light-count heat map: colours, and a legend below an image.
#pragma once

#include "shared/image/png.h"

#include <array>
#include <cstdint>

namespace diptych {

// t in [0, 1]: dark blue, blue, teal, green, yellow, white. As in viridis (van der Walt and Smith 2015),
// lightness rises all the way, also for protan and deutan vision.
std::array<std::uint8_t, 3> heatColor(double t);

// The top of a map with this largest count: the next of 1, 2, 5 times a power of ten.
double heatTop(double largest);

// The image with a legend below it, on black: "LIGHTS PER PIXEL", a colour bar, and the counts at its ends
// and middle. Images narrower than 80 pixels are returned unchanged.
Image8 withHeatLegend(const Image8& image, double top);

}  // namespace diptych
