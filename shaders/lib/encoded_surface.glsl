// SPDX-License-Identifier: MIT
// The surfaces of shared/contract/encoded_surface.h: a surface moved by what the G-buffer's bits allow, never
// encoded.
#ifndef ENCODED_SURFACE_GLSL
#define ENCODED_SURFACE_GLSL

#include "shaders/lib/brdf.glsl"
#include "shaders/lib/draw.glsl"
#include "shaders/lib/encoding_bits.glsl"
#include "shaders/lib/multiscatter.glsl"

bool compactBits() { return feature_gbuffer_encoding == GBUFFER_compact; }
float metallicBound(float x) {
    return unormBound(x, compactBits() ? COMPACT_METALLIC_BITS : STANDARD_METALLIC_BITS);
}
float roughnessBound(float x) {
    return unormBound(x, compactBits() ? COMPACT_ROUGHNESS_BITS : STANDARD_ROUGHNESS_BITS);
}
float normalBound() { return octahedralAngle(compactBits() ? COMPACT_NORMAL_BITS : STANDARD_NORMAL_BITS); }

// Floats of 16 bits round to 2^-11 of a number. A picture's normal is turned by one rounding of its parts,
// and its products with a direction are off by three more, those of their terms and two sums, which a turn by
// as much explains. Three pictures of 16 bits are in what the moved surfaces bound: deferred's, that of
// forward+, and the latter again, from which the first moved surface is held apart.
const float HALF_TURN = 3.0 * 4.0 / 2048.0;

// A unit vector perpendicular to n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
vec3 perpendicular(vec3 n) {
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    return vec3(1.0 - n.x * n.x / (1.0 + abs(n.z)), -n.x * n.y / (1.0 + abs(n.z)), -n.x * side);
}

// s moved as SURFACE_RAISED or one after it says, with SURFACE_OF_HALF or without, but for what raisedBrdf()
// raises.
Surface movedSurface(Surface s, uint moved) {
    uint surface = moved & ~SURFACE_OF_HALF;
    float turn = normalBound() + (surface != moved ? HALF_TURN : 0.0);
    s.occlusion += unormBound(s.occlusion, OCCLUSION_BITS);
    s.emission += radianceBound(s.emission, on(feature_gbuffer_wide_emission));
    s.lightmap += radianceBound(s.lightmap, on(feature_gbuffer_wide_lightmap));
    if (surface >= SURFACE_NORMAL && surface < SURFACE_ROUGHNESS) {
        // The corners of a square whose sides touch the cone: over a straight or convex part of the light it
        // is at them that the most is found.
        vec3 t = perpendicular(s.normal), b = crossProduct(s.normal, t);
        uint corner = surface - SURFACE_NORMAL;
        vec3 side = (corner & 2u) == 0u ? t : b;
        float reach = ((corner & 1u) == 0u ? 1.0 : -1.0) * sqrt(2.0) * turn;
        s.normal = normalized(s.normal + side * reach);
    }
    if (surface >= SURFACE_ROUGHNESS) {
        float bound = roughnessBound(s.roughness);
        s.roughness += surface == SURFACE_ROUGHNESS ? -bound : bound;
    }
    return s;
}

// The largest factors of light that the encoding may make of the surface `s` that has the factors `b`; what
// the layer over a dielectric's base reflects is the least.
Brdf raisedBrdf(Brdf b, Surface s) {
    vec3 albedo = s.albedo + rootBound(s.albedo, ALBEDO_BITS), f0 = s.dielectric_f0;
    vec3 least_f0 = f0;
    float f90 = s.dielectric_f90, least_f90 = f90, moved = metallicBound(s.metallic);
    float less = s.metallic - moved, more = s.metallic + moved;
    if (on(feature_dielectric_specular)) {
        vec3 bound = rootBound(s.dielectric_f0, SPECULAR_BITS);
        float bound90 = unormBound(s.dielectric_f90, SPECULAR_BITS);
        b.base_f0 = max(b.base_f0 - lostBelow(bound), vec3(0.0));
        b.base_f90 = max(b.base_f90 - bound90, vec3(0.0));
        least_f0 = max(f0 - bound, vec3(0.0));
        least_f90 = max(f90 - bound90, 0.0);
        f0 += bound;
        f90 += bound90;
    }
    b.diffuse = (1.0 - less) * albedo * INVERSE_PI;
    SpecularFactors low = mixedFactors(f0, f90, albedo, less, b.albedo),
                    high = mixedFactors(f0, f90, albedo, more, b.albedo);
    setSpecular(b, SpecularFactors(max(low.f0, high.f0), max(low.f90, high.f90),
                                   max(low.between, high.between)));
    if (on(feature_multiscatter) && !on(feature_base_by_component))
        setBase(b, layerAlbedo(least_f0, least_f90, b.albedo));
    return b;
}

// What the lights of a draw meet at a pixel: of shaded surfaces of SURFACE_RAISED on, the raised factors.
Brdf shadedBrdf(Surface s, vec3 v) {
    Brdf b = makeBrdf(s, v);
    if (on(feature_multiscatter)) b = compensated(b, s, specularAlbedo(b.alpha, b.n_dot_v));
    if (on(feature_encoded_surface) && constants.surface != SURFACE_DECODED) b = raisedBrdf(b, s);
    return b;
}

#endif
