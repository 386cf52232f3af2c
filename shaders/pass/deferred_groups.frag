// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Groups a pixel's samples (shaders/lib/samples/sample_pairs.glsl) and writes the groups as a depth, the
// same for all samples (shaders/lib/samples/sample_groups.glsl).
#define FLAT_VIEW
#include "shaders/lib/samples/sample_pairs.glsl"

void main() {
    uint count;
    gl_FragDepth = groupsAt(ivec2(gl_FragCoord.xy), count);
}
