// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/material.glsl"

layout(location = GBUFFER_ALBEDO) out uvec4 out_albedo;
layout(location = GBUFFER_NORMALS) out uvec4 out_normals;
layout(location = GBUFFER_PARAMS) out uvec4 out_params;
layout(location = GBUFFER_EMISSION) out uvec4 out_emission;
layout(location = GBUFFER_SPECULAR) out uvec4 out_specular;
layout(location = GBUFFER_IDS) out uvec4 out_ids;

void main() {
    vec4 base_color = baseColor();
    if (isCutOut(base_color)) discard;
    GBufferTexel t = encodeGBuffer(surfaceFromMaterial(base_color));
    out_albedo = t.attachments[GBUFFER_ALBEDO];
    out_normals = t.attachments[GBUFFER_NORMALS];
    out_params = t.attachments[GBUFFER_PARAMS];
    out_emission = t.attachments[GBUFFER_EMISSION];
    out_specular = t.attachments[GBUFFER_SPECULAR];
    out_ids = t.attachments[GBUFFER_IDS];
}
