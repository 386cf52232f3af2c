// SPDX-License-Identifier: MIT
// Radiance of the environment's lat-long image in a direction, and its rotation.
#ifndef SKY_GLSL
#define SKY_GLSL

#include "shaders/lib/math/angles.glsl"

layout(set = SET_FRAME, binding = BINDING_ENVIRONMENT) uniform samplerBuffer environment_texels;
layout(set = SET_FRAME, binding = BINDING_SKY) uniform sampler2D sky;

// Cosine and sine of its rotation about +Y, its radiance factor, and its number of map levels.
vec4 environmentRotation() { return texelFetch(environment_texels, 0); }

// World direction to the environment's axes.
vec3 environmentFromWorld(const vec3 d) {
    vec4 rotation = environmentRotation();
    vec3 turned = vec3(rotation.x * d.x - rotation.y * d.z, d.y, rotation.y * d.x + rotation.x * d.z);
    return turned;
}
float environmentFactor() { return environmentRotation().z; }

// Columns wrap around. Rows beyond a pole are mirrored and shifted by half a turn.
vec3 skyTexel(ivec2 p, const ivec2 size) {
    if (p.y < 0 || p.y >= size.y) {
        p.y = clamp(p.y < 0 ? -1 - p.y : 2 * size.y - 1 - p.y, 0, size.y - 1);
        p.x += size.x / 2;
    }
    p.x = p.x < 0 ? p.x + size.x : p.x;
    p.x = p.x >= size.x ? p.x - size.x : p.x;
    return texelFetch(sky, p, 0).rgb;
}

// W/(sr m^2); `d` unit, in the environment's axes. Bilinear between pixel centres.
vec3 skyRadiance(const vec3 d) {
    ivec2 size = textureSize(sky, 0);
    float across = lengthOf(d.xz), smallest = max(across, 1e-30);
    float azimuth = angleOf(-d.z / smallest, abs(d.x) / smallest), polar = angleOf(d.y, across);
    azimuth = d.x < 0.0 ? -azimuth : azimuth;
    vec2 at = vec2(azimuth * (0.5 * INVERSE_PI) + 0.5, polar * INVERSE_PI) * vec2(size) - 0.5;
    vec2 corner = floor(at), f = at - corner;
    ivec2 c = ivec2(corner);
    vec3 above = blend(skyTexel(c, size), skyTexel(c + ivec2(1, 0), size), f.x);
    vec3 below = blend(skyTexel(c + ivec2(0, 1), size), skyTexel(c + ivec2(1, 1), size), f.x);
    return blend(above, below, f.y);
}

#endif
