// SPDX-License-Identifier: MIT
// How much of the quantization error bound a surface channel uses at each pixel.
#pragma once

#include "compare/verdict/bound_use.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <optional>

namespace diptych {

// Compares one pixel's decoded value, `read`, with the value before packing, `own`. `slack` is added to the
// bound, in the channel's error kind.
PixelUse storedUse(const StoredField& field, const float* read, const float* own, int components,
                   double slack = 0);

// Compares what deferred decodes of a storedField() with forward+'s value. Each pixel's bound follows from
// that value and the number of bits alone. With MSAA every sample counts, also of the other
// lightingFields(), which are stored exactly. `slack`: granted beside it, in the channel's error kind. Empty
// for other pairs and channels, and for a channel that one of the two lacks.
std::optional<BoundUse> encodingUse(const DebugMode& mode, const FramePair& pair, double slack = 0);

}  // namespace diptych
