// SPDX-License-Identifier: MIT
// Uniform ambient light: the BRDF integrated over the hemisphere, from the table of
// shared/contract/albedo.h or from a fit.
#ifndef AMBIENT_GLSL
#define AMBIENT_GLSL

#include "shaders/lib/shading/brdf.glsl"
#include "shared/contract/albedo.h"

// Each texel stores a table sample and the next one.
layout(set = SET_FRAME, binding = BINDING_ALBEDO) uniform samplerBuffer albedo_pairs;

// Cubic Lagrange weights for samples at 0, 1, 2 and 3.
vec4 cubicWeights(const float t) {
    float a = t, b = t - 1.0, c = t - 2.0, d = t - 3.0;
    vec4 w = vec4(b * c * d / -6.0, a * c * d * 0.5, a * b * d * -0.5, a * b * c / 6.0);
    return w;
}

// Index of the first of the four samples around x in [0, 1]. `t` is the position of x from there, in
// samples.
uint cubicFirst(const float x, const uint count, out float t) {
    float position = clamp(x, 0.0, 1.0) * float(count - 1u);
    uint first = uint(clamp(int(position) - 1, 0, int(count) - 4));
    t = position - float(first);
    return first;
}

vec2 cubicRow(const uint first, const vec4 w) {
    vec4 lower = texelFetch(albedo_pairs, int(first)), upper = texelFetch(albedo_pairs, int(first) + 2);
    vec2 sum = lower.xy * w.x + lower.zw * w.y + upper.xy * w.z + upper.zw * w.w;
    return sum;
}

vec2 tabledAlbedo(const float alpha, const float n_dot_v) {
    float k = 2.0 * alpha, smallest = sqrt(MIN_PERCEPTUAL_ROUGHNESS);
    float x = ALBEDO_BLEND * sqrt(n_dot_v * (1.0 + k) / (n_dot_v + k)) + (1.0 - ALBEDO_BLEND) * sqrt(n_dot_v);
    float y = (sqrt(sqrt(alpha)) - smallest) / (1.0 - smallest);
    float tx, ty;
    uint column = cubicFirst(x, ALBEDO_TABLE_WIDTH, tx), row = cubicFirst(y, ALBEDO_TABLE_HEIGHT, ty);
    vec4 across = cubicWeights(tx), down = cubicWeights(ty);
    uint first = row * ALBEDO_TABLE_WIDTH + column;
    vec2 sum = cubicRow(first, across) * down.x +
               cubicRow(first + ALBEDO_TABLE_WIDTH, across) * down.y +
               cubicRow(first + 2u * ALBEDO_TABLE_WIDTH, across) * down.z +
               cubicRow(first + 3u * ALBEDO_TABLE_WIDTH, across) * down.w;
    return sum;
}

// Karis 2014, "Physically Based Shading on Mobile", after Lazarov 2013, "Getting More Physical in Call of
// Duty: Black Ops II". Negative values are clamped to 0.
vec2 fittedAlbedo(const float alpha, const float n_dot_v) {
    float roughness = sqrt(alpha), gloss = 1.0 - roughness;
    float edge = min(gloss * gloss, exp2(-9.28 * n_dot_v)) * gloss + (0.0425 - 0.0275 * roughness);
    float x = -1.04 * edge + (1.04 - 0.572 * roughness), y = 1.04 * edge + (-0.04 + 0.022 * roughness);
    return vec2(max(x, 0.0), max(y, 0.0));
}

// The directional albedo of the specular lobe is f0 * x + f90 * y. The table's error is at most 6e-5. The
// fit's error is at most 0.082 at F0 = 0.04, 0.31 at F = 1, and 0.54 below n.v = 0.1.
vec2 specularAlbedo(const float alpha, const float n_dot_v) {
    float mu = min(n_dot_v, 1.0);
    if (on(feature_fitted_albedo)) return fittedAlbedo(alpha, mu);
    return tabledAlbedo(alpha, mu);
}

// Cosine-weighted mean of schlickWeight() over the hemisphere: the light that the diffuse base loses.
// Polynomial for n.v in [0, 1], within 5e-6 of the integral.
float meanSchlickWeight(const float n_dot_v) {
    float mu = min(n_dot_v, 1.0);
    float mean = 0.0281597 + mu * (-0.079749 + mu * (0.0859503 + mu * (-0.0428453 + mu * 0.00856196)));
    return mean;
}

// v.h at which Schlick's weight of f90 is `weight`. A film's Fresnel term there stands for its mean over the
// directions whose mean weight that is.
float cosineOf(const float weight) { return 1.0 - exp(0.2 * log(clamp(weight, 1e-37, 1.0))); }

// Fraction of ambient light that passes the layer above the base.
vec3 baseFraction(const Brdf b) {
    float weight = meanSchlickWeight(b.n_dot_v);
    vec3 fraction = reachingBase(b, weight);
    if (hasLayer(LAYER_IRIDESCENCE)) {
        vec3 filmed = layeredAt(b, cosineOf(weight)).base;
        fraction = b.film.weight > 0.0 ? filmed : fraction;
    }
    return fraction;
}

// Fraction of ambient light that the specular lobe reflects to the viewer; of an anisotropic lobe, that of
// an isotropic one as wide as it is towards the viewer (shared/material/MEASURED.md, "Layers").
vec3 lobeFraction(const Brdf b) {
    vec2 lobe = b.albedo;
    if (!on(feature_multiscatter) || b.anisotropic) lobe = specularAlbedo(b.seen, b.n_dot_v);
    vec3 fraction = b.f0 * lobe.x + b.f90 * lobe.y;
    if (hasLayer(LAYER_IRIDESCENCE)) {
        float all = lobe.x + lobe.y;
        vec3 filmed = layeredAt(b, cosineOf(lobe.y / max(all, 1e-6))).lobe * all;
        fraction = b.film.weight > 0.0 ? filmed : fraction;
    }
    return fraction;
}

// A material under its lights: the base with its lobe, a coat, or what lies behind the surface.
struct Reflector {
    Brdf brdf;
    vec3 n, v;                   // unit; the normal, and to the viewer
    vec3 base_fraction, lobe_fraction;  // fractions of ambient light, from baseFraction() and lobeFraction()
};
Reflector makeReflector(const Brdf b, const vec3 n, const vec3 v) {
    return Reflector(b, n, v, baseFraction(b), lobeFraction(b));
}

// Radiance that leaves the base under uniform radiance 1.
vec3 fromBase(const Reflector r) { return r.brdf.diffuse * PI * r.base_fraction; }

// Radiance reflected to the viewer, W/(sr m^2), without occlusion. `ambient`: uniform radiance.
// `lightmap`: irradiance over pi, reflected by the base only.
vec3 reflectedAmbient(const Reflector r, const vec3 ambient, const vec3 lightmap) {
    vec3 radiance = vec3(0.0);
    if (on(feature_ambient)) {
        vec3 reflected = r.lobe_fraction;
        if (feature_multiscatter == MULTISCATTER_FDEZ) reflected += r.brdf.between * PI;
        radiance = reflected * ambient;
    }
    radiance += fromBase(r) * (ambient + lightmap);
    return radiance;
}

#endif
