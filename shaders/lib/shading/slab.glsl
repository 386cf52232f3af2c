// SPDX-License-Identifier: MIT
// KHR_materials_volume: a slab with parallel sides. The view ray bends by Snell's law, and leaves the slab
// after `thickness` metres, parallel to itself.
#ifndef SLAB_GLSL
#define SLAB_GLSL

#include "shaders/lib/surface/surface.glsl"

// Fraction of light that crosses `thickness` metres (Beer and Lambert). `color` remains after `distance`.
vec3 crossing(const vec3 color, const float distance, const float thickness) {
    // Finite, so that white, whose logarithm is 0, stays white.
    float lengths = distance > 0.0 ? min(thickness / distance, 3e38) : 0.0;
    vec3 crossed = exp(log(max(color, vec3(1e-37))) * lengths);
    return mix(crossed, vec3(0.0), bvec3(uvec3(equal(color, vec3(0.0))) * uint(lengths > 0.0)));
}
vec3 crossing(const Surface s) {
    return crossing(s.attenuation_color, s.attenuation_distance, s.thickness);
}

// From the surface to where the ray leaves the slab, m. `v`: unit, to the viewer. `ior` 0 stands for
// infinity (KHR_materials_ior).
vec3 slabShift(const Surface s, const vec3 v, const float ior) {
    float eta = ior > 0.0 ? 1.0 / max(ior, 1.0) : 0.0;
    float outside = eta * clamp(dot(s.normal, v), 0.0, 1.0);
    float inside = sqrt((1.0 - eta) * (1.0 + eta) + outside * outside);  // without cancellation near 1
    vec3 along = s.normal * (outside - inside) - v * eta;
    return normalized(along) * s.thickness;
}

#endif
