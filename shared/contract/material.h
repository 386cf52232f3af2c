// SPDX-License-Identifier: MIT
#ifndef DIPTYCH_CONTRACT_MATERIAL_H
#define DIPTYCH_CONTRACT_MATERIAL_H

#include "types.h"

// Texture slots of a material, at these bindings of SET_MATERIAL. FEATURE_<name>_texture says whether it
// has one, and how to read it: TEXEL_*.
// number  name  colours  reads  layer  factor  words
//   colours  srgb: red, green and blue are sRGB-encoded, alpha is linear; linear: all are
//   reads    the components that a shader reads; with specular_glossiness also the alpha of specular_color
//   layer    LAYER_* that reads the slot; BASE: every material does
//   factor   the CPU's Material member that multiplies these components; of metallic_roughness, green's
//   words    the slot's name in messages
// clang-format off
#define MATERIAL_SLOTS(X) \
    X(0,  base_color,            srgb,   rgba, BASE,         base_color,          "base colour")          \
    X(1,  metallic_roughness,    linear, gb,   BASE,         roughness,           "metallic-roughness")   \
    X(2,  normal,                linear, rgb,  BASE,         normal_scale,        "normal")               \
    X(3,  occlusion,             linear, r,    BASE,         occlusion_strength,  "occlusion")            \
    X(4,  emissive,              srgb,   rgb,  BASE,         emissive,            "emission")             \
    X(5,  specular,              linear, a,    BASE,         specular,            "specular")             \
    X(6,  specular_color,        srgb,   rgb,  BASE,         specular_color,      "specular colour")      \
    X(7,  lightmap,              srgb,   rgb,  BASE,         lightmap_intensity,  "lightmap")             \
    X(8,  clearcoat,             linear, r,    CLEARCOAT,    clearcoat,           "clear coat")           \
    X(9,  clearcoat_roughness,   linear, g,    CLEARCOAT,    clearcoat_roughness, "clear coat roughness") \
    X(10, clearcoat_normal,      linear, rgb,  CLEARCOAT,    clearcoat_normal_scale, "clear coat normal") \
    X(11, anisotropy,            linear, rgb,  ANISOTROPY,   anisotropy,          "anisotropy")           \
    X(12, sheen_color,           srgb,   rgb,  SHEEN,        sheen_color,         "sheen colour")         \
    /* often the alpha of the colour's image, and so is diffuse_transmission */                           \
    X(13, sheen_roughness,       srgb,   a,    SHEEN,        sheen_roughness,     "sheen roughness")      \
    X(14, iridescence,           linear, r,    IRIDESCENCE,  iridescence,         "iridescence")          \
    X(15, iridescence_thickness, linear, g,    IRIDESCENCE,  iridescence_thickness_max, "film thickness") \
    X(16, transmission,          linear, r,    TRANSMISSION, transmission,        "transmission")         \
    /* either transmission reads it, if the material has a volume: readsSlot() */                         \
    X(17, thickness,             linear, g,    BASE,         thickness,           "thickness")            \
    X(18, diffuse_transmission,  srgb,   a,    DIFFUSE_TRANSMISSION, diffuse_transmission,                \
          "diffuse transmission")                                                                         \
    X(19, diffuse_transmission_color, srgb, rgb, DIFFUSE_TRANSMISSION, diffuse_transmission_color,        \
          "colour of diffuse transmission")

// Layers, with the factor without which a material does not have it. FEATURE_layers is a sum of the layers of
// a draw's material, or of a scene's materials.
#define MATERIAL_LAYERS(X) \
    X(CLEARCOAT,            1,  clearcoat)            /* KHR_materials_clearcoat */            \
    X(ANISOTROPY,           2,  anisotropy)           /* KHR_materials_anisotropy */           \
    X(SHEEN,                4,  sheen_color)          /* KHR_materials_sheen */                \
    X(IRIDESCENCE,          8,  iridescence)          /* KHR_materials_iridescence */          \
    X(DIFFUSE_TRANSMISSION, 16, diffuse_transmission) /* KHR_materials_diffuse_transmission */ \
    /* KHR_materials_transmission, for a scene's materials alone: no draw has it as a layer */ \
    /* and the G-buffer does not store it, because its surfaces are drawn after either path */ \
    X(TRANSMISSION,         32, transmission)

