// SPDX-License-Identifier: MIT
// How much a surface channel uses of what the G-buffer's bits allow it at each pixel.
#pragma once

#include "compare/verdict/bound_use.h"
#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <optional>
#include <span>

namespace diptych {

// The channels of every field of Surface that lighting reads, so that lit is a function of them and of what
// both paths share.
std::span<const int> lightingFields();

// Of a field that deferred reads from a packed G-buffer and forward+ has as it is: the bound follows from
// forward+'s value and the number of bits alone. `slack`: granted beside it, in the channel's metric. Empty
// for other pairs and channels.
std::optional<BoundUse> encodingUse(const DebugMode& mode, const FramePair& pair, double slack = 0);

}  // namespace diptych
