// SPDX-License-Identifier: MIT
// The sums that the draws before this one left at the pixel.
#ifndef CARRY_GLSL
#define CARRY_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_CARRIED, binding = BINDING_CARRIED_DIFFUSE) uniform sampler2D carried_diffuse;
layout(set = SET_CARRIED, binding = BINDING_CARRIED_SPECULAR) uniform sampler2D carried_specular;

vec3 carriedDiffuse() { return texelFetch(carried_diffuse, ivec2(gl_FragCoord.xy), 0).rgb; }
vec3 carriedSpecular() { return texelFetch(carried_specular, ivec2(gl_FragCoord.xy), 0).rgb; }

#endif
