// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/frame.h"

namespace diptych::experiment {

// Resamples lit, before and after blending, and material_id at the pixel centres of another size.
// lit: bilinear over the 2x2 nearest pixels, without background pixels. Background if the nearest pixel is
// background. Silhouettes stay in place, and the black background does not darken them.
// material_id: nearest pixel.
// Returns the Frame unchanged if the size is equal. Throws std::runtime_error if a channel is missing.
Frame upsampled(Frame frame, const Size& size);

}  // namespace diptych::experiment
