// SPDX-License-Identifier: MIT
#include "deferred/compute_lighting.h"

#include "deferred/lighting_tiles.h"
#include "deferred/lighting_variant.h"
#include "shared/contract/samples.h"
#include "shared/draw/light_batches.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/shadow/shadow_maps.h"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace diptych {

namespace {

constexpr Part wholePart{0, 1, 0, 1};

std::uint32_t lightingGroups(std::uint32_t pixels) {
    return (pixels + gpu::LIGHTING_GROUP - 1) / gpu::LIGHTING_GROUP;
}

// Shades sample group `group` of every pixel to the targets.
struct LightingDispatch {
    Shader shader;
    gpu::uint group = 0;
    std::array<ImageRef, 2> targets;  // the second is used by light batches alone
    bool stores_all = true;           // overwrites the targets completely
};
void addDispatch(PassList& passes, Pass& pass, const FrameInputs& inputs, const FrameImages& frame,
                 const LightBatch& batch, const LightingDispatch& dispatch) {
    for (const ImageRef image : frame.gbuffer)
        if (image.valid()) pass.samples(image, inCompute);
    batch.read(pass, inCompute);
    inputs.lists.read(passes, pass, inCompute);
    inputs.shadow.read(pass, inCompute);
    pass.samples(frame.depth, inCompute).takes(shadingMs(passes, inputs, batch));
    for (const ImageRef target : dispatch.targets)
        if (target.valid())
            pass.uses(target, access::storageImageWrite(inCompute), wholePart, dispatch.stores_all);
    auto sets = std::make_shared<DescriptorSets>(gbufferSet(passes, inputs, frame));
    pass.prepare([&passes, sets, targets = dispatch.targets] {
        for (gpu::uint i = 0; i < targets.size(); ++i)
            if (targets[i].valid())
                sets->image(0, gpu::BINDING_LIT_TARGET + i, passes.view(targets[i]), VK_NULL_HANDLE,
                            VK_IMAGE_LAYOUT_GENERAL);
    });
    Variant variant = inputs.variant.only(featuresReadBy(gpu::PASS_LIGHTING));
    variant.set(gpu::FEATURE_light_batch, batch.kind);
    const auto pipelineOf = [&](const Variant& of) {
        return inputs.pipelines.compute(dispatch.shader, of, inputs.layouts.pipeline);
    };
    if (!frame.tiles) {
        pass.recordRows(lightingGroups(passes.height()),
                        recordDispatch(inputs, pipelineOf(variant), std::move(sets), batch,
                                       lightingGroups(passes.width()), dispatch.group));
        return;
    }
    std::vector<Pipeline> pipelines;
    for (const Variant& of_class : tileVariants(variant)) pipelines.push_back(pipelineOf(of_class));
    pass.recordRows(TileLayout(passes).dispatches,
                    recordTileDispatches(inputs, readTiles(passes, pass, frame, inCompute, pipelines),
                                         std::move(sets), batch, dispatch.group));
}
static_assert(gpu::BINDING_SPECULAR_TARGET == gpu::BINDING_LIT_TARGET + 1);

// Converts a stored image to the format of `lit`.
void addLitOf(PassList& passes, const FrameInputs& inputs, const FrameImages& frame, ImageRef stored,
              ImageRef lit) {
    Pass& pass = passes.draw("round lit")
                     .color(lit, Load::clear)
                     .samples(stored, inFragment)
                     .samples(frame.depth, inFragment)
                     .depthTest(frame.depth);
    const PartialSumImages images{stored, stored};
    LightBatch read{.images = images, .sums = partialSumSet(passes, pass, inputs, images)};
    const Pipeline pipeline =
        inputs.pipelines.get(inputs.depth.stored({.vertex = Shader::deferred_lighting_vert,
                                                  .fragment = Shader::deferred_lit_frag,
                                                  .variant = lightingVariant(inputs),
                                                  .input = NO_VERTICES,
                                                  .colors = {inputs.lit_format},
                                                  .depth = depthFormat,
                                                  .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                                                  .depth_write = false}));
    pass.record(recordFullScreen(inputs, pipeline, gbufferSet(passes, inputs, frame), read));
}

}  // namespace

void addComputeLighting(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                        gpu::uint groups, ImageRef lit) {
    const LightBatch last = addEarlierBatches(
        passes, inputs,
        [&](Pass& pass, const LightBatch& batch, const PartialSumImages& sums) {
            addDispatch(passes, pass, inputs, frame, batch,
                        {.shader = Shader::deferred_light_batch_comp, .targets = {sums[0], sums[1]}});
        },
        SumsBy::storage, inputs.gbuffer.layers);
    const bool stored = inputs.lit_format == litFormat, several = frame.groups.valid();
    const ImageRef target = stored ? lit
                                   : passes.image({.name = "lit of compute",
                                                   .format = litFormat,
                                                   .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                                                   .life = Life::transient});
    // Passes of one name are timed together. Each sample group stores to its own samples.
    if (several) passes.draw("shade").color(lit, Load::clear);
    for (gpu::uint group = 0; group < groups; ++group)
        addDispatch(passes, passes.compute("shade"), inputs, frame, last,
                    {.shader = Shader::deferred_shade_comp,
                     .group = group,
                     .targets = {target, ImageRef{}},
                     .stores_all = !several});
    if (!stored) addLitOf(passes, inputs, frame, target, lit);
}

}  // namespace diptych
