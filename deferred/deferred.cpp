// SPDX-License-Identifier: MIT
#include "deferred/deferred.h"

#include "shared/contract/bindings.h"
#include "shared/contract/debug_mode.h"
#include "shared/draw/light_batches.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace diptych {

namespace {

PipelineKey gbufferKey(const FrameInputs& inputs, const DrawItem& item, bool captured) {
    std::vector<VkFormat> formats;
    for (const VkFormat format : inputs.gbuffer.formats)
        if (format != VK_FORMAT_UNDEFINED) formats.push_back(format);
    constexpr FeatureMask read = featuresReadBy(gpu::PASS_GBUFFER);
    PipelineKey key{.vertex = "surface.vert",
                    .fragment = fmt::format("gbuffer.frag.{}", formats.size()),
                    .variant = item.variant.only(read & featuresSetBy(FeatureSource::item)),
                    .input = VERTEX_ALL,
                    .colors = formats,
                    .depth = depthFormat,
                    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                    .depth_write = true};
    key.variant.take(inputs.variant,
                     read & (featuresSetBy(FeatureSource::frame) | featuresSetBy(FeatureSource::gbuffer)));
    key.variant.set(gpu::FEATURE_captured, captured);
    return key;
}

// The attachments and depth as SET_GBUFFER.
DescriptorSets gbufferSet(const PassList& passes, const FrameInputs& inputs, const FrameImages& frame) {
    DescriptorSets sets(inputs.device, inputs.layouts.gbuffer, gbufferBindings(), 1);
    for (std::uint32_t i = 0; i < frame.gbuffer.size(); ++i) {
        // A missing attachment is never read; albedo, of the same kind, keeps its binding valid.
        const ImageRef image =
            frame.gbuffer[i].valid() ? frame.gbuffer[i] : frame.gbuffer[gpu::GBUFFER_ALBEDO];
        sets.image(0, i, passes.view(image), inputs.layouts.nearest,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    sets.image(0, gpu::BINDING_DEPTH, passes.view(frame.depth), inputs.layouts.nearest,
               VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    return sets;
}

Variant lightingVariant(const FrameInputs& inputs) {
    Variant variant = inputs.variant.only(featuresReadBy(gpu::PASS_LIGHTING));
    if (variant.get(gpu::FEATURE_view_source) != gpu::VIEW_UNIFORM)
        variant.set(gpu::FEATURE_view_source, gpu::VIEW_FLAT);
    return variant;
}

// A full-screen pass over the G-buffer. Its triangle lies at the smallest depth that can be drawn, so a depth
// test of LESS_OR_EQUAL skips every pixel that nothing was drawn to (0) before it is shaded.
void addDeferredLighting(PassList& passes, Pass& pass, const FrameInputs& inputs, const FrameImages& frame,
                         const std::string& fragment, Variant variant, const std::vector<VkFormat>& colors,
                         const LightBatch& batch) {
    for (const ImageRef image : frame.gbuffer)
        if (image.valid()) pass.samples(image, inFragment);
    batch.read(pass);
    inputs.lists.read(passes, pass);
    pass.samples(frame.depth, inFragment).depthTest(frame.depth);
    variant.set(gpu::FEATURE_light_batch, batch.kind);
    const VkPipeline pipeline = inputs.pipelines.get(PipelineKey{.vertex = "deferred_lighting.vert",
                                                                 .fragment = fragment,
                                                                 .variant = variant,
                                                                 .input = NO_VERTICES,
                                                                 .colors = colors,
                                                                 .depth = depthFormat,
                                                                 .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                                                                 .depth_write = false});
    const auto set = std::make_shared<DescriptorSets>(gbufferSet(passes, inputs, frame));
    pass.record([&inputs, pipeline, set, batch](VkCommandBuffer commands) {
        recordFullScreen(commands, inputs, pipeline, (*set)[0], batch);
    });
}

// Draws the scene into the depth and the attachments. `captured`: with what only channels need.
void addGBuffer(PassList& passes, const FrameInputs& inputs, const FrameImages& images, bool captured) {
    Pass& pass = passes.draw("G-buffer").depth(images.depth, Load::clear);
    for (const ImageRef image : images.gbuffer)
        if (image.valid()) pass.color(image, Load::clear);
    pass.record(
        recordDraws(inputs, [&](const DrawItem& item) { return gbufferKey(inputs, item, captured); }));
}

LightBatch addEarlierLighting(PassList& passes, const FrameInputs& inputs, const FrameImages& frame) {
    return addEarlierBatches(passes, inputs, [&](Pass& pass, const LightBatch& batch) {
        addDeferredLighting(passes, pass, inputs, frame, "deferred_light_batch.frag", lightingVariant(inputs),
                            {litFormat, litFormat}, batch);
    });
}

}  // namespace

FrameImages addDeferred(PassList& passes, const FrameInputs& inputs) {
    FrameImages images;
    images.depth = passes.image("depth", depthFormat);
    for (std::size_t i = 0; i < images.gbuffer.size(); ++i) {
        const VkFormat format = inputs.gbuffer.formats[i];
        if (format == VK_FORMAT_UNDEFINED) continue;
        images.gbuffer[i] = passes.image(gbufferAttachmentNames[i], format);
    }
    addGBuffer(passes, inputs, images, false);
    inputs.lists.addPasses(passes, inputs.pipelines, inputs.variant, inputs.frame_set, images.depth);
    const LightBatch last = addEarlierLighting(passes, inputs, images);
    images.lit = passes.image("lit", litFormat);
    Pass& shade = passes.draw("shade").color(images.lit, Load::clear);
    addDeferredLighting(passes, shade, inputs, images, "deferred_shade.frag", lightingVariant(inputs),
                        {litFormat}, last);
    return images;
}

std::vector<CapturedImage> addDeferredCapture(PassList& passes, const FrameInputs& inputs,
                                              const FrameImages& frame, const CaptureRequest& request) {
    std::vector<CapturedImage> images;
    // The frame's own G-buffer holds no geometric normals, as no light needs them.
    if (std::ranges::find(request.modes, static_cast<int>(gpu::DEBUG_geometric_normal)) !=
        request.modes.end())
        addGBuffer(passes, inputs, frame, true);
    const LightBatch last = addEarlierLighting(passes, inputs, frame);
    for (const CaptureGroup& group : captureGroups(request.modes)) {
        Pass& pass = passes.draw("capture");
        for (const CapturedImage& image : addCaptureImages(passes, pass, group)) images.push_back(image);
        Variant variant = lightingVariant(inputs);
        group.specialise(variant);
        addDeferredLighting(passes, pass, inputs, frame,
                            fmt::format("deferred_capture.frag.{}", group.modes.size()), variant,
                            group.formats, last);
    }
    return images;
}

}  // namespace diptych
