// SPDX-License-Identifier: MIT
#pragma once

#include "shared/draw/frame_inputs.h"

namespace diptych {

// Variant of shaders that read the G-buffer.
Variant lightingVariant(const FrameInputs& inputs);

}  // namespace diptych
