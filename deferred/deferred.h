// SPDX-License-Identifier: MIT
// The deferred path: surfaces go to a G-buffer, one full-screen pass shades what is left visible.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <vector>

namespace diptych {

// The passes of a frame as it is timed. `inputs` must outlive the list.
FrameImages addDeferred(PassList& passes, const FrameInputs& inputs);

// The passes that write channels, read from the G-buffer that the frame left and decoded: a difference to
// forward+ is the encoding's error. The request must not hold channels that the G-buffer does not store.
std::vector<CapturedImage> addDeferredCapture(PassList& passes, const FrameInputs& inputs,
                                              const FrameImages& frame, const CaptureRequest& request);

}  // namespace diptych
