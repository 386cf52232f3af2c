// SPDX-License-Identifier: MIT
// KHR_materials_transmission for a surface without thickness.
#ifndef TRANSMISSION_GLSL
#define TRANSMISSION_GLSL

#include "shaders/lib/shading/brdf.glsl"
#include "shaders/lib/shading/clearcoat.glsl"
#include "shaders/lib/shading/sheen.glsl"
#include "shaders/lib/geometry/position.glsl"

// Fraction of light from straight behind that the specular layer does not reflect and the base neither
// scatters nor absorbs. Its colour is the base's; all components use the fraction of its luminance.
float transmittedShare(Surface s) {
    vec3 v = viewVector(s.position);
    Brdf b = makeBrdf(s, v);
    if (hasLayer(LAYER_IRIDESCENCE)) addFilm(b, s);
    vec3 base = reachingBase(b, schlickWeight(b.n_dot_v));
    float color = dot(s.albedo * base, vec3(0.2126, 0.7152, 0.0722));
    if (hasLayer(LAYER_SHEEN)) color *= belowSheen(makeSheen(s, v));
    if (hasLayer(LAYER_CLEARCOAT)) color *= 1.0 - clearcoatWeight(s, v);
    return clamp(s.transmission * (1.0 - s.metallic) * color, 0.0, 1.0);
}

#endif
