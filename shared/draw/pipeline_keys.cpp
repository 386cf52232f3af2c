// SPDX-License-Identifier: MIT
#include "shared/draw/pipeline_keys.h"

#include "shared/contract/object_lights.h"

#include <fmt/format.h>

namespace diptych {

PipelineKey depthKey(const DrawItem& item) {
    PipelineKey key;
    key.depth = depthFormat;
    key.depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    key.depth_write = true;
    if (item.variant.get(gpu::FEATURE_alpha_mask) == 0) {
        key.vertex = "depth.vert";
        key.input = VertexInput::positions;
        return key;
    }
    key.vertex = "surface.vert";
    key.fragment = "depth_mask.frag";
    key.input = VertexInput::all;
    for (const gpu::uint feature :
         {gpu::FEATURE_alpha_mask, gpu::FEATURE_base_color_texture, gpu::FEATURE_texture_transform,
          gpu::FEATURE_second_texcoord, gpu::FEATURE_vertex_color})
        key.variant.set(feature, item.variant.get(feature));
    return key;
}

PipelineKey forwardKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch) {
    PipelineKey key{.vertex = "surface.vert",
                    .fragment = "forward_shade.frag",
                    .variant = item.variant,
                    .input = VertexInput::all,
                    .colors = {litFormat},
                    .depth = depthFormat,
                    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
                    .depth_write = false};
    for (const gpu::uint feature :
         {gpu::FEATURE_emission, gpu::FEATURE_dielectric_specular, gpu::FEATURE_directional_lights,
          gpu::FEATURE_point_lights, gpu::FEATURE_spot_lights, gpu::FEATURE_area_lights,
          gpu::FEATURE_light_lists, gpu::FEATURE_list_width, gpu::FEATURE_ambient, gpu::FEATURE_orthographic,
          gpu::FEATURE_view_source})
        key.variant.set(feature, inputs.variant.get(feature));
    gpu::uint objects = inputs.variant.get(gpu::FEATURE_object_lights);
    if (item.variant.get(gpu::FEATURE_lightmap_texture) != 0) objects &= ~gpu::OBJECT_LIGHTS_SH;
    key.variant.set(gpu::FEATURE_object_lights, objects);
    // Items without a lightmap, in a scene that has some, reflect exactly nothing of one.
    key.variant.set(gpu::FEATURE_lightmap, item.variant.get(gpu::FEATURE_lightmap_texture));
    key.variant.set(gpu::FEATURE_light_chunk, batch.kind);
    return key;
}

PipelineKey forwardBatchKey(const FrameInputs& inputs, const DrawItem& item, const LightBatch& batch) {
    PipelineKey key = forwardKey(inputs, item, batch);
    key.fragment = "forward_carry.frag";
    key.colors = {litFormat, litFormat};
    return key;
}

PipelineKey forwardCaptureKey(const FrameInputs& inputs, const DrawItem& item, const CaptureGroup& group,
                              const LightBatch& batch) {
    PipelineKey key = forwardKey(inputs, item, batch);
    key.fragment = fmt::format("forward_capture.frag.{}", group.modes.size());
    key.colors = group.formats;
    group.specialise(key.variant);
    key.variant.set(gpu::FEATURE_captured);
    return key;
}

PipelineKey quantised(PipelineKey key, const FrameInputs& inputs, bool surface) {
    inputs.gbuffer.specialise(key.variant);
    key.variant.set(gpu::FEATURE_quantise_surface, surface);
    return key;
}

}  // namespace diptych
