// SPDX-License-Identifier: MIT
// The deferred path: draws surfaces to a G-buffer and shades visible ones in a full-screen pass.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <string>
#include <vector>

namespace diptych {

// Returns a note about the second G-buffer pass, if the scene needs one.
std::vector<std::string> prepareDeferred(FrameInputs& inputs, const Settings& settings);

// Adds the passes of a timed frame. `inputs` must outlive the list.
FrameImages addDeferred(PassList& passes, const FrameInputs& inputs);

// Adds the passes that write channels, decoded from the frame's G-buffer: their difference from forward+
// is the encoding's error. The request must not contain channels that the G-buffer does not store.
std::vector<CapturedImage> addDeferredCapture(PassList& passes, const FrameInputs& inputs,
                                              const FrameImages& frame, const CaptureRequest& request);

}  // namespace diptych
