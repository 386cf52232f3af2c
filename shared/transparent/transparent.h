// SPDX-License-Identifier: MIT
// Blending of transparent surfaces over the opaque image, shared by both paths.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <vector>

namespace diptych {

// Range of view distances of the blended surfaces, m, not nearer than the near plane; both 1 without such
// surfaces.
gpu::BlendedConstants blendedRange(const DrawList& draws, const View& view);

// Throws std::runtime_error if the light lists of blended surfaces are too long for one draw: blended
// fragments have no partial sums that a second draw could continue.
void checkLightsOfBlended(const FrameInputs& inputs);

// Draws surfaces with transmission (transmission.h), then blended surfaces, over `lit`, which contains opaque
// surfaces and the background. `depth` is tested against and not written. Adds no pass if the view has
// neither.
void addTransparent(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit);

// The same for the lit of a capture that is the list's last pass. `images`: those of that pass are sorted
// by the pass that completes them. Channels of transmission show its surfaces; others remain those of opaque
// surfaces. lit occurs twice: the earlier one is marked before_blending.
void addTransparentCapture(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                           std::vector<CapturedImage>& images);

}  // namespace diptych
