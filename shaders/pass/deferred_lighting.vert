// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The full-screen triangle of deferred lighting, or the listed tiles, one per instance.
#define FLAT_VIEW
#include "shaders/lib/geometry/draw.glsl"
#include "shaders/lib/geometry/full_screen.glsl"
#include "shaders/lib/geometry/lighting_tiles.glsl"
#include "shaders/lib/samples/samples.glsl"
#include "shaders/lib/geometry/view.glsl"

void main() {
    gl_Position = fullScreenCorner(gl_VertexIndex);
    if (on(feature_lighting_tiles))
        gl_Position = tileCorner(listedTile(uint(gl_InstanceIndex)), gl_VertexIndex);
    // Depth at which the draw of a sample group passes the depth test: samples.h.
    if (multisampled())
        gl_Position.z = uintBitsToFloat((GROUP_EXPONENT + constants.group + 1u) << GROUP_MANTISSA_BITS);
    passViewThrough();
}
