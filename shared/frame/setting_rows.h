// SPDX-License-Identifier: MIT
// One row per Setting, for all code that reads, writes and explains Settings.
#pragma once

#include "shared/frame/light_rows.h"
#include "shared/frame/row_conditions.h"

namespace diptych {

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
                .help = "clear coats, anisotropy, sheen, iridescence and diffuse transmission in the "
                        "deferred path: stored in the G-buffer, or drawn by the forward shader after "
                        "deferred lighting",
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
    row::lightRows(visit);
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
                .help = "ordering of blended surfaces; off: neither they nor glass is drawn",
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
                          [](const Settings& s) { return s.spp >= 1 && s.spp <= row::max_samples; }},
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