// Factors that mean the same in the CPU's Material (shared/scene/model/scene.h) and in the shaders'. Others
// are members of either.
// type  name  default  least  most: their range (limits: animated.h)
#define MATERIAL_FACTORS(X) \
    X(vec4,  base_color,                  1,    0, 1)    /* linear Rec.709, alpha */            \
    X(float, metallic,                    1,    0, 1)                                           \
    X(float, roughness,                   1,    0, 1)    /* perceptual */                       \
    X(float, normal_scale,                1,    -maxFactor, maxFactor)                          \
    X(float, occlusion_strength,          1,    0, 1)                                           \
    X(float, alpha_cutoff,                0.5f, 0, maxFactor)                                   \
    X(float, lightmap_intensity,          1,    0, maxFactor)                                   \
    X(float, ior,                         1.5f, 0, maxFactor)  /* at least 1, or 0: infinite */ \
    X(float, specular,                    1,    0, 1)    /* the dielectric F90 */               \
    X(float, transmission,                0,    0, 1)                                           \
    X(float, thickness,                   0,    0, maxFactor)  /* m in the mesh's space; 0: thin wall */ \
    /* m; 0: infinite, nothing is absorbed */                                                   \
    X(float, attenuation_distance,        0,    minAttenuationDistance, maxFactor)              \
    X(vec3,  attenuation_color,           1,    0, 1)                                           \
    X(float, dispersion,                  0,    0, maxFactor)  /* 20 / Abbe number */           \
    X(float, diffuse_transmission,        0,    0, 1)    /* the layer's weight */               \
    X(vec3,  diffuse_transmission_color,  1,    0, 1)                                           \
    X(float, clearcoat,                   0,    0, 1)    /* the layer's weight */               \
    X(float, clearcoat_roughness,         0,    0, 1)    /* perceptual */                       \
    X(float, clearcoat_normal_scale,      1,    -maxFactor, maxFactor)                          \
    X(float, anisotropy,                  0,    0, 1)                                           \
    X(vec3,  sheen_color,                 0,    0, 1)                                           \
    X(float, sheen_roughness,             0,    0, 1)    /* perceptual */                       \
    X(float, iridescence,                 0,    0, 1)    /* weight of the thin film */          \
    X(float, iridescence_ior,             1.3f, 1, maxFactor)           /* of the film */       \
    X(float, iridescence_thickness_min, 100,  0, maxFilmThickness)    /* of the film, nm */   \
    X(float, iridescence_thickness_max,  400,  0, maxFilmThickness)
// clang-format on

CONTRACT_BEGIN

#define DIPTYCH_SLOT_NUMBER(number, name, colors, reads, layer, factor, words) \
    CONTRACT_CONST(uint, SLOT_##name, number);
MATERIAL_SLOTS(DIPTYCH_SLOT_NUMBER)
#undef DIPTYCH_SLOT_NUMBER
#define DIPTYCH_SLOT_ONE(number, name, colors, reads, layer, factor, words) +1
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

CONTRACT_CONST(uint, LAYER_BASE, 0);
#define DIPTYCH_LAYER(name, bit, factor) CONTRACT_CONST(uint, LAYER_##name, bit);
MATERIAL_LAYERS(DIPTYCH_LAYER)
#undef DIPTYCH_LAYER

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
#define DIPTYCH_FACTOR(type, name, initially, min, max) type name;
    MATERIAL_FACTORS(DIPTYCH_FACTOR)
#undef DIPTYCH_FACTOR
    vec3 emission;             // W/(sr m^2): emissiveFactor x emissiveStrength
    vec3 dielectric_f0;        // ((1 - ior) / (1 + ior))^2 x specularColorFactor, before specular and clamp
    vec2 anisotropy_rotation;  // cosine and sine of anisotropyRotation, from tangent to bitangent
    uint second_texcoord;      // bit SLOT_*: the slot reads the second UV set
    TextureTransform transforms[SLOT_COUNT];
    vec4 texels[SLOT_COUNT];  // of slots with TEXEL_CONSTANT, as the device decodes them
};

CONTRACT_END

#endif
