// SPDX-License-Identifier: MIT
// From the samples of a pixel to what a picture shows: passes of both paths.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/frame_inputs.h"

#include <cstddef>
#include <span>

namespace diptych {

// Throws std::runtime_error where the device does not draw with as many samples a pixel: it must have their
// standard places, and each format that the paths draw to must take them, whatever its limits say of all
// formats; or where more lights are shaded than one draw walks, as sums of several draws are kept by pixel.
void checkSamples(const FrameInputs& inputs);

// The radiance of `lit`'s pixels; `lit` itself where they have one sample.
ImageRef addResolve(PassList& passes, const FrameInputs& inputs, ImageRef lit, Life life = Life::kept);

// Channels that a capture's pass makes at once; of several samples a pixel fewer, as they take as much
// memory.
std::size_t mostCaptured(const FrameInputs& inputs);

// Puts pictures of one sample in the place of a group's `images`, as lists of passes read them back: of every
// channel the first sample, of shaded_samples the most of any, then lit resolved. Nothing where pixels have
// one sample.
void addCaptureResolve(PassList& passes, const FrameInputs& inputs, std::span<CapturedImage> images);

}  // namespace diptych
