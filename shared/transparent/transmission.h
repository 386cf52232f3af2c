// SPDX-License-Identifier: MIT
// Surfaces with KHR_materials_transmission, drawn after opaque surfaces and the background and before blended
// surfaces, by both paths. They show what is opaque behind them, refracted and blurred, and write depth: of
// several, the nearest is seen.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <cstddef>
#include <vector>

namespace diptych {

// Draws the surfaces over `lit`. Returns the depth that later draws test against; `depth` itself, and no
// pass, if the view has no such surface.
ImageRef addTransmission(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit);

// Draws the channels of these surfaces over those of opaque surfaces: of `images`, those from `first` on
// that describe transmission. `lit`: of opaque surfaces, for the light that they transmit.
void addTransmissionCapture(PassList& passes, const FrameInputs& inputs, ImageRef depth, ImageRef lit,
                            std::vector<CapturedImage>& images, std::size_t first);

}  // namespace diptych
