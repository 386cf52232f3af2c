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
          gpu::FEATURE_local_lights, gpu::FEATURE_orthographic})
        key.variant.set(feature, inputs.variant.get(feature));
    return key;
}

PipelineKey captureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                       bool throughGBuffer) {
    PipelineKey key = shadeKey(inputs, item);
    key.fragment = fmt::format("forward_capture.frag.{}", group.modes.size());
    key.colors = group.formats;
    inputs.gbuffer.specialise(key.variant);
    key.variant.set(gpu::FEATURE_quantise_surface, throughGBuffer);
    group.specialise(key.variant);
    return key;
}

ImageRef addPrepass(PassList& passes, const FrameInputs& inputs) {
    const ImageRef depth = passes.image("depth", depthFormat);
    if (inputs.prepass)
        passes.draw("depth pre-pass")
            .depth(depth, Load::clear)
            .record(recordDraws(inputs,
                                [&](const DrawItem& item) { return inputs.pipelines.get(depthKey(item)); }));
    return depth;
}

// Without a pre-pass the pass that shades writes depth itself.
void addDepth(Pass& pass, const FrameInputs& inputs, ImageRef depth) {
    if (inputs.prepass)
        pass.depthTest(depth);
    else
        pass.depth(depth, Load::clear);
}

}  // namespace

FrameImages addForwardPlus(PassList& passes, const FrameInputs& inputs) {
    FrameImages images;
    images.depth = addPrepass(passes, inputs);
    images.lit = passes.image("lit", litFormat);
    Pass& shade = passes.draw("shade").color(images.lit, Load::clear);
    addDepth(shade, inputs, images.depth);
    shade.record(recordDraws(
        inputs, [&](const DrawItem& item) { return inputs.pipelines.get(shadeKey(inputs, item)); }));
    return images;
}

std::vector<CapturedImage> addForwardPlusCapture(PassList& passes, const FrameInputs& inputs,
                                                 std::span<const int> modes, bool throughGBuffer) {
    std::vector<CapturedImage> images;
    const ImageRef depth = addPrepass(passes, inputs);
    for (const CaptureGroup& group : captureGroups(modes)) {
        Pass& pass = passes.draw("capture");
        for (const CapturedImage& image : addCaptureImages(passes, pass, group)) images.push_back(image);
        addDepth(pass, inputs, depth);
        pass.record(recordDraws(inputs, [&](const DrawItem& item) {
            return inputs.pipelines.get(captureKey(inputs, item, group, throughGBuffer));
        }));
    }
    return images;
}

}  // namespace diptych
