// SPDX-License-Identifier: MIT
// glTF 2.0's metallic-roughness BRDF (appendix B) with KHR_materials_specular and _ior. `metallic` mixes a
// dielectric (a Lambertian base under a specular layer) and a metal. All passes share this copy.
#ifndef BRDF_GLSL
#define BRDF_GLSL

#include "shaders/lib/lights/incident.glsl"
#include "shaders/lib/shading/fresnel.glsl"
#include "shaders/lib/surface/surface.glsl"

#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require

// Values that do not depend on the light.
struct Brdf {
    vec3 diffuse;    // (1 - metallic) albedo / pi, 1/sr
    vec3 through;    // the same for light from behind; only with LAYER_DIFFUSE_TRANSMISSION
    vec3 f0;         // of the mix
    vec3 f90;
    vec3 base_f0;    // of the dielectric's layer; the base loses what it reflects (lostBelow)
    vec3 base_f90;
    vec3 between;    // multiple scattering as a Lambertian lobe (multiscatter.glsl), 1/sr
    vec2 albedo;     // specularAlbedo(); only with feature_multiscatter
    float alpha;     // GGX width, roughness^2
    float alpha2;
    float n_dot_v;
    float smith_v;   // sqrt((n.v)^2 (1 - alpha^2) + alpha^2)
    // An anisotropic lobe has two widths; `alpha` is their geometric mean. Only with LAYER_ANISOTROPY.
    bool anisotropic;
    vec3 along, across;  // unit: where highlights stretch, and perpendicular to it and the normal
    vec2 alphas;         // GGX widths along and across
    vec2 viewed;         // components of the view vector
    float seen;          // width towards the viewer; of an isotropic lobe, alpha
    // With LAYER_IRIDESCENCE: f0, f90, base_f0 and base_f90 are then those of filmCurve().
    Film film;
    FilmBase dielectric, metal;
    float dielectric_f90, metallic;
    vec3 dielectric_gain, metal_gain;  // of multiple scattering and of layers above; 1: none
    bool base_fixed;                   // the base gets the same from all directions (multiscatter.glsl)
};

// Light that a base loses to a layer that reflects `layer`: each component, or the largest.
vec3 lostBelow(const vec3 layer) {
    if (on(feature_base_by_component)) return layer;
    return vec3(max(layer.r, max(layer.g, layer.b)));
}

// alpha_t = mix(alpha, 1, strength^2) along the direction (KHR_materials_anisotropy).
void stretch(inout Brdf b, const Surface s, const vec3 v) {
    vec3 x, y;
    axesAcross(s.normal, x, y);
    b.along = x * s.anisotropy_turn.x + y * s.anisotropy_turn.y;
    b.across = y * s.anisotropy_turn.x - x * s.anisotropy_turn.y;
    b.alphas = vec2(blend(b.alpha, 1.0, s.anisotropy * s.anisotropy), b.alpha);
    b.viewed = vec2(dot(b.along, v), dot(b.across, v));
    b.anisotropic = s.anisotropy > 0.0;
    if (b.anisotropic) {
        b.alpha2 = b.alphas.x * b.alphas.y;
        b.alpha = sqrt(b.alpha2);
        // Heitz 2014, equation 80.
        vec2 wide = b.viewed * b.alphas;
        float sideways = dot(b.viewed, b.viewed);
        float seen2 = sideways > 1e-8 ? dot(wide, wide) / sideways : b.alphas.y * b.alphas.y;
        b.seen = sqrt(seen2);
        b.smith_v = sqrt(b.n_dot_v * b.n_dot_v * (1.0 - seen2) + seen2);
    }
}

// A curve of Schlick's shape through a filmed Fresnel term `here`, for area lights: its f0. `w`:
// weight of f90 where it is `here`.
vec3 filmCurve(const vec3 here, const float f90, const float w) {
    return clamp((here - f90 * w) / max(1.0 - w, 1e-4), vec3(0.0), vec3(1.0));
}

