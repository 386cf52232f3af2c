// SPDX-License-Identifier: MIT
// Makes a Surface from the G-buffer.
#ifndef GBUFFER_READ_GLSL
#define GBUFFER_READ_GLSL

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/stored_depth.glsl"

layout(set = SET_GBUFFER, binding = GBUFFER_ALBEDO) uniform usampler2D gbuffer_albedo;
layout(set = SET_GBUFFER, binding = GBUFFER_NORMALS) uniform usampler2D gbuffer_normals;
layout(set = SET_GBUFFER, binding = GBUFFER_PARAMS) uniform usampler2D gbuffer_params;
layout(set = SET_GBUFFER, binding = GBUFFER_EMISSION) uniform usampler2D gbuffer_emission;
layout(set = SET_GBUFFER, binding = GBUFFER_SPECULAR) uniform usampler2D gbuffer_specular;
layout(set = SET_GBUFFER, binding = GBUFFER_IDS) uniform usampler2D gbuffer_ids;
layout(set = SET_GBUFFER, binding = GBUFFER_LIGHTMAP) uniform usampler2D gbuffer_lightmap;

Surface surfaceFromGBuffer(ivec2 p, float z) {
    GBufferTexel t;
    for (uint i = 0; i < GBUFFER_ATTACHMENTS; ++i) t.attachments[i] = uvec4(0);
    t.attachments[GBUFFER_ALBEDO] = texelFetch(gbuffer_albedo, p, 0);
    t.attachments[GBUFFER_NORMALS] = texelFetch(gbuffer_normals, p, 0);
    t.attachments[GBUFFER_PARAMS] = texelFetch(gbuffer_params, p, 0);
    if (on(feature_emission) || fullGBuffer())
        t.attachments[GBUFFER_EMISSION] = texelFetch(gbuffer_emission, p, 0);
    if (on(feature_dielectric_specular)) t.attachments[GBUFFER_SPECULAR] = texelFetch(gbuffer_specular, p, 0);
    if (on(feature_gbuffer_wide_material_id)) t.attachments[GBUFFER_IDS] = texelFetch(gbuffer_ids, p, 0);
    if (on(feature_lightmap)) t.attachments[GBUFFER_LIGHTMAP] = texelFetch(gbuffer_lightmap, p, 0);
    return decodeGBuffer(t, positionFromDepth(vec2(p) + 0.5, z));
}

#endif
