// SPDX-License-Identifier: MIT
// The one way in which a vertex reaches the screen. Every pass that draws geometry goes through here, so
// that depth is the same bits in all of them.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "shaders/lib/draw.glsl"
#include "shaders/lib/view.glsl"

invariant gl_Position;

layout(location = 0) in vec3 position;
// Of the instance: struct Draw.
layout(location = 6) in mat4x3 world_from_object;

// World axes, camera as origin, m.
vec3 worldFromVertex() {
    precise vec3 world = world_from_object * vec4(position, 1.0);
    return world;
}

vec4 clipFromVertex(vec3 world) {
    precise vec4 clip = view.clip_from_world * vec4(world, 1.0);
    return clip;
}

#endif
