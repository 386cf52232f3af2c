// SPDX-License-Identifier: MIT
#include "shared/draw/pipeline_keys.h"

#include "shared/contract/object_lights.h"
#include "shared/contract/shadow.h"
#include "shared/draw/pipeline_parts.h"

namespace diptych {

PipelineKey depthKey(const DrawItem& item) {
    PipelineKey key;
    key.depth = depthFormat;
    key.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    key.depth_write = true;
    if (item.variant.get(gpu::FEATURE_alpha_mask) == 0) {
        key.vertex = Shader::depth_vert;
        key.input = VERTEX_ALL;
        return key;
    }
    key.vertex = Shader::surface_vert;
    key.fragment = Shader::depth_mask_frag;
    key.input = VERTEX_ALL;
    key.variant = item.variant.only(featuresReadBy(gpu::PASS_DEPTH));
    return key;
}

PipelineKey forwardKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch) {
    constexpr FeatureMask read = featuresReadBy(gpu::PASS_FORWARD);
    PipelineKey key{.vertex = Shader::surface_vert,
                    .fragment = Shader::forward_shade_frag,
                    .variant = item.variant.only(read & featuresSetBy(FeatureSource::item)),
                    .input = VERTEX_ALL,
                    .colors = {inputs.lit_format},
                    .depth = depthFormat,
                    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                    .depth_write = false};
    key.variant.take(inputs.variant, read & featuresSetBy(FeatureSource::frame));
    gpu::uint objects = inputs.variant.get(gpu::FEATURE_object_lights);
    if (item.variant.get(gpu::FEATURE_lightmap_texture) != 0) objects &= ~gpu::OBJECT_LIGHTS_SH;
    key.variant.set(gpu::FEATURE_object_lights, objects);
    // Items without a lightmap have exactly no lightmap term, even if the scene has lightmaps.
    key.variant.set(gpu::FEATURE_lightmap, item.variant.get(gpu::FEATURE_lightmap_texture) != 0);
    key.variant.set(gpu::FEATURE_light_batch, batch.kind);
    // Shadow bias depends on the geometric normal, which both paths quantize alike.
    if (key.variant.any(FeatureMask().with(gpu::FEATURE_shadows).with(gpu::FEATURE_local_shadows)))
        key.variant.set(gpu::FEATURE_gbuffer_encoding, inputs.variant.get(gpu::FEATURE_gbuffer_encoding));
    return key;
}

PipelineKey blendedKey(const FrameInputs& inputs, const DrawItem& item) {
    PipelineKey key = forwardKey(inputs, item, {});
    key.fragment = Shader::forward_blended_frag;
    key.blends = {Blend::over};
    return key;
}

PipelineKey opacityKey(const FrameInputs& inputs, const DrawItem& item, Shader fragment) {
    PipelineKey key{.vertex = Shader::surface_vert,
                    .fragment = fragment,
                    .variant = item.variant.only(featuresReadBy(gpu::PASS_DEPTH)),
                    .input = VERTEX_ALL,
                    .depth = depthFormat,
                    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                    .depth_write = false};
    key.variant.set(gpu::FEATURE_orthographic, inputs.variant.get(gpu::FEATURE_orthographic))
        .set(gpu::FEATURE_depth_format, inputs.depth.kind);
    return key;
}

PipelineKey forwardBatchKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch) {
    PipelineKey key = forwardKey(inputs, item, batch);
    key.fragment = Shader::forward_light_batch_frag;
    key.colors = partialSumFormats(inputs.layers);
    key.variant.set(gpu::FEATURE_gbuffer_layers, inputs.layers);
    return key;
}

PipelineKey forwardCaptureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                              const LightBatch& batch) {
    PipelineKey key = forwardKey(inputs, item, batch);
    key.fragment = Shader::forward_capture_frag;
    key.colors = group.formats;
    key.variant.set(gpu::FEATURE_captures, group.feature());
    key.variant.set(gpu::FEATURE_captured);
    return key;
}

PipelineKey throughGBuffer(PipelineKey key, const FrameInputs& inputs) {
    // The deferred path does not store these either.
    const bool stored = inputs.variant.get(gpu::FEATURE_gbuffer_layers) == inputs.layers;
    if (!stored && key.variant.get(gpu::FEATURE_layers) != 0) return key;
    key.variant.take(inputs.variant, featuresSetBy(FeatureSource::gbuffer));
    key.variant.set(gpu::FEATURE_encoded_surface);
    return key;
}

}  // namespace diptych
