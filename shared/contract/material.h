// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_MATERIAL_H
#define DIPTYCH_CONTRACT_MATERIAL_H

#include "types.h"

// The texture slots of a material, at these bindings of SET_MATERIAL. FEATURE_<name>_texture says that it has
// one, and where its texel is found: TEXEL_*.
// clang-format off
#define MATERIAL_SLOTS(X)        \
    X(0, base_color)             \
    X(1, metallic_roughness)     \
    X(2, normal)                 \
    X(3, occlusion)              \
    X(4, emissive)               \
    X(5, specular)               \
    X(6, specular_color)         \
    X(7, lightmap)
// clang-format on

CONTRACT_BEGIN

#define DIPTYCH_SLOT_NUMBER(number, name) CONTRACT_CONST(uint, SLOT_##name, number);
MATERIAL_SLOTS(DIPTYCH_SLOT_NUMBER)
#undef DIPTYCH_SLOT_NUMBER
#define DIPTYCH_SLOT_ONE(number, name) +1
CONTRACT_CONST(uint, SLOT_COUNT, 0 MATERIAL_SLOTS(DIPTYCH_SLOT_ONE));
#undef DIPTYCH_SLOT_ONE
CONTRACT_CONST(uint, BINDING_MATERIAL, SLOT_COUNT);  // of SET_MATERIAL, after the slots: uniform Material

// Values of FEATURE_<slot>_texture: where its texel is found. All but the first take no sample of their own.
CONTRACT_CONST(uint, TEXEL_OWN, 1);       // sampled
CONTRACT_CONST(uint, TEXEL_CONSTANT, 2);  // Material::texels: the image has one colour
// Sampled for another slot, which reads the same image in the same way: of occlusion metallic_roughness, of
// emissive base_color.
CONTRACT_CONST(uint, TEXEL_SHARED, 3);
// Roughness is the alpha of the normal map, metallic that of base_color, where --textures packed put them.
CONTRACT_CONST(uint, TEXEL_ALPHAS, 4);

// Values of FEATURE_alpha_mask: a fragment is drawn where its alpha reaches the cutoff, or to as many of its
// samples as its alpha, sharpened at the cutoff, says.
CONTRACT_CONST(uint, MASK_CUTS, 1);
CONTRACT_CONST(uint, MASK_COVERS, 2);

// KHR_materials_transmission as a surface without thickness, which is blended: FEATURE_transmission. What of
// the base colour's alpha it covers, as of all that is blended, or all of what it is drawn on.
CONTRACT_CONST(uint, TRANSMISSION_COVERED, 1);
CONTRACT_CONST(uint, TRANSMISSION_WHOLE, 2);

// Whose changes from pixel to pixel FEATURE_specular_aa filters: the interpolated normal's, or those of the
// normal that a normal map has turned.
CONTRACT_CONST(uint, SPECULAR_AA_GEOMETRY, 1);
CONTRACT_CONST(uint, SPECULAR_AA_MAPPED, 2);
// Beside either: roughness grows by the change itself, not by its variance.
CONTRACT_CONST(uint, SPECULAR_AA_SLOPE, 4);

// KHR_texture_transform of one slot: uv' = (dot(u.xy, uv) + u.z, dot(v.xy, uv) + v.z).
struct TextureTransform {
    vec3 u;
    vec3 v;
};

// A lightmap holds, times its intensity, the irradiance that reaches the surface from all sides over pi: the
// radiance of light from everywhere that would bring as much, W/(sr m^2). The base reflects it as it does
// such light; the specular lobe, which would need its directions, does not.
//
// KHR_materials_unlit has an exact physical equivalent: a surface that reflects nothing and emits its base
// colour. So an unlit surface has that colour, factor x texture x COLOR_0, in the channel `emission` and 0 in
// `albedo` and `specular`, and no lighting code knows of it. Its normal, metallic (0), roughness (1) and
// occlusion (1) are never from textures. Alpha mode, cutoff and double-sidedness count as ever.
struct Material {
    vec4 base_color;  // linear Rec.709, alpha
    vec3 emission;    // W/(sr m^2): emissiveFactor x emissiveStrength
    float metallic;
    vec3 dielectric_f0;  // ((1 - ior) / (1 + ior))^2 x specularColorFactor, before specular and clamp
    float roughness;     // perceptual
    float specular;      // KHR_materials_specular's specularFactor, the dielectric F90
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    float lightmap_intensity;
    float transmission;    // KHR_materials_transmission's transmissionFactor
    uint second_texcoord;  // bit SLOT_*: that slot reads the second UV set
    TextureTransform transforms[SLOT_COUNT];
    vec4 texels[SLOT_COUNT];  // of slots with TEXEL_CONSTANT, as the device decodes them
};

CONTRACT_END

#endif
