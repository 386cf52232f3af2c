// SPDX-License-Identifier: MIT
// Records the commands that draw the scene or a full-screen triangle.
#pragma once

#include "shared/contract/transparency.h"
#include "shared/draw/light_batches.h"

#include <functional>
#include <memory>

namespace diptych {

// What records the draws of every item that is not blended, in the list's order, each with the pipeline of
// its key. Pipelines that do not exist yet are made at once, on all cores. `gbuffer`: SET_GBUFFER of shaders
// that read stored depth. `inputs` must outlive what is returned.
using KeyOf = std::function<PipelineKey(const DrawItem&)>;
std::function<void(VkCommandBuffer)> recordDraws(const FrameInputs& inputs, const KeyOf& keyOf,
                                                 const LightBatch& batch = {},
                                                 std::shared_ptr<const DescriptorSets> gbuffer = {});
// The same of those that are blended. `gbuffer`: SET_GBUFFER of shaders that read TRANSPARENCY_BINDINGS.
std::function<void(VkCommandBuffer)> recordBlended(const FrameInputs& inputs, const KeyOf& keyOf,
                                                   std::shared_ptr<const DescriptorSets> gbuffer = {},
                                                   const gpu::BlendedConstants& constants = {});
// The same of other draws than the picture's, depth alone: what casts shadows does with both of its sides.
// `draw_buffer`: Draw[draws.draws]. `draws` must outlive what is returned.
std::function<void(VkCommandBuffer)> recordCasters(const FrameInputs& inputs, const DrawList& draws,
                                                   VkBuffer draw_buffer);

// One triangle that covers the screen, with the descriptor sets that are bound.
void recordTriangle(VkCommandBuffer commands, VkPipeline pipeline);
// What records it with the sets of deferred lighting: frame, G-buffer, partial sums. `groups`: once for each
// of so many groups of samples.
std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, VkPipeline pipeline,
                                                      DescriptorSets gbuffer, const LightBatch& batch,
                                                      gpu::uint groups = 1);
// What records `vertices` of no buffer with these sets, once for each of `draws`, its number in
// DrawConstants::group.
std::function<void(VkCommandBuffer)> recordVertices(const FrameInputs& inputs, VkPipeline pipeline,
                                                    std::shared_ptr<const DescriptorSets> gbuffer,
                                                    gpu::uint vertices, gpu::uint draws);
// What records a dispatch of rows of `across` workgroups with the sets of deferred lighting. `group`: of
// samples.
std::function<void(VkCommandBuffer, const Pass::Rows&)> recordDispatch(
    const FrameInputs& inputs, VkPipeline pipeline, std::shared_ptr<const DescriptorSets> gbuffer,
    const LightBatch& batch, std::uint32_t across, gpu::uint group);
// As recordFullScreen() of a shader that puts blended surfaces together.
std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, VkPipeline pipeline,
                                                      std::shared_ptr<const DescriptorSets> gbuffer,
                                                      const gpu::BlendedConstants& constants);
// The same of a shader that reads the frame's set alone.
std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, VkPipeline pipeline);

}  // namespace diptych
