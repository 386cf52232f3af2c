// SPDX-License-Identifier: MIT
// How much a lit channel uses of what the G-buffer's bits allow it at each pixel.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace diptych {

// How far float32 shading may be from double precision, of the pixel's largest component.
inline constexpr double shadingRounding = 1e-4;

// A pixel darker than so many floors of the metric is rounded as one of so many.
double roundedFloors(const Requirements& needs);

struct EncodingUse {
    // The largest difference, as a share of what is allowed at its pixel; beyond 1 the bits do not explain
    // it.
    double used = 0;
    int x = -1, y = -1;         // its pixel
    std::uint64_t beyond = 0;   // pixels that use more than is allowed
    double most = 0, mean = 0;  // of what is allowed, in the channel's metric
    // What is allowed beside the bits, by formats of fewer bits than float32: "; and 9 steps of ..."; or
    // nothing.
    std::string beside;
};

// Deferred against forward+ at a packed encoding: at each pixel the bound that forward+ has from its own
// surfaces and the bits (Frame::encoding_bound), and the rounding of float32, of the format of lit and of
// shading in floats of 16 bits. Empty for other pairs and channels,
// and where forward+ has no bounds.
std::optional<EncodingUse> encodingUse(const DebugMode& mode, const FramePair& pair);

// What one pixel may differ by, of which encodingUse() tells the share that is used.
struct EncodingAllowed {
    double radiance = 0;   // W/(sr m^2): the bits' bound and rounding
    double in_metric = 0;  // the same in the channel's metric
};
std::optional<EncodingAllowed> encodingAllowed(const DebugMode& mode, const FramePair& pair,
                                               std::size_t pixel);

// Of a packed deferred Frame against the reference, the bound of each pixel, W x H x 1: what forward+ has of
// the same view. nullptr where there is none, and for forward+ and a full G-buffer, which need none.
const Image* allowedByBits(const DebugMode& mode, const FramePair& pair);

}  // namespace diptych
