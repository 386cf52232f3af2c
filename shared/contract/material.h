// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_MATERIAL_H
#define DIPTYCH_CONTRACT_MATERIAL_H

#include "types.h"

// Texture slots of a material, at these bindings of SET_MATERIAL. FEATURE_<name>_texture says whether it
// has one, and how to read it: TEXEL_*.
// clang-format off
#define MATERIAL_SLOTS(X)            \
    X(0, base_color)                 \
    X(1, metallic_roughness)         \
    X(2, normal)                     \
    X(3, occlusion)                  \
    X(4, emissive)                   \
    X(5, specular)                   \
    X(6, specular_color)             \
    X(7, lightmap)                   \
    X(8, clearcoat)                  \
    X(9, clearcoat_roughness)        \
    X(10, clearcoat_normal)          \
    X(11, anisotropy)                \
    X(12, sheen_color)               \
    X(13, sheen_roughness)           \
    X(14, iridescence)               \
    X(15, iridescence_thickness)     \
    X(16, transmission)              \
    X(17, thickness)                 \
    X(18, diffuse_transmission)      \
    X(19, diffuse_transmission_color)
// clang-format on

CONTRACT_BEGIN

#define DIPTYCH_SLOT_NUMBER(number, name) CONTRACT_CONST(uint, SLOT_##name, number);
MATERIAL_SLOTS(DIPTYCH_SLOT_NUMBER)
#undef DIPTYCH_SLOT_NUMBER
#define DIPTYCH_SLOT_ONE(number, name) +1
CONTRACT_CONST(uint, SLOT_COUNT, 0 MATERIAL_SLOTS(DIPTYCH_SLOT_ONE));
#undef DIPTYCH_SLOT_ONE
CONTRACT_CONST(uint, BINDING_MATERIAL, SLOT_COUNT);  // of SET_MATERIAL: uniform Material, after the slots

// Values of FEATURE_<slot>_texture: source of its texel. Only TEXEL_OWN takes a sample of its own.
CONTRACT_CONST(uint, TEXEL_OWN, 1);       // sampled
CONTRACT_CONST(uint, TEXEL_CONSTANT, 2);  // Material::texels: the image has one colour
// Uses the sample of a slot that reads the same image in the same way: occlusion of metallic_roughness,
// emissive of base_color.
CONTRACT_CONST(uint, TEXEL_SHARED, 3);
// Roughness is the alpha of the normal map, metallic that of base_color (--textures packed).
CONTRACT_CONST(uint, TEXEL_ALPHAS, 4);

// Values of FEATURE_alpha_mask: discard fragments whose alpha is below the cutoff, or convert alpha,
// sharpened at the cutoff, to sample coverage.
CONTRACT_CONST(uint, MASK_CUTS, 1);
CONTRACT_CONST(uint, MASK_COVERS, 2);

// FEATURE_transmission: KHR_materials_transmission. The surface covers the fraction of what is behind that
// base colour's alpha gives, or all of it.
CONTRACT_CONST(uint, TRANSMISSION_COVERED, 1);
CONTRACT_CONST(uint, TRANSMISSION_WHOLE, 2);

// FEATURE_layers: a sum of the layers of a draw's material, or of a scene's materials.
CONTRACT_CONST(uint, LAYER_CLEARCOAT, 1);              // KHR_materials_clearcoat
CONTRACT_CONST(uint, LAYER_ANISOTROPY, 2);             // KHR_materials_anisotropy
CONTRACT_CONST(uint, LAYER_SHEEN, 4);                  // KHR_materials_sheen
CONTRACT_CONST(uint, LAYER_IRIDESCENCE, 8);            // KHR_materials_iridescence
CONTRACT_CONST(uint, LAYER_DIFFUSE_TRANSMISSION, 16);  // KHR_materials_diffuse_transmission
// KHR_materials_transmission, for a scene's materials alone: no draw has it as a layer and the G-buffer
// does not store it, because its surfaces are drawn after either path.
CONTRACT_CONST(uint, LAYER_TRANSMISSION, 32);

