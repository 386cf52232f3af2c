// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/geometry/vertex.glsl"

void main() {
    vec3 at = position;
    if (on(feature_vertex_posing)) {
        PosedInstance i = instanceOfDraw();
        at = posedPosition(i, numberIn(i));
    }
    gl_Position = clipFrom(at);
}
