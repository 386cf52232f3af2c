// SPDX-License-Identifier: MIT
// Shading positions are the same function of pixel and depth in both paths: an interpolated position and a
// reconstructed one differ by up to 7e-3 of the radiance at a sharp highlight.
#ifndef POSITION_GLSL
#define POSITION_GLSL

#include "shaders/lib/view.glsl"

// View depth in metres from the reversed depth z in [0, 1].
float viewDepth(float z) {
    float d = (view.depth_numerator.x + view.depth_numerator.y * z) /
              (view.depth_denominator.x + view.depth_denominator.y * z);
    return d;
}

// Where the pixel's ray begins, at depth 0; world axes, camera as origin, m. `pixel` is the pixel's centre
// (gl_FragCoord.xy).
vec3 rayOrigin(vec2 pixel) {
    vec3 origin = vec3(0.0);
    if (on(feature_orthographic))
        origin = view.origin_0 + view.origin_x * pixel.x + view.origin_y * pixel.y;
    return origin;
}

// Likewise.
vec3 positionFromDepth(vec2 pixel, float z) {
    vec3 direction = view.direction_0, origin = rayOrigin(pixel);
    if (!on(feature_orthographic))
        direction = view.direction_0 + view.direction_x * pixel.x + view.direction_y * pixel.y;
    vec3 position = origin + direction * viewDepth(z);
    return position;
}

// Unit, from the surface to the viewer.
vec3 viewVector(vec3 position) {
    return on(feature_orthographic) ? view.backward : normalizedOfAnySize(-position);
}

#endif
