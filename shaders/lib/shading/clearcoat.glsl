// SPDX-License-Identifier: MIT
// KHR_materials_clearcoat: a dielectric layer of F0 = 0.04 above the material, with a normal and a roughness
// of its own. The layer reflects `weight` of the light and dims all below it, as the extension says:
// mix(material, lobe, clearcoat * fresnel(|n.v|)). The weight depends on the view alone.
#ifndef CLEARCOAT_GLSL
#define CLEARCOAT_GLSL

#include "shaders/lib/shading/ambient.glsl"

const float CLEARCOAT_F0 = 0.04;

// 0 without a coat.
float clearcoatWeight(const Surface s, const vec3 v) {
    float fresnel = CLEARCOAT_F0 + (1.0 - CLEARCOAT_F0) * schlickWeight(abs(dot(s.clearcoat_normal, v)));
    return s.clearcoat * fresnel;
}

// A lobe without a base. Where there is no coat it has the surface's normal and reflects nothing.
Reflector makeClearcoat(const Surface s, const vec3 v, const float weight) {
    Surface coat = s;
    coat.normal = s.clearcoat > 0.0 ? s.clearcoat_normal : s.normal;
    coat.roughness = s.clearcoat_roughness;
    coat.metallic = 1.0;
    coat.albedo = vec3(1.0);
    coat.anisotropy = coat.iridescence = 0.0;
    Brdf b = makeBrdf(coat, v);
    b.diffuse = vec3(0.0);
    b.f0 = b.f90 = vec3(weight);
    if (on(feature_multiscatter)) b.albedo = specularAlbedo(b.alpha, b.n_dot_v);
    return makeReflector(b, coat.normal, v);
}

// The material below layers that let the fraction `rest` pass.
void dim(inout Brdf b, const float rest) {
    b.diffuse *= rest;
    b.through *= rest;
    b.f0 *= rest;
    b.f90 *= rest;
    b.between *= rest;
    b.dielectric_gain *= rest;
    b.metal_gain *= rest;
}

#endif
