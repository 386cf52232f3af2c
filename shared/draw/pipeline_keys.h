// SPDX-License-Identifier: MIT
// Pipeline keys of draws that several passes share: depth alone, and forward shading.
#pragma once

#include "shared/draw/captures.h"
#include "shared/draw/light_batches.h"

namespace diptych {

// Depth alone. The only material feature is the alpha mask.
PipelineKey depthKey(const DrawItem& item);

// Forward shading to `lit`. The depth test is GREATER_OR_EQUAL without writes; a pass without a pre-pass
// sets depth_write.
PipelineKey forwardKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch);

// The same, blended over `lit`.
PipelineKey blendedKey(const FrameInputs& inputs, const DrawItem& item);
// Opacity and depth of a blended surface, with a depth test and without depth writes.
PipelineKey opacityKey(const FrameInputs& inputs, const DrawItem& item, Shader fragment);

// The same for an earlier light batch: writes the two partial sums.
PipelineKey forwardBatchKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch);

// The same for a capture: writes the group's channels.
PipelineKey forwardCaptureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                              const LightBatch& batch);

// A forward key whose surface is encoded and decoded as the frame's G-buffer does.
PipelineKey throughGBuffer(PipelineKey key, const FrameInputs& inputs);

}  // namespace diptych
