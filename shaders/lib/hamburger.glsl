// SPDX-License-Identifier: MIT
// The Hamburger problem for four moments (Peters and Klein 2015, "Moment Shadow Mapping", algorithm 3): of
// all distributions with these moments there is one of three places of which one is given.
#ifndef HAMBURGER_GLSL
#define HAMBURGER_GLSL

const float LEAST_DIVISOR = 1e-20;

struct ThreePlaces {
    vec2 other;    // the two other places, other.x <= other.y
    float before;  // the share at those places that lie before the given one
    float at;      // the share at the given one
};

// `b`: means of d, d^2, d^3, d^4, whose Hankel matrix is far enough from singular. `least_variance`: of d.
ThreePlaces threePlaces(vec4 b, float depth, float least_variance) {
    // The Hankel matrix of (1, b) is L D L^T.
    float l32_d22 = b.z - b.x * b.y;
    float d22 = max(b.y - b.x * b.x, least_variance);
    float d33_d22 = max((b.w - b.y * b.y) * d22 - l32_d22 * l32_d22, LEAST_DIVISOR);
    float l32 = l32_d22 / d22;
    // Its inverse times (1, depth, depth^2): a polynomial whose roots are the two other places.
    vec3 c = vec3(1.0, depth - b.x, 0.0);
    c.z = (depth * depth - b.y - l32 * c.y) * (d22 / d33_d22);
    c.y = c.y / d22 - l32 * c.z;
    c.x = 1.0 - c.y * b.x - c.z * b.y;
    float scale = abs(c.z) > LEAST_DIVISOR ? c.z : LEAST_DIVISOR, p = 0.5 * c.y / scale;
    float root = sqrt(max(p * p - c.x / scale, 0.0));
    vec2 z = vec2(-p - root, -p + root);
    // Shares by what a polynomial through the three places has to be.
    float at = (z.x * z.y - b.x * (z.x + z.y) + b.y) / ((depth - z.x) * (depth - z.y));
    float before = 0.0;
    if (z.y < depth)
        before = 1.0 - at;
    else if (z.x < depth)
        before = (depth * z.y - b.x * (depth + z.y) + b.y) / ((z.y - z.x) * (depth - z.x));
    return ThreePlaces(z, before, at);
}

#endif
