// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Which samples of a pixel deferred lighting shades as one. The depth of every sample of the pixel says so
// (lib/sample_groups.glsl).
#define FLAT_VIEW
#include "shaders/lib/sample_pairs.glsl"

void main() {
    uint count;
    gl_FragDepth = groupsAt(ivec2(gl_FragCoord.xy), count);
}
