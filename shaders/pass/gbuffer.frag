// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/gbuffer.glsl"
#include "shaders/lib/surface/material.glsl"

// A frame has only the attachments that its scene needs; their locations are contiguous.
layout(location = 0) out uvec4 out_albedo;
layout(location = 1) out uvec4 out_normals;
layout(location = 2) out uvec4 out_params;
layout(location = 3) out uvec4 out_3;
layout(location = 4) out uvec4 out_4;
layout(location = 5) out uvec4 out_5;
layout(location = 6) out uvec4 out_6;
layout(location = 7) out uvec4 out_7;

// Writes an optional attachment, if present, to the first free location.
void write(const bool there, const uvec4 texel, inout uint free) {
    if (!there) return;
    if (free == 3) out_3 = texel;
    if (free == 4) out_4 = texel;
    if (free == 5) out_5 = texel;
    if (free == 6) out_6 = texel;
    if (free == 7) out_7 = texel;
    ++free;
}

void main() {
    vec4 base_color = baseColor();
    uint left = cutOut(base_color);
    GBufferTexel t = encodeGBuffer(surfaceFromMaterial(base_color));
    if (multisampled())
        t.attachments[GBUFFER_SHADED].xy = shadedTexel(uint(gl_SampleMaskIn[0]), left, fragmentDepth());
    out_albedo = t.attachments[GBUFFER_ALBEDO];
    out_normals = t.attachments[GBUFFER_NORMALS];
    out_params = t.attachments[GBUFFER_PARAMS];
    uint free = 3;
    write(hasAttachment(GBUFFER_EMISSION), t.attachments[GBUFFER_EMISSION], free);
    write(hasAttachment(GBUFFER_SPECULAR), t.attachments[GBUFFER_SPECULAR], free);
    write(hasAttachment(GBUFFER_IDS), t.attachments[GBUFFER_IDS], free);
    write(hasAttachment(GBUFFER_LIGHTMAP), t.attachments[GBUFFER_LIGHTMAP], free);
    for (uint i = 0; i < LAYER_WORDS / 4; ++i)
        write(hasLayerAttachment(i) && i < layersInFirstPass(), t.attachments[GBUFFER_LAYERS + i], free);
    write(hasAttachment(GBUFFER_SHADED), t.attachments[GBUFFER_SHADED], free);
}
