// SPDX-License-Identifier: MIT
// Specialization constants of all shaders. Their values are a pipeline's key. Features that a scene does
// not need are switched off here and cost nothing; on lavapipe a branch that is not taken costs as much as
// one that is.
#ifndef DIPTYCH_CONTRACT_FEATURES_H
#define DIPTYCH_CONTRACT_FEATURES_H

#include "types.h"

// id  name  set by  read by    meaning; 0 is off
//   set by   item: a draw's material or geometry; frame: the scene, the view and its lights;
//            amount: the frame; a parameter of another feature (0 does not switch it off);
//            gbuffer: the layout of the G-buffer; pass: the code that records the pass
//   read by  passes whose modules use the constant, a sum of PASS_*; a test compares it with the modules
// clang-format off
#define FEATURES(X)                                                                                         \
    /* TEXEL_* of material.h: source of each texture slot */                                                \
    X(0,  base_color_texture,         item,    PASSES_DRAW)                                                 \
    X(1,  metallic_roughness_texture, item,    PASSES_SURFACE)                                              \
    X(2,  normal_texture,             item,    PASSES_SURFACE)                                              \
    X(3,  occlusion_texture,          item,    PASSES_SURFACE)                                              \
    X(4,  emissive_texture,           item,    PASSES_SURFACE)                                              \
    X(5,  specular_texture,           item,    PASSES_SURFACE)                                              \
    X(6,  specular_color_texture,     item,    PASSES_SURFACE)                                              \
    X(7,  texture_transform,          item,    PASSES_DRAW)     /* a slot has KHR_texture_transform */      \
    X(8,  second_texcoord,            item,    PASSES_DRAW)     /* a slot reads the second UV set */        \
    X(9,  vertex_color,               item,    PASSES_DRAW)                                                 \
    X(10, alpha_mask,                 item,    PASSES_DRAW)                                                 \
    X(11, double_sided,               item,    PASSES_SURFACE)                                              \
    /* the scene emits light */                                                                             \
    X(12, emission,                   frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* KHR_materials_specular, _ior, _pbrSpecularGlossiness, _unlit in the scene */                         \
    X(13, dielectric_specular,        frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    X(14, directional_lights,         frame,   PASSES_SHADE)    /* the scene has some */                    \
    X(15, point_lights,               frame,   PASSES_SHADE)                                                \
    /* GBUFFER_* of gbuffer.h */                                                                            \
    X(16, gbuffer_encoding,           gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* emission beyond the packed format's range: float32 */                                                \
    X(17, gbuffer_wide_emission,      gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* more materials than the packed index can store */                                                    \
    X(18, gbuffer_wide_material_id,   gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* forward+ shades what the G-buffer would give back */                                                 \
    X(19, encoded_surface,            pass,    PASS_FORWARD)                                                \
    /* images of CAPTURES (debug_mode.h) that a capture pass draws, one bit each */                         \
    X(20, captures,                   pass,    PASSES_SHADE | PASS_SAMPLES)                                 \
    X(21, orthographic,             frame, PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS | PASS_BACKGROUND)   \
    /* KHR_materials_unlit: emits base colour, reflects nothing */                                          \
    X(22, unlit,                      item,    PASSES_SURFACE)                                              \
    X(23, spot_lights,                frame,   PASSES_SHADE | PASS_LISTS)                                   \
    /* a sum of AREA_* of area_light.h */                                                                   \
    X(24, area_lights,                frame,   PASSES_SHADE | PASS_LISTS)                                   \
    X(25, light_lists,                frame,   PASSES_SHADE | PASS_LISTS) /* LISTS_* of light_list.h */     \
    /* BATCH_* of light_list.h: a draw evaluates a range of each list */                                    \
    X(26, light_batch,                pass,    PASSES_SHADE)                                                \
    /* lights per list entry: 1 or 4 */                                                                     \
    X(27, list_width,                 amount,  PASSES_SHADE | PASS_LISTS)                                   \
    X(28, lightmap_texture,           item,    PASSES_SURFACE)                                              \
    X(29, ambient,                    frame,   PASSES_SHADE)    /* constant ambient radiance */             \
    /* OBJECT_LIGHTS_* of object_lights.h */                                                                \
    X(30, object_lights,              frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    X(31, vanishing_normals,          item,    PASSES_SURFACE)  /* an interpolated normal may be 0 */       \
    /* a material of the scene has a lightmap */                                                            \
    X(32, lightmap,                   frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* lightmap beyond the packed format's range: float32 */                                                \
    X(33, gbuffer_wide_lightmap,      gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* VIEW_*: source of the view in fragment shaders */                                                    \
    X(34, view_source,                amount,  PASSES_SURFACE | PASS_LIGHTING | PASS_BACKGROUND)            \
    /* draws channels, which may need more inputs than shading */                                           \
    X(35, captured,                   pass,    PASSES_SURFACE)                                              \
    /* the draw reads the depth that a pre-pass has stored */                                               \
    X(36, stored_depth,               pass,    PASS_FORWARD)                                                \
    /* SHADOWS_* of shadow.h; shadow bias needs the triangle's normal */                                    \
    X(37, shadows,                    frame,   PASSES_SURFACE | PASS_LIGHTING | PASS_SHADOWS)               \
    /* side of the filter, texels; odd */                                                                   \
    X(38, shadow_kernel,              amount,  PASSES_SHADE | PASS_SHADOWS)                                 \
    X(39, shadow_cascades,            amount,  PASSES_SHADE)                                                \
    /* a sum of LOCAL_SHADOWS_* of local_shadow.h; needs normals, as shadows do */                          \
    X(40, local_shadows,              frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* MULTISCATTER_* of multiscatter.h */                                                                  \
    X(41, multiscatter,               frame,   PASSES_SHADE)                                                \
    /* a sum of ENVIRONMENT_* of environment.h */                                                           \
    X(42, environment,                frame,   PASSES_SHADE | PASS_BACKGROUND)                              \
    /* specularAlbedo() of ambient.glsl uses a fit instead of its table */                                  \
    X(43, fitted_albedo,              frame,   PASSES_SHADE)                                                \
    /* a sum of HAZE_* of haze.h */                                                                         \
    X(44, haze,                       frame,   PASSES_SHADE | PASS_BACKGROUND)                              \
    /* tiles' lists include lights in front of opaque surfaces, for blended surfaces there */               \
    X(45, lights_in_front,            frame,   PASS_LISTS)                                                  \
    /* TRANSMISSION_* of material.h */                                                                      \
    X(46, transmission,               item,    PASSES_SHADE)                                                \
    /* VERTEX_POSING_* of posing.h: the vertex shader skins */                                              \
    X(47, vertex_posing,              item,    PASSES_DRAW)                                                 \
    /* joint sets of the instance that a compute shader deforms; a sum of POSED_* of posing.h */            \
    X(48, posed_joint_sets,           pass,    PASS_POSING)                                                 \
    X(49, posed_parts,                pass,    PASS_POSING)                                                 \
    /* samples per pixel with MSAA: 4 or 8 */                                                               \
    X(50, samples,     frame, PASSES_DRAW | PASS_LIGHTING | PASS_LISTS | PASS_SHADOWS | PASS_SAMPLES)       \
    /* EDGES_* of samples.h */                                                                              \
    X(51, sample_edges,               pass,    PASS_LIGHTING)                                               \
    /* the resolve weights a pixel's samples by a tone curve */                                             \
    X(52, tonemapped_resolve,         frame,   PASS_SAMPLES)                                                \
    /* SPECULAR_AA_* of material.h; a parameter of shaders/lib/surface/specular_aa.glsl, float32 bits */    \
    X(53, specular_aa,                frame,   PASSES_SURFACE)                                              \
    X(54, specular_aa_variance,       amount,  PASSES_SURFACE)                                              \
    /* DEPTH_* of view.h: storage format of the scene's depth */                                            \
    X(55, depth_format,               amount,  PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS | PASS_SHADOWS)  \
    /* point, spot and directional lighting in 16-bit floats */                                             \
    X(56, half_shading,               frame,   PASSES_SHADE)                                                \
    /* attenuate a dielectric's base per component, not by its layer's largest reflectance */               \
    X(57, base_by_component,          frame,   PASSES_SHADE)                                                \
    /* spot cones fade by smoothstep; the range window is squared */                                        \
    X(58, smooth_cones,               frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    X(59, squared_window,             frame,   PASSES_SURFACE | PASS_LIGHTING)                              \
    /* read lights and lists by address: they exceed the device's largest texel buffer */                   \
    X(60, addressed_lights,           frame,   PASSES_SURFACE | PASS_LIGHTING | PASS_LISTS)                 \
    X(61, clearcoat_texture,          item,    PASSES_SURFACE)                                              \
    X(62, clearcoat_roughness_texture, item,   PASSES_SURFACE)                                              \
    X(63, clearcoat_normal_texture,   item,    PASSES_SURFACE)                                              \
    X(64, anisotropy_texture,         item,    PASSES_SURFACE)                                              \
    /* a sum of LAYER_* of material.h: of the draw; in deferred lighting, of the scene or of its tiles */   \
    X(65, layers,                     item,    PASSES_SURFACE | PASS_LIGHTING)                              \
    /* a sum of LAYER_*: those that the G-buffer stores */                                                  \
    X(66, gbuffer_layers,             gbuffer, PASSES_SURFACE | PASS_LIGHTING)                              \
    /* KHR_materials_pbrSpecularGlossiness (material.h) */                                                  \
    X(67, specular_glossiness,        item,    PASSES_SURFACE)                                              \
    X(68, sheen_color_texture,        item,    PASSES_SURFACE)                                              \
    X(69, sheen_roughness_texture,    item,    PASSES_SURFACE)                                              \
    X(70, iridescence_texture,        item,    PASSES_SURFACE)                                              \
    X(71, iridescence_thickness_texture, item, PASSES_SURFACE)                                              \
    X(72, transmission_texture,       item,    PASS_FORWARD)    /* the G-buffer stores no transmission */   \
    X(73, thickness_texture,          item,    PASSES_SURFACE)                                              \
    X(74, diffuse_transmission_texture, item,  PASSES_SURFACE)                                              \
    X(75, diffuse_transmission_color_texture, item, PASSES_SURFACE)                                         \
    /* the draw or dispatch shades listed tiles of the image: lighting_tiles.h */                           \
    X(76, lighting_tiles,             pass,    PASS_LIGHTING)                                               \
    /* a sum of LAYER_* of material.h: maps whose tangents differ from the normal map's */                  \
    X(77, turned_maps,                item,    PASSES_SURFACE | PASS_DEPTH)                                 \
    /* diffuse transmission through a volume that absorbs */                                                \
    X(78, absorbing,                  item,    PASSES_SURFACE)
// clang-format on

CONTRACT_BEGIN
#define DIPTYCH_FEATURE_ID(id, name, source, passes) CONTRACT_CONST(uint, FEATURE_##name, id);
FEATURES(DIPTYCH_FEATURE_ID)
#undef DIPTYCH_FEATURE_ID
#define DIPTYCH_FEATURE_ONE(id, name, source, passes) +1
CONTRACT_CONST(uint, FEATURE_COUNT, 0 FEATURES(DIPTYCH_FEATURE_ONE));
#undef DIPTYCH_FEATURE_ONE

// Types of passes, by the modules that they use.
CONTRACT_CONST(uint, PASS_DEPTH, 1);           // depth.vert, surface.vert, depth_mask.frag
CONTRACT_CONST(uint, PASS_FORWARD, 2);         // surface.vert, forward_*.frag
CONTRACT_CONST(uint, PASS_GBUFFER, 4);         // surface.vert, gbuffer*.frag
CONTRACT_CONST(uint, PASS_LIGHTING, 8);        // deferred lighting and its captures: deferred_*
CONTRACT_CONST(uint, PASS_LISTS, 16);          // light_*.comp
CONTRACT_CONST(uint, PASS_SHADOWS, 32);        // shadow moments and depth bounds: shadow_*.comp
CONTRACT_CONST(uint, PASS_BACKGROUND, 64);     // background.frag
CONTRACT_CONST(uint, PASS_POSING, 128);        // pose.comp, pose_*.comp
CONTRACT_CONST(uint, PASS_SAMPLES, 256);       // sample_*.frag: resolve the samples of a pixel
CONTRACT_CONST(uint, PASSES_DRAW, 1 | 2 | 4);  // passes that draw the scene's triangles
CONTRACT_CONST(uint, PASSES_SURFACE, 2 | 4);   // passes that create a Surface from a material
CONTRACT_CONST(uint, PASSES_SHADE, 2 | 8);     // passes that evaluate lights

CONTRACT_CONST(uint, VIEW_UNIFORM, 0);  // uniform buffers View and LightGrid
CONTRACT_CONST(uint, VIEW_FLAT, 1);     // PACKED_VIEW as flat interpolants from the vertex shader
CONTRACT_CONST(uint, VIEW_TEXELS, 2);   // PACKED_VIEW in a texel buffer
CONTRACT_END

#endif
