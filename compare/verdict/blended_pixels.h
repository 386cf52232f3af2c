// SPDX-License-Identifier: MIT
// What lit may be off by where surfaces are blended, held against the reference in mode surface: it meets
// those with its own rays and reads their textures by its own filter, while what is opaque is a path's
// capture.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>

namespace diptych {

class BlendedPixels {
public:
    // `pair` outlives it.
    explicit BlendedPixels(const FramePair& pair);

    bool any() const { return share_ != nullptr; }
    // In the channel's own unit; 0 for others than lit. Beside a pixel that something blended covers it is
    // what the reference's picture changes by within two pixels: the rasterizer's edge, and a mip level that
    // is a step coarser.
    double allowed(const DebugMode& mode, std::size_t pixel) const;

private:
    const Image* share_ = nullptr;  // Frame::blended
    const Image* lit_ = nullptr;    // the reference's
};

}  // namespace diptych
