// SPDX-License-Identifier: MIT
// Largest difference of one path's channel between two devices at each pixel, by the precision that Vulkan
// guarantees for both.
#pragma once

#include "compare/verdict/bound_use.h"
#include "compare/verdict/surface_grid.h"
#include "compare/verdict/tolerance.h"

#include <array>
#include <string>
#include <vector>

namespace diptych {

// Bound of an interpolated channel, in the channel's unit. Moving a vertex by one subpixel step moves a
// position by that fraction of a pixel, never as far as the next pixel. It also turns triangles narrower
// than two pixels; there the bound is the change to the next pixels of the material.
class PixelBound {
public:
    PixelBound(const DebugMode& mode, const FramePair& pair, const Image& baseline, const Image& test);
    double operator()(std::size_t i) const;

private:
    double change(const Image& image, std::size_t i, unsigned seen) const;

    const DebugMode& mode_;
    const SurfaceGrid& grid_;
    std::array<const Image*, 2> images_;
    double step_;
};

// Shadows in both images: finds pixels with different visibility of a shadow-casting light. Also compares
// the test's surfaces under the baseline's shadow maps, which decide how those are relit: a shadow's corner
// may lie between both devices' positions.
class Shadowed {
public:
    explicit Shadowed(const FramePair& pair);
    bool differs(std::size_t i) const;
    // Relative difference of light under visibilities that differs() considers equal.
    double relative(std::size_t i) const;
    // Next to a shadow boundary in any of the images.
    bool isBesideEdge(std::size_t i) const;

private:
    std::vector<std::array<const Image*, 3>> images_;  // relit (else baseline), test, baseline
};

// Tolerance of each pixel, and the difference compared with it, both in the channel's error kind.
class DeviceBounds {
public:
    DeviceBounds(const DebugMode& mode, const FramePair& pair);

    double operator()(std::size_t i) const;
    double error(std::size_t i) const;
    // Increase of lit's difference by blending, minus its change to the next pixels: no channel contains
    // edges and textures of blended surfaces.
    double blendedDifference(std::size_t i) const;
    std::string because() const;

private:
    enum class Kind { id, step, position, facet, surface, pane, light, part, visibility, list };
    static Kind kindOf(const DebugMode& mode);

    bool isBeside(std::size_t i) const;
    // Largest change of the channel to a neighbouring pixel of the image.
    double toNeighbours(const Image& image, std::size_t i) const;
    bool isColor() const;
    double textures(std::size_t i) const;
    // Difference of a decoded colour of this value.
    double decoded(double value) const;
    // Difference of albedo by F0, which darkens the base of specular-glossiness.
    double darkened(std::size_t i) const;
    std::string decoding() const;

    const DebugMode& mode_;
    const AcrossDevices& across_;
    Kind kind_;
    const Image &baseline_, &test_;
    PixelError error_;
    PixelBound position_;
    FacetBound facet_;
    double rounded_as_;  // rounding of darker pixels equals that at this value, in the channel's unit
    double per_texel_;   // change per unit of a linear texel, in the channel's unit
    double bits_;
    const Image *texels_, *expected_;
    bool darkens_;     // albedo, of a scene with specular-glossiness
    const Image* f0_;  // nullptr: not drawn
    Shadowed shadowed_;
    std::array<const Image*, 2> unblended_{};        // of lit, if anything may be blended
    std::array<double, 256> fractions_{}, exact_{};  // decodeFractions(), exactSrgb()
};

// Use of the tolerance at each covered pixel.
BoundUse deviceUse(const DebugMode& mode, const FramePair& pair);

// The largest tolerance of any pixel, with the reason.
Tolerance deviceTolerance(const DebugMode& mode, const FramePair& pair, const BoundUse& use);

}  // namespace diptych
