// SPDX-License-Identifier: MIT
// Numbers below the least normal one as 0, which is as dark, on every device and in every stage: lavapipe's
// fragments make that of them in some processes and not in others, its threads never do.
#ifndef FLUSHED_GLSL
#define FLUSHED_GLSL

const float LEAST_NORMAL = 1.17549435e-38;  // 2^-126

vec3 flushed(vec3 v) { return mix(v, vec3(0.0), lessThan(abs(v), vec3(LEAST_NORMAL))); }

#endif
