// SPDX-License-Identifier: MIT
// What a path that filters shadow maps may show near the edges of shadows, held against the reference.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>

namespace diptych {

class ShadowEdges {
public:
    // `pair` outlives it.
    explicit ShadowEdges(const FramePair& pair);

    // Whether the reference has edges and the path filters.
    bool any() const { return sun_ || local_ != nullptr; }
    // Of the sun's shadow, where hasSun(): how far the path's filter reaches at the pixel, and how far the
    // pixel is from an edge, m across the light.
    bool hasSun() const { return sun_; }
    const ShadowReach& reach(std::size_t pixel) const;
    double distance(std::size_t pixel) const { return double{reference_->shadow_edge.pixel(pixel)[0]}; }
    // Whether an edge of the sun's shadow, or of those of points and spots, lies within the reach of the
    // path's filter at the pixel.
    bool isNear(std::size_t pixel) const { return sun_ && distance(pixel) <= reach(pixel).reach; }
    bool isNearLocal(std::size_t pixel) const;
    // By how much a channel may be off at the pixel, in its own unit: within the filter's reach as much as
    // the light adds, of its visibility everything; 0 elsewhere, and for channels that no light changes.
    double allowed(const DebugMode& mode, std::size_t pixel) const;

private:
    const Frame* reference_ = nullptr;
    const Frame* path_ = nullptr;
    bool sun_ = false;                                   // both have its shadow
    const Image* depth_ = nullptr;                       // of the path
    const Image *level_ = nullptr, *coarser_ = nullptr;  // of its clipmap
    const Image* local_ = nullptr;  // Frame::local_shadow_edge, where points or spots cast
};

}  // namespace diptych
