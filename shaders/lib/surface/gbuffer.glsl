// SPDX-License-Identifier: MIT
// Encodes a Surface into the G-buffer and decodes it. shared/contract/gbuffer.h defines the layouts.
#ifndef GBUFFER_GLSL
#define GBUFFER_GLSL

#include "shaders/lib/surface/octahedral.glsl"
#include "shaders/lib/surface/packing.glsl"
#include "shaders/lib/surface/surface.glsl"

struct GBufferTexel {
    uvec4 attachments[GBUFFER_ATTACHMENTS];  // 0 if the layout lacks it
};

bool fullGBuffer() { return feature_gbuffer_encoding == GBUFFER_full; }
bool compactGBuffer() { return feature_gbuffer_encoding == GBUFFER_compact; }

// Both paths quantise the geometric normal equally, because shadow bias offsets along it.
vec3 quantiseGeometricNormal(vec3 n) {
    if (fullGBuffer() || !needsGeometricNormal()) return n;
    uint bits = compactGBuffer() ? COMPACT_GEOMETRIC_NORMAL_BITS : STANDARD_NORMAL_BITS;
    return decodeOctahedral(encodeOctahedral(n, bits), bits);
}

uvec4 encodeRadiance(vec3 radiance, bool wide) {
    return wide ? uvec4(floatBitsToUint(radiance), 0) : uvec4(packSharedExponent(radiance), 0, 0, 0);
}

vec3 decodeRadiance(uvec4 texel, bool wide) {
    return wide ? uintBitsToFloat(texel.xyz) : unpackSharedExponent(texel.x);
}

// A texel of 0 means no lightmap. A black lightmap has 1 in w (wide), or an exponent with mantissas of 0.
uvec4 encodeLightmap(Surface s, bool wide) {
    uvec4 texel = encodeRadiance(s.lightmap, wide);
    if (s.lightmapped && wide) texel.w = 1u;
    if (s.lightmapped && texel.x == 0u && !wide) texel.x = SHARED_EXPONENT_BLACK;
    return texel;
}

void decodeLightmap(uvec4 texel, bool wide, inout Surface s) {
    s.lightmap = decodeRadiance(texel, wide);
    s.lightmapped = (wide ? texel.w : texel.x) != 0u;
}

GBufferTexel encodeGBuffer(Surface s) {
    GBufferTexel t;
    for (uint i = 0; i < GBUFFER_ATTACHMENTS; ++i) t.attachments[i] = uvec4(0);
    if (fullGBuffer()) {
        t.attachments[GBUFFER_ALBEDO] = floatBitsToUint(vec4(s.albedo, s.occlusion));
        t.attachments[GBUFFER_NORMALS] = floatBitsToUint(vec4(s.normal, s.roughness));
        t.attachments[GBUFFER_PARAMS] = floatBitsToUint(vec4(s.geometric_normal, s.metallic));
        t.attachments[GBUFFER_EMISSION] = uvec4(floatBitsToUint(s.emission), s.material_id);
        t.attachments[GBUFFER_SPECULAR] = floatBitsToUint(vec4(s.dielectric_f0, s.dielectric_f90));
        t.attachments[GBUFFER_LIGHTMAP] = encodeLightmap(s, true);
        return t;
    }
    t.attachments[GBUFFER_ALBEDO].x = packSqrt(s.albedo, s.occlusion);
    if (compactGBuffer()) {
        t.attachments[GBUFFER_NORMALS].x = encodeOctahedral(s.normal, COMPACT_NORMAL_BITS) |
                                           (packUnorm(s.roughness, COMPACT_ROUGHNESS_BITS) << 24);
        t.attachments[GBUFFER_PARAMS].x =
            (packUnorm(s.metallic, COMPACT_METALLIC_BITS) << 16) | (s.material_id << 22);
        if (needsGeometricNormal())
            t.attachments[GBUFFER_PARAMS].x |=
                encodeOctahedral(s.geometric_normal, COMPACT_GEOMETRIC_NORMAL_BITS);
    } else {
        t.attachments[GBUFFER_NORMALS].x = encodeOctahedral(s.normal, STANDARD_NORMAL_BITS);
        if (needsGeometricNormal())
            t.attachments[GBUFFER_NORMALS].y = encodeOctahedral(s.geometric_normal, STANDARD_NORMAL_BITS);
        t.attachments[GBUFFER_PARAMS].x = packUnorm(s.roughness, STANDARD_ROUGHNESS_BITS) |
                                          (packUnorm(s.metallic, STANDARD_METALLIC_BITS) << 12) |
                                          (s.material_id << 20);
    }
    t.attachments[GBUFFER_EMISSION] = encodeRadiance(s.emission, on(feature_gbuffer_wide_emission));
    t.attachments[GBUFFER_LIGHTMAP] = encodeLightmap(s, on(feature_gbuffer_wide_lightmap));
    t.attachments[GBUFFER_SPECULAR].x = packSqrt(s.dielectric_f0, s.dielectric_f90);
    t.attachments[GBUFFER_IDS].x = s.material_id;
    return t;
}

