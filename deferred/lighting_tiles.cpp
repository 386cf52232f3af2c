// SPDX-License-Identifier: MIT
#include "deferred/lighting_tiles.h"

#include "shared/contract/bindings.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace diptych {

namespace {

constexpr const char* bufferName = "lighting tiles";

gpu::uint tilesAlong(std::uint32_t pixels) {
    return (pixels + gpu::LIGHTING_TILE - 1) / gpu::LIGHTING_TILE;
}

bool paysForTiles(const FrameInputs& inputs) {
    return inputs.gbuffer.layers != 0 &&
           std::ranges::any_of(inputs.draws.storedSolids(), [](const DrawItem& item) {
               return item.variant.get(gpu::FEATURE_layers) == 0;
           });
}

Pass& addKernel(PassList& passes, const FrameInputs& inputs, Shader shader, glm::uvec2 groups,
                const gpu::TileConstants& constants, std::shared_ptr<const DescriptorSets> gbuffer) {
    constexpr FeatureMask read = FeatureMask()
                                     .with(gpu::FEATURE_samples)
                                     .with(gpu::FEATURE_gbuffer_encoding)
                                     .with(gpu::FEATURE_gbuffer_layers);
    const Pipeline pipeline =
        inputs.pipelines.compute(shader, inputs.variant.only(read), inputs.layouts.pipeline);
    return passes.compute("classify tiles")
        .record(
            [&inputs, pipeline, groups, constants, gbuffer = std::move(gbuffer)](VkCommandBuffer commands) {
                const VkPipelineLayout layout = inputs.layouts.pipeline;
                const auto bind = [&](gpu::uint set, VkDescriptorSet descriptors) {
                    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, set, 1,
                                            &descriptors, 0, nullptr);
                };
                bind(gpu::SET_FRAME, inputs.frame_set);
                bind(gpu::SET_GBUFFER, (*gbuffer)[0]);
                vkCmdPushConstants(commands, layout, drawStages, 0, sizeof constants, &constants);
                vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
                vkCmdDispatch(commands, groups.x, groups.y, 1);
            });
}

}  // namespace

TileLayout::TileLayout(const PassList& passes)
    : size(tilesAlong(passes.width()), tilesAlong(passes.height())),
      tiles(size.x * size.y),
      dispatches((tiles + gpu::TILES_PER_DISPATCH - 1) / gpu::TILES_PER_DISPATCH) {}
static_assert(gpu::LIGHTING_TILE_GROUPS * gpu::LIGHTING_GROUP * gpu::LIGHTING_GROUP ==
              gpu::LIGHTING_TILE * gpu::LIGHTING_TILE);
static_assert(sizeof(gpu::TileDraw) == sizeof(VkDrawIndirectCommand) &&
              sizeof(gpu::TileDispatch) == sizeof(VkDispatchIndirectCommand));

void addTiles(PassList& passes, const FrameInputs& inputs, FrameImages& images) {
    if (!paysForTiles(inputs)) return;
    const TileLayout layout(passes);
    images.tiles = std::make_shared<const GpuBuffer>(
        inputs.device, bufferName, layout.bytes(),
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
            VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    const BufferRef buffer = passes.buffer(bufferName, *images.tiles);
    const auto at = [&](VkDeviceSize offset) { return addressWords(images.tiles->address() + offset); };
    const gpu::TileConstants constants{at(layout.classes()), at(layout.draw(0)), at(layout.dispatch(0)),
                                       at(layout.list(0)), layout.size};
    const auto sets = std::make_shared<const DescriptorSets>(gbufferSet(passes, inputs, images));
    Pass& classify = addKernel(passes, inputs, Shader::deferred_tiles_comp, layout.size, constants, sets)
                         .uses(buffer, access::storageWrite(inCompute));
    for (gpu::uint i = gpu::GBUFFER_LAYERS; i <= gpu::GBUFFER_LAYERS_5; ++i)
        if (images.gbuffer[i].valid()) classify.samples(images.gbuffer[i], inCompute);
    addKernel(passes, inputs, Shader::deferred_tile_lists_comp, {1, 1}, constants, sets)
        .uses(buffer, access::storageRead(inCompute))
        .uses(buffer, access::storageWrite(inCompute));
}

std::array<Variant, gpu::TILE_CLASSES> tileVariants(const Variant& variant) {
    std::array<Variant, gpu::TILE_CLASSES> variants{variant, variant};
    for (Variant& of_class : variants) of_class.set(gpu::FEATURE_lighting_tiles);
    variants[gpu::TILES_BASE].set(gpu::FEATURE_layers, 0);
    return variants;
}

TiledLighting readTiles(PassList& passes, Pass& pass, const FrameImages& images, VkPipelineStageFlags2 stage,
                        const std::vector<Pipeline>& pipelines) {
    const BufferRef buffer = passes.buffer(bufferName, *images.tiles);
    pass.uses(buffer, access::indirectRead).uses(buffer, access::storageRead(stage));
    const TileLayout layout(passes);
    constexpr auto twice = static_cast<float>(2 * gpu::LIGHTING_TILE);
    TiledLighting tiled{
        {},
        images.tiles,
        {twice / static_cast<float>(passes.width()), twice / static_cast<float>(passes.height())}};
    for (gpu::uint i = 0; i < pipelines.size(); ++i)
        tiled.classes.push_back({pipelines[i], stage == inCompute ? layout.dispatch(i) : layout.draw(i),
                                 images.tiles->address() + layout.list(i)});
    return tiled;
}

}  // namespace diptych
