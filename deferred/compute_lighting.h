// SPDX-License-Identifier: MIT
// Deferred lighting by compute shaders instead of a full-screen triangle.
#pragma once

#include "shared/draw/frame_inputs.h"

namespace diptych {

// Adds the passes that shade the first `groups` groups of samples of every pixel to `lit`, light batches
// among them; nothing drawn is 0. A workgroup is a square of pixels in one tile of the light lists. `frame`:
// with the groups in depth's place, where there are any. `lit`: of FrameInputs::lit_format, with storage
// where that is litFormat; what has fewer bits is drawn to from what is stored, as a device rounds the two
// differently.
void addComputeLighting(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                        gpu::uint groups, ImageRef lit);

}  // namespace diptych
