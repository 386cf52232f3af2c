// SPDX-License-Identifier: MIT
// Environment and haze of pixels without geometry: one pass, shared by both paths.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

namespace diptych {

// Adds the background to `lit`, or clears it first with Load::clear. Does nothing without an environment
// and haze.
void addBackground(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit,
                   Load load = Load::keep);

// Image that holds the background, on which a capture of `group` continues its `lit`. Invalid if the group
// has no lit, or without environment and haze. Add it before the capture's pass: a transient is read back
// after the last pass that uses it.
ImageRef addCaptureBackground(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                              const CaptureGroup& group);

}  // namespace diptych
