// SPDX-License-Identifier: MIT
// Multiple scattering: light that leaves a rough surface after several reflections between its
// microfacets, which the lobe of brdf.glsl omits (feature_multiscatter). A dielectric's layer and a metal
// are each compensated by their own F0 and then mixed, because the factor is not linear in F0.
#ifndef MULTISCATTER_GLSL
#define MULTISCATTER_GLSL

#include "shaders/lib/shading/ambient.glsl"

// A material's specular lobe. It reflects the fraction f0 * albedo.x + f90 * albedo.y + PI * between of
// ambient light, where albedo is specularAlbedo().
struct SpecularFactors {
    vec3 f0, f90;  // may be above 1
    vec3 between;  // multiple scattering as a Lambertian lobe, 1/sr
};

// Factor by which MULTISCATTER_ENERGY scales the lobe.
vec3 specularGain(const vec3 f0, const vec2 albedo) {
    float all = albedo.x + albedo.y;
    return 1.0 + f0 * (max(1.0 - all, 0.0) / all);
}

// `f0`, `f90`: of one material; `albedo`: specularAlbedo() at its alpha and n.v.
//
// MULTISCATTER_ENERGY: Turquin 2019, "Practical multiple scattering compensation for microfacet models".
// Scales the lobe by 1 + F0 (1 - E) / E, where E is its albedo at F = 1.
// MULTISCATTER_FDEZ: Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based
// Lighting". 1 - E meets a second facet, which reflects the mean Fresnel reflectance F. E of that leaves,
// evenly, and 1 - E meets a third facet: (F0 x + F90 y) F (1 - E) / (1 - F (1 - E)). The cosine-weighted
// mean of Schlick's term is F0 + (F90 - F0) / 21.
SpecularFactors specularFactors(const vec3 f0, const float f90, const vec2 albedo) {
    float all = albedo.x + albedo.y, lost = max(1.0 - all, 0.0);
    SpecularFactors s = SpecularFactors(f0, vec3(f90), vec3(0.0));
    if (feature_multiscatter == MULTISCATTER_ENERGY) {
        vec3 gain = specularGain(f0, albedo);
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

// The same for a mix by `metallic` of a dielectric's layer (f0, f90) and a metal of colour `metal`.
SpecularFactors mixedFactors(const vec3 f0, const float f90, const vec3 metal, const float metallic,
                             const vec2 albedo) {
    SpecularFactors a = specularFactors(f0, f90, albedo), b = specularFactors(metal, 1.0, albedo);
    return SpecularFactors(blend(a.f0, b.f0, metallic), blend(a.f90, b.f90, metallic),
                           blend(a.between, b.between, metallic));
}

// Fraction of ambient light that a base loses to a dielectric's layer.
vec3 layerAlbedo(const vec3 f0, const float f90, const vec2 albedo) {
    SpecularFactors s = specularFactors(f0, f90, albedo);
    vec3 all = s.f0 * albedo.x + s.f90 * albedo.y + s.between * PI;
    return min(lostBelow(all), vec3(1.0));
}

void setSpecular(inout Brdf b, const SpecularFactors s) {
    b.f0 = s.f0;
    b.f90 = s.f90;
    b.between = s.between;
}

// The base receives the ambient light that the layer does not reflect, equally from every direction: the
// half vector's Fresnel term (appendix B) does not conserve energy. If the base loses each component, the
// half vector's Fresnel term stays, as in the renderers that do so.
void setBase(inout Brdf b, const vec3 layer) {
    b.base_f0 = layer;
    b.base_f90 = layer;
}

// `albedo`: specularAlbedo() of b.
Brdf compensated(Brdf b, const Surface s, const vec2 albedo) {
    b.albedo = albedo;
    if (feature_multiscatter == MULTISCATTER_ENERGY && hasLayer(LAYER_IRIDESCENCE)) {
        b.dielectric_gain = specularGain(s.dielectric_f0, albedo);
        b.metal_gain = specularGain(s.albedo, albedo);
    }
    b.base_fixed = !on(feature_base_by_component);
    setSpecular(b, mixedFactors(s.dielectric_f0, s.dielectric_f90, s.albedo, s.metallic, b.albedo));
    if (!on(feature_base_by_component)) setBase(b, layerAlbedo(s.dielectric_f0, s.dielectric_f90, b.albedo));
    return b;
}

#endif
