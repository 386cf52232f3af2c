// SPDX-License-Identifier: MIT
// How far apart two paths may be, and why: derived from what the G-buffer's encoding loses.
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
    // Against the reference: forward+ of the same view, which was drawn through the G-buffer; or nullptr.
    const Frame* explaining = nullptr;

    const Frame* of(Path path) const;  // nullptr: neither, or both
};

// The largest angle in degrees that an octahedral normal of `bits` per coordinate can be off, float32
// evaluation included.
double octahedralBound(unsigned bits);

// The tolerance of `mode`, a channel of both Frames.
Tolerance derivedTolerance(const DebugMode& mode, const FramePair& pair);

// Against a reference that sampled: the error at 99.9 % of the pixels beyond what the reference is known to
// at each. Nothing where it is known, or no lit channel.
std::optional<double> certainP999(const DebugMode& mode, const FramePair& pair);

// Pixels where deferred is not what forward+ shades from a surface that has been through the G-buffer's
// encoding: a difference that the encoding does not explain. Nothing where forward+ has no such image.
std::optional<std::uint64_t> unexplainedPixels(const DebugMode& mode, const FramePair& pair);

}  // namespace diptych
