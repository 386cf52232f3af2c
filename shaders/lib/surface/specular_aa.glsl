// SPDX-License-Identifier: MIT
// Specular anti-aliasing: widens a highlight that is narrower than the normal's change within a pixel, so
// that it neither sparkles nor crawls. The filter over a pixel's half vectors is a Gaussian, which GGX
// takes as an addition to alpha^2. Tokuyoshi and Kaplanyan 2019, "Improved Geometric Specular
// Antialiasing", the isotropic kernel for deferred shading, which is independent of the lights,
//     alpha'^2 = alpha^2 + min(2 sigma^2 (|dn/dx|^2 + |dn/dy|^2), kappa).
#ifndef SPECULAR_AA_GLSL
#define SPECULAR_AA_GLSL

#include "shaders/lib/contract.glsl"

// Largest |dn/dx|^2 + |dn/dy|^2 that rounding may give a constant normal. With perspective a normal is n/w
// over 1/w, and both are sums of products with the pixel's coordinates (on lavapipe from the image's upper
// left). About six roundings are each relative to the largest term. They count most if a pixel of the quad
// is near the horizon, where 1/w is 0. `inverse_w`: 1/w; `pixel`: its position, pixels; `dx`, `dy`:
// changes of 1/w.
float roundedChange(const float inverse_w, const vec2 pixel, const float dx, const float dy) {
    float smallest = inverse_w - abs(dx) - abs(dy);
    float terms = abs(inverse_w) + abs(dx) * pixel.x + abs(dy) * pixel.y;
    float change = terms * (1.0 / 524288.0) / max(smallest, 1e-37);  // 2^-19: 32 roundings
    return change * change;
}

// Perceptual roughness if the unit normal changes by `dn_dx` and `dn_dy` between pixels. A change up to
// `rounded` counts as flat and keeps the roughness bit for bit. `limit`: kappa.
float filteredRoughness(const float roughness, const vec3 dn_dx, const vec3 dn_dy, const float rounded,
                        const float limit) {
    float change = dot(dn_dx, dn_dx) + dot(dn_dy, dn_dy);
    float variance = uintBitsToFloat(feature_specular_aa_variance);  // sigma^2, square pixels
    float kernel = change > rounded ? min(2.0 * variance * change, limit) : 0.0;
    float alpha = max(roughness, MIN_PERCEPTUAL_ROUGHNESS);  // as shaded
    alpha *= alpha;
    float filtered = sqrt(sqrt(min(alpha * alpha + kernel, 1.0)));
    return kernel > 0.0 ? max(filtered, roughness) : roughness;
}

// The filter of three.js (0.187, lights_physical_fragment): adds the largest component of the normal's
// change to perceptual roughness. Components are along the image's `right` and `down` and its depth.
float steepenedRoughness(const float roughness, const vec3 dn_dx, const vec3 dn_dy, const vec3 right,
                         const vec3 down, const float rounded) {
    if (dot(dn_dx, dn_dx) + dot(dn_dy, dn_dy) <= rounded) return roughness;
    mat3 image = mat3(right, down, crossProduct(right, down));
    vec3 change = max(abs(dn_dx * image), abs(dn_dy * image));
    float largest = max(change.x, max(change.y, change.z));
    return min(max(roughness, MIN_PERCEPTUAL_ROUGHNESS) + largest, 1.0);
}

#endif
