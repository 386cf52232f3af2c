// SPDX-License-Identifier: MIT
// Flushes subnormals to 0 on every device and in every stage. lavapipe's fragment shaders do so in some
// processes only; its compute shaders never do.
#ifndef FLUSHED_GLSL
#define FLUSHED_GLSL

const float MIN_NORMAL = 1.17549435e-38;  // 2^-126

vec3 flushed(const vec3 v) { return mix(v, vec3(0.0), lessThan(abs(v), vec3(MIN_NORMAL))); }

#endif
