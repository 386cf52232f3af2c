// SPDX-License-Identifier: MIT
// The pipelines of draws that several passes make: depth alone, and surfaces that are shaded as they are
// drawn.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/light_batches.h"

namespace diptych {

// Depth alone. Of the material only what can cut holes matters.
PipelineKey depthKey(const DrawItem& item);

// A surface that is shaded as it is drawn, to `lit`. Depth is tested (GREATER_OR_EQUAL) and not written;
// a pass without a pre-pass sets depth_write.
PipelineKey forwardKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch);

// The same blended over what `lit` holds.
PipelineKey blendedKey(const FrameInputs& inputs, const DrawItem& item);
// Of a blended surface its opacity and its depth alone, tested and not written.
PipelineKey opacityKey(const FrameInputs& inputs, const DrawItem& item, Shader fragment);

// The same for a batch of lights that is not the last: to the two partial sums.
PipelineKey forwardBatchKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch);

// The same for a capture: to the group's channels.
PipelineKey forwardCaptureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                              const LightBatch& batch);

// A forward key whose surface goes through the frame's G-buffer encoding and back.
PipelineKey throughGBuffer(PipelineKey key, const FrameInputs& inputs);

}  // namespace diptych
