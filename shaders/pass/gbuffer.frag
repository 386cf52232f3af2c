// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// INPUTS: 0 to 3
// COVERAGE: 0 to 1

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/material.glsl"

// ATTACHMENTS: 3 to 8, as many as the scene needs. Those that it lacks leave no gap.
layout(location = 0) out uvec4 out_texel[ATTACHMENTS];

// Number k of those after the first three that this scene has.
uvec4 optionalTexel(GBufferTexel t, uint k) {
    bool there[] = bool[](on(feature_emission) || fullGBuffer(), on(feature_dielectric_specular),
                          on(feature_gbuffer_wide_material_id), on(feature_lightmap), multisampled());
    uvec4 texel = uvec4(0);
    uint count = 0;
    for (uint i = 0; i < 5; ++i)
        if (there[i]) {
            if (count == k) texel = t.attachments[GBUFFER_EMISSION + i];
            ++count;
        }
    return texel;
}

void main() {
    vec4 base_color = baseColor();
    uint left = cutOut(base_color);
    GBufferTexel t = encodeGBuffer(surfaceFromMaterial(base_color));
    if (multisampled())
        t.attachments[GBUFFER_SHADED].xy = shadedTexel(uint(gl_SampleMaskIn[0]), left, fragmentDepth());
    out_texel[0] = t.attachments[GBUFFER_ALBEDO];
    out_texel[1] = t.attachments[GBUFFER_NORMALS];
    out_texel[2] = t.attachments[GBUFFER_PARAMS];
#if ATTACHMENTS > 3
    out_texel[3] = optionalTexel(t, 0);
#endif
#if ATTACHMENTS > 4
    out_texel[4] = optionalTexel(t, 1);
#endif
#if ATTACHMENTS > 5
    out_texel[5] = optionalTexel(t, 2);
#endif
#if ATTACHMENTS > 6
    out_texel[6] = optionalTexel(t, 3);
#endif
#if ATTACHMENTS > 7
    out_texel[7] = optionalTexel(t, 4);
#endif
}
