// SPDX-License-Identifier: MIT
// Rows of setting_rows.h about light: environment, lights and shadows.
#pragma once

#include "shared/frame/row_conditions.h"

namespace diptych::row {

template <class Visit>
void lightRows(Visit& visit) {
    visit(Field{.option = "env",
                .help = "lat-long environment, .exr or .hdr; scene: the one in the scene's file, an error if "
                        "it has none; none: the one in the scene's file, if any",
                .off = "none",
                .valid = {"is empty; name a file, or use none",
                          [](const Settings& s) { return !s.env.empty(); }},
                .for_surfaces = "none"},
          &Settings::env);
    visit(Field{.option = "env-rotation",
                .help = "rotation of the environment about +Y, degrees, counter-clockwise seen from above",
                .valid = {"must be finite", [](const Settings& s) { return std::isfinite(s.env_rotation); }},
                .default_only = {needs_env, hasEnv},
                .for_surfaces = "0"},
          &Settings::env_rotation);
    visit(Field{.option = "env-sun",
                .help = "extract the environment's sun as a directional light that casts shadows",
                .off = "off",
                .default_only = {needs_env, hasEnv},
                .for_surfaces = "off"},
          &Settings::env_sun);
    visit(Field{.option = "ibl-intensity",
                .help = "factor on the environment's radiance; 0: off",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return isFiniteFrom0(s.ibl_intensity); }},
                .default_only = {needs_env, hasEnv},
                .sweep = "0",
                .for_surfaces = "1"},
          &Settings::ibl_intensity);
    visit(Field{.option = "ibl",
                .help = "specular light of the environment: split sum with prefiltered maps (split), or "
                        "sampled at every pixel (sampled)",
                .default_only = {needs_env, hasEnv},
                .ignored = {.reference = integrates_env},
                .sweep = "all",
                .sweep_with = "ibl-samples"},
          &Settings::ibl);
    visit(Field{.option = "ibl-diffuse",
                .help = "diffuse light of the environment: spherical harmonics, the same windowed against "
                        "negative values, or an irradiance map",
                .default_only = {needs_env, hasEnv},
                .ignored = {.reference = integrates_env},
                .sweep = "all"},
          &Settings::ibl_diffuse);
    visit(
        Field{.option = "ibl-samples",
              .help = "directions per texel of the prefiltered environment, or per pixel with --ibl sampled",
              .valid = {"must be 1 to 4096",
                        [](const Settings& s) { return s.ibl_samples >= 1 && s.ibl_samples <= 4096; }},
              .default_only = {needs_env, hasEnv},
              .ignored = {.reference = integrates_env},
              .sweep = "16,32,64,256,1024",
              .sweep_with = "ibl-bias"},
        &Settings::ibl_samples);
    visit(Field{.option = "ibl-bias",
                .help = "mip level bias of these samples",
                .valid = {"must be 0 to 16",
                          [](const Settings& s) { return s.ibl_bias >= 0 && s.ibl_bias <= 16; }},
                .default_only = {needs_env, hasEnv},
                .ignored = {.reference = integrates_env},
                .sweep = "0,1,2"},
          &Settings::ibl_bias);
    visit(Field{.option = "ambient",
                .help = "constant ambient radiance R,G,B",
                .off = "0,0,0",
                .valid = {"components must be finite and at least 0",
                          [](const Settings& s) {
                              return isFiniteFrom0(s.ambient.r) && isFiniteFrom0(s.ambient.g) &&
                                     isFiniteFrom0(s.ambient.b);
                          }},
                .for_surfaces = "0,0,0"},
          &Settings::ambient);
    visit(Field{.option = "scene-lights",
                .help =
                    "the scene's own lights; off removes them and the default sun of a scene without lights",
                .off = "off"},
          &Settings::scene_lights);
    visit(Field{.option = "lights",
                .help = "KIND:N[,KIND:N...] for a seeded rig, or a JSON file of lights",
                .off = ""},
          &Settings::lights);
    visit(Field{.option = "seed", .help = "seed of the light rig"}, &Settings::seed);
    visit(Field{.option = "light-cutoff",
                .help = "luminance of a white surface at which a light without a range ends; 0: no end",
                .off = "0",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return isFiniteFrom0(s.light_cutoff); }},
                .ignored = {.reference = "the reference evaluates every light up to its own range"},
                .sweep = "0,1e-4,1e-3,1e-2",
                .sweep_with = "assign"},
          &Settings::light_cutoff);
    visit(Field{.option = "pixel-lights",
                .help = "lights shaded per pixel with --assign per_object",
                .valid = {"must be at least 0", [](const Settings& s) { return s.pixel_lights >= 0; }},
                .default_only = {"has no effect without --assign per_object",
                                 [](const Settings& s) { return s.assign == Assignment::per_object; }},
                .ignored = {.reference = every_light},
                .sweep = "0,1,2,4,8",
                .sweep_with = "assign"},
          &Settings::pixel_lights);
    visit(Field{.option = "area-lights",
                .help = "how area lights are evaluated",
                .ignored = {.reference = "the reference integrates area lights"},
                .sweep = "all"},
          &Settings::area_lights);
    visit(Field{.option = "textures",
                .help = "texture decoding: by the device; on the CPU, to 16-bit and float texels (exact); or "
                        "packed: metallic and roughness in unused alpha channels, one texture read less",
                .ignored = {.reference = "the reference decodes and filters in double precision",
                            .unless = shadesCaptures},
                .sweep = "all"},
          &Settings::textures);
    visit(Field{.option = "specular-albedo",
                .help = "directional albedo of the specular lobe: table, or Karis's fit",
                .ignored = {.reference = "the reference integrates the specular lobe's directional albedo"},
                .sweep = "all"},
          &Settings::specular_albedo);
    visit(Field{.option = "multiscatter",
                .help = "multiple scattering between microfacets; walk: only the reference",
                .off = "off",
                .sweep = "off,energy,fdez",
                .for_surfaces = "off"},
          &Settings::multiscatter);
    visit(Field{.option = "base-layer",
                .help = "light that reaches a dielectric's base: 1 - largest component of the layer's "
                        "reflectance, or 1 - each component",
                .for_surfaces = "max"},
          &Settings::base_layer);
    visit(Field{.option = "spot-cone",
                .help = "falloff of a spot between its inner and outer angle: that of KHR_lights_punctual, "
                        "or smoothstep",
                .for_surfaces = "gltf"},
          &Settings::spot_cone);
    visit(Field{.option = "range-window",
                .help = "how a light fades out at its range: 1 - (d / range)^4 as in KHR_lights_punctual, or "
                        "its square",
                .for_surfaces = "gltf"},
          &Settings::range_window);
    visit(Field{.option = "shadows",
                .help = "shadow technique",
                .off = "off",
                .one_for_reference = "pcf",  // it traces rays with every technique
                .sweep = "all",
                .for_surfaces = "off"},
          &Settings::shadows);
    visit(Field{.option = "shadow-lights",
                .help = "number of point and spot lights that cast shadows, brightest first, in addition to "
                        "those marked in the scene",
                .off = "0",
                .valid = {"must be at least 0", [](const Settings& s) { return s.shadow_lights >= 0; }},
                .default_only = {needs_shadows, hasShadows},
                .sweep = "0,1,4",
                .for_surfaces = "0"},
          &Settings::shadow_lights);
    visit(Field{.option = "shadow-size",
                .help = "edge length of a shadow map, a clipmap level or the atlas of local lights, texels",
                .valid = {"must be 16 to 16384",
                          [](const Settings& s) { return s.shadow_size >= 16 && isSide(s.shadow_size); }},
                .default_only = {needs_shadows, hasShadows},
                .ignored = {.reference = traces_shadows},
                .sweep = "512,1024,4096"},
          &Settings::shadow_size);
    visit(Field{.option = "shadow-cascades",
                .help = "cascades of the sun's shadow map",
                .valid = {"must be 1 to 4",
                          [](const Settings& s) { return s.shadow_cascades >= 1 && s.shadow_cascades <= 4; }},
                .default_only = {needs_cascades, hasCascades},
                .ignored = {.reference = traces_shadows},
                .sweep = "1,2,4"},
          &Settings::shadow_cascades);
    visit(Field{.option = "shadow-kernel",
                .help = "width of the shadow filter, texels",
                .valid = {"must be 1, 3, 5 or 7",
                          [](const Settings& s) {
                              return s.shadow_kernel >= 1 && s.shadow_kernel <= 7 && s.shadow_kernel % 2 == 1;
                          }},
                .default_only = {needs_shadows, hasShadows},
                .ignored = {.reference = traces_shadows},
                .sweep = "1,3,5,7"},
          &Settings::shadow_kernel);
    visit(Field{.option = "shadow-fit",
                .help = "range of the sun's cascades: the whole view, or only the visible depths",
                .default_only = {needs_cascades, hasCascades},
                .ignored = {.reference = traces_shadows},
                .sweep = "all"},
          &Settings::shadow_fit);
    visit(Field{.option = "shadow-distance",
                .help = "view depth at which shadows end, m; 0: end of the scene",
                .valid = {"must be finite and at least 0 m",
                          [](const Settings& s) { return isFiniteFrom0(double{s.shadow_distance}); }},
                .default_only = {needs_cascades, hasCascades},
                .ignored = {.reference = traces_shadows}},
          &Settings::shadow_distance);
    visit(Field{.option = "shadow-bias",
                .help = "offset of receivers towards the sun along the triangle's normal, texels",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return isFiniteFrom0(double{s.shadow_bias}); }},
                .default_only = {needs_shadows, hasShadows},
                .ignored = {.reference = traces_shadows},
                .sweep = "0.25,1"},
          &Settings::shadow_bias);
    visit(Field{.option = "shadow-casters",
                .help = "geometry drawn into shadow maps: only casters whose shadow may be visible, or all; "
                        "same picture",
                .default_only = {needs_shadows, hasShadows},
                .ignored = {.reference = traces_shadows}},
          &Settings::shadow_casters);
    visit(Field{.option = "clipmap-pages",
                .help = "capacity of the clipmap, pages; if more are needed, coarser levels are used",
                .valid = {"must be 1 to 16384",
                          [](const Settings& s) {
                              return s.clipmap_pages >= 1 && s.clipmap_pages <= max_pages;
                          }},
                .default_only = {needs_clipmap, hasClipmap},
                .ignored = {.reference = traces_shadows},
                .sweep = "64,1024",
                .sweep_with = "shadows"},
          &Settings::clipmap_pages);
    visit(Field{.option = "clipmap-page-size",
                .help = "edge length of a clipmap page, texels",
                .valid = {"must be 32, 64, 128 or 256",
                          [](const Settings& s) {
                              return s.clipmap_page_size == 32 || s.clipmap_page_size == 64 ||
                                     s.clipmap_page_size == 128 || s.clipmap_page_size == 256;
                          }},
                .default_only = {needs_clipmap, hasClipmap},
                .ignored = {.reference = traces_shadows},
                .sweep = "64,256",
                .sweep_with = "shadows"},
          &Settings::clipmap_page_size);
    visit(Field{.option = "evsm-precision",
                .help = "format of the moments",
                .default_only = {needs_evsm, hasEvsm},
                .ignored = {.reference = traces_shadows},
                .sweep = "fp32,fp16",
                .sweep_with = "shadows"},
          &Settings::evsm_precision);
    visit(Field{.option = "evsm-exponent",
                .help = "EVSM exponent; 0 selects 40, or 5.5 with 16-bit moments",
                .valid = {exponents, [](const Settings& s) { return isExponent(s, s.evsm_exponent); }},
                .default_only = {needs_evsm, hasEvsm},
                .ignored = {.reference = traces_shadows},
                .sweep = "5,20",
                .sweep_with = "shadows"},
          &Settings::evsm_exponent);
    visit(
        Field{.option = "evsm-negative-exponent",
              .help = "negative exponent of --shadows evsm4; 0 selects 5",
              .valid = {exponents, [](const Settings& s) { return isExponent(s, s.evsm_negative_exponent); }},
              .default_only = {needs_evsm4, hasEvsm4},
              .ignored = {.reference = traces_shadows},
              .sweep = "20",
              .sweep_with = "shadows"},
        &Settings::evsm_negative_exponent);
    visit(Field{.option = "evsm-depth",
                .help = "range of depth before warping: -1..1 halves light bleeding at the same exponent",
                .default_only = {needs_evsm, hasEvsm},
                .ignored = {.reference = traces_shadows},
                .sweep = "all",
                .sweep_with = "shadows"},
          &Settings::evsm_depth);
    visit(Field{.option = "evsm-bleed",
                .help = "light-bleeding reduction, 0 to below 1",
                .off = "0",
                .valid = {"must be 0 or more and below 1",
                          [](const Settings& s) { return s.evsm_bleed >= 0 && s.evsm_bleed < 1; }},
                .default_only = {needs_evsm, hasEvsm},
                .ignored = {.reference = traces_shadows},
                .sweep = "0.2",
                .sweep_with = "shadows"},
          &Settings::evsm_bleed);
    visit(Field{.option = "evsm-min-variance",
                .help = "minimum variance of depth, as a fraction of the depth range squared",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return isFiniteFrom0(double{s.evsm_min_variance}); }},
                .default_only = {needs_evsm, hasEvsm},
                .ignored = {.reference = traces_shadows},
                .sweep = "0,1e-4",
                .sweep_with = "shadows"},
          &Settings::evsm_min_variance);
}

}  // namespace diptych::row
