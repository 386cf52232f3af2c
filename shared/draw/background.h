// SPDX-License-Identifier: MIT
// The environment where nothing was drawn, and the haze before it: one pass of both paths.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

namespace diptych {

// Adds it to `lit`, which an earlier pass has drawn or (Load::clear) none has; nothing without an
// environment and haze.
void addBackground(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit,
                   Load load = Load::keep);

// The image of lit that a capture of `group` goes on from, with the background drawn; invalid where the group
// has no lit, or there is no environment and no haze. It comes before the capture's pass: a transient is read
// back after the last pass that has it.
ImageRef addCaptureBackground(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                              const CaptureGroup& group);

}  // namespace diptych
