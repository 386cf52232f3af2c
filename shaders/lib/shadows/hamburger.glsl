// SPDX-License-Identifier: MIT
// The Hamburger moment problem for four moments (Peters and Klein 2015, "Moment Shadow Mapping", algorithm
// 3). Finds the distribution on three points with these moments, one point being given.
#ifndef HAMBURGER_GLSL
#define HAMBURGER_GLSL

const float MIN_DIVISOR = 1e-20;

struct ThreeDepths {
    vec2 other;    // the two other points, other.x <= other.y
    float before;  // weight of the points before the given one
    float at;      // weight of the given one
};

// `b`: means of d, d^2, d^3, d^4; their Hankel matrix must not be near singular. `min_variance`:
// smallest variance of d.
ThreeDepths threeDepths(const vec4 b, const float depth, const float min_variance) {
    // The Hankel matrix of (1, b) is L D L^T.
    float l32_d22 = b.z - b.x * b.y;
    float d22 = max(b.y - b.x * b.x, min_variance);
    float d33_d22 = max((b.w - b.y * b.y) * d22 - l32_d22 * l32_d22, MIN_DIVISOR);
    float l32 = l32_d22 / d22;
    // Its inverse times (1, depth, depth^2): a polynomial whose roots are the two other points.
    vec3 c = vec3(1.0, depth - b.x, 0.0);
    c.z = (depth * depth - b.y - l32 * c.y) * (d22 / d33_d22);
    c.y = c.y / d22 - l32 * c.z;
    c.x = 1.0 - c.y * b.x - c.z * b.y;
    float scale = abs(c.z) > MIN_DIVISOR ? c.z : MIN_DIVISOR, p = 0.5 * c.y / scale;
    float root = sqrt(max(p * p - c.x / scale, 0.0));
    vec2 z = vec2(-p - root, -p + root);
    // A point's weight: the mean of the polynomial that vanishes at the other two, over its value at the
    // point.
    float at = (z.x * z.y - b.x * (z.x + z.y) + b.y) / ((depth - z.x) * (depth - z.y));
    float before = 0.0;
    if (z.y < depth)
        before = 1.0 - at;
    else if (z.x < depth)
        before = (depth * z.y - b.x * (depth + z.y) + b.y) / ((z.y - z.x) * (depth - z.x));
    return ThreeDepths(z, before, at);
}

#endif
