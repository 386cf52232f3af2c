// SPDX-License-Identifier: MIT
// Light that leaves a rough surface after more than one reflection between its microfacets, which the
// specular lobe of brdf.glsl leaves out, by feature_multiscatter. A dielectric's layer and a metal are
// compensated each by its own F0, and then mixed: the factor is no linear function of F0, and that of a mixed
// F0 is another.
#ifndef MULTISCATTER_GLSL
#define MULTISCATTER_GLSL

#include "shaders/lib/ambient.glsl"

// What a material's specular lobe sends to the viewer: of light from everywhere, `albedo` being
// specularAlbedo(), f0 * albedo.x + f90 * albedo.y + PI * between.
struct SpecularFactors {
    vec3 f0, f90;  // may be above 1
    vec3 between;  // a Lambertian lobe beside it, 1/sr
};

// `f0`, `f90`: one material's; `albedo`: specularAlbedo() of its alpha and of n.v.
//
// MULTISCATTER_ENERGY, Turquin 2019, "Practical multiple scattering compensation for microfacet models": the
// lobe times 1 + F0 (1 - E) / E, E being what it reflects where F = 1.
// MULTISCATTER_FDEZ, Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based
// Lighting": of the 1 - E that meets a second facet the mean Fresnel reflectance F is reflected, of which E
// leaves, evenly, and 1 - E meets a third: (F0 x + F90 y) F (1 - E) / (1 - F (1 - E)). The mean of Schlick's
// over the cosine-weighted hemisphere is F0 + (F90 - F0) / 21.
SpecularFactors specularFactors(vec3 f0, float f90, vec2 albedo) {
    float all = albedo.x + albedo.y, lost = max(1.0 - all, 0.0);
    SpecularFactors s = SpecularFactors(f0, vec3(f90), vec3(0.0));
    if (feature_multiscatter == MULTISCATTER_ENERGY) {
        vec3 gain = 1.0 + f0 * (lost / all);
        s.f0 = f0 * gain;
        s.f90 = f90 * gain;
    }
    if (feature_multiscatter == MULTISCATTER_FDEZ) {
        vec3 mean = f0 + (vec3(f90) - f0) * (1.0 / 21.0);
        vec3 again = mean * lost;
        s.between = (f0 * albedo.x + vec3(f90 * albedo.y)) * again * INVERSE_PI / (1.0 - again);
    }
    return s;
}

// The same of a mix by `metallic` of a dielectric's layer of f0 and f90 and of a metal of the colour `metal`.
SpecularFactors mixedFactors(vec3 f0, float f90, vec3 metal, float metallic, vec2 albedo) {
    SpecularFactors a = specularFactors(f0, f90, albedo), b = specularFactors(metal, 1.0, albedo);
    return SpecularFactors(blend(a.f0, b.f0, metallic), blend(a.f90, b.f90, metallic),
                           blend(a.between, b.between, metallic));
}

// Of light from everywhere what a base loses to a dielectric's layer.
vec3 layerAlbedo(vec3 f0, float f90, vec2 albedo) {
    SpecularFactors s = specularFactors(f0, f90, albedo);
    vec3 all = s.f0 * albedo.x + s.f90 * albedo.y + s.between * PI;
    return min(lostBelow(all), vec3(1.0));
}

void setSpecular(inout Brdf b, SpecularFactors s) {
    b.f0 = s.f0;
    b.f90 = s.f90;
    b.between = s.between;
}

// The base under a layer gets what the layer does not reflect of light from everywhere, from every direction
// alike: the weight by F of the half vector (appendix B) does not conserve energy. Where the base loses each
// component, F of the half vector stays, as in the renderers that have it so.
void setBase(inout Brdf b, vec3 layer) {
    b.base_f0 = layer;
    b.base_f90 = layer;
}

// `albedo`: specularAlbedo() of b.
Brdf compensated(Brdf b, Surface s, vec2 albedo) {
    b.albedo = albedo;
    setSpecular(b, mixedFactors(s.dielectric_f0, s.dielectric_f90, s.albedo, s.metallic, b.albedo));
    if (!on(feature_base_by_component)) setBase(b, layerAlbedo(s.dielectric_f0, s.dielectric_f90, b.albedo));
    return b;
}

#endif
