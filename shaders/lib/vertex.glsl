// SPDX-License-Identifier: MIT
// The one way in which a vertex reaches the screen. Every pass that draws geometry goes through here, so
// that depth is the same bits in all of them.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "shaders/lib/draw.glsl"

invariant gl_Position;

layout(location = 0) in vec3 position;
// Of the instance: struct Draw.
layout(location = 5) in mat4 clip_from_object;

vec4 clipFromVertex() {
    vec4 clip = clip_from_object * vec4(position, 1.0);
    return clip;
}

#endif
