// SPDX-License-Identifier: MIT
// Tolerances between two paths, with reasons, derived from the precision that the G-buffer's encoding
// loses.
#pragma once

#include "compare/reference/light/lighting.h"
#include "compare/reference/scattering/sampling.h"
#include "compare/verdict/blended_pixels.h"
#include "compare/verdict/environment_cost.h"
#include "compare/verdict/frame_pair.h"
#include "compare/verdict/shadow_edges.h"
#include "shared/frame/debug_modes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct Tolerance {
    double max = 0;  // in the channel's error kind
    std::string because;
    bool max_pixels = false;  // against the reference: 0.1 % of the pixels may exceed it
};

// Tolerance of `mode`, a channel of both Frames.
Tolerance derivedTolerance(const DebugMode& mode, const FramePair& pair);

// Approximations of a path, each of which its tolerance against the reference allows an error of lit.
enum class Approximation { shadow_filter, ibl_diffuse, ibl_specular, blending, haze_steps };
inline constexpr std::size_t approximations = 5;

class Allowances {
public:
    // `pair`, of a path and the reference, must outlive it.
    explicit Allowances(const FramePair& pair)
        : pair_(pair), edges_(pair), environment_(pair), blended_(pair) {}
    bool any() const;
    // Allowed errors of a channel at the pixel, in its unit, by Approximation.
    std::array<double, approximations> at(const DebugMode& mode, std::size_t pixel) const;

private:
    const FramePair& pair_;
    ShadowEdges edges_;
    EnvironmentCost environment_;
    BlendedPixels blended_;
};

// Error of float32 shading against double precision, relative to the pixel's largest component. More where
// Frame::rounding says so.
inline constexpr double shadingRounding = reference::everywhereRounded;

using reference::surerThan95;

// gpuUlps of the pixel's largest component, in the channel's error kind. Relative: that fraction, because the
// denominator is at least the component. Absolute: of the image's largest value. Angular: errors of that
// fraction in all three components turn a vector by sqrt(3) times it. Indices are exact.
double gpuSlack(const DebugMode& mode, const Image& baseline);

// For lit channels of a packed deferred Frame and a reference: the Frame whose `channels` and
// `through_gbuffer` show the effect of the encoding, either the reference itself or forward+ of the same
// view. Else nullptr.
const Frame* encodingFrame(const DebugMode& mode, const FramePair& pair);

// Quantization error bound of a surface channel for a packed path against the reference, in the channel's
// error kind; 0 for forward+, a full G-buffer and lit channels.
double encodingBound(const DebugMode& mode, const FramePair& pair);

// Comparison with the reference: errors of the covered pixels in row-major order, without the encoding's
// effect (encodingFrame()) and minus the reference's uncertainty. Empty if there is neither, and for
// channels other than lit ones.
std::optional<std::vector<double>> certainErrors(const DebugMode& mode, const FramePair& pair);

// The same for any two images of the channel in a comparison with the reference, even without uncertainty.
std::vector<double> openErrors(const DebugMode& mode, const FramePair& pair, const Image& baseline,
                               const Image& test);

// The smallest value that at least a `fraction` of all values, 0 to 1, do not exceed; 0 without values.
double nearestRank(std::vector<double> values, double fraction);

// Number of pixels where deferred differs from forward+'s shading of surfaces after the G-buffer's
// encoding, so that the encoding does not explain the difference. Empty if forward+ has no such image.
std::optional<std::uint64_t> unexplainedPixels(const DebugMode& mode, const FramePair& pair);

// Whether the encoding explains one pixel, by row-major index: false if the two differ there.
std::optional<bool> encodingExplains(const DebugMode& mode, const FramePair& pair, std::size_t pixel);

}  // namespace diptych