// Adds the film of a surface; the gains are known.
void addFilm(inout Brdf b, const Surface s) {
    b.film = makeFilm(s.iridescence, s.iridescence_ior, s.iridescence_thickness);
    b.dielectric = makeFilmBase(b.film, s.dielectric_f0);
    b.metal = makeFilmBase(b.film, s.albedo);
    b.dielectric_f90 = s.dielectric_f90;
    b.metallic = s.metallic;
    if (!(b.film.weight > 0.0)) return;
    FilmRay ray = filmRay(b.film, b.n_dot_v);
    float f90 = blend(b.dielectric_f90, 1.0, b.film.weight), w = ray.above;
    vec3 here = filmedFresnel(b.film, b.dielectric, ray, b.dielectric_f90);
    vec3 dielectric = filmCurve(here, f90, w);
    vec3 metal = filmCurve(filmedFresnel(b.film, b.metal, ray, 1.0), 1.0, w);
    b.f0 = blend(dielectric * b.dielectric_gain, metal * b.metal_gain, b.metallic);
    b.f90 = blend(f90 * b.dielectric_gain, b.metal_gain, b.metallic);
    if (b.base_fixed) {
        // The film may reflect more than the layer without it; no more than the rest reaches the base.
        b.base_f0 = b.base_f90 = max(b.base_f0, min(lostBelow(here), vec3(1.0)));
        return;
    }
    b.base_f0 = lostBelow(dielectric);
    b.base_f90 = vec3(f90);
}

// Without a film; see addFilm().
Brdf makeBrdf(const Surface s, const vec3 v) {
    Brdf b;
    b.diffuse = (1.0 - s.metallic) * s.albedo * INVERSE_PI;
    b.through = vec3(0.0);
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        b.through = s.diffuse_transmission * (1.0 - s.metallic) * s.diffuse_transmission_color * INVERSE_PI;
        b.diffuse *= 1.0 - s.diffuse_transmission;
    }
    if (on(feature_transmission)) {
        b.diffuse *= 1.0 - s.transmission;
        b.through *= 1.0 - s.transmission;
    }
    b.f0 = specularF0(s);
    b.f90 = vec3(blend(s.dielectric_f90, 1.0, s.metallic));
    b.base_f0 = lostBelow(s.dielectric_f0);
    b.base_f90 = vec3(s.dielectric_f90);
    b.between = vec3(0.0);
    b.albedo = vec2(0.0);
    float roughness = max(s.roughness, MIN_PERCEPTUAL_ROUGHNESS);
    b.alpha = roughness * roughness;
    b.alpha2 = b.alpha * b.alpha;
    b.n_dot_v = max(dot(s.normal, v), MIN_N_DOT_V);
    b.smith_v = sqrt(b.n_dot_v * b.n_dot_v * (1.0 - b.alpha2) + b.alpha2);
    b.anisotropic = false;
    b.along = b.across = vec3(0.0);
    b.alphas = b.viewed = vec2(0.0);
    b.seen = b.alpha;
    b.film = Film(0.0, 1.0, 0.0, 0.0, 0.0);
    b.dielectric = b.metal = FilmBase(vec3(0.0), vec3(0.0), vec3(0.0));
    b.dielectric_f90 = b.metallic = 0.0;
    b.dielectric_gain = b.metal_gain = vec3(1.0);
    b.base_fixed = false;
    if (hasLayer(LAYER_ANISOTROPY)) stretch(b, s, v);
    return b;
}

// Denominator of GGX for a half vector `s` of any length: |s|^2 ((n.h)^2 (alpha^2 - 1) + 1). That form
// cancels near the highlight, so Lagrange's identity replaces 1 - (n.h)^2 by |n x h|^2. At roughness 0.1,
// the first form errs by over 1e-4 on 40 % of near-highlight samples, this one on none.
// D = (alpha |s|^2 / denominator)^2 / pi, 1/sr.
float ggxDenominator(const float alpha2, const vec3 n, const vec3 s) {
    vec3 n_cross_s = crossProduct(n, s);
    float n_dot_s = dot(n, s);
    float q = dot(n_cross_s, n_cross_s) + n_dot_s * n_dot_s * alpha2;
    return q;
}

