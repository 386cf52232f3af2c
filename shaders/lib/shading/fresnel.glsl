// SPDX-License-Identifier: MIT
// Fresnel terms: Schlick's, and that of a thin film.
#ifndef FRESNEL_GLSL
#define FRESNEL_GLSL

#include "shaders/lib/contract.glsl"

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering": the weight of f90.
float schlickWeight(const float v_dot_h) {
    float x = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float x2 = x * x;
    return x2 * x2 * x;
}

// KHR_materials_iridescence: a thin film in air replaces the Fresnel terms of the material below it (Belcour
// and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", as
// the extension simplifies it: Schlick's terms, no polarisation, two orders of interference). The
// extension's guards 1e-4 and 1e-5 are omitted, so that a film without thickness is the material.

// One material below the film.
struct FilmBase {
    vec3 f0;        // of the material in air
    vec3 f0_below;  // of the film's lower face
    vec3 shifted;   // 1 where the lower face does not invert the wave, -1 where it does
};

struct Film {
    float weight;     // 0: none
    float index;      // of refraction
    float thickness;  // nm
    float f0;         // of the film's upper face
    float presence;   // 0 to 1: fades the film in up to 0.03 nm
};

// Terms of the film at one angle, which all materials below it share.
struct FilmRay {
    float above, below;  // weights of f90 at both faces
    vec3 once, twice;    // interference of light that crosses the film one and two times: CIE XYZ, unsigned
};

// Below 0.03 nm the film's index approaches air's, as the extension says, and its upper face fades with it:
// Schlick's term would reflect at grazing angles even where both sides are air.
Film makeFilm(const float weight, const float index, const float thickness) {
    float t = clamp(thickness / 0.03, 0.0, 1.0), presence = t * t * (3.0 - 2.0 * t);
    float n = blend(1.0, max(index, 1.0), presence), r = (n - 1.0) / (n + 1.0);
    return Film(weight, n, thickness, r * r, presence);
}

FilmBase makeFilmBase(const Film film, const vec3 f0) {
    vec3 root = sqrt(min(f0, vec3(0.9999))), index = (1.0 + root) / (1.0 - root);
    vec3 r = (index - film.index) / (index + film.index);
    // Indices within 1e-5 of each other count as equal, so that rounding does not decide.
    return FilmBase(f0, r * r, mix(vec3(-1.0), vec3(1.0), lessThan(index, vec3(film.index * 0.99999))));
}

// cos(2 pi x); GLSL's guarantees 11 bits. The series of sin(pi f) up to its eleventh power, 6e-8 off.
vec4 cosineOfTurns(const vec4 x) {
    vec4 y = (x - floor(x + 0.5)) * PI, y2 = y * y;
    vec4 p = 2.7557319e-6 - y2 * 2.5052108e-8;
    p = -1.9841270e-4 + y2 * p;
    p = 8.3333333e-3 + y2 * p;
    p = -0.16666667 + y2 * p;
    vec4 sine = y + y * (y2 * p);
    return 1.0 - 2.0 * sine * sine;
}

// Interference at an optical path difference in nm, CIE XYZ relative to its value at 0: the transform of
// the colour matching functions, as the extension's Gaussians.
vec3 filmSpectrum(const float path) {
    const vec4 turns = vec4(1.6810e-3, 2.2399e-3, 1.7953e-3, 2.2084e-3);  // per nm
    const vec4 falls = vec4(1.70854696e-7, 1.78766171e-7, 3.67330884e-7, 2.61035245e-7);  // per nm^2
    const vec4 sizes = vec4(0.846590002, 0.153868307, 1.00022189, 1.00112249);
    vec4 waves = sizes * cosineOfTurns(turns * path) * exp(-falls * min(path * path, 1e10));
    return vec3(waves.x + waves.y, waves.z, waves.w);
}

FilmRay filmRay(const Film film, const float v_dot_h) {
    float c = clamp(v_dot_h, 0.0, 1.0), s2 = (1.0 - c * c) / (film.index * film.index);
    float below = sqrt(max(1.0 - s2, 0.0)), path = 2.0 * film.index * film.thickness * below;
    return FilmRay(schlickWeight(c), schlickWeight(below), filmSpectrum(path), filmSpectrum(2.0 * path));
}

vec3 rec709FromXyz(const vec3 xyz) {
    return vec3(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
}

// Fraction of light that film and material reflect together, 0 or more.
vec3 filmFresnel(const Film film, const FilmBase base, const FilmRay ray) {
    float r12 = film.presence * (film.f0 + (1.0 - film.f0) * ray.above), through = 1.0 - r12;
    vec3 r23 = base.f0_below + (1.0 - base.f0_below) * ray.below;
    vec3 both = min(r12 * r23, vec3(0.9999)), root = sqrt(both);
    vec3 inside = through * through * r23 / (1.0 - both);
    vec3 order = (inside - through) * root;
    vec3 sum = r12 + inside + order * (2.0 * rec709FromXyz(base.shifted * ray.once)) +
               order * root * (2.0 * rec709FromXyz(ray.twice));
    return max(sum, vec3(0.0));
}

// Fresnel term of a material with `f90` and a film of film.weight.
vec3 filmedFresnel(const Film film, const FilmBase base, const FilmRay ray, const float f90) {
    vec3 plain = base.f0 + (vec3(f90) - base.f0) * ray.above;
    return blend(plain, filmFresnel(film, base, ray), film.weight);
}

#endif
