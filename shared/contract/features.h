// SPDX-License-Identifier: MIT
// Every variant of every shader: one list of specialization constants. A pipeline's key is this list's
// values. What a scene does not need is switched off here and costs nothing (on lavapipe a branch that
// is not taken costs as much as one that is).
#ifndef DIPTYCH_CONTRACT_FEATURES_H
#define DIPTYCH_CONTRACT_FEATURES_H

#include "types.h"

// id  name  what it switches; 0 is off
// clang-format off
#define FEATURES(X)                                                                                   \
    X(0,  base_color_texture)         /* material slots with a texture */                             \
    X(1,  metallic_roughness_texture)                                                                 \
    X(2,  normal_texture)                                                                             \
    X(3,  occlusion_texture)                                                                          \
    X(4,  emissive_texture)                                                                           \
    X(5,  specular_texture)                                                                           \
    X(6,  specular_color_texture)                                                                     \
    X(7,  texture_transform)          /* some slot has KHR_texture_transform */                       \
    X(8,  second_texcoord)            /* some slot reads the second UV set */                         \
    X(9,  vertex_color)                                                                               \
    X(10, alpha_mask)                                                                                 \
    X(11, double_sided)                                                                               \
    X(12, emission)                   /* the scene emits light */                                     \
    X(13, dielectric_specular)        /* KHR_materials_specular, _ior, _unlit in the scene */     \
    X(14, directional_lights)         /* the scene has some */                                        \
    X(15, point_lights)                                                                               \
    X(16, gbuffer_encoding)           /* GBUFFER_* of gbuffer.h */                                    \
    X(17, gbuffer_wide_emission)      /* emission beyond the packed format's range: float32 */        \
    X(18, gbuffer_wide_material_id)   /* more materials than the packed bits can name */              \
    X(19, quantise_surface)           /* forward: shade what the G-buffer would have given back */    \
    X(20, capture_0)                  /* DEBUG_* of each attachment of a capture pass */              \
    X(21, capture_1)                                                                                  \
    X(22, capture_2)                                                                                  \
    X(23, capture_3)                                                                                  \
    X(24, capture_4)                                                                                  \
    X(25, capture_5)                                                                                  \
    X(26, capture_6)                                                                                  \
    X(27, capture_7)                                                                                  \
    X(28, orthographic)                                                                               \
    X(29, unlit)                      /* KHR_materials_unlit: emits its base colour, reflects nothing */ \
    X(30, spot_lights)                                                                                \
    X(31, area_lights)                /* a sum of AREA_* of area_light.h */                           \
    X(32, light_lists)                /* LISTS_* of light_list.h */                                   \
    X(33, light_chunk)                /* CHUNK_* of light_list.h: a draw walks a part of each list */  \
    X(34, list_width)                 /* lights that one turn of a list's loop takes: 1 or 4 */       \
    X(35, lightmap_texture)                                                                           \
    X(36, ambient)                    /* constant ambient radiance */                                 \
    X(37, object_lights)              /* OBJECT_LIGHTS_* of object_lights.h */                        \
    X(38, vanishing_normals)          /* an interpolated normal may be zero */                        \
    X(39, lightmap)                   /* a material of the scene has one */                           \
    X(40, gbuffer_wide_lightmap)      /* beyond the packed format's range: float32 */                 \
    X(41, view_source)                /* VIEW_*: where a fragment shader has the view from */             \
    X(42, captured)                   /* for channels, which may ask for more than shading does */
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_FEATURE_ID(id, name) CONTRACT_CONST(uint, FEATURE_##name, id);
FEATURES(DIPTYCH_FEATURE_ID)
#undef DIPTYCH_FEATURE_ID
CONTRACT_CONST(uint, FEATURE_COUNT, 43);

CONTRACT_CONST(uint, VIEW_UNIFORM, 0);  // the uniform buffers View and LightGrid
CONTRACT_CONST(uint, VIEW_FLAT, 1);     // flat inputs, handed on by the vertex shader: texels of PackedView
CONTRACT_CONST(uint, VIEW_TEXELS, 2);   // texels of PackedView

// Attachments of one capture pass: the fewest that every Vulkan device has.
CONTRACT_CONST(uint, CAPTURE_ATTACHMENTS, 8);
CONTRACT_END

#endif
