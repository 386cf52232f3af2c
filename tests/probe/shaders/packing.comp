// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/packing.glsl"
#include "tests/probe/shaders/probe.glsl"

// rgb -> shared exponent and back (3), square root in 8 bits and back (3), red in 12 bits and back (1),
// red as F90 above a packed F0 and back (1)
void main() {
    if (PROBE_ROW >= probe_rows) return;
    vec3 rgb = IN3(3, 0);
    vec3 emission = unpackSharedExponent(packSharedExponent(rgb));
    vec3 root = unpackSqrt(packSqrt(rgb, 8), 8);
    for (uint i = 0; i < 3; ++i) {
        OUT(8, i) = emission[i];
        OUT(8, 3 + i) = root[i];
    }
    OUT(8, 6) = unpackUnorm(packUnorm(rgb.r, 12) << 7, 7, 12);
    uint specular = packSqrt(vec3(0.04, 1.0, 0.5), SPECULAR_BITS) | PACKED(rgb.r, SPECULAR_F90);
    OUT(8, 7) = UNPACKED(specular, SPECULAR_F90);
}
