// SPDX-License-Identifier: MIT
// Channels that a path can show or write. README.md says how new ones are numbered, and
// tests/architecture/README.md which files to change.
#ifndef DIPTYCH_CONTRACT_DEBUG_MODE_H
#define DIPTYCH_CONTRACT_DEBUG_MODE_H

#include "types.h"

// number  name  width  error   kind  domain  supported_by  shows
//     stage  step  code  standard  compact  part  texels  related
//   width   components; kind names them in an EXR: color .R.G.B, vector .X.Y.Z, scalar .Y, id .Y
//   error   relative  |a-b| / max(|b|, 1e-3 of the mean luminance)     absolute  |a-b|
//           angular   atan2(|a x b|, a.b), degrees                     exact     1 where a != b
//           axial     the same between lines: b and -b are equal, so at most 90 degrees
//   domain  unit: vectors of length 1   unit_or_zero: these, or 0   ratio: 0 to 1   positive: 0 or more   any
//   supported_by  which renderers produce it:
//           both           both paths and the reference
//           forward_only   forward+ and the reference: the G-buffer does not store it
//           deferred_only  deferred alone: it describes samples of the G-buffer
//           paths_only     both paths, not the reference: it describes how they work
//   stage   what makes the value:
//           id          the material's index
//           position    the position alone, as the rasteriser interpolates it
//           facet       the triangle
//           surface     the material's factors and texels
//           list        selection of lights, or of samples, to evaluate
//           map         selection of a shadow map
//           visibility  shadow maps or rays
//           light       surface and light, with shadows      unshadowed  surface and light without shadows
//           haze        the medium between surface and camera
//   step    order of computation, in tens to leave room: from 100 position and normal, 200 material,
//           400 light that arrives, 500 light that leaves
//   code    how packed G-buffers store it (StoredField::Code); exact: unchanged, or not at all
//   standard, compact  bits in these encodings (gbuffer.h), of each component; radiance: of the mantissas
//   part    the part of a material without which a scene's G-buffer does not store it; that of a layer
//           (LAYER_* of material.h): without which the channel is 0
//   texels  how it depends on texels: number: linearly; color: sRGB, times linear ones if scaled_color;
//           thickness: linear between two lengths; length: linear, times a length; direction, line: 3 and 2
//           components 2 t - 1 of a direction
//   related its index among the channels that relations of an audit compare; 0: they do not
// clang-format off
#define DEBUG_MODES(X) \
    X(0,  lit, 3, relative, color, any, both, "radiance, W/(sr m^2)", \
          light, 620, exact, 0, 0, none, none, 1) \
    X(1,  albedo, 3, absolute, color, ratio, both, "base colour, linear Rec.709", \
          surface, 200, root, ALBEDO_BITS, ALBEDO_BITS, none, color, 2) \
    X(2,  normals, 3, angular, vector, unit, both, "shading normal, world", \
          surface, 180, octahedral, STANDARD_NORMAL_BITS, COMPACT_NORMAL_BITS, none, direction, 3) \
    X(3,  metallic, 1, absolute, scalar, ratio, both, "metallic, 0 to 1", \
          surface, 210, unorm, STANDARD_METALLIC_BITS, COMPACT_METALLIC_BITS, none, number, 4) \
    X(4,  roughness, 1, absolute, scalar, ratio, both, "perceptual roughness, 0 to 1", \
          surface, 220, unorm, STANDARD_ROUGHNESS_BITS, COMPACT_ROUGHNESS_BITS, none, number, 5) \
    X(5,  emission, 3, relative, color, positive, both, "emitted radiance, W/(sr m^2)", \
          surface, 370, radiance, EMISSION_MANTISSA_BITS, EMISSION_MANTISSA_BITS, emission, color, 6) \
    X(6,  occlusion, 1, absolute, scalar, ratio, both, "ambient occlusion, 0 to 1", \
          surface, 360, unorm, OCCLUSION_BITS, OCCLUSION_BITS, none, number, 0) \
    X(7,  specular, 3, absolute, color, ratio, both, "F0, specular colour at normal incidence", \
          surface, 250, exact, 0, 0, none, scaled_color, 0) \
    X(8,  material_id, 1, exact, id, any, both, "material index; -1: background", \
          id, 100, exact, 0, 0, none, none, 7) \
    X(9,  texcoords, 2, absolute, vector, any, forward_only, "first UV set", \
          position, 140, exact, 0, 0, none, none, 0) \
    X(10, depth, 1, relative, scalar, positive, both, "view depth, m (EXR layer Z)", \
          position, 110, exact, 0, 0, none, none, 8) \
    X(11, position, 3, relative, vector, any, both, \
          "shading position relative to the camera, world axes, m", \
          position, 120, exact, 0, 0, none, none, 0) \
    X(12, geometric_normal, 3, angular, vector, unit, both, "triangle normal, world", \
          facet, 130, octahedral, STANDARD_GEOMETRIC_NORMAL_BITS, COMPACT_GEOMETRIC_NORMAL_BITS, \
          none, none, 9) \
    X(20, light_count, 1, absolute, scalar, positive, paths_only, "number of lights evaluated at the pixel", \
          list, 450, exact, 0, 0, none, none, 0) \
    X(21, list_overflow, 1, exact, scalar, ratio, paths_only, "1 where the pixel's light list overflowed", \
          list, 440, exact, 0, 0, none, none, 0) \
    X(22, shaded_samples, 1, absolute, scalar, positive, deferred_only, \
          "number of sample groups that deferred lighting shades at the pixel", \
          list, 460, exact, 0, 0, none, none, 0) \
    X(30, shadow_visibility, 1, absolute, scalar, ratio, both, \
          "visible fraction of the shadow-casting sun; 1 without one", \
          visibility, 400, exact, 0, 0, none, none, 0) \
    X(31, cascade, 1, exact, id, any, paths_only, \
          "sun shadow cascade, or requested clipmap level, from 0; -1: none", \
          map, 410, exact, 0, 0, none, none, 0) \
    X(32, page_residency, 1, exact, id, any, paths_only, \
          "resident minus requested clipmap level; 0: page resident; -1: no clipmap", \
          map, 420, exact, 0, 0, none, none, 0) \
    X(33, local_visibility, 1, absolute, scalar, ratio, both, \
          "visible fraction of shadow-casting point and spot lights, weighted by irradiance; 1 without any", \
          visibility, 430, exact, 0, 0, none, none, 0) \
    X(40, lit_diffuse, 3, relative, color, any, both, \
          "radiance of the diffuse lobes, in front and through the surface, W/(sr m^2)", \
          light, 500, exact, 0, 0, none, none, 0) \
    X(41, lit_specular, 3, relative, color, any, both, \
          "radiance reflected by the specular lobe, W/(sr m^2)", \
          light, 510, exact, 0, 0, none, none, 0) \
    X(42, lit_ambient, 3, relative, color, any, both, \
          "radiance of ambient light, reflected and through the surface, W/(sr m^2)", \
          unshadowed, 520, exact, 0, 0, none, none, 0) \
    X(43, lit_haze, 3, relative, color, any, both, \
          "radiance scattered by haze in front of the surface, W/(sr m^2)", \
          haze, 610, exact, 0, 0, none, none, 0) \
    X(44, transmittance, 3, absolute, color, ratio, both, \
          "transmittance of haze between surface and camera, 0 to 1", \
          haze, 600, exact, 0, 0, none, none, 0) \
    X(45, lit_environment, 3, relative, color, any, both, \
          "environment's contribution to lit_diffuse and lit_specular, W/(sr m^2)", \
          unshadowed, 530, exact, 0, 0, none, none, 0) \
    X(46, lit_clearcoat, 3, relative, color, any, both, \
          "clear coat's contribution to lit_specular and lit_ambient, W/(sr m^2)", \
          light, 550, exact, 0, 0, clearcoat, none, 0) \
    X(47, lit_sheen, 3, relative, color, any, both, \
          "sheen's contribution to lit_specular and lit_ambient, W/(sr m^2)", \
          light, 540, exact, 0, 0, sheen, none, 0) \
    X(48, lit_transmission, 3, relative, color, any, both, \
          "radiance through the nearest surface with transmission; elsewhere diffuse transmission's " \
          "contribution to lit_diffuse and lit_ambient, W/(sr m^2)", \
          light, 560, exact, 0, 0, transmitted, none, 0) \
    X(50, dielectric_f90, 1, absolute, scalar, ratio, both, "F90 of the dielectric layer, 0 to 1", \
          surface, 240, unorm, SPECULAR_F90_BITS, SPECULAR_F90_BITS, dielectric, number, 0) \
    X(51, lightmap, 3, relative, color, positive, both, "lightmap irradiance / pi, W/(sr m^2)", \
          surface, 380, radiance, EMISSION_MANTISSA_BITS, EMISSION_MANTISSA_BITS, lightmap, color, 0) \
    X(52, tangent, 3, absolute, vector, any, forward_only, \
          "tangent of the normal map, world; 0 without a normal map", \
          position, 150, exact, 0, 0, none, none, 0) \
    X(53, handedness, 1, exact, scalar, any, forward_only, \
          "sign of the bitangent, 1 or -1; 0 without a normal map", \
          surface, 160, exact, 0, 0, none, none, 0) \
    X(54, tangent_normal, 3, absolute, vector, any, forward_only, \
          "normal map's normal, tangent space, unit; 0 without a normal map", \
          surface, 170, exact, 0, 0, none, direction, 0) \
    X(55, dielectric_f0, 3, absolute, color, ratio, both, "F0 of the dielectric layer", \
          surface, 230, root, SPECULAR_BITS, SPECULAR_BITS, dielectric, scaled_color, 0) \
    X(56, lightmapped, 1, exact, scalar, ratio, both, \
          "1 where the material has a lightmap, which replaces the environment's diffuse light", \
          surface, 390, exact, 0, 0, none, none, 0) \
    X(60, clearcoat, 1, absolute, scalar, ratio, both, "weight of the clear coat, 0 to 1", \
          surface, 330, unorm, CLEARCOAT_BITS, CLEARCOAT_BITS, clearcoat, number, 0) \
    X(61, clearcoat_roughness, 1, absolute, scalar, ratio, both, \
          "perceptual roughness of the clear coat, 0 to 1; 0 without one", \
          surface, 340, unorm, CLEARCOAT_ROUGHNESS_BITS, CLEARCOAT_ROUGHNESS_BITS, clearcoat, number, 11) \
    X(62, clearcoat_normal, 3, angular, vector, unit_or_zero, both, \
          "normal of the clear coat, world; 0 without one", \
          surface, 350, octahedral, CLEARCOAT_NORMAL_BITS, CLEARCOAT_NORMAL_BITS, clearcoat, direction, 10) \
    X(63, anisotropy, 1, absolute, scalar, ratio, both, "strength of anisotropy, 0 to 1", \
          surface, 260, unorm, ANISOTROPY_BITS, ANISOTROPY_BITS, anisotropy, number, 0) \
    X(64, anisotropy_direction, 3, axial, vector, unit_or_zero, both, \
          "direction along which highlights stretch, world, either sign; 0 where isotropic", \
          surface, 270, line, ANISOTROPY_ANGLE_BITS, ANISOTROPY_ANGLE_BITS, anisotropy, line, 0) \
    X(65, sheen_color, 3, absolute, color, ratio, both, "colour of the sheen, linear Rec.709", \
          surface, 310, root, SHEEN_COLOR_BITS, SHEEN_COLOR_BITS, sheen, color, 12) \
    X(66, sheen_roughness, 1, absolute, scalar, ratio, both, \
          "perceptual roughness of the sheen, 0 to 1; 0 without one", \
          surface, 320, unorm, SHEEN_ROUGHNESS_BITS, SHEEN_ROUGHNESS_BITS, sheen, number, 13) \
    X(67, iridescence, 1, absolute, scalar, ratio, both, "weight of the thin film, 0 to 1", \
          surface, 280, unorm, IRIDESCENCE_BITS, IRIDESCENCE_BITS, iridescence, number, 14) \
    X(68, iridescence_ior, 1, absolute, scalar, positive, both, \
          "index of refraction of the thin film; 0 without one", \
          surface, 290, index, IRIDESCENCE_IOR_BITS, IRIDESCENCE_IOR_BITS, iridescence, none, 0) \
    X(69, iridescence_thickness, 1, relative, scalar, positive, both, \
          "thickness of the thin film, nm; 0 without one", \
          surface, 300, half, IRIDESCENCE_THICKNESS_BITS, IRIDESCENCE_THICKNESS_BITS, \
          iridescence, thickness, 15) \
    X(70, transmission, 1, absolute, scalar, ratio, both, \
          "fraction of light that the nearest surface with transmission transmits; 0 without one", \
          surface, 392, exact, 0, 0, transmission, number, 0) \
    X(71, transmission_thickness, 1, relative, scalar, positive, both, "its thickness, m; 0: thin wall", \
          surface, 394, exact, 0, 0, transmission, length, 0) \
    X(72, attenuation_color, 3, absolute, color, ratio, both, \
          "its colour at attenuation_distance, linear Rec.709", \
          surface, 395, exact, 0, 0, transmission, none, 0) \
    X(73, attenuation_distance, 1, relative, scalar, positive, both, \
          "its attenuation distance, m; 0: nothing is absorbed", \
          surface, 396, exact, 0, 0, transmission, none, 0) \
    X(74, dispersion, 1, absolute, scalar, positive, both, "its dispersion, 20 / Abbe number", \
          surface, 398, exact, 0, 0, transmission, none, 0) \
    X(75, diffuse_transmission, 1, absolute, scalar, ratio, both, "weight of diffuse transmission, 0 to 1", \
          surface, 302, unorm, DIFFUSE_TRANSMISSION_BITS, DIFFUSE_TRANSMISSION_BITS, \
          diffuse_transmission, number, 0) \
    X(76, diffuse_transmission_color, 3, absolute, color, ratio, both, \
          "colour of diffuse transmission, with its volume's absorption, linear Rec.709; 0 without it", \
          surface, 304, root, DIFFUSE_TRANSMISSION_COLOR_BITS, DIFFUSE_TRANSMISSION_COLOR_BITS, \
          diffuse_transmission, color, 0)
