// SPDX-License-Identifier: MIT
// The forward+ path: an optional depth pre-pass, then every surface is shaded as it is drawn.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"
#include "shared/frame/settings.h"

#include <string>
#include <vector>

namespace diptych {

// Decides whether forward+ draws a depth pre-pass (FrameInputs::prepass). --prepass auto counts the view's
// fragments once. Returns notes on the decision and its reason, one line each. Must be called before
// addForwardPlus().
std::vector<std::string> prepareForwardPlus(FrameInputs& inputs, const Settings& settings);

// The passes of a timed frame. `inputs` must outlive the list.
FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs);

// The passes that write channels, using the frame's depth. For request.through_gbuffer, surfaces are
// encoded as inputs.gbuffer does and decoded again before shading.
std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 const FrameImages& frame, const CaptureRequest& request);

}  // namespace diptych
