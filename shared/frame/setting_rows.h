// SPDX-License-Identifier: MIT
// One row per Setting, for all code that reads, writes and explains Settings.
#pragma once

#include "shared/frame/settings.h"

#include <cmath>
#include <string_view>

namespace diptych {

// Texts and checks that several rows share.
namespace row {

inline constexpr std::string_view needs_evsm = "has no effect without --shadows evsm or evsm4";
inline constexpr std::string_view needs_evsm4 = "has no effect without --shadows evsm4";
inline constexpr std::string_view needs_clipmap = "has no effect without --shadows clipmap";
inline constexpr std::string_view exponents =
    "must be 0 to 44.36, or 0 to 5.54 with 16-bit moments; larger squares exceed the format";
inline constexpr std::string_view needs_shadows = "has no effect without --shadows";
inline constexpr std::string_view needs_cascades =
    "has no effect without --shadows pcf, pcss, evsm, evsm4 or msm4";
inline constexpr std::string_view needs_reference =
    "has no effect without a reference (--path reference, compare: --baseline reference)";
inline constexpr std::string_view every_light = "the reference evaluates every light";
inline constexpr std::string_view traces_shadows = "the reference traces the shadows of every light";
inline constexpr std::string_view only_reference = "only the reference takes several samples of a surface";

inline constexpr int largest_side = 16384;  // at most maxImageDimension2D of current Vulkan 1.3 devices
inline constexpr int most_pages = 16384;
inline constexpr int most_samples = 65536;  // more would take a day for a small image

inline constexpr std::string_view needs_env =
    "has no effect without --env (--env scene uses the environment in the scene's file)";
inline constexpr std::string_view needs_haze = "has no effect without --haze on";
inline constexpr std::string_view scattering = "components must be 0 to 1e6 1/m";
inline constexpr std::string_view scale_height = "must be 0.01 to 1e9 m";
inline bool isHazy(const Settings& s) {
    return s.haze;
}
constexpr bool isScattering(const Rgb& c) {
    const auto fits = [](float x) { return x >= 0 && x <= 1e6f; };
    return fits(c.r) && fits(c.g) && fits(c.b);
}
constexpr bool isScaleHeight(float metres) {
    return metres >= 0.01f && metres <= 1e9f;
}
inline constexpr std::string_view integrates_env = "the reference integrates the environment";
inline bool hasEnv(const Settings& s) {
    return s.env != Settings().env;
}
constexpr bool isSide(int pixels) {
    return pixels >= 1 && pixels <= largest_side;
}
inline bool isFiniteFrom0(double value) {
    return value >= 0 && std::isfinite(value);
}
inline bool isReference(const Settings& s) {
    return diptych::isReference(s.path);
}
inline constexpr std::string_view needs_msaa = "has no effect without --msaa 4";
inline constexpr std::string_view own_samples = "the reference takes --spp samples per pixel";
inline bool hasMsaa(const Settings& s) {
    return s.msaa > 1;
}
inline bool hasOneSample(const Settings& s) {
    return !hasMsaa(s);
}
inline bool hasReferenceSamples(const Settings& s) {
    return isReference(s) && s.reference_mode == ReferenceMode::scene && s.spp > 1;
}
inline constexpr std::string_view needs_spec_aa = "has no effect without --spec-aa on";
inline constexpr std::string_view unfiltered =
    "the reference takes several samples instead of filtering roughness";
constexpr bool shadesCaptures(const Settings& s) {
    return s.reference_mode == ReferenceMode::surface;
}
inline bool hasSpecAa(const Settings& s) {
    return s.spec_aa;
}
inline bool hasShadows(const Settings& s) {
    return s.shadows != Shadows::off;
}
inline bool hasClipmap(const Settings& s) {
    return s.shadows == Shadows::clipmap;
}
inline bool hasCascades(const Settings& s) {
    return hasShadows(s) && !hasClipmap(s);
}
inline bool isShadowedForwardPlus(const Settings& s) {
    return shadesFragments(s.path) && hasShadows(s);  // its geometric normals are quantized, too
}
inline bool hasEvsm4(const Settings& s) {
    return s.shadows == Shadows::evsm4;
}
inline bool hasEvsm(const Settings& s) {
    return s.shadows == Shadows::evsm || hasEvsm4(s);
}
inline bool isExponent(const Settings& s, float exponent) {
    return exponent >= 0 && exponent <= (s.evsm_precision == EvsmPrecision::fp16 ? 5.54f : 44.36f);
}

}  // namespace row

template <class Visit>
void Settings::rows(Visit&& visit) {
    visit(Field{.option = "path",
                .help = "deferred, forward_plus or reference",
                .sweep = "all",
                .sweep_with = "*",
                .for_surfaces = "forward_plus"},
          &Settings::path);
    visit(Field{.option = "assign",
                .help = "how lights are assigned to pixels",
                .ignored = {.reference = row::every_light},
                .sweep = "all"},
          &Settings::assign);
    visit(Field{.option = "light-kernel",
                .help = "filling of light lists: per light (scatter) or per tile (gather)",
                .ignored = {.reference = row::every_light},
                .sweep = "scatter,gather"},
          &Settings::light_kernel);
    visit(Field{.option = "prepass",
                .help = "depth pre-pass of the forward+ path",
                .off = "off",
                .ignored = {.deferred = "deferred has no depth pre-pass",
                            .reference = "the reference has no depth pre-pass"},
                .sweep = "on,off",
                .for_surfaces = "on"},
          &Settings::prepass);
    visit(
        Field{.option = "cull",
              .help = "skip opaque triangles outside the view, facing away, or between samples; same picture",
              .off = "off",
              .ignored = {.reference = "the reference draws no triangles"},
              .for_surfaces = "on"},
        &Settings::cull);
    visit(Field{.option = "gbuffer",
                .help = "encoding of the deferred path's G-buffer",
                .ignored = {.forward_plus = "forward_plus has no G-buffer",
                            .reference = "the reference has no G-buffer",
                            .unless = row::isShadowedForwardPlus},
                .sweep = "all",
                .for_surfaces = "full"},  // geometric normals are not quantized either
          &Settings::gbuffer);
    visit(Field{.option = "lighting",
                .help = "shading of the deferred path's G-buffer: by fragments of a full-screen triangle, or "
                        "in compute; same picture",
                .ignored = {.forward_plus = "forward_plus shades what it draws",
                            .reference = "the reference shades on the CPU"},
                .sweep = "all",
                .for_surfaces = "fragment"},
          &Settings::lighting);
    visit(Field{.option = "layers",
                .help = "clear coats, anisotropy, sheen and iridescence in the deferred path: stored in the "
                        "G-buffer, or drawn by the forward shader after deferred lighting",
                .ignored = {.forward_plus = "forward_plus shades what it draws",
                            .reference = "the reference has no G-buffer"},
                .sweep = "all",
                .for_surfaces = "gbuffer"},
          &Settings::layers);
    visit(Field{.option = "depth-format",
                .help = "depth format: reversed float, standard float, or reversed integers of 24 or 16 bits",
                .default_only = {"cannot be used with --msaa 4, which shades interpolated positions instead "
                                 "of the stored depth",
                                 row::hasOneSample},
                .ignored = {.reference = "the reference stores no depth"},
                .sweep = "all",
                .for_surfaces = "d32f"},
          &Settings::depth_format);
    visit(Field{.option = "lit-format",
                .help = "format of the lit image: floats of 32 or 16 bits, or of 11, 11 and 10 bits",
                .default_only = {"requires --msaa 1", row::hasOneSample},
                .ignored = {.reference = "the reference computes in double precision"},
                .sweep = "all",
                .for_surfaces = "fp32"},
          &Settings::lit_format);
    visit(
        Field{.option = "shading-precision",
              .help = "precision of shading by point, spot and directional lights, if the device supports it",
              .default_only = {"requires --msaa 1", row::hasOneSample},
              .ignored = {.reference = "the reference computes in double precision"},
              .sweep = "all",
              .for_surfaces = "fp32"},
        &Settings::shading_precision);
    visit(Field{.option = "size",
                .help = "picture size, WxH",
                .valid = {"width and height must be 1 to 16384",
                          [](const Settings& s) {
                              return row::isSide(s.size.width) && row::isSide(s.size.height);
                          }},
                .sweep = "1/4,1/2,3/4",
                .sweep_with = "gbuffer"},
          &Settings::size);
    visit(
        Field{.option = "camera", .help = "index, name, or \"eye=x,y,z target=x,y,z fov=deg near=m far=m\""},
        &Settings::camera);
    visit(Field{.option = "time",
                .help = "animation time, seconds",
                .valid = {"must be finite and at least 0 s",
                          [](const Settings& s) { return row::isFiniteFrom0(s.time); }}},
          &Settings::time);
    visit(Field{.option = "animation", .help = "animation to play, by index or name; default: all"},
          &Settings::animation);
    visit(Field{.option = "variant",
                .help = "material variant of the scene, by index or name; default: its own materials"},
          &Settings::variant);
    visit(Field{.option = "skinning",
                .help =
                    "deform skinned and morphed vertices once per frame (compute) or in every draw (vertex)",
                .ignored = {.reference = "the reference deforms vertices in double precision"},
                .sweep = "all"},
          &Settings::skinning);
    visit(Field{.option = "skin-normals",
                .help = "transform of skinned normals: mean of the joints' inverse transposes, or cofactors "
                        "of the mean of their matrices"},
          &Settings::skin_normals);
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
                .default_only = {row::needs_env, row::hasEnv},
                .for_surfaces = "0"},
          &Settings::env_rotation);
    visit(Field{.option = "env-sun",
                .help = "extract the environment's sun as a directional light that casts shadows",
                .off = "off",
                .default_only = {row::needs_env, row::hasEnv},
                .for_surfaces = "off"},
          &Settings::env_sun);
    visit(Field{.option = "ibl-intensity",
                .help = "factor on the environment's radiance; 0: off",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return row::isFiniteFrom0(s.ibl_intensity); }},
                .default_only = {row::needs_env, row::hasEnv},
                .sweep = "0",
                .for_surfaces = "1"},
          &Settings::ibl_intensity);
    visit(Field{.option = "ibl",
                .help = "specular light of the environment: split sum with prefiltered maps (split), or "
                        "sampled at every pixel (sampled)",
                .default_only = {row::needs_env, row::hasEnv},
                .ignored = {.reference = row::integrates_env},
                .sweep = "all",
                .sweep_with = "ibl-samples"},
          &Settings::ibl);
    visit(Field{.option = "ibl-diffuse",
                .help = "diffuse light of the environment: spherical harmonics, the same windowed against "
                        "negative values, or an irradiance map",
                .default_only = {row::needs_env, row::hasEnv},
                .ignored = {.reference = row::integrates_env},
                .sweep = "all"},
          &Settings::ibl_diffuse);
    visit(
        Field{.option = "ibl-samples",
              .help = "directions per texel of the prefiltered environment, or per pixel with --ibl sampled",
              .valid = {"must be 1 to 4096",
                        [](const Settings& s) { return s.ibl_samples >= 1 && s.ibl_samples <= 4096; }},
              .default_only = {row::needs_env, row::hasEnv},
              .ignored = {.reference = row::integrates_env},
              .sweep = "16,32,64,256,1024",
              .sweep_with = "ibl-bias"},
        &Settings::ibl_samples);
    visit(Field{.option = "ibl-bias",
                .help = "mip level bias of these samples",
                .valid = {"must be 0 to 16",
                          [](const Settings& s) { return s.ibl_bias >= 0 && s.ibl_bias <= 16; }},
                .default_only = {row::needs_env, row::hasEnv},
                .ignored = {.reference = row::integrates_env},
                .sweep = "0,1,2"},
          &Settings::ibl_bias);
    visit(Field{.option = "ambient",
                .help = "constant ambient radiance R,G,B",
                .off = "0,0,0",
                .valid = {"components must be finite and at least 0",
                          [](const Settings& s) {
                              return row::isFiniteFrom0(s.ambient.r) && row::isFiniteFrom0(s.ambient.g) &&
                                     row::isFiniteFrom0(s.ambient.b);
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
                          [](const Settings& s) { return row::isFiniteFrom0(s.light_cutoff); }},
                .ignored = {.reference = "the reference evaluates every light up to its own range"},
                .sweep = "0,1e-4,1e-3,1e-2",
                .sweep_with = "assign"},
          &Settings::light_cutoff);
    visit(Field{.option = "pixel-lights",
                .help = "lights shaded per pixel with --assign per_object",
                .valid = {"must be at least 0", [](const Settings& s) { return s.pixel_lights >= 0; }},
                .default_only = {"has no effect without --assign per_object",
                                 [](const Settings& s) { return s.assign == Assignment::per_object; }},
                .ignored = {.reference = row::every_light},
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
                            .unless = row::shadesCaptures},
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
                .default_only = {row::needs_shadows, row::hasShadows},
                .sweep = "0,1,4",
                .for_surfaces = "0"},
          &Settings::shadow_lights);
    visit(
        Field{.option = "shadow-size",
              .help = "edge length of a shadow map or clipmap level, texels",
              .valid = {"must be 16 to 16384",
                        [](const Settings& s) { return s.shadow_size >= 16 && row::isSide(s.shadow_size); }},
              .default_only = {row::needs_shadows, row::hasShadows},
              .ignored = {.reference = row::traces_shadows},
              .sweep = "512,1024,4096"},
        &Settings::shadow_size);
    visit(Field{.option = "shadow-cascades",
                .help = "cascades of the sun's shadow map",
                .valid = {"must be 1 to 4",
                          [](const Settings& s) { return s.shadow_cascades >= 1 && s.shadow_cascades <= 4; }},
                .default_only = {row::needs_cascades, row::hasCascades},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "1,2,4"},
          &Settings::shadow_cascades);
    visit(Field{.option = "shadow-kernel",
                .help = "width of the shadow filter, texels",
                .valid = {"must be 1, 3, 5 or 7",
                          [](const Settings& s) {
                              return s.shadow_kernel >= 1 && s.shadow_kernel <= 7 && s.shadow_kernel % 2 == 1;
                          }},
                .default_only = {row::needs_shadows, row::hasShadows},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "1,3,5,7"},
          &Settings::shadow_kernel);
    visit(Field{.option = "shadow-fit",
                .help = "range of the sun's cascades: the whole view, or only the visible depths",
                .default_only = {row::needs_cascades, row::hasCascades},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "all"},
          &Settings::shadow_fit);
    visit(Field{.option = "shadow-distance",
                .help = "view depth at which shadows end, m; 0: end of the scene",
                .valid = {"must be finite and at least 0 m",
                          [](const Settings& s) { return row::isFiniteFrom0(double{s.shadow_distance}); }},
                .default_only = {row::needs_cascades, row::hasCascades},
                .ignored = {.reference = row::traces_shadows}},
          &Settings::shadow_distance);
    visit(Field{.option = "shadow-bias",
                .help = "offset of receivers towards the sun along the triangle's normal, texels",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return row::isFiniteFrom0(double{s.shadow_bias}); }},
                .default_only = {row::needs_shadows, row::hasShadows},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "0.25,1"},
          &Settings::shadow_bias);
    visit(Field{.option = "shadow-casters",
                .help = "geometry drawn into shadow maps: only casters whose shadow may be visible, or all; "
                        "same picture",
                .default_only = {row::needs_shadows, row::hasShadows},
                .ignored = {.reference = row::traces_shadows}},
          &Settings::shadow_casters);
    visit(Field{.option = "clipmap-pages",
                .help = "capacity of the clipmap, pages; if more are needed, coarser levels are used",
                .valid = {"must be 1 to 16384",
                          [](const Settings& s) {
                              return s.clipmap_pages >= 1 && s.clipmap_pages <= row::most_pages;
                          }},
                .default_only = {row::needs_clipmap, row::hasClipmap},
                .ignored = {.reference = row::traces_shadows},
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
                .default_only = {row::needs_clipmap, row::hasClipmap},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "64,256",
                .sweep_with = "shadows"},
          &Settings::clipmap_page_size);
    visit(Field{.option = "evsm-precision",
                .help = "format of the moments",
                .default_only = {row::needs_evsm, row::hasEvsm},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "fp32,fp16",
                .sweep_with = "shadows"},
          &Settings::evsm_precision);
    visit(Field{.option = "evsm-exponent",
                .help = "EVSM exponent; 0 selects 40, or 5.5 with 16-bit moments",
                .valid = {row::exponents,
                          [](const Settings& s) { return row::isExponent(s, s.evsm_exponent); }},
                .default_only = {row::needs_evsm, row::hasEvsm},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "5,20",
                .sweep_with = "shadows"},
          &Settings::evsm_exponent);
    visit(Field{.option = "evsm-negative-exponent",
                .help = "negative exponent of --shadows evsm4; 0 selects 5",
                .valid = {row::exponents,
                          [](const Settings& s) { return row::isExponent(s, s.evsm_negative_exponent); }},
                .default_only = {row::needs_evsm4, row::hasEvsm4},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "20",
                .sweep_with = "shadows"},
          &Settings::evsm_negative_exponent);
    visit(Field{.option = "evsm-depth",
                .help = "range of depth before warping: -1..1 halves light bleeding at the same exponent",
                .default_only = {row::needs_evsm, row::hasEvsm},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "all",
                .sweep_with = "shadows"},
          &Settings::evsm_depth);
    visit(Field{.option = "evsm-bleed",
                .help = "light-bleeding reduction, 0 to below 1",
                .off = "0",
                .valid = {"must be 0 or more and below 1",
                          [](const Settings& s) { return s.evsm_bleed >= 0 && s.evsm_bleed < 1; }},
                .default_only = {row::needs_evsm, row::hasEvsm},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "0.2",
                .sweep_with = "shadows"},
          &Settings::evsm_bleed);
    visit(Field{.option = "evsm-min-variance",
                .help = "minimum variance of depth, as a fraction of the depth range squared",
                .valid = {"must be finite and at least 0",
                          [](const Settings& s) { return row::isFiniteFrom0(double{s.evsm_min_variance}); }},
                .default_only = {row::needs_evsm, row::hasEvsm},
                .ignored = {.reference = row::traces_shadows},
                .sweep = "0,1e-4",
                .sweep_with = "shadows"},
          &Settings::evsm_min_variance);
    visit(Field{.option = "msaa",
                .help = "samples per pixel: 1 or 4, and 8 if the device supports it",
                .off = "1",
                .valid = {"must be 1, 4 or 8",
                          [](const Settings& s) { return s.msaa == 1 || s.msaa == 4 || s.msaa == 8; }},
                .ignored = {.reference = row::own_samples},
                .sweep = "1,4",
                .sweep_with = "gbuffer,size"},
          &Settings::msaa);
    visit(Field{.option = "msaa-shading",
                .help = "shade once per triangle of a pixel, or once per sample",
                .default_only = {row::needs_msaa, row::hasMsaa},
                .ignored = {.reference = row::own_samples},
                .sweep = "sample",
                .sweep_with = "msaa"},
          &Settings::msaa_shading);
    visit(Field{.option = "msaa-edges",
                .help = "pixels where deferred lighting shades each sample: all; those whose samples differ "
                        "in any bit of the G-buffer (exact) or visibly (similar); or those that a triangle "
                        "covers in part (coverage)",
                .default_only = {row::needs_msaa, row::hasMsaa},
                .ignored = {.forward_plus = "forward_plus shades triangles as they are drawn",
                            .reference = row::own_samples},
                .sweep = "all,similar,coverage",
                .sweep_with = "msaa"},
          &Settings::msaa_edges);
    visit(Field{.option = "resolve",
                .help = "average of a pixel's samples: plain, or weighted by 1 / (1 + largest component)",
                .default_only = {"has no effect without --msaa 4 or a reference",
                                 [](const Settings& s) { return row::hasMsaa(s) || row::isReference(s); }},
                .ignored = {.reference = "the reference takes one sample per pixel",
                            .unless = row::hasReferenceSamples},
                .sweep = "tonemapped",
                .sweep_with = "msaa",
                .for_surfaces = "linear"},
          &Settings::resolve);
    visit(
        Field{
            .option = "alpha-to-coverage",
            .help = "alpha masks cover a fraction of a pixel's samples, sharpened at the cutoff",
            .default_only =
                {"has no effect without --msaa 4 and --msaa-shading pixel: a single sample is covered or not",
                 [](const Settings& s) { return row::hasMsaa(s) && s.msaa_shading == MsaaShading::pixel; }},
            .ignored = {.reference = row::own_samples},
            .sweep = "on",
            .sweep_with = "msaa"},
        &Settings::alpha_to_coverage);
    visit(Field{.option = "spec-aa",
                .help = "specular antialiasing: roughness grows where the normal varies within a pixel",
                .off = "off",
                .ignored = {.reference = row::unfiltered, .unless = row::shadesCaptures},
                .sweep = "on"},
          &Settings::spec_aa);
    visit(Field{.option = "spec-aa-variance",
                .help = "variance of the pixel filter, pixels squared",
                .valid = {"must be 0 to 100",
                          [](const Settings& s) {
                              return s.spec_aa_variance >= 0 && s.spec_aa_variance <= 100;
                          }},
                .default_only = {row::needs_spec_aa, row::hasSpecAa},
                .ignored = {.reference = row::unfiltered, .unless = row::shadesCaptures},
                .sweep = "0.05,0.5",
                .sweep_with = "spec-aa"},
          &Settings::spec_aa_variance);
    visit(Field{.option = "spec-aa-limit",
                .help = "largest increase of the squared GGX width",
                .valid = {"must be 0 to 1",
                          [](const Settings& s) { return s.spec_aa_limit >= 0 && s.spec_aa_limit <= 1; }},
                .default_only = {row::needs_spec_aa, row::hasSpecAa},
                .ignored = {.reference = row::unfiltered, .unless = row::shadesCaptures},
                .sweep = "0.5",
                .sweep_with = "spec-aa"},
          &Settings::spec_aa_limit);
    visit(Field{.option = "spec-aa-normals",
                .help = "normal whose variation is used: the interpolated one, or also the normal map's",
                .default_only = {row::needs_spec_aa, row::hasSpecAa},
                .ignored = {.reference = row::unfiltered, .unless = row::shadesCaptures},
                .sweep = "mapped",
                .sweep_with = "spec-aa"},
          &Settings::spec_aa_normals);
    visit(Field{.option = "spec-aa-kernel",
                .help = "increase of roughness with this variation: by its variance, or by its largest slope",
                .default_only = {row::needs_spec_aa, row::hasSpecAa},
                .ignored = {.reference = row::unfiltered, .unless = row::shadesCaptures}},
          &Settings::spec_aa_kernel);
    visit(Field{.option = "transparency",
                .help = "ordering of blended surfaces; off: they are not drawn",
                .ignored = {.reference = "the reference sorts blended surfaces by depth",
                            .unless = [](const Settings& s) { return s.transparency == Transparency::off; }},
                .sweep = "sorted,unsorted,triangles,weighted,moments,list",
                .for_surfaces = "sorted"},
          &Settings::transparency);
    visit(Field{.option = "transparency-layers",
                .help = "fragments per pixel that --transparency list sorts; the others are blended as one "
                        "layer behind them",
                .valid = {"must be 1 to 256",
                          [](const Settings& s) {
                              return s.transparency_layers >= 1 && s.transparency_layers <= 256;
                          }},
                .default_only = {"has no effect without --transparency list",
                                 [](const Settings& s) { return s.transparency == Transparency::list; }},
                .ignored = {.reference = "the reference sorts blended surfaces by depth"},
                .sweep = "4,8,16",
                .sweep_with = "transparency"},
          &Settings::transparency_layers);
    visit(Field{.option = "haze",
                .help = "aerial perspective: air that scatters sunlight and ambient light",
                .off = "off",
                .for_surfaces = "off"},
          &Settings::haze);
    visit(Field{.option = "haze-density",
                .help = "factor on the scattering and absorption of the air",
                .valid = {"must be 0 to 1e6",
                          [](const Settings& s) { return s.haze_density >= 0 && s.haze_density <= 1e6f; }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "1"},
          &Settings::haze_density);
    visit(Field{.option = "haze-rayleigh",
                .help = "scattering coefficient of molecules at height 0, R,G,B, 1/m",
                .valid = {row::scattering,
                          [](const Settings& s) { return row::isScattering(s.haze_rayleigh); }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "5.8e-6,13.5e-6,33.1e-6"},
          &Settings::haze_rayleigh);
    visit(Field{.option = "haze-rayleigh-height",
                .help = "scale height of molecules (density falls to 1/e), m",
                .valid = {row::scale_height,
                          [](const Settings& s) { return row::isScaleHeight(s.haze_rayleigh_height); }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "8000"},
          &Settings::haze_rayleigh_height);
    visit(Field{.option = "haze-mie",
                .help = "scattering coefficient of aerosols at height 0, R,G,B, 1/m",
                .valid = {row::scattering, [](const Settings& s) { return row::isScattering(s.haze_mie); }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "2e-5,2e-5,2e-5"},
          &Settings::haze_mie);
    visit(Field{.option = "haze-mie-height",
                .help = "scale height of aerosols (density falls to 1/e), m",
                .valid = {row::scale_height,
                          [](const Settings& s) { return row::isScaleHeight(s.haze_mie_height); }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "1200"},
          &Settings::haze_mie_height);
    visit(Field{.option = "haze-g",
                .help = "mean cosine of aerosols' scattering angle; above 0: forward",
                .valid = {"must be -0.99 to 0.99",
                          [](const Settings& s) { return s.haze_g >= -0.99f && s.haze_g <= 0.99f; }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "0.76"},
          &Settings::haze_g);
    visit(Field{.option = "haze-ground",
                .help = "world y of height 0, m",
                .valid = {"must be -1e9 to 1e9 m",
                          [](const Settings& s) { return s.haze_ground >= -1e9f && s.haze_ground <= 1e9f; }},
                .default_only = {row::needs_haze, row::isHazy},
                .for_surfaces = "0"},
          &Settings::haze_ground);
    visit(Field{.option = "haze-march-steps",
                .help = "steps along each ray, with two scale heights and a sun attenuated by the air; 0: "
                        "closed form with one scale height and a constant sun",
                .off = "0",
                .valid = {"must be 0 to 256",
                          [](const Settings& s) {
                              return s.haze_march_steps >= 0 && s.haze_march_steps <= 256;
                          }},
                .default_only = {row::needs_haze, row::isHazy},
                .one_for_reference = "32",  // it integrates
                .sweep = "0,8,32",
                .for_surfaces = "0"},
          &Settings::haze_march_steps);
    visit(Field{.option = "spp",
                .help = "samples per pixel of the reference",
                .valid = {"must be 1 to 65536",
                          [](const Settings& s) { return s.spp >= 1 && s.spp <= row::most_samples; }},
                .default_only = {row::needs_reference, row::isReference},
                .ignored = {.deferred = row::only_reference, .forward_plus = row::only_reference}},
          &Settings::spp);
    visit(Field{.option = "reference-mode",
                .help = "surfaces that the reference shades: those captured by forward+, or those it traces "
                        "in the scene",
                .default_only = {row::needs_reference, row::isReference},
                .ignored = {.deferred = row::only_reference, .forward_plus = row::only_reference}},
          &Settings::reference_mode);
}

template <class Self, class Visit>
void Settings::fields(Self& self, Visit&& visit) {
    rows([&](const Field& field, auto member) { visit(field, self.*member); });
}

}  // namespace diptych
