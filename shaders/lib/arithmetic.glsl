// SPDX-License-Identifier: MIT
// What GLSL's cross(), length(), normalize(), mix() and reflect() do. Those are one instruction each, which
// every driver writes out in its own way and which NoContraction does not reach; here they are as lavapipe
// has them, to the bit.
#ifndef ARITHMETIC_GLSL
#define ARITHMETIC_GLSL

vec3 crossProduct(vec3 a, vec3 b) { return a.yzx * b.zxy - a.zxy * b.yzx; }

float lengthOf(vec2 v) { return sqrt(dot(v, v)); }
float lengthOf(vec3 v) { return sqrt(dot(v, v)); }

vec2 normalized(vec2 v) { return v / lengthOf(v); }
vec3 normalized(vec3 v) { return v / lengthOf(v); }

// The same to the bit, and also of what is so short that its square is below what float32 holds.
vec3 normalizedOfAnySize(vec3 v) {
    float shrunk = dot(v, v) < 1e-30 ? 1.2089258e24 : 1.0;  // 2^80
    return normalized(v * shrunk);
}

// Of any length that float32 holds; 0 where it has none.
vec3 unitVector(vec3 v) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    // A selection, not a branch: then a variant that does not read it does not read v either.
    return mix(vec3(0.0), normalized(v / largest), bvec3(largest > 0.0));
}

// From a to b, exact at both ends.
float blend(float a, float b, float t) { return a * (1.0 - t) + b * t; }
vec3 blend(vec3 a, vec3 b, float t) { return a * (1.0 - t) + b * t; }

// 0 to 1, 0 of what is no number.
float shareOf(float value) { return value > 0.0 ? min(value, 1.0) : 0.0; }

// n: unit.
vec3 reflection(vec3 v, vec3 n) { return v - n * (2.0 * dot(n, v)); }

#endif
