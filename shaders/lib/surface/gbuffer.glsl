// SPDX-License-Identifier: MIT
// Encodes a Surface into the G-buffer and decodes it. shared/contract/gbuffer.h defines the layouts.
#ifndef GBUFFER_GLSL
#define GBUFFER_GLSL

#include "shaders/lib/math/angles.glsl"
#include "shaders/lib/surface/octahedral.glsl"
#include "shaders/lib/surface/packing.glsl"
#include "shaders/lib/surface/surface.glsl"

struct GBufferTexel {
    uvec4 attachments[GBUFFER_ATTACHMENTS];  // 0 if the layout lacks it
};

bool fullGBuffer() { return feature_gbuffer_encoding == GBUFFER_full; }
bool compactGBuffer() { return feature_gbuffer_encoding == GBUFFER_compact; }

vec3 decodedNormal(uint word) {
    return decodeOctahedral(word, compactGBuffer() ? COMPACT_NORMAL_BITS : STANDARD_NORMAL_BITS);
}

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

bool storesLayer(uint layer) { return (feature_gbuffer_layers & layer) != 0u; }

// Whether there is an attachment LAYERS.
bool storesLayers() {
    return fullGBuffer() ? storesLayer(LAYER_CLEARCOAT) : on(feature_gbuffer_layers);
}

const uint LAYER_IS_THERE = 1u << 28;

// Two words: the normal, and the other values.
uvec2 encodeClearcoat(Surface s) {
    if (!(s.clearcoat > 0.0)) return uvec2(0);
    return uvec2(encodeOctahedral(s.clearcoat_normal, CLEARCOAT_NORMAL_BITS),
                 packUnorm(s.clearcoat, CLEARCOAT_BITS) |
                     (packUnorm(s.clearcoat_roughness, CLEARCOAT_ROUGHNESS_BITS) << CLEARCOAT_BITS) |
                     LAYER_IS_THERE);
}

void decodeClearcoat(uvec2 words, inout Surface s) {
    if ((words.y & LAYER_IS_THERE) == 0u) return;
    s.clearcoat_normal = decodeOctahedral(words.x, CLEARCOAT_NORMAL_BITS);
    s.clearcoat = unpackUnorm(words.y, 0, CLEARCOAT_BITS);
    s.clearcoat_roughness = unpackUnorm(words.y, CLEARCOAT_BITS, CLEARCOAT_ROUGHNESS_BITS);
}

// `n`: the decoded normal, about which the direction will be turned.
uint encodeAnisotropy(Surface s, vec3 n) {
    if (!(s.anisotropy > 0.0)) return 0u;
    vec2 turn = turnOf(anisotropyDirection(s), n);
    float angle = angleOf(turn.y < 0.0 ? -turn.x : turn.x, abs(turn.y));
    float steps = float(1u << ANISOTROPY_ANGLE_BITS);
    uint code = uint(floor(angle * (INVERSE_PI * steps) + 0.5)) & ((1u << ANISOTROPY_ANGLE_BITS) - 1u);
    return packUnorm(s.anisotropy, ANISOTROPY_BITS) | (code << ANISOTROPY_BITS) | LAYER_IS_THERE;
}

void decodeAnisotropy(uint word, inout Surface s) {
    if ((word & LAYER_IS_THERE) == 0u) return;
    uint code = bitfieldExtract(word, int(ANISOTROPY_BITS), int(ANISOTROPY_ANGLE_BITS));
    float angle = float(code) * (PI / float(1u << ANISOTROPY_ANGLE_BITS));
    s.anisotropy = unpackUnorm(word, 0, ANISOTROPY_BITS);
    s.anisotropy_turn = vec2(cos(angle), sin(angle));
}

uvec4 encodeLayers(Surface s, vec3 decoded_normal) {
    uvec2 coat = uvec2(0);
    uint anisotropy = 0u;
    if (storesLayer(LAYER_CLEARCOAT)) coat = encodeClearcoat(s);
    if (storesLayer(LAYER_ANISOTROPY)) anisotropy = encodeAnisotropy(s, decoded_normal);
    return storesLayer(LAYER_CLEARCOAT) ? uvec4(coat, anisotropy, 0) : uvec4(anisotropy, 0, 0, 0);
}

void decodeLayers(uvec4 texel, inout Surface s) {
    if (storesLayer(LAYER_CLEARCOAT)) decodeClearcoat(texel.xy, s);
    if (storesLayer(LAYER_ANISOTROPY)) decodeAnisotropy(storesLayer(LAYER_CLEARCOAT) ? texel.z : texel.x, s);
}

void decodeFullLayers(GBufferTexel t, inout Surface s) {
    vec4 further = uintBitsToFloat(t.attachments[GBUFFER_LAYERS_2]);
    if (storesLayer(LAYER_CLEARCOAT)) {
        vec4 coat = uintBitsToFloat(t.attachments[GBUFFER_LAYERS]);
        s.clearcoat_normal = coat.xyz;
        s.clearcoat = coat.w;
        s.clearcoat_roughness = further.x;
    }
    if (storesLayer(LAYER_ANISOTROPY)) {
        s.anisotropy = further.y;
        s.anisotropy_turn = further.zw;
    }
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
        t.attachments[GBUFFER_LAYERS] = floatBitsToUint(vec4(s.clearcoat_normal, s.clearcoat));
        t.attachments[GBUFFER_LAYERS_2] =
            floatBitsToUint(vec4(s.clearcoat_roughness, s.anisotropy, s.anisotropy_turn));
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
    if (on(feature_gbuffer_layers))
        t.attachments[GBUFFER_LAYERS] = encodeLayers(s, decodedNormal(t.attachments[GBUFFER_NORMALS].x));
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
    removeLayers(s);
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
        if (on(feature_gbuffer_layers)) decodeFullLayers(t, s);
        return s;
    }
    uint albedo = t.attachments[GBUFFER_ALBEDO].x;
    uint normals = t.attachments[GBUFFER_NORMALS].x;
    uint params = t.attachments[GBUFFER_PARAMS].x;
    s.albedo = unpackSqrt(albedo);
    s.occlusion = unpackUnorm(albedo, 24, OCCLUSION_BITS);
    s.normal = decodedNormal(normals);
    if (compactGBuffer()) {
        s.roughness = unpackUnorm(normals, 24, COMPACT_ROUGHNESS_BITS);
        s.geometric_normal = decodeOctahedral(params, COMPACT_GEOMETRIC_NORMAL_BITS);
        s.metallic = unpackUnorm(params, 16, COMPACT_METALLIC_BITS);
        s.material_id = params >> 22;
    } else {
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
    if (on(feature_gbuffer_layers)) decodeLayers(t.attachments[GBUFFER_LAYERS], s);
    return s;
}

#endif