// clang-format on

// channel  slot (SLOT_* of material.h)  component: the texels that change a channel, each times the
// material's factor of the slot. rgb: all three. texel_ranges.cpp has what materials combine otherwise.
// clang-format off
#define CHANNEL_TEXELS(X)                      \
    X(albedo,              base_color,          rgb) \
    X(specular,            base_color,          rgb) \
    X(roughness,           metallic_roughness,  g)   \
    X(metallic,            metallic_roughness,  b)   \
    X(specular,            metallic_roughness,  b)   \
    X(normals,             normal,              rgb) \
    X(tangent_normal,      normal,              rgb) \
    X(occlusion,           occlusion,           r)   \
    X(emission,            emissive,            rgb) \
    X(dielectric_f90,      specular,            a)   \
    X(dielectric_f0,       specular,            a)   \
    X(specular,            specular,            a)   \
    X(dielectric_f0,       specular_color,      rgb) \
    X(specular,            specular_color,      rgb) \
    X(lightmap,            lightmap,            rgb) \
    X(clearcoat,           clearcoat,           r)   \
    X(clearcoat_roughness, clearcoat_roughness, g)   \
    X(clearcoat_normal,    clearcoat_normal,    rgb) \
    X(anisotropy,          anisotropy,          b)   \
    X(anisotropy_direction, anisotropy,         rg)  \
    X(sheen_color,         sheen_color,         rgb) \
    X(sheen_roughness,     sheen_roughness,     a)   \
    X(iridescence,         iridescence,         r)   \
    X(iridescence_thickness, iridescence_thickness, g) \
    X(transmission,        transmission,        r)   \
    X(transmission_thickness, thickness,        g)   \
    X(diffuse_transmission, diffuse_transmission, a) \
    X(diffuse_transmission_color, diffuse_transmission_color, rgb)
