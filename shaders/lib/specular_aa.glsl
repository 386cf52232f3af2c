// SPDX-License-Identifier: MIT
// Specular anti-aliasing: a highlight that is narrower than what the normal turns by within a pixel is made
// as wide, so that it neither sparkles nor crawls. The filter of a pixel's half vectors is a Gaussian,
// which GGX takes as an addition to alpha^2. Tokuyoshi and Kaplanyan 2019, "Improved Geometric Specular
// Antialiasing", the isotropic kernel for deferred shading, which knows no light,
//     alpha'^2 = alpha^2 + min(2 sigma^2 (|dn/dx|^2 + |dn/dy|^2), kappa).
#ifndef SPECULAR_AA_GLSL
#define SPECULAR_AA_GLSL

#include "shaders/lib/contract.glsl"

// |dn/dx|^2 + |dn/dy|^2 that rounding may make of a normal that does not change. With perspective a normal
// is n/w over 1/w, and both are sums of products with the pixel's coordinates (on lavapipe from the
// picture's upper left): each of some six roundings is of the largest term, and counts most where a pixel
// of the quad is near the horizon, where 1/w is 0. `inverse_w` is 1/w, `pixel` where it is, in pixels; `dx`
// and `dy` are what 1/w changes by.
float roundedChange(float inverse_w, vec2 pixel, float dx, float dy) {
    float smallest = inverse_w - abs(dx) - abs(dy);
    float terms = abs(inverse_w) + abs(dx) * pixel.x + abs(dy) * pixel.y;
    float change = terms * (1.0 / 524288.0) / max(smallest, 1e-37);  // 2^-19: 32 roundings
    return change * change;
}

// Perceptual roughness, where the unit normal changes by `dn_dx` and `dn_dy` from a pixel to the next.
// Where that is no more than `rounded`, it is flat and keeps its roughness to the bit.
float filteredRoughness(float roughness, vec3 dn_dx, vec3 dn_dy, float rounded) {
    float change = dot(dn_dx, dn_dx) + dot(dn_dy, dn_dy);
    float variance = uintBitsToFloat(feature_specular_aa_variance);  // sigma^2, square pixels
    float limit = uintBitsToFloat(feature_specular_aa_limit);        // kappa
    float kernel = change > rounded ? min(2.0 * variance * change, limit) : 0.0;
    float alpha = max(roughness, MIN_PERCEPTUAL_ROUGHNESS);  // of what is shaded
    alpha *= alpha;
    float filtered = sqrt(sqrt(min(alpha * alpha + kernel, 1.0)));
    return kernel > 0.0 ? max(filtered, roughness) : roughness;
}

// The same as three.js has it (0.187, lights_physical_fragment): perceptual roughness and the largest
// component by which the normal changes, along the picture's `right` and `down` and its depth.
float steepenedRoughness(float roughness, vec3 dn_dx, vec3 dn_dy, vec3 right, vec3 down, float rounded) {
    if (dot(dn_dx, dn_dx) + dot(dn_dy, dn_dy) <= rounded) return roughness;
    mat3 picture = mat3(right, down, crossProduct(right, down));
    vec3 change = max(abs(dn_dx * picture), abs(dn_dy * picture));
    float most = max(change.x, max(change.y, change.z));
    return min(max(roughness, MIN_PERCEPTUAL_ROUGHNESS) + most, 1.0);
}

#endif
