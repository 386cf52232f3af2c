// SPDX-License-Identifier: MIT
// The forward+ path: depth pre-pass (by choice), then every surface is shaded as it is drawn.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <vector>

namespace diptych {

// The passes of a frame as it is timed. `inputs` must outlive the list.
FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs);

// The passes that write channels, over the depth that the frame left. With request.through_gbuffer every
// surface is encoded as inputs.gbuffer does and decoded again before it is shaded.
std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 const FrameImages& frame, const CaptureRequest& request);

}  // namespace diptych
