// SPDX-License-Identifier: MIT
// Filters before a comparison, which make it tolerate noise or features shifted by a pixel.
#pragma once

#include "shared/image/image.h"

namespace diptych::metrics {

// Gaussian blur with standard deviation `radius` pixels, truncated at three deviations. Non-finite pixels
// and pixels outside the image have no weight, and the other weights are renormalized. Non-finite pixels
// do not change.
Image blurred(const Image& image, double radius);

// Replaces every pixel of `test` by the one within `radius` rows and columns that is closest to the
// reference's pixel, by the largest component's difference; the spatially closest wins ties. NaN is
// closest to NaN. Both images have the same size.
Image shifted(const Image& reference, const Image& test, int radius);

}  // namespace diptych::metrics
