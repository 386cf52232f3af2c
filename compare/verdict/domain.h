// SPDX-License-Identifier: MIT
// Checks that a channel's values are in its valid range: unit vectors, fractions of 1, ...
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"

#include <string>

namespace diptych {

// Pixels of a channel outside its valid range (DebugMode::domain), beyond float32 rounding: "3 pixel(s)
// are no unit vectors, length 1.02 at 5,7"; empty if there are none. Only counts covered pixels that are
// no background (`ids`: the image's material_id; nullptr: no background). Ignores NaN and infinity, which
// the metrics handle.
std::string outsideDomain(const DebugMode& mode, const Image& image, const Coverage& coverage,
                          const Image* ids = nullptr);

}  // namespace diptych
