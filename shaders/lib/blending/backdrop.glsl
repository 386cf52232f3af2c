// SPDX-License-Identifier: MIT
// The image of opaque surfaces and the background, and its mip chain, behind surfaces with transmission.
#ifndef BACKDROP_GLSL
#define BACKDROP_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_GBUFFER, binding = BINDING_BACKDROP) uniform texture2D backdrop;

// Bilinear, clamped to the edge. `p`: pixels of level 0.
vec3 backdropLevel(const vec2 p, const int level) {
    ivec2 size = textureSize(backdrop, level);
    vec2 q = p * (vec2(size) / vec2(textureSize(backdrop, 0))) - 0.5;
    vec2 first = floor(q), t = q - first;
    ivec2 a = clamp(ivec2(first), ivec2(0), size - 1), b = clamp(ivec2(first) + 1, ivec2(0), size - 1);
    vec3 aa = texelFetch(backdrop, a, level).rgb, ba = texelFetch(backdrop, ivec2(b.x, a.y), level).rgb;
    vec3 ab = texelFetch(backdrop, ivec2(a.x, b.y), level).rgb, bb = texelFetch(backdrop, b, level).rgb;
    return blend(blend(aa, ba, t.x), blend(ab, bb, t.x), t.y);
}

// Radiance, W/(sr m^2), at pixel `p`, which may lie outside the image. `level`: at least 0, between levels.
vec3 backdropAt(const vec2 p, const float level) {
    vec2 inside = clamp(p, vec2(0.0), vec2(textureSize(backdrop, 0)));
    float last = float(textureQueryLevels(backdrop) - 1), at = min(level, last), first = floor(at);
    vec3 fine = backdropLevel(inside, int(first));
    return blend(fine, backdropLevel(inside, int(min(first + 1.0, last))), at - first);
}

#endif
