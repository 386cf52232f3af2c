// SPDX-License-Identifier: MIT
// KHR_materials_transmission for a surface without thickness.
#ifndef TRANSMISSION_GLSL
#define TRANSMISSION_GLSL

#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/geometry/position.glsl"

// Fraction of light from straight behind that the specular layer does not reflect and the base neither
// scatters nor absorbs. Its colour is the base's; all components use the fraction of its luminance.
float transmittedShare(Surface s) {
    Brdf b = makeBrdf(s, viewVector(s.position));
    vec3 base = reachingBase(b, schlickWeight(b.n_dot_v));
    float color = dot(s.albedo * base, vec3(0.2126, 0.7152, 0.0722));
    return clamp(s.transmission * (1.0 - s.metallic) * color, 0.0, 1.0);
}

#endif
