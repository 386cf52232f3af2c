// SPDX-License-Identifier: MIT
// Tolerance of lit at blended surfaces against the reference in mode surface. The reference traces those
// with its own rays and filters their textures itself; opaque surfaces are a path's capture.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>

namespace diptych {

class BlendedPixels {
public:
    // `pair` must outlive it.
    explicit BlendedPixels(const FramePair& pair);

    bool any() const { return share_ != nullptr; }
    // Tolerance in the channel's unit; 0 for channels other than lit. Next to a pixel with a blended
    // surface, it is the reference's change within two pixels. That covers the rasteriser's edge, and a
    // mip level one step coarser.
    double allowed(const DebugMode& mode, std::size_t pixel) const;

private:
    const Image* share_ = nullptr;  // Frame::blended
    const Image* lit_ = nullptr;    // the reference's
};

}  // namespace diptych
