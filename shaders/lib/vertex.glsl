// SPDX-License-Identifier: MIT
// The one way in which a vertex reaches the screen. Every pass that draws geometry goes through here, so
// that depth is the same bits in all of them.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/posing.glsl"

invariant gl_Position;

layout(location = 0) in vec3 position;
// Of the instance: struct Draw.
layout(location = 5) in mat4 clip_from_object;

vec4 clipFrom(vec3 position) {
    vec4 clip = clip_from_object * vec4(position, 1.0);
    return clip;
}

// With feature_vertex_posing: the instance that is drawn, and the number of the vertex in it.
PosedInstance instanceOfDraw() { return PosedInstanceBlock(constants.posing).instance; }
uint numberIn(PosedInstance i) { return uint(gl_VertexIndex) - i.first_vertex; }

#endif