// Decodes all fields except the position, which comes from depth, and those that only forward+ has.
Surface decodeGBuffer(GBufferTexel t, vec3 position) {
    Surface s;
    s.position = position;
    s.texcoord = vec2(0.0);
    s.tangent = s.tangent_normal = vec3(0.0);
    s.handedness = 0.0;
    s.emission = vec3(0.0);
    s.lightmap = vec3(0.0);
    s.lightmapped = false;
    s.object_irradiance = vec3(0.0);  // not stored
    s.transmission = 0.0;             // blended surfaces are not stored
    s.dielectric_f0 = vec3(DEFAULT_DIELECTRIC_F0);
    s.dielectric_f90 = 1.0;
    if (fullGBuffer()) {
        s.albedo = uintBitsToFloat(t.attachments[GBUFFER_ALBEDO].xyz);
        s.occlusion = uintBitsToFloat(t.attachments[GBUFFER_ALBEDO].w);
        s.normal = uintBitsToFloat(t.attachments[GBUFFER_NORMALS].xyz);
        s.roughness = uintBitsToFloat(t.attachments[GBUFFER_NORMALS].w);
        s.geometric_normal = uintBitsToFloat(t.attachments[GBUFFER_PARAMS].xyz);
        s.metallic = uintBitsToFloat(t.attachments[GBUFFER_PARAMS].w);
        s.emission = uintBitsToFloat(t.attachments[GBUFFER_EMISSION].xyz);
        s.material_id = t.attachments[GBUFFER_EMISSION].w;
        if (on(feature_dielectric_specular)) {
            s.dielectric_f0 = uintBitsToFloat(t.attachments[GBUFFER_SPECULAR].xyz);
            s.dielectric_f90 = uintBitsToFloat(t.attachments[GBUFFER_SPECULAR].w);
        }
        s.triangle_normal = s.geometric_normal;
        if (on(feature_lightmap)) decodeLightmap(t.attachments[GBUFFER_LIGHTMAP], true, s);
        return s;
    }
    uint albedo = t.attachments[GBUFFER_ALBEDO].x;
    uint normals = t.attachments[GBUFFER_NORMALS].x;
    uint params = t.attachments[GBUFFER_PARAMS].x;
    s.albedo = unpackSqrt(albedo);
    s.occlusion = unpackUnorm(albedo, 24, OCCLUSION_BITS);
    if (compactGBuffer()) {
        s.normal = decodeOctahedral(normals, COMPACT_NORMAL_BITS);
        s.roughness = unpackUnorm(normals, 24, COMPACT_ROUGHNESS_BITS);
        s.geometric_normal = decodeOctahedral(params, COMPACT_GEOMETRIC_NORMAL_BITS);
        s.metallic = unpackUnorm(params, 16, COMPACT_METALLIC_BITS);
        s.material_id = params >> 22;
    } else {
        s.normal = decodeOctahedral(normals, STANDARD_NORMAL_BITS);
        s.geometric_normal = decodeOctahedral(t.attachments[GBUFFER_NORMALS].y, STANDARD_NORMAL_BITS);
        s.roughness = unpackUnorm(params, 0, STANDARD_ROUGHNESS_BITS);
        s.metallic = unpackUnorm(params, 12, STANDARD_METALLIC_BITS);
        s.material_id = params >> 20;
    }
    s.triangle_normal = s.geometric_normal;
    if (on(feature_gbuffer_wide_material_id)) s.material_id = t.attachments[GBUFFER_IDS].x;
    if (on(feature_emission))
        s.emission = decodeRadiance(t.attachments[GBUFFER_EMISSION], on(feature_gbuffer_wide_emission));
    if (on(feature_lightmap))
        decodeLightmap(t.attachments[GBUFFER_LIGHTMAP], on(feature_gbuffer_wide_lightmap), s);
    if (on(feature_dielectric_specular)) {
        uint specular = t.attachments[GBUFFER_SPECULAR].x;
        s.dielectric_f0 = unpackSqrt(specular);
        s.dielectric_f90 = unpackUnorm(specular, 24, SPECULAR_BITS);
    }
    return s;
}

#endif
