// SPDX-License-Identifier: MIT
// Filters applied before a comparison, so that it tolerates noise, or features that moved by a pixel.
#pragma once

#include "shared/image/image.h"

namespace diptych::metrics {

// Blurred by a Gaussian of standard deviation `radius` pixels, truncated at three times that. Pixels beyond
// the picture or with a NaN or infinity get no weight and the others are renormalised; pixels with a NaN or
// infinity stay as they are.
Image blurred(const Image& image, double radius);

// `test` with every pixel replaced by the one within `radius` rows and columns whose value is closest to the
// reference's pixel, by the largest component's difference; of equal ones the spatially closest. NaN is
// closest to NaN. Both images have one size.
Image shifted(const Image& reference, const Image& test, int radius);

}  // namespace diptych::metrics
