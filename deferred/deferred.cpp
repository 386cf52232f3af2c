// SPDX-License-Identifier: MIT
#include "deferred/deferred.h"

#include "deferred/compute_lighting.h"
#include "deferred/lighting_tiles.h"
#include "deferred/lighting_variant.h"
#include "deferred/sample_groups.h"
#include "shared/contract/debug_mode.h"
#include "shared/draw/background.h"
#include "shared/draw/forward_draws.h"
#include "shared/draw/light_batches.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/pipeline_parts.h"
#include "shared/draw/record.h"
#include "shared/draw/resolve.h"
#include "shared/shadow/shadow_maps.h"
#include "shared/transparent/transparent.h"
#include "shared/vulkan/device/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

namespace {

// `attachments`: GBUFFER_* that the pass draws.
PipelineKey gbufferKey(const FrameInputs& inputs, const DrawItem& item,
                       const std::vector<gpu::uint>& attachments, bool captured) {
    std::vector<VkFormat> formats;
    for (const gpu::uint i : attachments) formats.push_back(inputs.gbuffer.formats[i]);
    constexpr FeatureMask read = featuresReadBy(gpu::PASS_GBUFFER);
    PipelineKey key{.vertex = Shader::surface_vert,
                    .fragment = Shader::gbuffer_frag,
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

bool hasLayers(const DrawItem& item, gpu::uint layers) {
    return (item.variant.get(gpu::FEATURE_layers) & layers) != 0;
}

PipelineKey secondGBufferKey(const FrameInputs& inputs, const DrawItem& item, const GBufferPasses& parts) {
    PipelineKey key = gbufferKey(inputs, item, parts.second, false);
    key.fragment = Shader::gbuffer_layers_frag;
    key.depth_compare = VK_COMPARE_OP_EQUAL;
    key.depth_write = false;
    // Surfaces without such layers write 0; of their material only the mask matters.
    if (!hasLayers(item, parts.second_layers))
        key.variant = key.variant.only(featuresReadBy(gpu::PASS_DEPTH) | featuresSetBy(FeatureSource::frame) |
                                       featuresSetBy(FeatureSource::gbuffer));
    return key;
}

struct LightingDraw {
    Shader fragment;
    Variant variant;
    std::vector<VkFormat> colors;
    gpu::uint groups;  // with MSAA: draws this many sample groups
};

// A full-screen pass over the G-buffer. Its triangle lies at the smallest drawable depth, so a depth test
// of LESS_OR_EQUAL skips pixels without geometry (depth 0) before shading. With MSAA the depth is
// frame.groups of addGroups(), and there is a triangle for each of the first `groups` sample groups. With
// frame.tiles each class of tiles is drawn instead, by its own variant.
void addDeferredLighting(PassList& passes, Pass& pass, const FrameInputs& inputs, const FrameImages& frame,
                         LightingDraw draw, const LightBatch& batch) {
    for (const ImageRef image : frame.gbuffer)
        if (image.valid()) pass.samples(image, inFragment);
    batch.read(pass);
    inputs.lists.read(passes, pass);
    inputs.shadow.read(pass);
    pass.samples(frame.depth, inFragment).depthTest(frame.depth).takes(shadingMs(passes, inputs, batch));
    draw.variant.set(gpu::FEATURE_light_batch, batch.kind);
    const DepthStorage drawn = frame.groups.valid() ? DepthStorage() : inputs.depth;
    const auto keyOf = [&](const Variant& variant) {
        return drawn.stored({.vertex = Shader::deferred_lighting_vert,
                             .fragment = draw.fragment,
                             .variant = variant,
                             .input = NO_VERTICES,
                             .colors = draw.colors,
                             .depth = depthFormat,
                             .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                             .depth_write = false,
                             .samples = inputs.samples});
    };
    DescriptorSets sets = gbufferSet(passes, inputs, frame);
    if (!frame.tiles) {
        const Pipeline pipeline = inputs.pipelines.get(keyOf(draw.variant));
        pass.record(recordFullScreen(inputs, pipeline, std::move(sets), batch, draw.groups));
        return;
    }
    std::vector<PipelineKey> keys;
    for (const Variant& variant : tileVariants(draw.variant)) keys.push_back(keyOf(variant));
    pass.record(recordTiles(inputs, readTiles(passes, pass, frame, inVertex, inputs.pipelines.get(keys)),
                            std::move(sets), batch, draw.groups));
}

// Inputs of lighting: G-buffer and depth. Under MSAA the sample-group image replaces depth.
FrameImages forLighting(const FrameImages& frame) {
    FrameImages read = frame;
    if (frame.groups.valid()) read.depth = frame.groups;
    return read;
}

// Draws the layers that the first pass has no attachments for. Surfaces without such layers that follow the
// first one with them write 0: of two surfaces at the same depth, the later is stored.
void addSecondGBuffer(PassList& passes, const FrameInputs& inputs, const FrameImages& images,
                      const GBufferPasses& parts) {
    Pass& pass = readGeometry(passes, passes.draw("G-buffer of layers"), inputs).depthTest(images.depth);
    for (const gpu::uint i : parts.second) pass.color(images.gbuffer[i], Load::clear);
    const std::span<const DrawItem> stored = inputs.draws.storedSolids();
    const auto first = std::ranges::find_if(
        stored, [&](const DrawItem& item) { return hasLayers(item, parts.second_layers); });
    pass.record(recordDraws(inputs, stored.subspan(static_cast<std::size_t>(first - stored.begin())),
                            [&](const DrawItem& item) { return secondGBufferKey(inputs, item, parts); }));
}

// Draws the scene into depth and G-buffer. `captured`: with data that only channels need.
void addGBuffer(PassList& passes, const FrameInputs& inputs, const FrameImages& images, bool captured) {
    const GBufferPasses parts = gbufferPasses(inputs.gbuffer);
    Pass& pass = readGeometry(passes, passes.draw("G-buffer"), inputs).depth(images.depth, Load::clear);
    for (const gpu::uint i : parts.first) pass.color(images.gbuffer[i], Load::clear);
    pass.record(recordDraws(inputs, inputs.draws.storedSolids(), [&](const DrawItem& item) {
        return gbufferKey(inputs, item, parts.first, captured);
    }));
    if (!parts.second.empty()) addSecondGBuffer(passes, inputs, images, parts);
}

// Adds the depth of forward-shaded solids, which come after lighting. Lighting shades their pixels in vain.
void addForwardShadedDepth(PassList& passes, const FrameInputs& inputs, const FrameImages& images) {
    if (inputs.draws.forwardShadedSolids().empty()) return;
    readGeometry(passes, passes.draw("depth of layers"), inputs)
        .depth(images.depth, Load::keep)
        .record(recordDraws(inputs, inputs.draws.forwardShadedSolids(), depthKey));
}

// Shades solids that the G-buffer does not store; `target` declares the attachments of the last pass.
void addForwardShaded(PassList& passes, const FrameInputs& inputs, const FrameImages& images,
                      const std::function<Pass&()>& target,
                      const std::function<PipelineKey(const DrawItem&, const LightBatch&)>& keyOf) {
    const auto add = [&](Pass& pass, const LightBatch& batch, const auto& key) {
        pass.depthTest(images.depth);
        inputs.shadow.read(pass);
        addForwardDraws(
            pass, passes, inputs, images,
            {inputs.draws.forwardShadedSolids(), [&](const DrawItem& item) { return key(item, batch); }},
            batch);
    };
    const LightBatch last = addEarlierBatches(
        passes, inputs,
        [&](Pass& pass, const LightBatch& batch, const auto&) {
            add(pass, batch, [&](const DrawItem& item, const LightBatch& of) {
                return forwardBatchKey(inputs, item, of);
            });
        },
        SumsBy::attachments, inputs.layers);
    add(target(), last, keyOf);
}

void addForwardShaded(PassList& passes, const FrameInputs& inputs, const FrameImages& images, ImageRef lit) {
    if (inputs.draws.forwardShadedSolids().empty()) return;
    addForwardShaded(
        passes, inputs, images, [&]() -> Pass& { return passes.draw("shade layers").color(lit, Load::keep); },
        [&](const DrawItem& item, const LightBatch& batch) { return forwardKey(inputs, item, batch); });
}

// Continues a capture of the last pass, whose images are the last of `images`.
void addForwardShadedCapture(PassList& passes, const FrameInputs& inputs, const FrameImages& frame,
                             const CaptureGroup& group, std::vector<CapturedImage>& images) {
    if (inputs.draws.forwardShadedSolids().empty()) return;
    const std::size_t before = passes.size() - 1;
    std::vector<CapturedImage*> of_group;
    for (CapturedImage& image : images)
        if (image.pass == before) of_group.push_back(&image);
    const auto target = [&]() -> Pass& {
        Pass& pass = passes.draw("capture layers");
        ImageRef last;
        for (const CapturedImage* image : of_group) {
            if (image->image.index != last.index) pass.color(image->image, Load::keep);
            last = image->image;
        }
        return pass;
    };
    addForwardShaded(passes, inputs, frame, target, [&](const DrawItem& item, const LightBatch& batch) {
        return forwardCaptureKey(inputs, item, group, batch);
    });
    for (CapturedImage* image : of_group) image->pass = passes.size() - 1;
}

LightBatch addEarlierLighting(PassList& passes, const FrameInputs& inputs, const FrameImages& frame) {
    const auto add = [&](Pass& pass, const LightBatch& batch, const auto&) {
        addDeferredLighting(passes, pass, inputs, frame,
                            {Shader::deferred_light_batch_frag, lightingVariant(inputs),
                             partialSumFormats(inputs.gbuffer.layers), inputs.samples},
                            batch);
    };
    return addEarlierBatches(passes, inputs, add, SumsBy::attachments, inputs.gbuffer.layers);
}

// Adds the forward-shaded solids, background, blended surfaces, resolve and shadow page marks to lit opaque
// surfaces.
void addRest(PassList& passes, const FrameInputs& inputs, FrameImages& images, ImageRef lit) {
    addForwardShaded(passes, inputs, images, lit);
    addBackground(passes, inputs, images.depth, lit);
    addTransparent(passes, inputs, images.depth, lit);
    images.lit_samples = lit;
    images.lit = addResolve(passes, inputs, lit);
    inputs.shadow.addMarks(passes, inputs, images.depth);
}

// Whether nothing in view is stored: then the frame has no G-buffer and no lighting pass.
bool storesNothing(const FrameInputs& inputs) {
    return inputs.draws.storedSolids().empty();
}
void addCleared(PassList& passes, const FrameInputs& inputs, FrameImages& images) {
    const ImageRef lit = sampledImage(passes, inputs, "lit", inputs.lit_format);
    passes.draw("clear").color(lit, Load::clear).depth(images.depth, Load::clear).record([](VkCommandBuffer) {
    });
    addForwardShadedDepth(passes, inputs, images);
    inputs.lists.addPasses(passes, inputs.pipelines, inputs.variant, inputs.frame_set, images.depth);
    addRest(passes, inputs, images, lit);
}

}  // namespace

std::vector<std::string> prepareDeferred(FrameInputs& inputs, const Settings&) {
    const GBufferPasses parts = gbufferPasses(inputs.gbuffer);
    if (parts.second.empty() || storesNothing(inputs)) return {};
    std::uint32_t bytes = 0;
    for (const gpu::uint i : parts.second) bytes += bytesPerTexel(inputs.gbuffer.formats[i]);
    return {fmt::format(
        "a second G-buffer pass draws {} of {} attachments, {} bytes per pixel: a pass has at most {}",
        parts.second.size(), parts.first.size() + parts.second.size(),
        bytes * static_cast<std::uint32_t>(inputs.samples), gpu::MAX_COLOR_ATTACHMENTS)};
}

FrameImages addDeferred(PassList& passes, const FrameInputs& inputs) {
    FrameImages images;
    addGeometryPasses(passes, inputs);
    inputs.shadow.addPasses(passes, inputs);
    images.depth = sceneDepth(passes, inputs);
    if (storesNothing(inputs)) {
        addCleared(passes, inputs, images);
        return images;
    }
    for (std::size_t i = 0; i < images.gbuffer.size(); ++i) {
        const VkFormat format = inputs.gbuffer.formats[i];
        if (format == VK_FORMAT_UNDEFINED) continue;
        images.gbuffer[i] = sampledImage(passes, inputs, gbufferAttachmentNames[i], format);
    }
    addGBuffer(passes, inputs, images, false);
    addForwardShadedDepth(passes, inputs, images);
    inputs.lists.addPasses(passes, inputs.pipelines, inputs.variant, inputs.frame_set, images.depth);
    const FurtherGroups further = addGroups(passes, inputs, images);
    addTiles(passes, inputs, images);
    const FrameImages shaded = forLighting(images);
    const bool computes = inputs.lighting == Lighting::compute, stores = further.any() || computes;
    const ImageRef lit = passes.image({.name = "lit",
                                       .format = inputs.lit_format,
                                       .samples = inputs.samples,
                                       .usage = stores && inputs.lit_format == litFormat
                                                    ? VkImageUsageFlags{VK_IMAGE_USAGE_STORAGE_BIT}
                                                    : 0});
    const gpu::uint groups = further.any() ? 1u : static_cast<gpu::uint>(inputs.samples);
    if (computes) {
        addComputeLighting(passes, inputs, shaded, groups, lit);
    } else {
        const LightBatch last = addEarlierLighting(passes, inputs, shaded);
        addDeferredLighting(
            passes, passes.draw("shade").color(lit, Load::clear), inputs, shaded,
            {Shader::deferred_shade_frag, lightingVariant(inputs), {inputs.lit_format}, groups}, last);
    }
    addFurtherGroups(passes, inputs, shaded, further, lit);
    addRest(passes, inputs, images, lit);
    return images;
}

std::vector<CapturedImage> addDeferredCapture(PassList& passes, const FrameInputs& inputs,
                                              const FrameImages& frame, const CaptureRequest& request) {
    std::vector<CapturedImage> images;
    const bool stored = !storesNothing(inputs);
    // The frame's own G-buffer stores geometric normals only if shadows need them.
    if (stored && std::ranges::find(request.modes, Channel::geometric_normal) != request.modes.end()) {
        addGBuffer(passes, inputs, frame, true);
        addForwardShadedDepth(passes, inputs, frame);
    }
    FrameImages shaded = forLighting(frame);
    shaded.tiles = nullptr;  // one variant draws a channel
    const LightBatch last = stored ? addEarlierLighting(passes, inputs, shaded) : LightBatch{};
    for (const CaptureGroup& group : captureGroups(request.modes, inputs.lit_format, maxCaptured(inputs))) {
        const ImageRef lit = addCaptureBackground(passes, inputs, frame.depth, group);
        Pass& pass = passes.draw("capture");
        for (const CapturedImage& image :
             addCaptureImages(passes, pass, group, lit, inputs.samples, request.every_sample))
            images.push_back(image);
        Variant variant = lightingVariant(inputs);
        variant.set(gpu::FEATURE_captures, group.feature());
        if (stored)
            addDeferredLighting(passes, pass, inputs, shaded,
                                {Shader::deferred_capture_frag, variant, group.formats, inputs.samples},
                                last);
        else
            pass.record([](VkCommandBuffer) {});
        addForwardShadedCapture(passes, inputs, frame, group, images);
        addTransparentCapture(passes, inputs, frame.depth, images);
    }
    return images;
}

}  // namespace diptych
