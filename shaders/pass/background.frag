// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The environment where nothing was drawn.
#define FLAT_VIEW
#include "shaders/lib/position.glsl"
#include "shaders/lib/sky.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    vec3 away = -view.backward;
    if (!on(feature_orthographic))
        away = normalized(view.direction_0 + view.direction_x * gl_FragCoord.x +
                          view.direction_y * gl_FragCoord.y);
    out_lit = vec4(skyRadiance(environmentFromWorld(away)) * environmentFactor(), 1.0);
}
