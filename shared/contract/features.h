// SPDX-License-Identifier: MIT
// Every variant of every shader: one list of specialization constants. A pipeline's key is this list's
// values. What a scene does not need is switched off here and costs nothing (on lavapipe a branch that
// is not taken costs as much as one that is).
#ifndef DIPTYCH_CONTRACT_FEATURES_H
#define DIPTYCH_CONTRACT_FEATURES_H

#include "types.h"

// id  name  set by  inputs  read by    what it switches; 0 is off
//   set by   item: a draw's material or geometry; frame: the scene, the view and its lights;
//            amount: the frame, how much or which way of another feature (0 does not switch it off);
//            gbuffer: the layout of the G-buffer; pass: the code that records the pass
//   inputs   the least set of shaders/lib/inputs.glsl that has what a surface with the feature reads
//   read by  the passes whose modules use the constant, a sum of PASS_*; a test holds it against the modules
// clang-format off
#define FEATURES(X)                                                                                         \
    /* TEXEL_* of material.h: material slots with a texture */                                              \
    X(0,  base_color_texture,         item,    1, PASSES_DRAW)                                              \
    X(1,  metallic_roughness_texture, item,    1, PASSES_SURFACE)                                           \
    X(2,  normal_texture,             item,    2, PASSES_SURFACE)                                           \
    X(3,  occlusion_texture,          item,    1, PASSES_SURFACE)                                           \
    X(4,  emissive_texture,           item,    1, PASSES_SURFACE)                                           \
    X(5,  specular_texture,           item,    1, PASSES_SURFACE)                                           \
    X(6,  specular_color_texture,     item,    1, PASSES_SURFACE)                                           \
    X(7,  texture_transform,          item,    3, PASSES_DRAW)     /* some slot has KHR_texture_transform */ \
    X(8,  second_texcoord,            item,    3, PASSES_DRAW)     /* some slot reads the second UV set */  \
    X(9,  vertex_color,               item,    3, PASSES_DRAW)                                              \
    X(10, alpha_mask,                 item,    0, PASSES_DRAW)                                              \
    X(11, double_sided,               item,    0, PASSES_SURFACE)                                           \
    /* the scene emits light */                                                                             \
    X(12, emission,                   frame,   0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* KHR_materials_specular, _ior, _unlit in the scene */                                                 \
    X(13, dielectric_specular,        frame,   0, PASSES_SURFACE | PASS_LIGHTING)                           \
    X(14, directional_lights,         frame,   0, PASSES_SHADE)    /* the scene has some */                 \
    X(15, point_lights,               frame,   0, PASSES_SHADE)                                             \
    /* GBUFFER_* of gbuffer.h */                                                                            \
    X(16, gbuffer_encoding,           gbuffer, 0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* emission beyond the packed format's range: float32 */                                                \
    X(17, gbuffer_wide_emission,      gbuffer, 0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* more materials than the packed bits can name */                                                      \
    X(18, gbuffer_wide_material_id,   gbuffer, 0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* shade DrawConstants::surface of encoded_surface.h */                                                 \
    X(19, encoded_surface,            pass,    0, PASSES_SHADE)                                             \
    /* DEBUG_* of each attachment of a capture pass */                                                      \
    X(20, capture_0,                  pass,    0, PASSES_SHADE)                                             \
    X(21, capture_1,                  pass,    0, PASSES_SHADE)                                             \
    X(22, capture_2,                  pass,    0, PASSES_SHADE)                                             \
    X(23, capture_3,                  pass,    0, PASSES_SHADE)                                             \
    X(24, capture_4,                  pass,    0, PASSES_SHADE)                                             \
    X(25, capture_5,                  pass,    0, PASSES_SHADE)                                             \
    X(26, capture_6,                  pass,    0, PASSES_SHADE)                                             \
    X(27, capture_7,                  pass,    0, PASSES_SHADE)                                             \
    X(28, orthographic,               frame,   0, PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS | PASS_BACKGROUND) \
    /* KHR_materials_unlit: emits its base colour, reflects nothing */                                      \
    X(29, unlit,                      item,    0, PASSES_SURFACE)                                           \
    X(30, spot_lights,                frame,   0, PASSES_SHADE | PASS_LISTS)                                \
    /* a sum of AREA_* of area_light.h */                                                                   \
    X(31, area_lights,                frame,   0, PASSES_SHADE | PASS_LISTS)                                \
    X(32, light_lists,                frame,   0, PASSES_SHADE | PASS_LISTS) /* LISTS_* of light_list.h */  \
    /* BATCH_* of light_list.h: a draw walks a part of each list */                                         \
    X(33, light_batch,                pass,    0, PASSES_SHADE)                                             \
    /* lights of a packet: 1 or 4 */                                                                        \
    X(34, list_width,                 amount,  0, PASSES_SHADE | PASS_LISTS)                                \
    X(35, lightmap_texture,           item,    1, PASSES_SURFACE)                                           \
    X(36, ambient,                    frame,   0, PASSES_SHADE)    /* constant ambient radiance */          \
    /* OBJECT_LIGHTS_* of object_lights.h; those of vertices need inputs 3 */                               \
    X(37, object_lights,              frame,   0, PASSES_SURFACE | PASS_LIGHTING)                           \
    X(38, vanishing_normals,          item,    2, PASSES_SURFACE)  /* an interpolated normal may be zero */ \
    /* a material of the scene has one */                                                                   \
    X(39, lightmap,                   frame,   0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* beyond the packed format's range: float32 */                                                         \
    X(40, gbuffer_wide_lightmap,      gbuffer, 0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* VIEW_*: where a fragment shader has the view from */                                                 \
    X(41, view_source,                amount,  0, PASSES_SURFACE | PASS_LIGHTING | PASS_BACKGROUND)         \
    /* for channels, which may need more than shading does */                                               \
    X(42, captured,                   pass,    3, PASSES_SURFACE)                                           \
    /* a depth pre-pass has stored the depth, which the draw reads */                                       \
    X(43, stored_depth,               pass,    0, PASS_FORWARD)                                             \
    /* SHADOWS_* of shadow.h; where a shadow begins depends on the triangle's normal */                     \
    X(44, shadows,                    frame,   2, PASSES_SURFACE | PASS_LIGHTING | PASS_SHADOWS)            \
    /* side of the filter, texels: odd */                                                                   \
    X(45, shadow_kernel,              amount,  0, PASSES_SHADE | PASS_SHADOWS)                              \
    X(46, shadow_cascades,            amount,  0, PASSES_SHADE)                                             \
    /* a sum of LOCAL_SHADOWS_* of local_shadow.h; normals as for shadows */                                \
    X(47, local_shadows,              frame,   2, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* MULTISCATTER_* of multiscatter.h */                                                                  \
    X(48, multiscatter,               frame,   0, PASSES_SHADE)                                             \
    /* a sum of ENVIRONMENT_* of environment.h */                                                           \
    X(49, environment,                frame,   0, PASSES_SHADE | PASS_BACKGROUND)                           \
    /* specularAlbedo() of ambient.glsl by a fit, not by its table */                                       \
    X(50, fitted_albedo,              frame,   0, PASSES_SHADE)                                             \
    /* a sum of HAZE_* of haze.h */                                                                         \
    X(51, haze,                       frame,   0, PASSES_SHADE | PASS_BACKGROUND)                           \
    /* tiles' lists hold the lights in front of the opaque surfaces too, for what is blended there */       \
    X(52, lights_in_front,            frame,   0, PASS_LISTS)                                               \
    /* TRANSMISSION_* of material.h */                                                                      \
    X(53, transmission,               item,    0, PASSES_SHADE)                                             \
    /* the vertex shader poses: posing.h */                                                                 \
    X(54, vertex_posing,              item,    0, PASSES_DRAW)                                              \
    /* of the instance that a kernel poses: how many sets of joints it has, a sum of POSED_* of posing.h */ \
    X(55, posed_joint_sets,           pass,    0, PASS_POSING)                                              \
    X(56, posed_parts,                pass,    0, PASS_POSING)                                              \
    /* of a pixel, where it has several: 4 or 8 */                                                          \
    X(57, samples,                    frame,   0, PASSES_DRAW | PASS_LIGHTING | PASS_LISTS | PASS_SAMPLES)  \
    /* EDGES_* of samples.h */                                                                              \
    X(58, sample_edges,               pass,    0, PASS_LIGHTING)                                            \
    /* the mean of a pixel's samples is weighted by what a tone curve leaves of them */                     \
    X(59, tonemapped_resolve,         frame,   0, PASS_SAMPLES)                                             \
    /* SPECULAR_AA_* of material.h, and the two numbers of shaders/lib/specular_aa.glsl, bits of float32 */  \
    X(60, specular_aa,                frame,   0, PASSES_SURFACE)                                           \
    X(61, specular_aa_variance,       amount,  0, PASSES_SURFACE)                                           \
    X(62, specular_aa_limit,          amount,  0, PASSES_SURFACE)                                           \
    /* DEPTH_* of view.h: how the scene's depth is stored */                                                \
    X(63, depth_format,               amount,  0, PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS | PASS_SHADOWS) \
    /* the light of points, spots and suns in floats of 16 bits */                                          \
    X(64, half_shading,               frame,   0, PASSES_SHADE)                                             \
    /* a dielectric's base loses each component of what its layer reflects, not the largest */              \
    X(65, base_by_component,          frame,   0, PASSES_SHADE)                                             \
    /* spots fade by smoothstep, ranges end by the window's square */                                       \
    X(66, smooth_cones,               frame,   0, PASSES_SURFACE | PASS_LIGHTING)                           \
    X(67, squared_window,             frame,   0, PASSES_SURFACE | PASS_LIGHTING)                           \
    /* lights and lists are read by their addresses: more than a texel buffer of the device holds */        \
    X(68, addressed_lights,           frame,   0, PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS)
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_FEATURE_ID(id, name, source, inputs, passes) CONTRACT_CONST(uint, FEATURE_##name, id);
FEATURES(DIPTYCH_FEATURE_ID)
#undef DIPTYCH_FEATURE_ID
#define DIPTYCH_FEATURE_ONE(id, name, source, inputs, passes) +1
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

// Attachments of one capture pass: the fewest that every Vulkan device has.
CONTRACT_CONST(uint, CAPTURE_ATTACHMENTS, 8);
CONTRACT_END

#endif
