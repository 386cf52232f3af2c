// SPDX-License-Identifier: MIT
// Reads a Surface from the G-buffer.
#ifndef GBUFFER_READ_GLSL
#define GBUFFER_READ_GLSL

#include "shaders/lib/surface/gbuffer.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/samples/samples.glsl"
#include "shaders/lib/geometry/stored_depth.glsl"

// Declares each image twice, single-sampled and multisampled; a pipeline keeps the one that it reads.
#define GBUFFER_IMAGE(number, name, kind, what)                                \
    layout(set = SET_GBUFFER, binding = number) uniform utexture2D gbuffer_##name; \
    layout(set = SET_GBUFFER, binding = number) uniform utexture2DMS gbuffer_##name##_samples;
GBUFFER_BINDINGS(GBUFFER_IMAGE)

#define FETCHED(name, p, i) \
    (multisampled() ? texelFetch(gbuffer_##name##_samples, p, i) : texelFetch(gbuffer_##name, p, i))

// i: sample index; 0 without MSAA.
GBufferTexel texelOfGBuffer(const ivec2 p, const int i) {
    GBufferTexel t;
    for (uint k = 0; k < GBUFFER_ATTACHMENTS; ++k) t.attachments[k] = uvec4(0);
#define READ(number, name, kind, what)                                      \
    if ((!isOfLayers(number) || decodesLayers()) && hasAttachment(number)) \
        t.attachments[number] = FETCHED(name, p, i);
    GBUFFER_BINDINGS(READ)
    return t;
}

// The bits of the first `words` components, which the attachment has: others are not 0.
uint bitsOf(const uvec4 texel, const uint words) {
    return texel.x | (words > 1u ? texel.y : 0u) | (words > 2u ? texel.z | texel.w : 0u);
}

// 0 if a sample stores no layer: the words of layers that it lacks are 0.
uint layerBits(const ivec2 p, const int i) {
    uint bits = 0u, words = layerWords();
#define ADD_BITS(number, name, kind, what)         \
    if (isOfLayers(number) && hasAttachment(number)) \
        bits |= bitsOf(FETCHED(name, p, i), words - 4u * (number - GBUFFER_LAYERS));
    GBUFFER_BINDINGS(ADD_BITS)
    return bits;
}

// Surface of a sample; z is the reversed depth at which it is shaded.
Surface surfaceFromGBuffer(const ivec2 p, const int i, out float z) {
    GBufferTexel t = texelOfGBuffer(p, i);
    vec2 position = vec2(0.5);
    if (multisampled()) {
        uvec2 shaded = t.attachments[GBUFFER_SHADED].xy;
        z = depthOfShaded(shaded);
        position = locationOfShaded(shaded);
    } else {
        z = depthAt(p);
    }
    return decodeGBuffer(t, positionFromDepth(vec2(p) + position, z));
}

#endif
