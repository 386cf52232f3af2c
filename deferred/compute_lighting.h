// SPDX-License-Identifier: MIT
// Deferred lighting by compute shaders instead of a full-screen triangle.
#pragma once

#include "shared/draw/frame_inputs.h"

namespace diptych {

// Adds the passes, light batches included, that shade the first `groups` sample groups of every pixel to
// `lit`. Pixels without geometry become 0. A workgroup is a square of pixels in one tile of the light
// lists.
// `frame`: with sample groups in place of depth, if there are any. `lit`: of FrameInputs::lit_format. It
// needs storage usage if that is litFormat. Smaller formats are drawn from a stored float32 image, because
// devices round stores and attachment writes differently.
void addComputeLighting(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                        gpu::uint groups, ImageRef lit);

}  // namespace diptych
