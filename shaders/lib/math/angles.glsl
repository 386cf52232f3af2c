// SPDX-License-Identifier: MIT
// Angles from their sine and cosine. GLSL's acos and atan guarantee far less than float32 precision.
#ifndef ANGLES_GLSL
#define ANGLES_GLSL

#include "shaders/lib/contract.glsl"

// acos(x) / sqrt(1 - x^2) for x in [0, 1]. Minimax polynomial of degree 7, exact at 0; relative error
// 6e-7.
float arcRatio(const float x) {
    float p = 0.140058979 - 0.027750602 * x;
    p = -0.329970568 + p * x;
    p = 0.513551354 + p * x;
    p = -0.65040642 + p * x;
    p = 0.783655047 + p * x;
    p = -0.999934554 + p * x;
    return 0.5 * PI + p * x;
}

// Angle over its sine, for angles in [0, pi].
float angleRatio(const float cosine, const float sine) {
    float ratio = arcRatio(min(abs(cosine), 1.0));
    return cosine >= 0.0 ? ratio : PI / max(sine, 1e-15) - ratio;
}
// Angle in [0, pi]; `sine` is at least 0.
float angleOf(const float cosine, const float sine) {
    float small = arcRatio(min(abs(cosine), 1.0)) * sine;
    return cosine >= 0.0 ? small : PI - small;
}

#endif
