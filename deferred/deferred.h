// SPDX-License-Identifier: MIT
// The deferred path: surfaces go to a G-buffer, one full-screen pass shades what is left visible.
#pragma once

#include "shared/draw/frame_inputs.h"

#include <span>
#include <vector>

namespace diptych {

// The passes of a frame as it is timed. `inputs` must outlive the list.
FrameImages addDeferred(PassList& passes, const FrameInputs& inputs);

// The passes that write channels, read back from the G-buffer and decoded: a difference to forward+ is the
// encoding's error. Channels that the G-buffer does not carry must not be asked for.
std::vector<CapturedImage> addDeferredCapture(PassList& passes, const FrameInputs& inputs,
                                              std::span<const int> modes);

}  // namespace diptych