// The same of an anisotropic lobe: |s|^2 alpha_t alpha_b ((t.h / alpha_t)^2 + (b.h / alpha_b)^2 + (n.h)^2).
float ggxDenominator(const Brdf b, const vec3 n, const vec3 s) {
    float along = dot(b.along, s), across = dot(b.across, s), up = dot(n, s);
    float q = along * along * (b.alphas.y / b.alphas.x) + across * across * (b.alphas.x / b.alphas.y) +
              up * up * b.alpha2;
    return q;
}

// n.v times Smith's root for the light, whose components are those of s = l + v less the view's.
float smithOfLight(const Brdf b, const vec3 s, const float n_dot_l) {
    vec2 wide = (vec2(dot(b.along, s), dot(b.across, s)) - b.viewed) * b.alphas;
    float root = sqrt(dot(wide, wide) + n_dot_l * n_dot_l);
    return b.n_dot_v * root;
}

// D G / (4 (n.l) (n.v)), 1/sr, in one division. GGX: Walter et al. 2007, "Microfacet Models for Refraction
// through Rough Surfaces". Height-correlated Smith masking and shadowing: Heitz 2014, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs"; 0.5 / (lambda_v + lambda_l). `s` is l + v.
// Down-facing microfacets are excluded: a normal map that turns away from the viewer would mirror lights
// behind the surface. If light and viewer are opposite, s is only rounding error and the result is 0.
float specularLobe(const Brdf b, const vec3 n, const vec3 s, const float s2, const float n_dot_l) {
    float q = ggxDenominator(b.alpha2, n, s);
    float light = b.n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - b.alpha2) + b.alpha2);
    if (hasLayer(LAYER_ANISOTROPY)) {
        float stretched = ggxDenominator(b, n, s), of_light = smithOfLight(b, s, n_dot_l);
        q = b.anisotropic ? stretched : q;
        light = b.anisotropic ? of_light : light;
    }
    float lambda = n_dot_l * b.smith_v + light;
    float a = b.alpha * s2;
    // At the smallest alpha, 0.002, q^2 lambda is above 1e-34 if s2 is above 1e-8.
    // The floor only avoids 0 / 0.
    float lobe = a * a * (0.5 * INVERSE_PI) / max(q * q * lambda, 1e-37);
    return dot(n, s) > 0.0 && s2 > 1e-12 ? lobe : 0.0;
}

// Fraction of light that reaches the base; `weight` is the weight of f90.
vec3 reachingBase(const Brdf b, const float weight) {
    vec3 fraction = vec3(1.0) - (b.base_f0 + (b.base_f90 - b.base_f0) * weight);
    return fraction;
}

// Fresnel term of the lobe, and fraction of light that reaches the base, at one half vector.
struct Layered {
    vec3 lobe, base;
};
Layered unfilmedAt(const Brdf b, const float v_dot_h) {
    float weight = schlickWeight(v_dot_h);
    return Layered(b.f0 + (b.f90 - b.f0) * weight, reachingBase(b, weight));
}
Layered layeredAt(const Brdf b, const float v_dot_h) {
    Layered plain = unfilmedAt(b, v_dot_h);
    if (!hasLayer(LAYER_IRIDESCENCE)) return plain;
    FilmRay ray = filmRay(b.film, v_dot_h);
    vec3 dielectric = filmedFresnel(b.film, b.dielectric, ray, b.dielectric_f90);
    vec3 metal = filmedFresnel(b.film, b.metal, ray, 1.0);
    bool filmed = b.film.weight > 0.0;
    vec3 lobe = blend(dielectric * b.dielectric_gain, metal * b.metal_gain, b.metallic);
    plain.lobe = filmed ? lobe : plain.lobe;
    plain.base = filmed && !b.base_fixed ? max(1.0 - lostBelow(dielectric), vec3(0.0)) : plain.base;
    return plain;
}

// Reflection of light from one direction.
struct Reflected {
    float n_dot_l;  // 0 to 1
    vec3 base;      // 1/sr
    vec3 lobe;      // 1/sr
};

