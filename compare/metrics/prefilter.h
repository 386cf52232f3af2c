// SPDX-License-Identifier: MIT
// What makes a comparison forgive noise, or features that moved by a pixel.
#pragma once

#include "shared/image/image.h"

namespace diptych::metrics {

// Blurred by a Gaussian of standard deviation `radius` pixels, cut at three times that; weights beyond the
// picture and of pixels with a NaN or infinity are left out and made up for, and such pixels stay as they
// are.
Image blurred(const Image& image, double radius);

// `test` with every pixel replaced by that one within `radius` pixels (rows and columns) which is nearest to
// the reference's: by its largest component's distance, then by its own distance. NaN is nearest to NaN.
// Both of one size.
Image shifted(const Image& reference, const Image& test, int radius);

}  // namespace diptych::metrics
