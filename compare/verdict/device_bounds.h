// SPDX-License-Identifier: MIT
// How far a channel of one path may differ on two devices at each pixel, by the precision that Vulkan
// promises of both.
#pragma once

#include "compare/verdict/bound_use.h"
#include "compare/verdict/surface_grid.h"
#include "compare/verdict/tolerance.h"

#include <array>
#include <string>
#include <vector>

namespace diptych {

// The bound of an interpolated channel, in the channel's unit. A vertex a step of the sub-pixel grid
// elsewhere moves a place by as much of a pixel, and never as far as the next one. It turns triangles
// narrower than two pixels as well; there the bound is the change to the next pixels of the material.
class PlaceBound {
public:
    PlaceBound(const DebugMode& mode, const FramePair& pair, const Image& baseline, const Image& test);
    double operator()(std::size_t i) const;

private:
    double change(const Image& image, std::size_t i, unsigned seen) const;

    const DebugMode& mode_;
    const SurfaceGrid& grid_;
    std::array<const Image*, 2> images_;
    double step_;
};

// Shadows in both pictures: where a pixel shows another share of a light that casts.
class Shadowed {
public:
    explicit Shadowed(const FramePair& pair);
    bool differs(std::size_t i) const;
    // The relative difference of light under shares that differs() takes for equal.
    double relative(std::size_t i) const;
    // Beside the edge of a shadow in either picture.
    bool isBesideEdge(std::size_t i) const;

private:
    std::vector<std::array<const Image*, 2>> images_;
};

// The tolerance of each pixel, and the difference that is held to it, both in the channel's metric.
class DeviceBounds {
public:
    DeviceBounds(const DebugMode& mode, const FramePair& pair);

    double operator()(std::size_t i) const;
    double error(std::size_t i) const;
    // How much further apart lit is than before something was blended over it, beyond its change to the next
    // pixels: no channel holds edges and textures of blended surfaces.
    double blendedApart(std::size_t i) const;
    std::string because() const;

private:
    enum class Kind { id, step, place, facet, surface, light, seen, list };
    static Kind kindOf(const DebugMode& mode);

    bool isBeside(std::size_t i) const;
    bool isColor() const;
    double textures(std::size_t i) const;
    std::string decoding() const;

    const DebugMode& mode_;
    const AcrossDevices& across_;
    Kind kind_;
    const Image &baseline_, &test_;
    PixelError error_;
    PlaceBound place_;
    FacetBound facet_;
    double rounded_as_;  // what is darker is rounded as this, in the channel's unit
    double bits_;
    const Image *texels_, *expected_;
    Shadowed shadowed_;
    std::array<const Image*, 2> unblended_{};     // of lit, where something may be blended
    std::array<double, 256> shares_{}, exact_{};  // decodeShares(), exactSrgb()
};

// How much a channel uses of its tolerance at each covered pixel.
BoundUse deviceUse(const DebugMode& mode, const FramePair& pair);

// The largest tolerance of a pixel, with the reason.
Tolerance deviceTolerance(const DebugMode& mode, const FramePair& pair, const BoundUse& use);

}  // namespace diptych
