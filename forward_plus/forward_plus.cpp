// SPDX-License-Identifier: MIT
#include "forward_plus/forward_plus.h"

#include "shared/contract/object_lights.h"

#include <fmt/format.h>

namespace diptych {

namespace {

// Of the scene's features those that forward shading reads: the timed pipeline has no G-buffer.
PipelineKey shadeKey(const FrameInputs& inputs, const DrawItem& item, const LightChunk& chunk) {
    PipelineKey key{.vertex = "surface.vert",
                    .fragment = "forward_shade.frag",
                    .variant = item.variant,
                    .input = VertexInput::all,
                    .colors = {litFormat},
                    .depth = depthFormat,
                    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                    .depth_write = !inputs.prepass};
    for (const gpu::uint feature :
         {gpu::FEATURE_emission, gpu::FEATURE_dielectric_specular, gpu::FEATURE_directional_lights,
          gpu::FEATURE_point_lights, gpu::FEATURE_spot_lights, gpu::FEATURE_area_lights,
          gpu::FEATURE_light_lists, gpu::FEATURE_list_width, gpu::FEATURE_ambient, gpu::FEATURE_orthographic,
          gpu::FEATURE_view_source})
        key.variant.set(feature, inputs.variant.get(feature));
    gpu::uint objects = inputs.variant.get(gpu::FEATURE_object_lights);
    if (item.variant.get(gpu::FEATURE_lightmap_texture) != 0) objects &= ~gpu::OBJECT_LIGHTS_SH;
    key.variant.set(gpu::FEATURE_object_lights, objects);
    // The others of a scene with lightmaps reflect exactly nothing of one.
    key.variant.set(gpu::FEATURE_lightmap, item.variant.get(gpu::FEATURE_lightmap_texture));
    key.variant.set(gpu::FEATURE_light_chunk, chunk.kind);
    return key;
}

// A surface that goes through the G-buffer's encoding and back before it is shaded, or only its geometric
// normal.
void quantise(PipelineKey& key, const FrameInputs& inputs, bool throughGBuffer) {
    inputs.gbuffer.specialise(key.variant);
    key.variant.set(gpu::FEATURE_quantise_surface, throughGBuffer);
}

PipelineKey captureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                       bool throughGBuffer, const LightChunk& chunk) {
    PipelineKey key = shadeKey(inputs, item, chunk);
    key.fragment = fmt::format("forward_capture.frag.{}", group.modes.size());
    key.colors = group.formats;
    key.depth_write = false;
    quantise(key, inputs, throughGBuffer);
    group.specialise(key.variant);
    key.variant.set(gpu::FEATURE_captured);
    return key;
}

}  // namespace

FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs) {
    FrameImages images;
    images.depth = passes.image("depth", depthFormat);
    if (inputs.prepass)
        passes.draw("depth pre-pass").depth(images.depth, Load::clear).record(recordDraws(inputs, depthKey));
    inputs.lists.addPasses(passes, inputs.pipelines, inputs.variant, inputs.frame_set, images.depth);
    // The first draw that shades makes the depth where no pre-pass has.
    bool drawn = inputs.prepass;
    const auto addShading = [&](Pass& pass, const LightChunk& chunk, const char* fragment,
                                const std::vector<VkFormat>& colors) {
        if (drawn)
            pass.depthTest(images.depth);
        else
            pass.depth(images.depth, Load::clear);
        chunk.read(pass);
        pass.record(recordDraws(
            inputs,
            [&](const DrawItem& item) {
                PipelineKey key = shadeKey(inputs, item, chunk);
                key.fragment = fragment;
                key.colors = colors;
                key.depth_write = !drawn;
                return key;
            },
            chunk));
        drawn = true;
    };
    const LightChunk last = addEarlierLights(passes, inputs, [&](Pass& pass, const LightChunk& chunk) {
        addShading(pass, chunk, "forward_carry.frag", {litFormat, litFormat});
    });
    images.lit = passes.image("lit", litFormat);
    addShading(passes.draw("shade").color(images.lit, Load::clear), last, "forward_shade.frag", {litFormat});
    return images;
}

std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 const FrameImages& frame, const CaptureRequest& request) {
    std::vector<CapturedImage> images;
    for (const bool throughGBuffer : {false, true}) {
        const std::vector<int>& modes = throughGBuffer ? request.through_gbuffer : request.modes;
        if (modes.empty()) continue;
        const LightChunk last = addEarlierLights(passes, inputs, [&](Pass& pass, const LightChunk& chunk) {
            pass.depthTest(frame.depth);
            pass.record(recordDraws(
                inputs,
                [&](const DrawItem& item) {
                    PipelineKey key = shadeKey(inputs, item, chunk);
                    key.fragment = "forward_carry.frag";
                    key.colors = {litFormat, litFormat};
                    key.depth_write = false;
                    quantise(key, inputs, throughGBuffer);
                    return key;
                },
                chunk));
        });
        for (const CaptureGroup& group : captureGroups(modes)) {
            Pass& pass = passes.draw("capture").depthTest(frame.depth);
            last.read(pass);
            for (CapturedImage image : addCaptureImages(passes, pass, group)) {
                image.through_gbuffer = throughGBuffer;
                images.push_back(image);
            }
            pass.record(recordDraws(
                inputs,
                [&](const DrawItem& item) { return captureKey(inputs, item, group, throughGBuffer, last); },
                last));
        }
    }
    return images;
}

}  // namespace diptych
