// SPDX-License-Identifier: MIT
// Angles of which sine and cosine are known. GLSL's acos and atan promise far less than float32 holds.
#ifndef ANGLES_GLSL
#define ANGLES_GLSL

#include "shaders/lib/contract.glsl"

// acos(x) / sqrt(1 - x^2) for x in [0, 1]: the polynomial of degree 7 with the least relative error, 6e-7,
// that is exact at 0. GLSL's acos and atan promise far less.
float arcRatio(float x) {
    float p = 0.140058979 - 0.027750602 * x;
    p = -0.329970568 + p * x;
    p = 0.513551354 + p * x;
    p = -0.65040642 + p * x;
    p = 0.783655047 + p * x;
    p = -0.999934554 + p * x;
    return 0.5 * PI + p * x;
}

// angle / sine of an angle in [0, pi], of which both are given.
float angleRatio(float cosine, float sine) {
    float ratio = arcRatio(min(abs(cosine), 1.0));
    return cosine >= 0.0 ? ratio : PI / max(sine, 1e-15) - ratio;
}
// In [0, pi]; sine at least 0.
float angleOf(float cosine, float sine) {
    float small = arcRatio(min(abs(cosine), 1.0)) * sine;
    return cosine >= 0.0 ? small : PI - small;
}

#endif
