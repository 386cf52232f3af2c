// SPDX-License-Identifier: MIT
// What the bits of a G-buffer's field allow the number in it to be off by: nothing here calls the code that
// encodes or decodes, so a fault of that code cannot widen what it is granted.
// compare/verdict/encoding_bits.cpp has the same bounds in double, and a probe holds the two together.
#ifndef ENCODING_BITS_GLSL
#define ENCODING_BITS_GLSL

// Float32 on the way of a number in [0, 1] through its code: a product, a sum and a division.
const float UNORM_ROUNDING = 8.0 / 16777216.0;

float halfStep(uint bits) { return 0.5 / float((1u << bits) - 1u); }

// Of a number in [0, 1]; both ends have codes of their own.
float unormBound(float x, uint bits) {
    return x <= 0.0 || x >= 1.0 ? 0.0 : halfStep(bits) + UNORM_ROUNDING;
}

// Of a number whose square root is coded: |(r + h)^2 - r^2|.
float rootBound(float x, uint bits) {
    float h = halfStep(bits);
    return x <= 0.0 || x >= 1.0 ? 0.0 : h * (2.0 * sqrt(x) + h) + 2.0 * UNORM_ROUNDING;
}
vec3 rootBound(vec3 x, uint bits) {
    return vec3(rootBound(x.r, bits), rootBound(x.g, bits), rootBound(x.b, bits));
}

// Of radiance in 9.9.9.e5: half a step of the largest component, whose top bit is set, and 1/512 of that more
// where rounding moves the exponent; below the least exponent half a step stays 2^-25.
float radianceBound(vec3 x, bool wide) {
    float largest = max(x.r, max(x.g, x.b));
    return wide || largest <= 0.0 ? 0.0
                                  : max(largest * (0.5 / 256.0) * (1.0 + 1.0 / 512.0), 1.0 / 33554432.0);
}

// The angle by which an octahedral direction may be off, radians: half a step in both coordinates at the
// centre of a face, and float32 on the way.
float octahedralAngle(uint bits) {
    float h = 0.5 / float((1u << (bits - 1u)) - 1u);
    return 3.0 * sqrt(2.0) * (h + 8.0 / 16777216.0) + 10.0 / 16777216.0;
}

#endif
