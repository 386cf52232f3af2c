// SPDX-License-Identifier: MIT
// What is blended over the opaque picture: one pass of both paths.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <vector>

namespace diptych {

// Distances between which the view's blended surfaces lie, m, none nearer than its near plane; both 1 where
// there are none.
gpu::BlendedConstants blendedRange(const DrawList& draws, const View& view);

// Throws std::runtime_error where blended surfaces are lit by longer lists than one draw walks: fragments
// that are blended have no sums that a second draw could go on from.
void checkLightsOfBlended(const FrameInputs& inputs);

// Blends the view's blended draws over `lit`, which holds the opaque surfaces and the background, where
// nothing opaque is in front of them: `depth`, which stays as it is. Adds no pass where there are none.
void addTransparent(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit);

// The same over the lit of the capture that is the list's last pass, where it has one: `images`' last ones,
// which are put in the order in which they are ready. Other channels are those of the opaque surfaces; lit is
// among them once more, before_blending, of the same image at an earlier pass.
void addTransparentCapture(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                           std::vector<CapturedImage>& images);

}  // namespace diptych
