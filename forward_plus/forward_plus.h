// SPDX-License-Identifier: MIT
// The forward+ path: depth pre-pass (by choice), then every surface is shaded as it is drawn.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/settings.h"

#include <string>
#include <vector>

namespace diptych {

// Decides what forward+ leaves open in the inputs, which is whether it draws a depth pre-pass
// (FrameInputs::prepass). With --prepass auto that takes counting the fragments of the view once. Returns
// notes on what was decided and why, one line each. Must be called before addForwardPlus().
std::vector<std::string> prepareForwardPlus(FrameInputs& inputs, const Settings& settings);

// The passes of a frame as it is timed. `inputs` must outlive the list.
FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs);

// The passes that write channels, over the depth that the frame left. For request.through_gbuffer every
// surface is encoded as inputs.gbuffer does and decoded again before it is shaded.
std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 const FrameImages& frame, const CaptureRequest& request);

}  // namespace diptych
