// SPDX-License-Identifier: MIT
// Replacements for cross(), length(), normalize(), mix() and reflect(). Each of these is one instruction
// that drivers expand differently and that NoContraction does not cover. These functions equal lavapipe's
// bit for bit.
#ifndef ARITHMETIC_GLSL
#define ARITHMETIC_GLSL

vec3 crossProduct(const vec3 a, const vec3 b) { return a.yzx * b.zxy - a.zxy * b.yzx; }

float lengthOf(const vec2 v) { return sqrt(dot(v, v)); }
float lengthOf(const vec3 v) { return sqrt(dot(v, v)); }

vec2 normalized(const vec2 v) { return v / lengthOf(v); }
vec3 normalized(const vec3 v) { return v / lengthOf(v); }

// Equals normalized() bit for bit; also works if the squared length underflows float32.
vec3 normalizedOfAnySize(const vec3 v) {
    float shrunk = dot(v, v) < 1e-30 ? 1.2089258e24 : 1.0;  // 2^80
    return normalized(v * shrunk);
}

// Unit vector for any finite length; 0 for the zero vector.
vec3 unitVector(const vec3 v) {
    float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    // A selection, not a branch: a variant that does not read the result then does not read v either.
    return mix(vec3(0.0), normalized(v / largest), bvec3(largest > 0.0));
}

// Linear interpolation from a to b, exact at both ends.
float blend(const float a, const float b, const float t) { return a * (1.0 - t) + b * t; }
vec3 blend(const vec3 a, const vec3 b, const float t) { return a * (1.0 - t) + b * t; }

// Clamps to [0, 1]; NaN becomes 0.
float fractionOf(const float value) { return value > 0.0 ? min(value, 1.0) : 0.0; }

// Mirrors v at the plane with unit normal n.
vec3 reflection(const vec3 v, const vec3 n) { return v - n * (2.0 * dot(n, v)); }

#endif
