// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Second pass of the G-buffer: layers for which the first one, gbuffer.frag, has no attachments.
#include "shaders/lib/surface/gbuffer.glsl"
#include "shaders/lib/surface/material.glsl"

// At most four: float32 has five attachments of layers and seven others, packed encodings two and eight.
layout(location = 0) out uvec4 out_0;
layout(location = 1) out uvec4 out_1;
layout(location = 2) out uvec4 out_2;
layout(location = 3) out uvec4 out_3;

void main() {
    vec4 base_color = baseColor();
    cutOut(base_color);
    GBufferTexel t = encodeGBuffer(surfaceFromMaterial(base_color));
    uint first = layersInFirstPass();
    out_0 = t.attachments[GBUFFER_LAYERS + first];
    if (hasLayerAttachment(first + 1u)) out_1 = t.attachments[GBUFFER_LAYERS + first + 1u];
    if (hasLayerAttachment(first + 2u)) out_2 = t.attachments[GBUFFER_LAYERS + first + 2u];
    if (hasLayerAttachment(first + 3u)) out_3 = t.attachments[GBUFFER_LAYERS + first + 3u];
}
