// SPDX-License-Identifier: MIT
// G-buffer layouts. Every attachment stores unsigned integers that the shader packs itself. So the
// device's rounding on writes to a render target has no effect (lavapipe truncates halves), and forward+
// can compute exactly what deferred will read.
//
//               compact                       standard                        full
//   albedo    R32  sqrt 8.8.8, occl. 8     R32  sqrt 8.8.8, occl. 8        RGBA32 albedo, occlusion
//   normals   R32  oct 12.12, rough. 8     RG32 oct 16.16, geom. 16.16     RGBA32 normal, roughness
//   params    R32  geom. oct 8.8,          R32  roughness 12,              RGBA32 geom. normal, metallic
//                  metallic 6, id 10            metallic 8, id 12
//   emission  R32  9.9.9.e5                R32  9.9.9.e5                   RGBA32 emission, id
//   specular  R32  sqrt 8.8.8, F90 8       R32  sqrt 8.8.8, F90 8          RGBA32 dielectric F0, F90
//   ids       R32  (only if 10 bits            R32  (only if 12 bits
//                   are too few)                   are too few)
//   lightmap  R32  9.9.9.e5                R32  9.9.9.e5                   RGBA32 lightmap
//   layers    words in LAYERS to LAYERS_5, four each, only for what materials have:
//               clear coat: oct 16.16; weight 12, roughness 12, bit 28     normal, weight, roughness
//               anisotropy: strength 12, angle 16, bit 28                  strength, direction 2
//               sheen: sqrt 8.8.8, roughness 8                             colour, roughness
//               iridescence: weight 8, ior 9, thickness 15                 weight, ior, thickness
//               diffuse transmission: sqrt 8.8.8, weight 8                 colour, weight
//   shaded    RG32 shading depth (bits of a float) and sample mask (MSAA only)
//   bytes     12 to 48, + 4 depth          16 to 52, + 4 depth             64 to 176, + 4 depth
//
// sqrt: the square root is stored, so 0.04, the default F0, is exactly 51/255.
// emission exists if the scene emits light; full always has it, because it stores the id. It is RGBA32
// float if radiance exceeds the range of 9.9.9.e5.
// lightmap exists if a material has one, in the same formats. It is 0 on surfaces without a lightmap;
// shaders/lib/surface/gbuffer.glsl distinguishes them from black.
// Bit 28 says that the surface has the layer; other layers that the surface lacks are words of 0.
// specular exists if a material has KHR_materials_specular, _ior, _pbrSpecularGlossiness or _unlit.
// With MSAA every attachment is multisampled. shaded then stores where the surface was evaluated in the
// pixel: the mean location of the samples that its triangle covers, and the depth there.
// If there are more than MAX_COLOR_ATTACHMENTS, a second pass draws the last layers.
#ifndef DIPTYCH_CONTRACT_GBUFFER_H
#define DIPTYCH_CONTRACT_GBUFFER_H

#include "types.h"

// Attachments. Deferred lighting reads them as SET_GBUFFER at these bindings.
// number  name  kind  display name
// clang-format off
#define GBUFFER_BINDINGS(X)                  \
    X(0, ALBEDO,   fetched_image, "albedo")          \
    X(1, NORMALS,  fetched_image, "normals")         \
    X(2, PARAMS,   fetched_image, "params")          \
    X(3, EMISSION, fetched_image, "emission")        \
    X(4, SPECULAR, fetched_image, "specular")        \
    X(5, IDS,      fetched_image, "material ids")    \
    X(6, LIGHTMAP, fetched_image, "lightmap")        \
    X(7, LAYERS,   fetched_image, "layers")          \
    X(8, LAYERS_2, fetched_image, "layers 2")        \
    X(9, LAYERS_3, fetched_image, "layers 3")        \
    X(10, LAYERS_4, fetched_image, "layers 4")       \
    X(11, LAYERS_5, fetched_image, "layers 5")       \
    X(12, SHADED,   fetched_image, "shaded sample locations")
// clang-format on

CONTRACT_BEGIN

CONTRACT_CONST(uint, GBUFFER_compact, 0);
CONTRACT_CONST(uint, GBUFFER_standard, 1);
CONTRACT_CONST(uint, GBUFFER_full, 2);

