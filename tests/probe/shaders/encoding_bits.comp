// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/encoding_bits.glsl"
#include "tests/probe/shaders/probe.glsl"

// x, bits -> bounds of x: as unorm, as a root, as the largest component of a radiance, as one in float32; of
// a normal, radians
void main() {
    if (PROBE_ROW >= probe_rows) return;
    float x = IN(2, 0);
    uint bits = uint(IN(2, 1));
    OUT(5, 0) = unormBound(x, bits);
    OUT(5, 1) = rootBound(x, bits);
    OUT(5, 2) = radianceBound(vec3(0.25 * x, x, 0.0), false);
    OUT(5, 3) = radianceBound(vec3(x), true);
    OUT(5, 4) = octahedralAngle(bits);
}
