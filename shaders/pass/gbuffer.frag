// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/material.glsl"

// ATTACHMENTS: 3 to 6, as many as the scene needs. Those that it lacks leave no gap.
layout(location = 0) out uvec4 out_texel[ATTACHMENTS];

void main() {
    vec4 base_color = baseColor();
    if (isCutOut(base_color)) discard;
    GBufferTexel t = encodeGBuffer(surfaceFromMaterial(base_color));
    out_texel[0] = t.attachments[GBUFFER_ALBEDO];
    out_texel[1] = t.attachments[GBUFFER_NORMALS];
    out_texel[2] = t.attachments[GBUFFER_PARAMS];
    bool emission = on(feature_emission) || fullGBuffer(), specular = on(feature_dielectric_specular);
    uvec4 last = t.attachments[GBUFFER_IDS];
#if ATTACHMENTS > 3
    out_texel[3] = emission ? t.attachments[GBUFFER_EMISSION] : specular ? t.attachments[GBUFFER_SPECULAR] : last;
#endif
#if ATTACHMENTS > 4
    out_texel[4] = emission && specular ? t.attachments[GBUFFER_SPECULAR] : last;
#endif
#if ATTACHMENTS > 5
    out_texel[5] = last;
#endif
}
