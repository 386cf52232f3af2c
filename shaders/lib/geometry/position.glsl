// SPDX-License-Identifier: MIT
// Both paths compute shading positions by the same function of pixel and depth. An interpolated and a
// reconstructed position differ by up to 7e-3 of the radiance at a sharp highlight.
#ifndef POSITION_GLSL
#define POSITION_GLSL

#include "shaders/lib/geometry/view.glsl"

// View depth in metres from the reversed depth z in [0, 1].
float viewDepth(const float z) {
    float d = (view.depth_numerator.x + view.depth_numerator.y * z) /
              (view.depth_denominator.x + view.depth_denominator.y * z);
    return d;
}

// Origin of the pixel's ray, at depth 0; world axes, camera as origin, m. `pixel` is the pixel's centre
// (gl_FragCoord.xy).
vec3 rayOrigin(const vec2 pixel) {
    vec3 origin = vec3(0.0);
    if (on(feature_orthographic))
        origin = view.origin_0 + view.origin_x * pixel.x + view.origin_y * pixel.y;
    return origin;
}

// World axes, camera as origin, m.
vec3 positionFromDepth(const vec2 pixel, const float z) {
    vec3 direction = view.direction_0, origin = rayOrigin(pixel);
    if (!on(feature_orthographic))
        direction = view.direction_0 + view.direction_x * pixel.x + view.direction_y * pixel.y;
    vec3 position = origin + direction * viewDepth(z);
    return position;
}

// Unit, from the surface to the viewer.
vec3 viewVector(const vec3 position) {
    return on(feature_orthographic) ? view.backward : normalizedOfAnySize(-position);
}

#endif
