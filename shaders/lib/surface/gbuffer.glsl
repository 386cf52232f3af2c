// SPDX-License-Identifier: MIT
// Encodes a Surface into the G-buffer and decodes it. shared/contract/gbuffer.h defines the layouts.
#ifndef GBUFFER_GLSL
#define GBUFFER_GLSL

#include "shaders/lib/math/angles.glsl"
#include "shaders/lib/samples/samples.glsl"
#include "shaders/lib/surface/octahedral.glsl"
#include "shaders/lib/surface/packing.glsl"
#include "shaders/lib/surface/surface.glsl"

struct GBufferTexel {
    uvec4 attachments[GBUFFER_ATTACHMENTS];  // 0 if the layout lacks it
};

bool fullGBuffer() { return feature_gbuffer_encoding == GBUFFER_full; }
bool compactGBuffer() { return feature_gbuffer_encoding == GBUFFER_compact; }

vec3 decodedNormal(const uint word) {
    return decodeOctahedral(word, compactGBuffer() ? COMPACT_NORMAL_BITS : STANDARD_NORMAL_BITS);
}

// Both paths quantise the geometric normal equally, because shadow bias offsets along it.
vec3 quantiseGeometricNormal(const vec3 n) {
    if (fullGBuffer() || !needsGeometricNormal()) return n;
    uint bits = compactGBuffer() ? COMPACT_GEOMETRIC_NORMAL_BITS : STANDARD_GEOMETRIC_NORMAL_BITS;
    return decodeOctahedral(encodeOctahedral(n, bits), bits);
}

uvec4 encodeRadiance(const vec3 radiance, const bool wide) {
    return wide ? uvec4(floatBitsToUint(radiance), 0) : uvec4(packSharedExponent(radiance), 0, 0, 0);
}

vec3 decodeRadiance(const uvec4 texel, const bool wide) {
    return wide ? uintBitsToFloat(texel.xyz) : unpackSharedExponent(texel.x);
}

// A texel of 0 means no lightmap. A black lightmap has 1 in w (wide), or an exponent with mantissas of 0.
uvec4 encodeLightmap(const Surface s, const bool wide) {
    uvec4 texel = encodeRadiance(s.lightmap, wide);
    if (s.lightmapped && wide) texel.w = 1u;
    if (s.lightmapped && texel.x == 0u && !wide) texel.x = SHARED_EXPONENT_BLACK;
    return texel;
}

void decodeLightmap(const uvec4 texel, const bool wide, inout Surface s) {
    s.lightmap = decodeRadiance(texel, wide);
    s.lightmapped = (wide ? texel.w : texel.x) != 0u;
}

bool storesLayer(const uint layer) { return (feature_gbuffer_layers & layer) != 0u; }
// Shaders that shade no layers do not read them: they are 0.
bool decodesLayers() { return on(feature_gbuffer_layers & feature_layers); }

