// SPDX-License-Identifier: MIT
// How far apart two paths may be, and why: derived from the precision that the G-buffer's encoding loses.
#pragma once

#include "compare/reference/sampling.h"
#include "compare/verdict/frame_pair.h"
#include "shared/frame/debug_modes.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

struct Tolerance {
    double max = 0;  // in the channel's metric
    std::string because;
    bool most_pixels = false;  // 0.1 % of the pixels may exceed it: against the reference
};

// The tolerance of `mode`, a channel of both Frames.
Tolerance derivedTolerance(const DebugMode& mode, const FramePair& pair);

// How far float32 shading may be from double precision, of the pixel's largest component.
inline constexpr double shadingRounding = 1e-4;

using reference::surerThan95;

// gpuUlps of the pixel's largest component in the channel's metric. Relative: that share, for the denominator
// is no smaller than the component. Absolute: of the largest value in the image. Angular: all three
// components off by so much turn a vector by sqrt(3) times the share. Indices are exact.
double gpuSlack(const DebugMode& mode, const Image& baseline);

// Of lit channels of a packed deferred Frame and a reference: the Frame whose `channels` and
// `through_gbuffer` say what the encoding changes, the reference's own or forward+'s of the same view.
// nullptr elsewhere.
const Frame* encodingShownBy(const DebugMode& mode, const FramePair& pair);

// What the bits of a packed path that is compared with the reference allow a channel of its surfaces, in the
// channel's metric; 0 for forward+, a full G-buffer and lit channels.
double encodingBound(const DebugMode& mode, const FramePair& pair);

// In a comparison with the reference: the covered pixels' errors, without what the encoding changes
// (encodingShownBy()), less the reference's uncertainty, row by row. Empty where there is neither, and for
// channels other than lit ones.
std::optional<std::vector<double>> certainErrors(const DebugMode& mode, const FramePair& pair);

// The same of any two images of the channel in a comparison with the reference, also where nothing is open.
std::vector<double> openErrors(const DebugMode& mode, const FramePair& pair, const Image& baseline,
                               const Image& test);

// Their 99.9th percentile.
std::optional<double> certainP999(const DebugMode& mode, const FramePair& pair);

// The number of pixels where deferred differs from what forward+ shades from a surface that went through the
// G-buffer's encoding: differences that the encoding does not explain. Empty if forward+ has no such image.
std::optional<std::uint64_t> unexplainedPixels(const DebugMode& mode, const FramePair& pair);

// Whether it does so at one pixel, row by row from 0: false where the two differ there.
std::optional<bool> encodingExplains(const DebugMode& mode, const FramePair& pair, std::size_t pixel);

}  // namespace diptych
