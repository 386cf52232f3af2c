// SPDX-License-Identifier: MIT
// Records the commands that draw the scene or a full-screen triangle.
#pragma once

#include "shared/draw/light_batches.h"

#include <functional>

namespace diptych {

// What records the draws of every item, in the list's order, each with the pipeline of its key. Pipelines
// that do not exist yet are made at once, on all cores. `inputs` must outlive what is returned.
using KeyOf = std::function<PipelineKey(const DrawItem&)>;
std::function<void(VkCommandBuffer)> recordDraws(const FrameInputs& inputs, const KeyOf& keyOf,
                                                 const LightBatch& batch = {});

// One triangle that covers the screen, with the descriptor sets that are bound.
void recordTriangle(VkCommandBuffer commands, VkPipeline pipeline);
// The same with the sets of deferred lighting: frame, G-buffer, partial sums.
void recordFullScreen(VkCommandBuffer commands, const FrameInputs& inputs, VkPipeline pipeline,
                      VkDescriptorSet gbuffer, const LightBatch& batch);

}  // namespace diptych
