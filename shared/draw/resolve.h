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

// Resolved radiance; `lit` itself without MSAA.
ImageRef addResolve(PassList& passes, const FrameInputs& inputs, ImageRef lit, Life life = Life::kept);

// Number of channels that one capture pass writes; fewer with MSAA, to limit memory.
std::size_t mostCaptured(const FrameInputs& inputs);

// Replaces a group's `images` by single-sample images, as pass lists read back. Takes the first sample of
// each channel, the largest sample of shaded_samples, and resolves lit. Does nothing without MSAA.
void addCaptureResolve(PassList& passes, const FrameInputs& inputs, std::span<CapturedImage> images);

}  // namespace diptych
