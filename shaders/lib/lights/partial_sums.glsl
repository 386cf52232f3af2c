// SPDX-License-Identifier: MIT
// Light that earlier light batches reflected at the pixel, W/(sr m^2). The fourth components contain
// Radiance's local_seen (diffuse) and local_light (specular).
#ifndef PARTIAL_SUMS_GLSL
#define PARTIAL_SUMS_GLSL

#include "shaders/lib/surface/pixel.glsl"

layout(set = SET_PARTIAL_SUMS, binding = BINDING_PARTIAL_DIFFUSE) uniform texture2D partial_diffuse;
layout(set = SET_PARTIAL_SUMS, binding = BINDING_PARTIAL_SPECULAR) uniform texture2D partial_specular;
layout(set = SET_PARTIAL_SUMS, binding = BINDING_PARTIAL_CLEARCOAT) uniform texture2D partial_clearcoat;
layout(set = SET_PARTIAL_SUMS, binding = BINDING_PARTIAL_SHEEN) uniform texture2D partial_sheen;
layout(set = SET_PARTIAL_SUMS, binding = BINDING_PARTIAL_TRANSMISSION) uniform texture2D partial_transmission;

vec4 partialDiffuse() { return texelFetch(partial_diffuse, pixelHere(), 0); }
// Layers' parts of partialSpecular().
vec4 partialClearcoat() { return texelFetch(partial_clearcoat, pixelHere(), 0); }
vec4 partialSheen() { return texelFetch(partial_sheen, pixelHere(), 0); }
// Light from behind: a part of partialDiffuse(), and ambient light.
vec4 partialTransmission() { return texelFetch(partial_transmission, pixelHere(), 0); }
vec4 partialSpecular() { return texelFetch(partial_specular, pixelHere(), 0); }

#endif
