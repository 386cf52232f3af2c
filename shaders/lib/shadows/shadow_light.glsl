// SPDX-License-Identifier: MIT
// The shadow-casting directional light and the areas of its maps, as texels.
#ifndef SHADOW_LIGHT_GLSL
#define SHADOW_LIGHT_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_FRAME, binding = BINDING_SHADOW_LIGHT) uniform samplerBuffer shadow_texels;

ShadowLight shadowLight() {
    vec4 a = texelFetch(shadow_texels, 0), b = texelFetch(shadow_texels, 1), c = texelFetch(shadow_texels, 2);
    vec4 d = texelFetch(shadow_texels, 3), e = texelFetch(shadow_texels, 4), f = texelFetch(shadow_texels, 5);
    vec4 g = texelFetch(shadow_texels, 6), h = texelFetch(shadow_texels, 7);
    return SHADOW_LIGHT_OF_TEXELS(a, b, c, d, e, f, g, h);
}

// Index of the shadow-casting directional light.
uint castingLight() {
    return floatBitsToUint(texelFetch(shadow_texels, 5).w);
}

#endif
