// SPDX-License-Identifier: MIT
// How far apart two paths may be, and why: derived from the precision that the G-buffer's encoding loses.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"
#include "shared/scene/requirements.h"

#include <cstdint>
#include <optional>
#include <string>

namespace diptych {

struct Tolerance {
    double max = 0;  // in the channel's metric
    std::string because;
    bool most_pixels = false;  // 0.1 % of the pixels may exceed it: against the reference
};

// Two Frames of one scene and camera, the device they were drawn on, and what the scene needs.
struct FramePair {
    const Frame& baseline;
    const Frame& test;
    const Requirements& needs;
    const Coverage& coverage;
    bool cpu = true;  // a CPU device rounds alike in every pipeline; a GPU is granted gpuUlps
    // In a comparison with the reference: the Frame of forward+ of the same view that was also drawn through
    // the G-buffer; or nullptr.
    const Frame* explaining = nullptr;

    const Frame* of(Path path) const;  // nullptr: neither, or both
};

// The largest angle in degrees that an octahedral normal of `bits` per coordinate can be off, float32
// evaluation included.
double octahedralBound(unsigned bits);

// The tolerance of `mode`, a channel of both Frames.
Tolerance derivedTolerance(const DebugMode& mode, const FramePair& pair);

// In a comparison with a sampled reference: the 99.9th percentile of the errors less the reference's
// uncertainty at each pixel. Empty for a reference without uncertainty and for channels other than lit ones.
std::optional<double> certainP999(const DebugMode& mode, const FramePair& pair);

// The number of pixels where deferred differs from what forward+ shades from a surface that went through the
// G-buffer's encoding: differences that the encoding does not explain. Empty if forward+ has no such image.
std::optional<std::uint64_t> unexplainedPixels(const DebugMode& mode, const FramePair& pair);

}  // namespace diptych
