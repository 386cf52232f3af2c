// SPDX-License-Identifier: MIT
// glTF 2.0's metallic-roughness BRDF (appendix B) with KHR_materials_specular and _ior: the mix by
// `metallic` of a dielectric (a Lambertian base under a specular layer) and a metal. One copy for all.
#ifndef BRDF_GLSL
#define BRDF_GLSL

#include "shaders/lib/surface.glsl"

// What does not depend on the light.
struct Brdf {
    vec3 diffuse;    // (1 - metallic) albedo / pi, 1/sr
    vec3 f0;         // of the mix
    float f90;
    float base_f0;   // the dielectric layer's largest component: what it reflects the base does not get
    float base_f90;
    float alpha;     // GGX width, roughness^2
    float n_dot_v;
};

Brdf makeBrdf(Surface s, vec3 v) {
    Brdf b;
    b.diffuse = (1.0 - s.metallic) * s.albedo * INVERSE_PI;
    b.f0 = specularF0(s);
    b.f90 = mix(s.dielectric_f90, 1.0, s.metallic);
    b.base_f0 = max(s.dielectric_f0.r, max(s.dielectric_f0.g, s.dielectric_f0.b));
    b.base_f90 = s.dielectric_f90;
    float roughness = max(s.roughness, MIN_PERCEPTUAL_ROUGHNESS);
    b.alpha = roughness * roughness;
    b.n_dot_v = max(dot(s.normal, v), MIN_N_DOT_V);
    return b;
}

// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; 1/sr.
// (n.h)^2 (alpha^2 - 1) + 1 cancels near the highlight; by Lagrange's identity 1 - (n.h)^2 = |n x h|^2,
// which does not (off by over 1e-4 on 40 % of near-highlight samples at roughness 0.1, against none).
// No microfacet faces down: a normal map that turns from the viewer would mirror lights behind the surface.
float distributionGgx(float alpha, vec3 n, vec3 h) {
    vec3 n_cross_h = cross(n, h);
    float n_dot_h = dot(n, h);
    float a = n_dot_h * alpha;
    precise float k = alpha / (dot(n_cross_h, n_cross_h) + a * a);
    precise float d = k * k * INVERSE_PI;
    return n_dot_h > 0.0 ? d : 0.0;
}

// Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs": height-correlated
// Smith for GGX, G / (4 (n.l) (n.v)), 1/sr.
float visibilitySmith(float alpha, float n_dot_v, float n_dot_l) {
    float a2 = alpha * alpha;
    precise float lambda_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    precise float lambda_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    return 0.5 / (lambda_v + lambda_l);
}

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering": the weight of f90.
float schlickWeight(float v_dot_h) {
    float x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float x2 = x * x;
    return x2 * x2 * x;
}

// Adds what light of `irradiance` (W/m^2, across its direction) from the unit vector `l` sends to `v`.
void addLight(Brdf b, vec3 n, vec3 v, vec3 l, vec3 irradiance, inout vec3 diffuse, inout vec3 specular) {
    float n_dot_l = clamp(dot(n, l), 0.0, 1.0);
    vec3 sum = l + v;  // zero where light and viewer stand opposite: nothing is reflected, but nothing may be NaN
    float length2 = dot(sum, sum);
    vec3 h = length2 > 1e-12 ? sum * inversesqrt(length2) : n;
    float weight = schlickWeight(dot(v, h));
    vec3 fresnel = b.f0 + (vec3(b.f90) - b.f0) * weight;
    float base = 1.0 - (b.base_f0 + (b.base_f90 - b.base_f0) * weight);
    float lobe = distributionGgx(b.alpha, n, h) * visibilitySmith(b.alpha, b.n_dot_v, max(n_dot_l, 1e-7));
    vec3 received = irradiance * n_dot_l;
    precise vec3 from_base = b.diffuse * base * received;
    precise vec3 from_lobe = fresnel * lobe * received;
    diffuse += from_base;
    specular += from_lobe;
}

#endif
