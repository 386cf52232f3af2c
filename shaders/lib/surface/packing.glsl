// SPDX-License-Identifier: MIT
// Packs numbers into bits and back. Rounds to nearest itself instead of relying on the device.
#ifndef PACKING_GLSL
#define PACKING_GLSL

#include "shaders/lib/contract.glsl"

// x in [0, 1] to `bits` bits.
uint packUnorm(const float x, const uint bits) {
    float top = float((1u << bits) - 1u);
    return uint(floor(clamp(x, 0.0, 1.0) * top + 0.5));
}

float unpackUnorm(const uint code, const uint offset, const uint bits) {
    return float(bitfieldExtract(code, int(offset), int(bits))) *
           (1.0 / float((1u << bits) - 1u));  // the largest code gives 1
}

// Square root of each component in 8 bits; `w` (no root) in the highest 8.
uint packSqrt(const vec3 rgb, const float w) {
    vec3 root = sqrt(max(rgb, vec3(0.0)));
    return packUnorm(root.r, 8) | (packUnorm(root.g, 8) << 8) | (packUnorm(root.b, 8) << 16) |
           (packUnorm(w, 8) << 24);
}

vec3 unpackSqrt(const uint code) {
    vec3 root = vec3(unpackUnorm(code, 0, 8), unpackUnorm(code, 8, 8), unpackUnorm(code, 16, 8));
    return root * root;
}

// 2^e for e in [-126, 127], exact.
float powerOfTwo(const int e) { return uintBitsToFloat(uint(e + 127) << 23); }

// EXT_texture_shared_exponent's 9.9.9.e5: nine bits per component, with the exponent of the largest one.
uint packSharedExponent(const vec3 rgb) {
    vec3 c = clamp(rgb, vec3(0.0), vec3(EMISSION_MAX));
    float largest = max(c.r, max(c.g, c.b));
    int exponent = max(int(floatBitsToUint(largest) >> 23) - 127, -16) + 1;  // largest < 2^exponent
    if (floor(largest * powerOfTwo(9 - exponent) + 0.5) == 512.0) ++exponent;
    uvec3 m = uvec3(floor(c * powerOfTwo(9 - exponent) + 0.5));
    return m.r | (m.g << 9) | (m.b << 18) | (uint(exponent + 15) << 27);
}

// Decodes to zero, but differs from packSharedExponent(vec3(0.0)), which is 0.
const uint SHARED_EXPONENT_BLACK = 1u << 27;

vec3 unpackSharedExponent(const uint code) {
    vec3 m = vec3(code & 511u, (code >> 9) & 511u, (code >> 18) & 511u);
    return m * powerOfTwo(int(code >> 27) - 15 - 9);
}

#endif