// Words of all layers in LAYERS to LAYERS_5.
uint layerWords() {
    uint words = 0u;
#define ADD_WORDS(layer, packed, values) \
    if (storesLayer(LAYER_##layer)) words += fullGBuffer() ? layer##_FULL_WORDS : layer##_WORDS;
    STORED_LAYERS(ADD_WORDS)
    return words;
}
// Whether there is the attachment LAYERS + i.
bool hasLayerAttachment(const uint i) { return layerWords() > 4u * i; }
bool isOfLayers(const uint attachment) {
    return attachment >= GBUFFER_LAYERS && attachment < GBUFFER_SHADED;
}
// Whether the frame has an attachment.
bool hasAttachment(const uint attachment) {
    return attachment == GBUFFER_EMISSION   ? on(feature_emission) || fullGBuffer()
           : attachment == GBUFFER_SPECULAR ? on(feature_dielectric_specular)
           : attachment == GBUFFER_IDS      ? on(feature_gbuffer_wide_material_id)
           : attachment == GBUFFER_LIGHTMAP ? on(feature_lightmap)
           : attachment == GBUFFER_SHADED   ? multisampled()
           : isOfLayers(attachment)         ? hasLayerAttachment(attachment - GBUFFER_LAYERS)
                                            : true;
}
// Number of layer attachments that the first pass has room for; a second pass draws the others.
uint layersInFirstPass() {
    uint others = 0u;
#define COUNT_OTHER(number, name, kind, what) \
    if (!isOfLayers(number) && hasAttachment(number)) ++others;
    GBUFFER_BINDINGS(COUNT_OTHER)
    return MAX_COLOR_ATTACHMENTS - others;
}

const uint HAS_CLEARCOAT = 1u << CLEARCOAT_THERE_SHIFT, HAS_ANISOTROPY = 1u << ANISOTROPY_THERE_SHIFT;

// Two words: the normal, and the other values.
uvec2 encodeClearcoat(const Surface s) {
    if (!(s.clearcoat > 0.0)) return uvec2(0);
    return uvec2(encodeOctahedral(s.clearcoat_normal, CLEARCOAT_NORMAL_BITS),
                 packUnorm(s.clearcoat, CLEARCOAT_BITS) |
                     PACKED(s.clearcoat_roughness, CLEARCOAT_ROUGHNESS) | HAS_CLEARCOAT);
}

void decodeClearcoat(const uvec2 words, inout Surface s) {
    if ((words.y & HAS_CLEARCOAT) == 0u) return;
    s.clearcoat_normal = decodeOctahedral(words.x, CLEARCOAT_NORMAL_BITS);
    s.clearcoat = unpackUnorm(words.y, 0, CLEARCOAT_BITS);
    s.clearcoat_roughness = UNPACKED(words.y, CLEARCOAT_ROUGHNESS);
}

// `n`: the decoded normal, about which the direction will be turned.
uint encodeAnisotropy(const Surface s, const vec3 n) {
    if (!(s.anisotropy > 0.0)) return 0u;
    vec2 turn = turnOf(anisotropyDirection(s), n);
    float angle = angleOf(turn.y < 0.0 ? -turn.x : turn.x, abs(turn.y));
    float steps = float(1u << ANISOTROPY_ANGLE_BITS);
    uint code = uint(floor(angle * (INVERSE_PI * steps) + 0.5)) & ((1u << ANISOTROPY_ANGLE_BITS) - 1u);
    return packUnorm(s.anisotropy, ANISOTROPY_BITS) | (code << ANISOTROPY_ANGLE_SHIFT) | HAS_ANISOTROPY;
}

void decodeAnisotropy(const uint word, inout Surface s) {
    if ((word & HAS_ANISOTROPY) == 0u) return;
    uint code = bitfieldExtract(word, int(ANISOTROPY_ANGLE_SHIFT), int(ANISOTROPY_ANGLE_BITS));
    float angle = float(code) * (PI / float(1u << ANISOTROPY_ANGLE_BITS));
    s.anisotropy = unpackUnorm(word, 0, ANISOTROPY_BITS);
    s.anisotropy_turn = vec2(cos(angle), sin(angle));
}

// Fields of one word. A surface without a sheen has the word 0.
uint encodeSheen(const Surface s) {
    return packSqrt(s.sheen_color, SHEEN_COLOR_BITS) | PACKED(s.sheen_roughness, SHEEN_ROUGHNESS);
}

void decodeSheen(const uint word, inout Surface s) {
    s.sheen_color = unpackSqrt(word, SHEEN_COLOR_BITS);
    s.sheen_roughness = UNPACKED(word, SHEEN_ROUGHNESS);
}

const uint HALF_MANTISSA_BITS = IRIDESCENCE_THICKNESS_BITS - HALF_EXPONENT_BITS;
const uint HALF_CUT = 23u - HALF_MANTISSA_BITS;                    // bits of a float's mantissa that it lacks
const float HALF_STEPS = float(1u << (14u + HALF_MANTISSA_BITS));  // the smallest is 1 / HALF_STEPS

// The nearest half to x in [0, 65504], ties to even.
uint halfOf(const float x) {
    uint bits = floatBitsToUint(x);
    uint rounding = (1u << (HALF_CUT - 1u)) - 1u;
    uint normal = (bits - (112u << 23) + rounding + (bits >> HALF_CUT & 1u)) >> HALF_CUT;
    return x < 6.103515625e-5 ? uint(x * HALF_STEPS + 0.5) : normal;
}
float fromHalf(const uint code) {
    return code < 1u << HALF_MANTISSA_BITS ? float(code) * (1.0 / HALF_STEPS)
                                           : uintBitsToFloat((code << HALF_CUT) + (112u << 23));
}

const float IRIDESCENCE_IOR_STEPS = float((1u << IRIDESCENCE_IOR_BITS) - 2u);

// A surface without a film has the word 0.
uint encodeIridescence(const Surface s) {
    if (!(s.iridescence_ior > 0.0)) return 0u;
    float x = (s.iridescence_ior - 1.0) / (s.iridescence_ior + 1.0);
    uint ior = 1u + uint(clamp(x, 0.0, 1.0) * IRIDESCENCE_IOR_STEPS + 0.5);
    return packUnorm(s.iridescence, IRIDESCENCE_BITS) | (ior << IRIDESCENCE_IOR_SHIFT) |
           (halfOf(s.iridescence_thickness) << IRIDESCENCE_THICKNESS_SHIFT);
}

void decodeIridescence(const uint word, inout Surface s) {
    uint ior = bitfieldExtract(word, int(IRIDESCENCE_IOR_SHIFT), int(IRIDESCENCE_IOR_BITS));
    if (ior == 0u) return;
    float x = min(float(ior - 1u) / IRIDESCENCE_IOR_STEPS, 0.9999);
    s.iridescence = unpackUnorm(word, 0, IRIDESCENCE_BITS);
    s.iridescence_ior = (1.0 + x) / (1.0 - x);
    s.iridescence_thickness = fromHalf(word >> IRIDESCENCE_THICKNESS_SHIFT);
}

// Fields of one word. A surface without diffuse transmission has the word 0.
uint encodeDiffuseTransmission(const Surface s) {
    return packSqrt(s.diffuse_transmission_color, DIFFUSE_TRANSMISSION_COLOR_BITS) |
           PACKED(s.diffuse_transmission, DIFFUSE_TRANSMISSION);
}

void decodeDiffuseTransmission(const uint word, inout Surface s) {
    s.diffuse_transmission_color = unpackSqrt(word, DIFFUSE_TRANSMISSION_COLOR_BITS);
    s.diffuse_transmission = UNPACKED(word, DIFFUSE_TRANSMISSION);
}

// Layers as words; the last are unused.
struct LayerWords {
    uint words[LAYER_WORDS];
};

// Next words of `w`, from the word `at`.
#define STORE_float(x) w.words[at++] = floatBitsToUint(x);
#define STORE_vec2(v) STORE_float(v.x) STORE_float(v.y)
#define STORE_vec3(v) STORE_float(v.x) STORE_float(v.y) STORE_float(v.z)
#define LOAD_float(x) x = uintBitsToFloat(w.words[at++]);
#define LOAD_vec2(v) LOAD_float(v.x) LOAD_float(v.y)
#define LOAD_vec3(v) LOAD_float(v.x) LOAD_float(v.y) LOAD_float(v.z)

// `decoded_normal`: of the packed encodings.
LayerWords encodeLayers(const Surface s, const vec3 decoded_normal) {
    LayerWords w;
    for (uint i = 0; i < LAYER_WORDS; ++i) w.words[i] = 0u;
    uint at = 0u;
    if (fullGBuffer()) {
#define STORE(type, name) STORE_##type(s.name)
#define STORE_LAYER(layer, packed, values) \
        if (storesLayer(LAYER_##layer)) { values(STORE) }
        STORED_LAYERS(STORE_LAYER)
        return w;
    }
    if (storesLayer(LAYER_CLEARCOAT)) {
        uvec2 coat = encodeClearcoat(s);
        w.words[at++] = coat.x;
        w.words[at++] = coat.y;
    }
    if (storesLayer(LAYER_ANISOTROPY)) w.words[at++] = encodeAnisotropy(s, decoded_normal);
    if (storesLayer(LAYER_SHEEN)) w.words[at++] = encodeSheen(s);
    if (storesLayer(LAYER_IRIDESCENCE)) w.words[at++] = encodeIridescence(s);
    if (storesLayer(LAYER_DIFFUSE_TRANSMISSION)) w.words[at++] = encodeDiffuseTransmission(s);
    return w;
}

void decodeLayers(const LayerWords w, inout Surface s) {
    uint at = 0u;
    if (fullGBuffer()) {
#define LOAD(type, name) LOAD_##type(s.name)
#define LOAD_LAYER(layer, packed, values) \
        if (storesLayer(LAYER_##layer)) { values(LOAD) }
        STORED_LAYERS(LOAD_LAYER)
        return;
    }
    if (storesLayer(LAYER_CLEARCOAT)) {
        decodeClearcoat(uvec2(w.words[0], w.words[1]), s);
        at = CLEARCOAT_WORDS;
    }
    if (storesLayer(LAYER_ANISOTROPY)) decodeAnisotropy(w.words[at++], s);
    if (storesLayer(LAYER_SHEEN)) decodeSheen(w.words[at++], s);
    if (storesLayer(LAYER_IRIDESCENCE)) decodeIridescence(w.words[at++], s);
    if (storesLayer(LAYER_DIFFUSE_TRANSMISSION)) decodeDiffuseTransmission(w.words[at++], s);
}

void writeLayers(const LayerWords w, inout GBufferTexel t) {
    for (uint i = 0; i < LAYER_WORDS / 4; ++i)
        t.attachments[GBUFFER_LAYERS + i] =
            uvec4(w.words[4 * i], w.words[4 * i + 1], w.words[4 * i + 2], w.words[4 * i + 3]);
}
LayerWords layersIn(const GBufferTexel t) {
    LayerWords w;
    for (uint i = 0; i < LAYER_WORDS; ++i) w.words[i] = t.attachments[GBUFFER_LAYERS + i / 4][i % 4];
    return w;
}

GBufferTexel encodeGBuffer(const Surface s) {
    GBufferTexel t;
    for (uint i = 0; i < GBUFFER_ATTACHMENTS; ++i) t.attachments[i] = uvec4(0);
    if (fullGBuffer()) {
        t.attachments[GBUFFER_ALBEDO] = floatBitsToUint(vec4(s.albedo, s.occlusion));
        t.attachments[GBUFFER_NORMALS] = floatBitsToUint(vec4(s.normal, s.roughness));
        t.attachments[GBUFFER_PARAMS] = floatBitsToUint(vec4(s.geometric_normal, s.metallic));
        t.attachments[GBUFFER_EMISSION] = uvec4(floatBitsToUint(s.emission), s.material_id);
        t.attachments[GBUFFER_SPECULAR] = floatBitsToUint(vec4(s.dielectric_f0, s.dielectric_f90));
        t.attachments[GBUFFER_LIGHTMAP] = encodeLightmap(s, true);
        if (on(feature_gbuffer_layers)) writeLayers(encodeLayers(s, s.normal), t);
        return t;
    }
    t.attachments[GBUFFER_ALBEDO].x = packSqrt(s.albedo, ALBEDO_BITS) | PACKED(s.occlusion, OCCLUSION);
    if (compactGBuffer()) {
        t.attachments[GBUFFER_NORMALS].x =
            encodeOctahedral(s.normal, COMPACT_NORMAL_BITS) | PACKED(s.roughness, COMPACT_ROUGHNESS);
        t.attachments[GBUFFER_PARAMS].x =
            PACKED(s.metallic, COMPACT_METALLIC) | (s.material_id << COMPACT_ID_SHIFT);
        if (needsGeometricNormal())
            t.attachments[GBUFFER_PARAMS].x |=
                encodeOctahedral(s.geometric_normal, COMPACT_GEOMETRIC_NORMAL_BITS);
    } else {
        t.attachments[GBUFFER_NORMALS].x = encodeOctahedral(s.normal, STANDARD_NORMAL_BITS);
        if (needsGeometricNormal())
            t.attachments[GBUFFER_NORMALS].y =
                encodeOctahedral(s.geometric_normal, STANDARD_GEOMETRIC_NORMAL_BITS);
        t.attachments[GBUFFER_PARAMS].x = packUnorm(s.roughness, STANDARD_ROUGHNESS_BITS) |
                                          PACKED(s.metallic, STANDARD_METALLIC) |
                                          (s.material_id << STANDARD_ID_SHIFT);
    }
    t.attachments[GBUFFER_EMISSION] = encodeRadiance(s.emission, on(feature_gbuffer_wide_emission));
    t.attachments[GBUFFER_LIGHTMAP] = encodeLightmap(s, on(feature_gbuffer_wide_lightmap));
    t.attachments[GBUFFER_SPECULAR].x =
        packSqrt(s.dielectric_f0, SPECULAR_BITS) | PACKED(s.dielectric_f90, SPECULAR_F90);
    t.attachments[GBUFFER_IDS].x = s.material_id;
    if (on(feature_gbuffer_layers))
        writeLayers(encodeLayers(s, decodedNormal(t.attachments[GBUFFER_NORMALS].x)), t);
    return t;
}

void decodeFull(const GBufferTexel t, inout Surface s) {
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
    if (on(feature_lightmap)) decodeLightmap(t.attachments[GBUFFER_LIGHTMAP], true, s);
}

void decodePacked(const GBufferTexel t, inout Surface s) {
    uint albedo = t.attachments[GBUFFER_ALBEDO].x;
    uint normals = t.attachments[GBUFFER_NORMALS].x;
    uint params = t.attachments[GBUFFER_PARAMS].x;
    s.albedo = unpackSqrt(albedo, ALBEDO_BITS);
    s.occlusion = UNPACKED(albedo, OCCLUSION);
    s.normal = decodedNormal(normals);
    if (compactGBuffer()) {
        s.roughness = UNPACKED(normals, COMPACT_ROUGHNESS);
        s.geometric_normal = decodeOctahedral(params, COMPACT_GEOMETRIC_NORMAL_BITS);
        s.metallic = UNPACKED(params, COMPACT_METALLIC);
        s.material_id = params >> COMPACT_ID_SHIFT;
    } else {
        s.geometric_normal =
            decodeOctahedral(t.attachments[GBUFFER_NORMALS].y, STANDARD_GEOMETRIC_NORMAL_BITS);
        s.roughness = unpackUnorm(params, 0, STANDARD_ROUGHNESS_BITS);
        s.metallic = UNPACKED(params, STANDARD_METALLIC);
        s.material_id = params >> STANDARD_ID_SHIFT;
    }
    if (on(feature_gbuffer_wide_material_id)) s.material_id = t.attachments[GBUFFER_IDS].x;
    if (on(feature_emission))
        s.emission = decodeRadiance(t.attachments[GBUFFER_EMISSION], on(feature_gbuffer_wide_emission));
    if (on(feature_lightmap))
        decodeLightmap(t.attachments[GBUFFER_LIGHTMAP], on(feature_gbuffer_wide_lightmap), s);
    if (on(feature_dielectric_specular)) {
        uint specular = t.attachments[GBUFFER_SPECULAR].x;
        s.dielectric_f0 = unpackSqrt(specular, SPECULAR_BITS);
        s.dielectric_f90 = UNPACKED(specular, SPECULAR_F90);
    }
}

// Decodes all fields except the position, which comes from depth, and fields that only forward+ has.
Surface decodeGBuffer(const GBufferTexel t, const vec3 position) {
    Surface s = bareSurface(position);
    if (fullGBuffer())
        decodeFull(t, s);
    else
        decodePacked(t, s);
    s.triangle_normal = s.geometric_normal;
    if (decodesLayers()) decodeLayers(layersIn(t), s);
    return s;
}

#endif
