// SPDX-License-Identifier: MIT
// Makes a Surface from the G-buffer. SAMPLES: 1 where pixels have several samples.
#ifndef GBUFFER_READ_GLSL
#define GBUFFER_READ_GLSL

#ifndef SAMPLES
#define SAMPLES 0
#endif

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/samples.glsl"
#include "shaders/lib/stored_depth.glsl"

#if SAMPLES
#define GBUFFER_IMAGE usampler2DMS
#else
#define GBUFFER_IMAGE usampler2D
#endif

layout(set = SET_GBUFFER, binding = GBUFFER_ALBEDO) uniform GBUFFER_IMAGE gbuffer_albedo;
layout(set = SET_GBUFFER, binding = GBUFFER_NORMALS) uniform GBUFFER_IMAGE gbuffer_normals;
layout(set = SET_GBUFFER, binding = GBUFFER_PARAMS) uniform GBUFFER_IMAGE gbuffer_params;
layout(set = SET_GBUFFER, binding = GBUFFER_EMISSION) uniform GBUFFER_IMAGE gbuffer_emission;
layout(set = SET_GBUFFER, binding = GBUFFER_SPECULAR) uniform GBUFFER_IMAGE gbuffer_specular;
layout(set = SET_GBUFFER, binding = GBUFFER_IDS) uniform GBUFFER_IMAGE gbuffer_ids;
layout(set = SET_GBUFFER, binding = GBUFFER_LIGHTMAP) uniform GBUFFER_IMAGE gbuffer_lightmap;
#if SAMPLES
layout(set = SET_GBUFFER, binding = GBUFFER_SHADED) uniform GBUFFER_IMAGE gbuffer_shaded;
#endif

// i: the sample, 0 where pixels have one.
GBufferTexel texelOfGBuffer(ivec2 p, int i) {
    GBufferTexel t;
    for (uint k = 0; k < GBUFFER_ATTACHMENTS; ++k) t.attachments[k] = uvec4(0);
    t.attachments[GBUFFER_ALBEDO] = texelFetch(gbuffer_albedo, p, i);
    t.attachments[GBUFFER_NORMALS] = texelFetch(gbuffer_normals, p, i);
    t.attachments[GBUFFER_PARAMS] = texelFetch(gbuffer_params, p, i);
    if (on(feature_emission) || fullGBuffer())
        t.attachments[GBUFFER_EMISSION] = texelFetch(gbuffer_emission, p, i);
    if (on(feature_dielectric_specular)) t.attachments[GBUFFER_SPECULAR] = texelFetch(gbuffer_specular, p, i);
    if (on(feature_gbuffer_wide_material_id)) t.attachments[GBUFFER_IDS] = texelFetch(gbuffer_ids, p, i);
    if (on(feature_lightmap)) t.attachments[GBUFFER_LIGHTMAP] = texelFetch(gbuffer_lightmap, p, i);
#if SAMPLES
    t.attachments[GBUFFER_SHADED] = texelFetch(gbuffer_shaded, p, i);
#endif
    return t;
}

// The Surface of a sample and the reversed depth z that it is shaded at.
Surface surfaceFromGBuffer(ivec2 p, int i, out float z) {
    GBufferTexel t = texelOfGBuffer(p, i);
#if SAMPLES
    uvec2 shaded = t.attachments[GBUFFER_SHADED].xy;
    z = depthOfShaded(shaded);
    vec2 place = placeOfShaded(shaded);
#else
    z = depthAt(p);
    vec2 place = vec2(0.5);
#endif
    return decodeGBuffer(t, positionFromDepth(vec2(p) + place, z));
}

#endif
