// SPDX-License-Identifier: MIT
// The only vertex transform. Every pass that draws geometry uses it, so that depth is bitwise identical in
// all of them.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "shaders/lib/geometry/draw.glsl"
#include "shaders/lib/geometry/posing.glsl"

invariant gl_Position;

layout(location = 0) in vec3 position;
// Per instance: struct Draw.
layout(location = 5) in mat4 clip_from_object;

vec4 clipFrom(const vec3 position) {
    vec4 clip = clip_from_object * vec4(position, 1.0);
    return clip;
}

// With feature_vertex_posing: the drawn instance, and the vertex's index in it.
PosedInstance instanceOfDraw() { return PosedInstanceBlock(constants.posing).instance; }
uint numberIn(const PosedInstance i) { return uint(gl_VertexIndex) - i.first_vertex; }

#endif
