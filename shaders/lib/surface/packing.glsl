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

// A field of GBUFFER_WORDS, after the first one, in its word.
#define PACKED(x, field) (packUnorm(x, field##_BITS) << field##_SHIFT)
#define UNPACKED(word, field) unpackUnorm(word, field##_SHIFT, field##_BITS)

// Square root of each component in `bits` bits, from the lowest.
uint packSqrt(const vec3 rgb, const uint bits) {
    vec3 root = sqrt(max(rgb, vec3(0.0)));
    return packUnorm(root.r, bits) | (packUnorm(root.g, bits) << bits) |
           (packUnorm(root.b, bits) << (2u * bits));
}

vec3 unpackSqrt(const uint code, const uint bits) {
    vec3 root = vec3(unpackUnorm(code, 0, bits), unpackUnorm(code, bits, bits),
                     unpackUnorm(code, 2u * bits, bits));
    return root * root;
}

// 2^e for e in [-126, 127], exact.
float powerOfTwo(const int e) { return uintBitsToFloat(uint(e + 127) << 23); }

// EXT_texture_shared_exponent: a mantissa per component, with the exponent of the largest one.
const uint EMISSION_STEPS = 1u << EMISSION_MANTISSA_BITS;
uint packSharedExponent(const vec3 rgb) {
    vec3 c = clamp(rgb, vec3(0.0), vec3(EMISSION_MAX));
    float largest = max(c.r, max(c.g, c.b));
    int exponent = max(int(floatBitsToUint(largest) >> 23) - 127, -int(EMISSION_BIAS) - 1) + 1;
    // Now largest < 2^exponent.
    int bits = int(EMISSION_MANTISSA_BITS);
    if (floor(largest * powerOfTwo(bits - exponent) + 0.5) == float(EMISSION_STEPS)) ++exponent;
    uvec3 m = uvec3(floor(c * powerOfTwo(bits - exponent) + 0.5));
    return m.r | (m.g << EMISSION_MANTISSA_BITS) | (m.b << (2u * EMISSION_MANTISSA_BITS)) |
           (uint(exponent + int(EMISSION_BIAS)) << EMISSION_EXPONENT_SHIFT);
}

// Decodes to zero, but differs from packSharedExponent(vec3(0.0)), which is 0.
const uint SHARED_EXPONENT_BLACK = 1u << EMISSION_EXPONENT_SHIFT;

vec3 unpackSharedExponent(const uint code) {
    const uint bits = EMISSION_MANTISSA_BITS, mask = EMISSION_STEPS - 1u;
    vec3 m = vec3(code & mask, (code >> bits) & mask, (code >> (2u * bits)) & mask);
    return m * powerOfTwo(int(code >> EMISSION_EXPONENT_SHIFT) - int(EMISSION_BIAS) - int(bits));
}

#endif