#define DIPTYCH_GBUFFER_NUMBER(number, name, kind, what) CONTRACT_CONST(uint, GBUFFER_##name, number);
GBUFFER_BINDINGS(DIPTYCH_GBUFFER_NUMBER)
#undef DIPTYCH_GBUFFER_NUMBER
#define DIPTYCH_GBUFFER_ONE(number, name, kind, what) +1
CONTRACT_CONST(uint, GBUFFER_ATTACHMENTS, 0 GBUFFER_BINDINGS(DIPTYCH_GBUFFER_ONE));
#undef DIPTYCH_GBUFFER_ONE
// Most colour attachments of a pass, captures included; device_support.h requires as many.
CONTRACT_CONST(uint, MAX_COLOR_ATTACHMENTS, 8);
CONTRACT_CONST(uint, BINDING_DEPTH, GBUFFER_ATTACHMENTS);  // of SET_GBUFFER: an image, after the
                                                           // attachments

// Bits of each packed field by encoding. Tolerances are derived from these.
CONTRACT_CONST(uint, ALBEDO_BITS, 8);
CONTRACT_CONST(uint, OCCLUSION_BITS, 8);
CONTRACT_CONST(uint, SPECULAR_BITS, 8);
CONTRACT_CONST(uint, COMPACT_NORMAL_BITS, 12);
CONTRACT_CONST(uint, COMPACT_GEOMETRIC_NORMAL_BITS, 8);
CONTRACT_CONST(uint, COMPACT_ROUGHNESS_BITS, 8);
CONTRACT_CONST(uint, COMPACT_METALLIC_BITS, 6);
CONTRACT_CONST(uint, COMPACT_ID_BITS, 10);
CONTRACT_CONST(uint, STANDARD_NORMAL_BITS, 16);
CONTRACT_CONST(uint, STANDARD_ROUGHNESS_BITS, 12);
CONTRACT_CONST(uint, STANDARD_METALLIC_BITS, 8);
CONTRACT_CONST(uint, STANDARD_ID_BITS, 12);
CONTRACT_CONST(uint, EMISSION_MANTISSA_BITS, 9);
// Layers have the same bits in both packed encodings.
CONTRACT_CONST(uint, CLEARCOAT_BITS, 12);
CONTRACT_CONST(uint, CLEARCOAT_ROUGHNESS_BITS, 12);
CONTRACT_CONST(uint, CLEARCOAT_NORMAL_BITS, 16);
CONTRACT_CONST(uint, ANISOTROPY_BITS, 12);
// The direction is an angle in [0, pi) about the decoded normal: highlights stretch both ways.
CONTRACT_CONST(uint, ANISOTROPY_ANGLE_BITS, 16);
CONTRACT_CONST(uint, SHEEN_BITS, 8);  // of the roots of its colour, and of its roughness
CONTRACT_CONST(uint, IRIDESCENCE_BITS, 8);
// (ior - 1) / (ior + 1), 0 to 1; code 0: no film, so codes from 1 count.
CONTRACT_CONST(uint, IRIDESCENCE_IOR_BITS, 9);
// A half without its sign: 10 bits of mantissa from 2^-14 to 65504 nm.
CONTRACT_CONST(uint, IRIDESCENCE_THICKNESS_BITS, 15);
CONTRACT_CONST(uint, DIFFUSE_TRANSMISSION_BITS, 8);  // of the roots of its colour, and of its weight

// Words of each layer by encoding; they follow each other in the order of LAYER_*.
CONTRACT_CONST(uint, CLEARCOAT_WORDS, 2);
CONTRACT_CONST(uint, ANISOTROPY_WORDS, 1);
CONTRACT_CONST(uint, SHEEN_WORDS, 1);
CONTRACT_CONST(uint, IRIDESCENCE_WORDS, 1);
CONTRACT_CONST(uint, DIFFUSE_TRANSMISSION_WORDS, 1);
CONTRACT_CONST(uint, CLEARCOAT_FULL_WORDS, 5);
CONTRACT_CONST(uint, ANISOTROPY_FULL_WORDS, 3);
CONTRACT_CONST(uint, SHEEN_FULL_WORDS, 4);
CONTRACT_CONST(uint, IRIDESCENCE_FULL_WORDS, 3);
CONTRACT_CONST(uint, DIFFUSE_TRANSMISSION_FULL_WORDS, 4);
CONTRACT_CONST(uint, LAYER_WORDS, 20);  // of LAYERS to LAYERS_5

// Largest component of 9.9.9.e5: (511 / 512) * 2^16 (EXT_texture_shared_exponent).
CONTRACT_CONST(float, EMISSION_MAX, 65408.0f);
// Smallest value of the largest component that keeps all nine bits: 2^-15.
CONTRACT_CONST(float, EMISSION_MIN, 3.0517578125e-5f);

CONTRACT_END

#endif
