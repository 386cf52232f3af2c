// SPDX-License-Identifier: MIT
#include "deferred/sample_groups.h"

#include "deferred/lighting_variant.h"
#include "shared/contract/samples.h"
#include "shared/draw/light_batches.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/shadow/shadow_maps.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace diptych {

namespace {

constexpr Part onlyPart{0, 1, 0, 1};

gpu::uint edgesOf(MsaaEdges edges) {
    switch (edges) {
        case MsaaEdges::all:
            return gpu::EDGES_ALL;
        case MsaaEdges::exact:
            return gpu::EDGES_EXACT;
        case MsaaEdges::similar:
            return gpu::EDGES_SIMILAR;
        case MsaaEdges::coverage:
            return gpu::EDGES_COVERAGE;
    }
    return gpu::EDGES_EXACT;
}

std::uint64_t maxFurther(const PassList& passes, const FrameInputs& inputs) {
    return std::uint64_t{passes.width()} * passes.height() * (static_cast<gpu::uint>(inputs.samples) - 1);
}

// Whether secondary groups are listed. Not if the list would exceed the largest image.
bool listsFurther(const PassList& passes, const FrameInputs& inputs) {
    const Device& device = inputs.device;
    const std::uint32_t max = std::min(device.support().maxPixels(), 1u << gpu::FURTHER_PIXEL_BITS);
    return device.profile().shades_failed_samples && inputs.edges != MsaaEdges::all &&
           device.support().storesSamples() &&
           (device.support().sampleCounts(litFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                         VK_IMAGE_USAGE_SAMPLED_BIT |
                                                         VK_IMAGE_USAGE_STORAGE_BIT) &
            inputs.samples) != 0 &&
           std::max(passes.width(), passes.height()) <= max &&
           maxFurther(passes, inputs) <= std::uint64_t{max} << gpu::FURTHER_WIDTH_BITS;
}

// SET_GBUFFER with the list and, if valid, `lit` as a storage image.
std::shared_ptr<DescriptorSets> setOf(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                                      const FurtherGroups& further, ImageRef lit) {
    auto sets = std::make_shared<DescriptorSets>(gbufferSet(passes, inputs, frame));
    const auto store = [&](gpu::uint binding, ImageRef image) {
        if (image.valid())
            sets->image(0, binding, passes.view(image), VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL);
    };
    store(gpu::BINDING_FURTHER_COUNT, further.count);
    store(gpu::BINDING_FURTHER_LIST, further.list);
    store(gpu::BINDING_LIT_TARGET, lit);
    return sets;
}

}  // namespace

FurtherGroups addGroups(PassList& passes, const FrameInputs& inputs, FrameImages& frame) {
    FurtherGroups further;
    if (inputs.samples == VK_SAMPLE_COUNT_1_BIT) return further;
    if (listsFurther(passes, inputs)) {
        constexpr VkFormat word = VK_FORMAT_R32_UINT;
        const auto rows = static_cast<std::uint32_t>((maxFurther(passes, inputs) + gpu::FURTHER_WIDTH - 1) >>
                                                     gpu::FURTHER_WIDTH_BITS);
        further.count = passes.image({.name = "number of further groups",
                                      .format = word,
                                      .extent = {1, 1},
                                      .usage = VK_IMAGE_USAGE_STORAGE_BIT});
        further.list = passes.image({.name = "further groups",
                                     .format = word,
                                     .extent = {gpu::FURTHER_WIDTH, rows},
                                     .usage = VK_IMAGE_USAGE_STORAGE_BIT,
                                     .with_image = true});
        passes.draw("group samples").color(further.count, Load::clear);
    }
    frame.groups = sampledImage(passes, inputs, "groups of samples", depthFormat);
    Pass& pass = passes.draw("group samples").depth(frame.groups, Load::clear);
    for (const ImageRef image : frame.gbuffer)
        if (image.valid()) pass.samples(image, inFragment);
    pass.samples(frame.depth, inFragment);
    if (further.any()) {
        Access counts = access::storageImageWrite(inFragment);
        counts.access |= VK_ACCESS_2_SHADER_STORAGE_READ_BIT;  // atomic add
        pass.uses(further.count, counts, onlyPart)
            .uses(further.list, access::storageImageWrite(inFragment), onlyPart, true);
    }
    Variant variant = lightingVariant(inputs);
    variant.set(gpu::FEATURE_sample_edges, edgesOf(inputs.edges));
    const Pipeline pipeline = inputs.pipelines.get(PipelineKey{
        .vertex = Shader::deferred_lighting_vert,
        .fragment = further.any() ? Shader::deferred_groups_list_frag : Shader::deferred_groups_frag,
        .variant = variant,
        .input = NO_VERTICES,
        .depth = depthFormat,
        .depth_compare = VK_COMPARE_OP_ALWAYS,
        .depth_write = true,
        .samples = inputs.samples});
    pass.record(recordVertices(inputs, pipeline, setOf(passes, inputs, frame, further, {}), 3, 1));
    return further;
}

void addFurtherGroups(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                      const FurtherGroups& further, ImageRef lit) {
    if (!further.any()) return;
    constexpr std::uint64_t a_draw = std::uint64_t{gpu::FURTHER_WIDTH} * gpu::FURTHER_ROWS;
    const auto draws = static_cast<gpu::uint>((maxFurther(passes, inputs) + a_draw - 1) / a_draw);
    // Passes of one name are timed together.
    Pass& pass = passes.draw("shade")
                     .covers({gpu::FURTHER_WIDTH, gpu::FURTHER_ROWS})
                     .takes(shadingMs(passes, inputs, {}));
    for (const ImageRef image : frame.gbuffer)
        if (image.valid()) pass.samples(image, inFragment);
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    pass.samples(frame.depth, inFragment)
        .uses(further.count, access::storageImageRead(inVertex | inFragment), onlyPart)
        .uses(further.list, access::storageImageRead(inFragment), onlyPart)
        .uses(lit, access::storageImageWrite(inFragment), onlyPart);
    const Pipeline pipeline = inputs.pipelines.get(PipelineKey{.vertex = Shader::deferred_further_vert,
                                                               .fragment = Shader::deferred_further_frag,
                                                               .variant = lightingVariant(inputs),
                                                               .input = NO_VERTICES});
    pass.record(recordVertices(inputs, pipeline, setOf(passes, inputs, frame, further, lit), 6, draws));
}

}  // namespace diptych
