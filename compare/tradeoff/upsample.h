// SPDX-License-Identifier: MIT
#pragma once

#include "shared/frame/frame.h"

namespace diptych::tradeoff {

// The Frame's lit, before and after blending, and material_id as a viewer of another size sees them, between
// pixel centres: lit bilinearly from the nearest 2x2 pixels that show a surface or something blended,
// background where the nearest pixel is background. So silhouettes stay in place and are not darkened by the
// black background.
// material_id of the nearest pixel. Of the same size: as it is. Throws std::runtime_error where one of the
// channels is missing.
Frame upsampled(Frame frame, const Size& size);

}  // namespace diptych::tradeoff
