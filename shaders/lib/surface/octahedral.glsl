// SPDX-License-Identifier: MIT
// Octahedral map of unit vectors (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors"). Each coordinate is a signed integer of `bits` bits. 0 is exact, so axes are.
#ifndef OCTAHEDRAL_GLSL
#define OCTAHEDRAL_GLSL

#include "shaders/lib/math/arithmetic.glsl"

vec2 octahedralWrap(const vec2 p) {
    return (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
}

// n: unit. Returns x in the low `bits`, y above them.
uint encodeOctahedral(const vec3 n, const uint bits) {
    vec2 p = n.xy * (1.0 / (abs(n.x) + abs(n.y) + abs(n.z)));
    if (n.z < 0.0) p = octahedralWrap(p);
    float top = float((1u << (bits - 1u)) - 1u);
    ivec2 q = ivec2(floor(clamp(p, -1.0, 1.0) * top + 0.5));
    uint mask = (1u << bits) - 1u;
    return (uint(q.x) & mask) | ((uint(q.y) & mask) << bits);
}

vec3 decodeOctahedral(const uint code, const uint bits) {
    float top = float((1u << (bits - 1u)) - 1u);
    ivec2 q =
        ivec2(bitfieldExtract(int(code), 0, int(bits)), bitfieldExtract(int(code), int(bits), int(bits)));
    vec2 p = vec2(q) * (1.0 / top);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = octahedralWrap(p);
    return normalized(n);
}

#endif
