// SPDX-License-Identifier: MIT
// Records draws of the scene and of full-screen triangles.
#pragma once

#include "shared/contract/transparency.h"
#include "shared/draw/light_batches.h"

#include <functional>
#include <memory>
#include <vector>

namespace diptych {

// Records the draws of items, a part of DrawList::solids() or transmissive(), in list order, each with the
// pipeline of its key. Missing pipelines are compiled at once, on all cores. `gbuffer`: SET_GBUFFER of
// shaders that read stored depth or the backdrop. `inputs` must outlive the returned function.
using KeyOf = std::function<PipelineKey(const DrawItem&)>;
std::function<void(VkCommandBuffer)> recordDraws(const FrameInputs& inputs, std::span<const DrawItem> items,
                                                 const KeyOf& keyOf, const LightBatch& batch = {},
                                                 std::shared_ptr<const DescriptorSets> gbuffer = {});
// The same for blended items. `gbuffer`: SET_GBUFFER of shaders that read TRANSPARENCY_BINDINGS.
std::function<void(VkCommandBuffer)> recordBlended(const FrameInputs& inputs, const KeyOf& keyOf,
                                                   std::shared_ptr<const DescriptorSets> gbuffer = {},
                                                   const gpu::BlendedConstants& constants = {});
// Records shadow casters, depth alone, both sides of each triangle. `draw_buffer`: Draw[draws.draws].
// `draws` must outlive the returned function.
std::function<void(VkCommandBuffer)> recordCasters(const FrameInputs& inputs, const DrawList& draws,
                                                   VkBuffer draw_buffer);

// Draws a full-screen triangle with the bound descriptor sets.
void recordTriangle(VkCommandBuffer commands, const Pipeline& pipeline);
// Records a full-screen triangle with the sets of deferred lighting: frame, G-buffer, partial sums.
// `groups`: draws it once for each of this many sample groups.
std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, const Pipeline& pipeline,
                                                      DescriptorSets gbuffer, const LightBatch& batch,
                                                      gpu::uint groups = 1);
// Records `draws` draws of `vertices` vertices without vertex buffers. DrawConstants::group is the draw's
// index.
std::function<void(VkCommandBuffer)> recordVertices(const FrameInputs& inputs, const Pipeline& pipeline,
                                                    std::shared_ptr<const DescriptorSets> gbuffer,
                                                    gpu::uint vertices, gpu::uint draws);
// Records a dispatch of rows of `across` workgroups with the sets of deferred lighting. `group`: index of
// the sample group.
std::function<void(VkCommandBuffer, const Pass::Rows&)> recordDispatch(
    const FrameInputs& inputs, const Pipeline& pipeline, std::shared_ptr<const DescriptorSets> gbuffer,
    const LightBatch& batch, std::uint32_t across, gpu::uint group);
// Tiles of the image by class (shared/contract/lighting_tiles.h). A pipeline shades those of its class, by
// indirect draws or dispatches.
struct TiledLighting {
    struct Class {
        Pipeline pipeline;
        VkDeviceSize commands;  // offset of its TileDraw or first TileDispatch
        VkDeviceAddress list;   // of its tiles
    };
    std::vector<Class> classes;
    std::shared_ptr<const GpuBuffer> buffer;
    gpu::vec2 tile_size;  // DrawConstants::tile_size
};
// As recordFullScreen() and recordDispatch() of deferred lighting. A row is a dispatch of each class.
std::function<void(VkCommandBuffer)> recordTiles(const FrameInputs& inputs, TiledLighting tiled,
                                                 DescriptorSets gbuffer, const LightBatch& batch,
                                                 gpu::uint groups);
std::function<void(VkCommandBuffer, const Pass::Rows&)> recordTileDispatches(
    const FrameInputs& inputs, TiledLighting tiled, std::shared_ptr<const DescriptorSets> gbuffer,
    const LightBatch& batch, gpu::uint group);
// As recordFullScreen(), for a shader that composites blended surfaces.
std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, const Pipeline& pipeline,
                                                      std::shared_ptr<const DescriptorSets> gbuffer,
                                                      const gpu::BlendedConstants& constants);
// The same for a shader that reads SET_FRAME alone.
std::function<void(VkCommandBuffer)> recordFullScreen(const FrameInputs& inputs, const Pipeline& pipeline);

}  // namespace diptych