// The specular lobe in 16-bit floats (optional in Vulkan), as in mobile renderers. Light and its sums stay
// in 32 bits. D is (alpha / (|n x h|^2 + (alpha n.h)^2))^2 / pi for a unit half vector, so that no small
// value is squared. D is clamped to the range of 16 bits, the visibility term where it would be infinite.
float halfLobe(const Brdf b, const f16vec3 n, const f16vec3 h, const float16_t n_dot_l) {
    f16vec3 n_cross_h = n.yzx * h.zxy - n.zxy * h.yzx;
    float16_t alpha = float16_t(b.alpha), alpha2 = float16_t(b.alpha2), n_dot_v = float16_t(b.n_dot_v);
    float16_t a = dot(n, h) * alpha;
    float16_t k = alpha / max(dot(n_cross_h, n_cross_h) + a * a, float16_t(6e-8));
    k = min(k, float16_t(450.0));  // 65504 pi is 453.6^2
    float16_t lambda = n_dot_l * float16_t(b.smith_v) +
                       n_dot_v * sqrt(n_dot_l * n_dot_l * (float16_t(1.0) - alpha2) + alpha2);
    float16_t visibility = float16_t(0.5) / max(lambda, float16_t(1e-5));
    // In this order: k^2 alone may exceed 65504.
    float lobe = float(k * float16_t(INVERSE_PI) * k) * float(visibility);
    return dot(n, h) > float16_t(0.0) ? lobe : 0.0;
}

Reflected reflectedInHalf(const Brdf b, const vec3 normal, const vec3 view_vector, const vec3 to_light) {
    f16vec3 n = f16vec3(normal), v = f16vec3(view_vector), l = f16vec3(to_light);
    float16_t n_dot_l = clamp(dot(n, l), float16_t(0.0), float16_t(1.0));
    f16vec3 s = l + v;
    f16vec3 h = s * inversesqrt(max(dot(s, s), float16_t(1e-6)));
    float16_t x = clamp(float16_t(1.0) - dot(v, h), float16_t(0.0), float16_t(1.0));
    float16_t x2 = x * x, weight = x2 * x2 * x;
    f16vec3 f0 = f16vec3(b.f0), fresnel = f0 + (f16vec3(b.f90) - f0) * weight;
    f16vec3 base_f0 = f16vec3(b.base_f0);
    f16vec3 base = f16vec3(1.0) - (base_f0 + (f16vec3(b.base_f90) - base_f0) * weight);
    return Reflected(float(n_dot_l), vec3(f16vec3(b.diffuse) * base),
                     vec3(fresnel) * halfLobe(b, n, h, n_dot_l));
}

// l: unit vector to the light.
Reflected reflectedLight(const Brdf b, const vec3 n, const vec3 v, const vec3 l) {
    float n_dot_l = clamp(dot(n, l), 0.0, 1.0);
    vec3 s = l + v;
    float s2 = dot(s, s);
    float v_dot_h = 0.5 * sqrt(s2);
    Layered at_h = layeredAt(b, v_dot_h);
    float lobe = specularLobe(b, n, s, s2, n_dot_l);
    return Reflected(n_dot_l, b.diffuse * at_h.base, at_h.lobe * lobe);
}

// Radiance towards the viewer, W/(sr m^2).
struct Lobes {
    vec3 diffuse, specular;
};

// The part of a light that leaves to the unit vector `v`.
Lobes lobesUnder(const Brdf b, const vec3 n, const vec3 v, const Incident light) {
    Reflected reflected;
    if (on(feature_half_shading) && !(b.anisotropic || b.film.weight > 0.0))
        reflected = reflectedInHalf(b, n, v, light.direction);
    else
        reflected = reflectedLight(b, n, v, light.direction);
    vec3 received = light.irradiance * reflected.n_dot_l;
    vec3 from_lobe = reflected.lobe * received;
    if (feature_multiscatter == MULTISCATTER_FDEZ) from_lobe += b.between * received;
    return Lobes(reflected.base * received, from_lobe);
}

#endif
