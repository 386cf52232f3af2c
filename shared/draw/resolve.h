// SPDX-License-Identifier: MIT
// MSAA resolves, shared by both paths.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <cstddef>
#include <span>

namespace diptych {

// Throws std::runtime_error if the device does not support the sample count. It needs the standard sample
// locations and support by each format that the paths draw to, whatever its limits say about all formats.
// Also throws if lights need several batches, because partial sums are stored per pixel.
void checkSamples(const FrameInputs& inputs);

// Resolved radiance; `lit` itself without MSAA. `name`: of the pass.
ImageRef addResolve(PassList& passes, const FrameInputs& inputs, ImageRef lit, Life life = Life::kept,
                    const char* name = "resolve");

// Number of channels that one capture pass writes; fewer with MSAA, to limit memory.
std::size_t maxCaptured(const FrameInputs& inputs);

// Puts images of one sample in the place of a group's, which are images[first] and all after it, as lists of
// passes read them back: of every channel the first sample, of channels with every_sample the others too, of
// shaded_samples the most of any, and lit resolved. Does nothing without MSAA.
void addCaptureResolve(PassList& passes, const FrameInputs& inputs, std::vector<CapturedImage>& images,
                       std::size_t first);

}  // namespace diptych
