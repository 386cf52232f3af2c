// SPDX-License-Identifier: MIT
// Tolerance of a path that filters shadow maps near shadow boundaries, against the reference.
#pragma once

#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>

namespace diptych {

class ShadowEdges {
public:
    // `pair` must outlive it.
    explicit ShadowEdges(const FramePair& pair);

    // Whether the reference has shadow boundaries and the path filters shadow maps.
    bool any() const { return sun_ || local_ != nullptr; }
    // For the directional light, if hasSun(): the path's filter radius at the pixel, and the pixel's
    // distance from a shadow boundary, m, perpendicular to the light.
    bool hasSun() const { return sun_; }
    const ShadowFilterRadius& filterRadius(std::size_t pixel) const;
    double distance(std::size_t pixel) const { return double{reference_->shadow_edge.pixel(pixel)[0]}; }
    // Whether a shadow boundary of the directional light, or of point and spot lights, lies within the
    // path's filter radius at the pixel.
    bool isNear(std::size_t pixel) const { return sun_ && distance(pixel) <= filterRadius(pixel).radius; }
    bool isNearLocal(std::size_t pixel) const;
    // Permitted error of a channel at the pixel, in its unit. Within the filter radius: all that the light
    // adds, or all of its visibility. Elsewhere, and for channels without light: 0.
    double allowed(const DebugMode& mode, std::size_t pixel) const;

private:
    const Frame* reference_ = nullptr;
    const Frame* path_ = nullptr;
    bool sun_ = false;                                   // both have the directional light's shadow
    const Image* depth_ = nullptr;                       // of the path
    const Image *level_ = nullptr, *coarser_ = nullptr;  // of its clipmap
    const Image* local_ = nullptr;  // Frame::local_shadow_edge, if point or spot lights cast shadows
};

}  // namespace diptych
