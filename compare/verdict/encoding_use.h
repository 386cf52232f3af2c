// SPDX-License-Identifier: MIT
// How much of the quantization error bound a surface channel uses at each pixel.
#pragma once

#include "compare/verdict/bound_use.h"
#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <optional>
#include <span>

namespace diptych {

// Channels of all fields of Surface that lighting reads: lit depends only on them and on inputs that both
// paths share.
std::span<const int> lightingFields();

// For a field that deferred reads from a packed G-buffer and forward+ has unpacked. The bound only depends
// on forward+'s value and the number of bits. `slack`: added to it, in the channel's metric. Empty for
// other pairs and channels.
std::optional<BoundUse> encodingUse(const DebugMode& mode, const FramePair& pair, double slack = 0);

}  // namespace diptych