// clang-format on

// name  image  component  value: where captures store a channel, and which value, without a colour map.
// Captures render images of four components; component is the channel's first. Images below FIRST_LIT_IMAGE
// do not depend on lights, so no light is evaluated for them. The channel at component 0 of an image is
// listed first.
// value is an expression of capture() in shaders/lib/surface/capture.glsl, a float or a vector of the
// channel's width.
// lit has an image of its own because it is blended into. lit_transmission follows it, to be drawn in the
// same pass: light through a surface is that of opaque surfaces' lit. So has shaded_samples, which takes the
// largest sample instead of the first.
// clang-format off
#define CAPTURES(X)                                                     \
    X(albedo,                      0, 0, s.albedo)                      \
    X(metallic,                    0, 3, s.metallic)                    \
    X(normals,                     1, 0, s.normal)                      \
    X(roughness,                   1, 3, s.roughness)                   \
    X(emission,                    2, 0, s.emission)                    \
    X(occlusion,                   2, 3, s.occlusion)                   \
    X(specular,                    3, 0, specularF0(s))                 \
    X(material_id,                 3, 3, float(s.material_id))          \
    X(position,                    4, 0, s.position)                    \
    X(depth,                       4, 3, viewDepth(z))                  \
    X(geometric_normal,            5, 0, s.triangle_normal)             \
    X(dielectric_f90,              5, 3, s.dielectric_f90)              \
    X(lightmap,                    6, 0, s.lightmap)                    \
    X(light_count,                 6, 3, float(lightCount(lights)))     \
    X(dielectric_f0,               7, 0, s.dielectric_f0)               \
    X(list_overflow,               7, 3, float(listOverflowed(lights))) \
    X(texcoords,                   8, 0, s.texcoord)                    \
    X(cascade,                     8, 2, cascadeIndex(s.position))      \
    X(page_residency,              8, 3, pageResidency(s.position))     \
    X(tangent,                     9, 0, s.tangent)                     \
    X(handedness,                  9, 3, s.handedness)                  \
    X(tangent_normal,             10, 0, s.tangent_normal)              \
    X(lightmapped,                10, 3, float(s.lightmapped))          \
    X(clearcoat_normal,           11, 0, s.clearcoat_normal)            \
    X(clearcoat,                  11, 3, s.clearcoat)                   \
    X(anisotropy_direction,       12, 0, anisotropyDirection(s))        \
    X(anisotropy,                 12, 3, s.anisotropy)                  \
    X(sheen_color,                13, 0, s.sheen_color)                 \
    X(sheen_roughness,            13, 3, s.sheen_roughness)             \
    X(clearcoat_roughness,        14, 0, s.clearcoat_roughness)         \
    X(iridescence,                14, 1, s.iridescence)                 \
    X(iridescence_ior,            14, 2, s.iridescence_ior)             \
    X(iridescence_thickness,      14, 3, s.iridescence_thickness)       \
    X(attenuation_color,          15, 0, s.attenuation_color)           \
    X(attenuation_distance,       15, 3, s.attenuation_distance)        \
    X(transmission,               16, 0, s.transmission)                \
    X(transmission_thickness,     16, 1, s.thickness)                   \
    X(dispersion,                 16, 2, s.dispersion)                  \
    X(diffuse_transmission_color, 17, 0, s.diffuse_transmission_color)  \
    X(diffuse_transmission,       17, 3, s.diffuse_transmission)        \
    X(shaded_samples,             18, 0, float(shaded))                 \
    X(lit,                        19, 0, lit(radiance))                 \
    X(lit_transmission,           20, 0, radiance.transmission)         \
    X(lit_diffuse,                21, 0, radiance.diffuse)              \
    X(shadow_visibility,          21, 3, radiance.sun_visibility)       \
    X(lit_specular,               22, 0, radiance.specular)             \
    X(local_visibility,           22, 3, localVisibility(radiance))     \
    X(lit_ambient,                23, 0, radiance.ambient)              \
    X(lit_haze,                   24, 0, radiance.haze)                 \
    X(transmittance,              25, 0, radiance.transmittance)        \
    X(lit_environment,            26, 0, radiance.environment)          \
    X(lit_clearcoat,              27, 0, radiance.clearcoat)            \
    X(lit_sheen,                  28, 0, radiance.sheen)
// clang-format on

CONTRACT_BEGIN
CONTRACT_CONST(uint, CAPTURE_IMAGES, 29);
CONTRACT_CONST(uint, FIRST_LIT_IMAGE, 19);
// Set in FEATURE_captures if shadow_visibility is the only channel of lit images: no light is evaluated.
CONTRACT_CONST(uint, CAPTURES_UNLIT, 0x80000000u);

#define DIPTYCH_DEBUG_NUMBER(number, name, width, errorKind, kind, domain, supported_by, shows, stage, step, \
                             code, standard, compact, part, texels, related)                                 \
    CONTRACT_CONST(uint, DEBUG_##name, number);
DEBUG_MODES(DIPTYCH_DEBUG_NUMBER)
#undef DIPTYCH_DEBUG_NUMBER
CONTRACT_END

#endif
