// SPDX-License-Identifier: MIT
// Every variant of every shader: one list of specialization constants. A pipeline's key is this list's
// values. What a scene does not need is switched off here and costs nothing (on lavapipe a branch that
// is not taken costs as much as one that is).
#ifndef DIPTYCH_CONTRACT_FEATURES_H
#define DIPTYCH_CONTRACT_FEATURES_H

#include "types.h"

// id  name  set by  read by    what it switches; 0 is off
//   set by   item: a draw's material or geometry; frame: the scene, the view and its lights;
//            amount: the frame, how much or which way of another feature (0 does not switch it off);
//            gbuffer: the layout of the G-buffer; pass: the code that records the pass
//   read by  the passes whose modules use the constant, a sum of PASS_*; a test holds it against the modules
// clang-format off
#define FEATURES(X)                                                                                         \
    /* TEXEL_* of material.h: material slots with a texture */                                              \
    X(0,  base_color_texture,         item,    PASSES_DRAW)                                                 \
    X(1,  metallic_roughness_texture, item,    PASSES_SURFACE)                                              \
    X(2,  normal_texture,             item,    PASSES_SURFACE)                                              \
    X(3,  occlusion_texture,          item,    PASSES_SURFACE)                                              \
    X(4,  emissive_texture,           item,    PASSES_SURFACE)                                              \
    X(5,  specular_texture,           item,    PASSES_SURFACE)                                              \
    X(6,  specular_color_texture,     item,    PASSES_SURFACE)                                              \
    X(7,  texture_transform,          item,    PASSES_DRAW)     /* some slot has KHR_texture_transform */   \
    X(8,  second_texcoord,            item,    PASSES_DRAW)     /* some slot reads the second UV set */     \
    X(9,  vertex_color,               item,    PASSES_DRAW)                                                 \
    X(10, alpha_mask,                 item,    PASSES_DRAW)                                                 \
    X(11, double_sided,               item,    PASSES_SURFACE)                                              \
    /* the scene emits light */                                                                             \
    X(12, emission,                   frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* KHR_materials_specular, _ior, _unlit in the scene */                                                 \
    X(13, dielectric_specular,        frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    X(14, directional_lights,         frame,   PASSES_SHADE)    /* the scene has some */                    \
    X(15, point_lights,               frame,   PASSES_SHADE)                                                \
    /* GBUFFER_* of gbuffer.h */                                                                            \
    X(16, gbuffer_encoding,           gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* emission beyond the packed format's range: float32 */                                                \
    X(17, gbuffer_wide_emission,      gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* more materials than the packed bits can name */                                                      \
    X(18, gbuffer_wide_material_id,   gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* forward+ shades what the G-buffer would give back */                                                 \
    X(19, encoded_surface,            pass,    PASSES_SHADE)                                                \
    /* of a capture pass: which images of CAPTURES (debug_mode.h) it draws, a bit each */                   \
    X(20, captures,                   pass,    PASSES_SHADE | PASS_SAMPLES)                                 \
    X(21, orthographic,               frame,   PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS | PASS_BACKGROUND) \
    /* KHR_materials_unlit: emits its base colour, reflects nothing */                                      \
    X(22, unlit,                      item,    PASSES_SURFACE)                                              \
    X(23, spot_lights,                frame,   PASSES_SHADE | PASS_LISTS)                                   \
    /* a sum of AREA_* of area_light.h */                                                                   \
    X(24, area_lights,                frame,   PASSES_SHADE | PASS_LISTS)                                   \
    X(25, light_lists,                frame,   PASSES_SHADE | PASS_LISTS) /* LISTS_* of light_list.h */     \
    /* BATCH_* of light_list.h: a draw walks a part of each list */                                         \
    X(26, light_batch,                pass,    PASSES_SHADE)                                                \
    /* lights of a packet: 1 or 4 */                                                                        \
    X(27, list_width,                 amount,  PASSES_SHADE | PASS_LISTS)                                   \
    X(28, lightmap_texture,           item,    PASSES_SURFACE)                                              \
    X(29, ambient,                    frame,   PASSES_SHADE)    /* constant ambient radiance */             \
    /* OBJECT_LIGHTS_* of object_lights.h */                                                                \
    X(30, object_lights,              frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    X(31, vanishing_normals,          item,    PASSES_SURFACE)  /* an interpolated normal may be zero */    \
    /* a material of the scene has one */                                                                   \
    X(32, lightmap,                   frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* beyond the packed format's range: float32 */                                                         \
    X(33, gbuffer_wide_lightmap,      gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* VIEW_*: where a fragment shader has the view from */                                                 \
    X(34, view_source,                amount,  PASSES_SURFACE | PASS_LIGHTING | PASS_BACKGROUND)            \
    /* for channels, which may need more than shading does */                                               \
    X(35, captured,                   pass,    PASSES_SURFACE)                                              \
    /* a depth pre-pass has stored the depth, which the draw reads */                                       \
    X(36, stored_depth,               pass,    PASS_FORWARD)                                                \
    /* SHADOWS_* of shadow.h; where a shadow begins depends on the triangle's normal */                     \
    X(37, shadows,                    frame,   PASSES_SURFACE | PASS_LIGHTING | PASS_SHADOWS)               \
    /* side of the filter, texels: odd */                                                                   \
    X(38, shadow_kernel,              amount,  PASSES_SHADE | PASS_SHADOWS)                                 \
    X(39, shadow_cascades,            amount,  PASSES_SHADE)                                                \
    /* a sum of LOCAL_SHADOWS_* of local_shadow.h; normals as for shadows */                                \
    X(40, local_shadows,              frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* MULTISCATTER_* of multiscatter.h */                                                                  \
    X(41, multiscatter,               frame,   PASSES_SHADE)                                                \
    /* a sum of ENVIRONMENT_* of environment.h */                                                           \
    X(42, environment,                frame,   PASSES_SHADE | PASS_BACKGROUND)                              \
    /* specularAlbedo() of ambient.glsl by a fit, not by its table */                                       \
    X(43, fitted_albedo,              frame,   PASSES_SHADE)                                                \
    /* a sum of HAZE_* of haze.h */                                                                         \
    X(44, haze,                       frame,   PASSES_SHADE | PASS_BACKGROUND)                              \
    /* tiles' lists hold the lights in front of the opaque surfaces too, for what is blended there */       \
    X(45, lights_in_front,            frame,   PASS_LISTS)                                                  \
    /* TRANSMISSION_* of material.h */                                                                      \
    X(46, transmission,               item,    PASSES_SHADE)                                                \
    /* VERTEX_POSING_* of posing.h: the vertex shader poses */                                              \
    X(47, vertex_posing,              item,    PASSES_DRAW)                                                 \
    /* of the instance that a kernel poses: how many sets of joints it has, a sum of POSED_* of posing.h */ \
    X(48, posed_joint_sets,           pass,    PASS_POSING)                                                 \
    X(49, posed_parts,                pass,    PASS_POSING)                                                 \
    /* of a pixel, where it has several: 4 or 8 */                                                          \
    X(50, samples,                    frame,   PASSES_DRAW | PASS_LIGHTING | PASS_LISTS | PASS_SHADOWS | PASS_SAMPLES)     \
    /* EDGES_* of samples.h */                                                                              \
    X(51, sample_edges,               pass,    PASS_LIGHTING)                                               \
    /* the mean of a pixel's samples is weighted by what a tone curve leaves of them */                     \
    X(52, tonemapped_resolve,         frame,   PASS_SAMPLES)                                                \
    /* SPECULAR_AA_* of material.h, and the two numbers of shaders/lib/specular_aa.glsl, bits of float32 */ \
    X(53, specular_aa,                frame,   PASSES_SURFACE)                                              \
    X(54, specular_aa_variance,       amount,  PASSES_SURFACE)                                              \
    X(55, specular_aa_limit,          amount,  PASSES_SURFACE)                                              \
    /* DEPTH_* of view.h: how the scene's depth is stored */                                                \
    X(56, depth_format,               amount,  PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS | PASS_SHADOWS)  \
    /* the light of points, spots and suns in floats of 16 bits */                                          \
    X(57, half_shading,               frame,   PASSES_SHADE)                                                \
    /* a dielectric's base loses each component of what its layer reflects, not the largest */              \
    X(58, base_by_component,          frame,   PASSES_SHADE)                                                \
    /* spots fade by smoothstep, ranges end by the window's square */                                       \
    X(59, smooth_cones,               frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    X(60, squared_window,             frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* lights and lists are read by their addresses: more than a texel buffer of the device holds */        \
    X(61, addressed_lights,           frame,   PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS)
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_FEATURE_ID(id, name, source, passes) CONTRACT_CONST(uint, FEATURE_##name, id);
FEATURES(DIPTYCH_FEATURE_ID)
#undef DIPTYCH_FEATURE_ID
#define DIPTYCH_FEATURE_ONE(id, name, source, passes) +1
CONTRACT_CONST(uint, FEATURE_COUNT, 0 FEATURES(DIPTYCH_FEATURE_ONE));
#undef DIPTYCH_FEATURE_ONE

// Kinds of passes, by the modules that they are made of.
CONTRACT_CONST(uint, PASS_DEPTH, 1);           // depth.vert, surface.vert, depth_mask.frag
CONTRACT_CONST(uint, PASS_FORWARD, 2);         // surface.vert, forward_*.frag
CONTRACT_CONST(uint, PASS_GBUFFER, 4);         // surface.vert, gbuffer.frag
CONTRACT_CONST(uint, PASS_LIGHTING, 8);        // deferred lighting and its captures: deferred_*
CONTRACT_CONST(uint, PASS_LISTS, 16);          // light_*.comp
CONTRACT_CONST(uint, PASS_SHADOWS, 32);        // moments of shadow maps: shadow_*.comp
CONTRACT_CONST(uint, PASS_BACKGROUND, 64);     // background.frag
CONTRACT_CONST(uint, PASS_POSING, 128);        // pose.comp, pose_*.comp
CONTRACT_CONST(uint, PASS_SAMPLES, 256);       // sample_*.frag: of a pixel to its radiance
CONTRACT_CONST(uint, PASSES_DRAW, 1 | 2 | 4);  // those that draw the scene's triangles
CONTRACT_CONST(uint, PASSES_SURFACE, 2 | 4);   // those that make a Surface from a material
CONTRACT_CONST(uint, PASSES_SHADE, 2 | 8);     // those that evaluate lights

CONTRACT_CONST(uint, VIEW_UNIFORM, 0);  // the uniform buffers View and LightGrid
CONTRACT_CONST(uint, VIEW_FLAT, 1);     // PACKED_VIEW as flat inputs, passed through by the vertex shader
CONTRACT_CONST(uint, VIEW_TEXELS, 2);   // PACKED_VIEW as texels
CONTRACT_END

#endif
