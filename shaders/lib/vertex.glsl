// SPDX-License-Identifier: MIT
// The one way in which a vertex reaches the screen. Every pass that draws geometry goes through here, so
// that depth is the same bits in all of them.
#ifndef VERTEX_GLSL
#define VERTEX_GLSL

#include "shaders/lib/draw.glsl"

invariant gl_Position;

// World axes, camera as origin, m.
vec3 worldFromVertex(Draw draw, vec3 position) {
    precise vec3 world = draw.world_from_object * vec4(position, 1.0);
    return world;
}

vec4 clipFromVertex(vec3 world) {
    precise vec4 clip = view.clip_from_world * vec4(world, 1.0);
    return clip;
}

#endif