// FEATURE_specular_aa filters the screen-space change of the interpolated normal or of the normal-mapped
// one.
CONTRACT_CONST(uint, SPECULAR_AA_GEOMETRY, 1);
CONTRACT_CONST(uint, SPECULAR_AA_MAPPED, 2);
// Added to either: roughness grows by the change itself, not by its variance.
CONTRACT_CONST(uint, SPECULAR_AA_SLOPE, 4);

// KHR_texture_transform of one slot: uv' = (dot(u.xy, uv) + u.z, dot(v.xy, uv) + v.z).
struct TextureTransform {
    vec3 u;
    vec3 v;
};

// A lightmap times its intensity is irradiance / pi: the uniform ambient radiance of the same irradiance,
// W/(sr m^2). The base reflects it like ambient light. The specular lobe does not, since it would need
// directions.
//
// KHR_materials_unlit has an exact physical equivalent: a surface that reflects nothing and emits its base
// colour. So an unlit surface has factor x texture x COLOR_0 in the channel `emission` and 0 in `albedo`
// and `specular`, and lighting code has no case for it. Its normal, metallic (0), roughness (1) and
// occlusion (1) ignore textures. Alpha mode, cutoff and double-sidedness apply as usual.
//
// KHR_materials_pbrSpecularGlossiness: base_color is the diffuse colour; dielectric_f0 and the slot
// specular_color are F0, and that slot's alpha times 1 - roughness is glossiness. Metallic is 0, F90 1. As
// the extension defines, albedo is diffuse x (1 - largest component of F0) and roughness 1 - glossiness.
// The layer then takes light from the base by the Setting base_layer, as from every base, because the
// G-buffer has no bit for a rule of one material. The extension's rule is `component`; `max` makes
// component c of its diffuse light darker by the fraction (largest F0 - F0_c) / (1 - F0_c), the same for
// all directions: by 0 for grey F0, and by at most a quarter of `diffuse`.
struct Material {
    vec4 base_color;  // linear Rec.709, alpha
    vec3 emission;    // W/(sr m^2): emissiveFactor x emissiveStrength
    float metallic;
    vec3 dielectric_f0;  // ((1 - ior) / (1 + ior))^2 x specularColorFactor, before specular and clamp
    float roughness;     // perceptual; with specular_glossiness, 1 - glossinessFactor
    float specular;      // KHR_materials_specular: specularFactor, the dielectric F90
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    float lightmap_intensity;
    float ior;           // KHR_materials_ior; 0: infinite
    float transmission;  // KHR_materials_transmission: transmissionFactor
    float thickness;     // KHR_materials_volume: m in the mesh's space; 0: thin wall
    vec3 attenuation_color;
    float attenuation_distance;  // m; 0: infinite, nothing is absorbed
    float dispersion;            // KHR_materials_dispersion: 20 / Abbe number
    float diffuse_transmission;  // KHR_materials_diffuse_transmission: weight, 0 to 1
    vec3 diffuse_transmission_color;
    float clearcoat;            // KHR_materials_clearcoat: the layer's weight, 0 to 1
    float clearcoat_roughness;  // perceptual
    float clearcoat_normal_scale;
    float anisotropy;          // KHR_materials_anisotropy: anisotropyStrength, 0 to 1
    vec2 anisotropy_rotation;  // cosine and sine of anisotropyRotation, from tangent to bitangent
    vec3 sheen_color;          // KHR_materials_sheen
    float sheen_roughness;     // perceptual
    float iridescence;         // KHR_materials_iridescence: weight of the thin film, 0 to 1
    float iridescence_ior;     // of the film
    float iridescence_thickness_least, iridescence_thickness_most;  // of the film, nm
    uint second_texcoord;  // bit SLOT_*: the slot reads the second UV set
    TextureTransform transforms[SLOT_COUNT];
    vec4 texels[SLOT_COUNT];  // of slots with TEXEL_CONSTANT, as the device decodes them
};

CONTRACT_END

#endif
