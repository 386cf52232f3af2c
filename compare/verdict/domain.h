// SPDX-License-Identifier: MIT
// Whether the numbers of a channel are what they may be at all: unit vectors, shares of 1, ...
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"

#include <string>

namespace diptych {

// The pixels of a channel that are outside of its domain (DebugMode::domain), beyond float32's rounding:
// "3 pixel(s) are no unit vectors, length 1.02 at 5,7"; empty where there are none. Only covered pixels
// count, of them those that are no background of the picture (`ids`: its material_id; nullptr: none is), and
// NaN and infinity are left to the metrics.
std::string outsideDomain(const DebugMode& mode, const Image& image, const Coverage& coverage,
                          const Image* ids = nullptr);

}  // namespace diptych
