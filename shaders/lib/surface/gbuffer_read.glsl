// SPDX-License-Identifier: MIT
// Reads a Surface from the G-buffer.
#ifndef GBUFFER_READ_GLSL
#define GBUFFER_READ_GLSL

#include "shaders/lib/surface/gbuffer.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/samples/samples.glsl"
#include "shaders/lib/geometry/stored_depth.glsl"

// Declares each image twice, single-sampled and multisampled; a pipeline keeps the one that it reads.
#define GBUFFER_IMAGE(at, name)                                       \
    layout(set = SET_GBUFFER, binding = at) uniform utexture2D name;  \
    layout(set = SET_GBUFFER, binding = at) uniform utexture2DMS name##_samples;
GBUFFER_IMAGE(GBUFFER_ALBEDO, gbuffer_albedo)
GBUFFER_IMAGE(GBUFFER_NORMALS, gbuffer_normals)
GBUFFER_IMAGE(GBUFFER_PARAMS, gbuffer_params)
GBUFFER_IMAGE(GBUFFER_EMISSION, gbuffer_emission)
GBUFFER_IMAGE(GBUFFER_SPECULAR, gbuffer_specular)
GBUFFER_IMAGE(GBUFFER_IDS, gbuffer_ids)
GBUFFER_IMAGE(GBUFFER_LIGHTMAP, gbuffer_lightmap)
GBUFFER_IMAGE(GBUFFER_LAYERS, gbuffer_layers)
GBUFFER_IMAGE(GBUFFER_LAYERS_2, gbuffer_layers_2)
GBUFFER_IMAGE(GBUFFER_LAYERS_3, gbuffer_layers_3)
GBUFFER_IMAGE(GBUFFER_LAYERS_4, gbuffer_layers_4)
GBUFFER_IMAGE(GBUFFER_LAYERS_5, gbuffer_layers_5)
#undef GBUFFER_IMAGE
layout(set = SET_GBUFFER, binding = GBUFFER_SHADED) uniform utexture2DMS gbuffer_shaded_samples;

#define FETCHED(name, p, i) (multisampled() ? texelFetch(name##_samples, p, i) : texelFetch(name, p, i))

// i: sample index; 0 without MSAA.
GBufferTexel texelOfGBuffer(const ivec2 p, const int i) {
    GBufferTexel t;
    for (uint k = 0; k < GBUFFER_ATTACHMENTS; ++k) t.attachments[k] = uvec4(0);
    t.attachments[GBUFFER_ALBEDO] = FETCHED(gbuffer_albedo, p, i);
    t.attachments[GBUFFER_NORMALS] = FETCHED(gbuffer_normals, p, i);
    t.attachments[GBUFFER_PARAMS] = FETCHED(gbuffer_params, p, i);
    if (on(feature_emission) || fullGBuffer())
        t.attachments[GBUFFER_EMISSION] = FETCHED(gbuffer_emission, p, i);
    if (on(feature_dielectric_specular)) t.attachments[GBUFFER_SPECULAR] = FETCHED(gbuffer_specular, p, i);
    if (on(feature_gbuffer_wide_material_id)) t.attachments[GBUFFER_IDS] = FETCHED(gbuffer_ids, p, i);
    if (on(feature_lightmap)) t.attachments[GBUFFER_LIGHTMAP] = FETCHED(gbuffer_lightmap, p, i);
    if (decodesLayers()) {
        if (hasLayerAttachment(0)) t.attachments[GBUFFER_LAYERS] = FETCHED(gbuffer_layers, p, i);
        if (hasLayerAttachment(1)) t.attachments[GBUFFER_LAYERS_2] = FETCHED(gbuffer_layers_2, p, i);
        if (hasLayerAttachment(2)) t.attachments[GBUFFER_LAYERS_3] = FETCHED(gbuffer_layers_3, p, i);
        if (hasLayerAttachment(3)) t.attachments[GBUFFER_LAYERS_4] = FETCHED(gbuffer_layers_4, p, i);
        if (hasLayerAttachment(4)) t.attachments[GBUFFER_LAYERS_5] = FETCHED(gbuffer_layers_5, p, i);
    }
    if (multisampled()) t.attachments[GBUFFER_SHADED] = texelFetch(gbuffer_shaded_samples, p, i);
    return t;
}

// The bits of the first `words` components, which the attachment has: others are not 0.
uint bitsOf(const uvec4 texel, const uint words) {
    return texel.x | (words > 1u ? texel.y : 0u) | (words > 2u ? texel.z | texel.w : 0u);
}

// 0 if a sample stores no layer: the words of layers that it lacks are 0.
uint layerBits(const ivec2 p, const int i) {
    uint bits = 0u, words = layerWords();
    if (hasLayerAttachment(0)) bits |= bitsOf(FETCHED(gbuffer_layers, p, i), words);
    if (hasLayerAttachment(1)) bits |= bitsOf(FETCHED(gbuffer_layers_2, p, i), words - 4u);
    if (hasLayerAttachment(2)) bits |= bitsOf(FETCHED(gbuffer_layers_3, p, i), words - 8u);
    if (hasLayerAttachment(3)) bits |= bitsOf(FETCHED(gbuffer_layers_4, p, i), words - 12u);
    if (hasLayerAttachment(4)) bits |= bitsOf(FETCHED(gbuffer_layers_5, p, i), words - 16u);
    return bits;
}

// Surface of a sample; z is the reversed depth at which it is shaded.
Surface surfaceFromGBuffer(const ivec2 p, const int i, out float z) {
    GBufferTexel t = texelOfGBuffer(p, i);
    vec2 place = vec2(0.5);
    if (multisampled()) {
        uvec2 shaded = t.attachments[GBUFFER_SHADED].xy;
        z = depthOfShaded(shaded);
        place = placeOfShaded(shaded);
    } else {
        z = depthAt(p);
    }
    return decodeGBuffer(t, positionFromDepth(vec2(p) + place, z));
}

#endif
