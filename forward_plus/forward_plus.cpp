// SPDX-License-Identifier: MIT
#include "forward_plus/forward_plus.h"

#include <fmt/format.h>

namespace diptych {

namespace {

// Of the scene's features those that forward shading reads: the timed pipeline has no G-buffer.
PipelineKey shadeKey(const FrameInputs& inputs, const DrawItem& item) {
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
          gpu::FEATURE_point_lights, gpu::FEATURE_spot_lights, gpu::FEATURE_light_lists,
          gpu::FEATURE_list_width, gpu::FEATURE_orthographic})
        key.variant.set(feature, inputs.variant.get(feature));
    return key;
}

PipelineKey captureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                       bool throughGBuffer) {
    PipelineKey key = shadeKey(inputs, item);
    key.fragment = fmt::format("forward_capture.frag.{}", group.modes.size());
    key.colors = group.formats;
    key.depth_write = false;
    inputs.gbuffer.specialise(key.variant);
    key.variant.set(gpu::FEATURE_quantise_surface, throughGBuffer);
    group.specialise(key.variant);
    return key;
}

}  // namespace

FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs) {
    FrameImages images;
    images.depth = passes.image("depth", depthFormat);
    if (inputs.prepass)
        passes.draw("depth pre-pass").depth(images.depth, Load::clear).record(recordDraws(inputs, depthKey));
    inputs.lists.addPasses(passes, inputs.pipelines, inputs.variant, inputs.frame_set, images.depth);
    images.lit = passes.image("lit", litFormat);
    Pass& shade = passes.draw("shade").color(images.lit, Load::clear);
    if (inputs.prepass)
        shade.depthTest(images.depth);
    else
        shade.depth(images.depth, Load::clear);
    shade.record(recordDraws(inputs, [&](const DrawItem& item) { return shadeKey(inputs, item); }));
    return images;
}

std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 const FrameImages& frame, const CaptureRequest& request) {
    std::vector<CapturedImage> images;
    for (const bool throughGBuffer : {false, true})
        for (const CaptureGroup& group :
             captureGroups(throughGBuffer ? request.through_gbuffer : request.modes)) {
            Pass& pass = passes.draw("capture").depthTest(frame.depth);
            for (CapturedImage image : addCaptureImages(passes, pass, group)) {
                image.through_gbuffer = throughGBuffer;
                images.push_back(image);
            }
            pass.record(recordDraws(inputs, [&](const DrawItem& item) {
                return captureKey(inputs, item, group, throughGBuffer);
            }));
        }
    return images;
}

}  // namespace diptych
