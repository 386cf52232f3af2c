// SPDX-License-Identifier: MIT
// G-buffer layouts. Every attachment stores unsigned integers that the shader packs itself. So the
// device's rounding on writes to a render target has no effect (lavapipe truncates halves), and forward+
// can compute exactly what deferred will read.
//
// compact and standard store GBUFFER_WORDS: one in each attachment, both normals of standard in NORMALS, and
// the words of layers one after the other. full stores float32:
//   albedo    albedo, occlusion                 specular  dielectric F0, F90
//   normals   normal, roughness                 emission  emission, id
//   params    geometric normal, metallic        lightmap  lightmap, 1
//   layers    the values of STORED_LAYERS
//
// emission exists if the scene emits light; full always has it, because it stores the id. Radiance beyond
// the range of its word is RGBA32 float. lightmap exists if a material has one, in the same formats. It is
// 0 on surfaces without a lightmap; shaders/lib/surface/gbuffer.glsl distinguishes them from black.
// specular exists if a material has KHR_materials_specular, _ior, _pbrSpecularGlossiness or _unlit.
// ids exists if a packed id has too few bits.
// layers to layers 5 have up to four words each, only for what materials have. A layer that the surface lacks
// is words of 0.
// shaded exists with MSAA, when every attachment is multisampled. It stores the mask of samples that the
// triangle covers, the mask of those that alpha keeps, and the depth (float32) at the covered samples' mean
// location, where the surface was evaluated.
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
// Binding of SET_GBUFFER after the attachments.
#define DEPTH_BINDING(X) X(13, DEPTH, fetched_image, "depth")
// clang-format on

// Words of the packed encodings, and the bits of their fields, from the lowest bit. The first field has n
// components, each of so many bits. From these numbers follow encoder, decoder and tolerances, and which
// values need an attachment of their own or float32.
// word  n  field  bits  ...
//   Colours are square roots, so 0.04, the default F0, is exactly 51/255. Normals are octahedral.
//   Radiance is that of EXT_texture_shared_exponent, 9.9.9.e5.
//   ANISOTROPY_ANGLE: in [0, pi) about the decoded normal, because highlights stretch both ways.
//   IRIDESCENCE_IOR: (ior - 1) / (ior + 1), 0 to 1; code 0: no film, so codes from 1 count.
//   IRIDESCENCE_THICKNESS: nm, a half without its sign.
//   CLEARCOAT_THERE, ANISOTROPY_THERE: 1 if the surface has the layer.
//   Ids, exponents and the thickness are read without a mask: they are the last fields of their words.
// clang-format off
#define GBUFFER_WORDS(ONE, TWO, THREE)                                                                   \
    TWO(albedo, 3, ALBEDO, 8, OCCLUSION, 8)                                                              \
    TWO(specular, 3, SPECULAR, 8, SPECULAR_F90, 8)                                                       \
    TWO(radiance, 3, EMISSION_MANTISSA, 9, EMISSION_EXPONENT, 5)                                         \
    TWO(compact_normals, 2, COMPACT_NORMAL, 12, COMPACT_ROUGHNESS, 8)                                    \
    THREE(compact_params, 2, COMPACT_GEOMETRIC_NORMAL, 8, COMPACT_METALLIC, 6, COMPACT_ID, 10)           \
    ONE(standard_normals, 2, STANDARD_NORMAL, 16)                                                        \
    ONE(standard_geometric_normals, 2, STANDARD_GEOMETRIC_NORMAL, 16)                                    \
    THREE(standard_params, 1, STANDARD_ROUGHNESS, 12, STANDARD_METALLIC, 8, STANDARD_ID, 12)             \
    ONE(clearcoat_normal, 2, CLEARCOAT_NORMAL, 16)                                                       \
    THREE(clearcoat, 1, CLEARCOAT, 12, CLEARCOAT_ROUGHNESS, 12, CLEARCOAT_THERE, 1)                      \
    THREE(anisotropy, 1, ANISOTROPY, 12, ANISOTROPY_ANGLE, 16, ANISOTROPY_THERE, 1)                      \
    TWO(sheen, 3, SHEEN_COLOR, 8, SHEEN_ROUGHNESS, 8)                                                    \
    THREE(iridescence, 1, IRIDESCENCE, 8, IRIDESCENCE_IOR, 9, IRIDESCENCE_THICKNESS, 15)                 \
    TWO(diffuse_transmission, 3, DIFFUSE_TRANSMISSION_COLOR, 8, DIFFUSE_TRANSMISSION, 8)

// Values of each layer in a Surface (shaders/lib/surface/surface.glsl), 0 without the layer. Each is the
// channel of the same name; anisotropy_turn is the channel anisotropy_direction.
// type  name
#define CLEARCOAT_VALUES(X)                                                                           \
    X(vec3, clearcoat_normal)             /* unit, shading */                                         \
    X(float, clearcoat)                   /* weight */                                                \
    X(float, clearcoat_roughness)         /* perceptual */
#define ANISOTROPY_VALUES(X)                                                                          \
    X(float, anisotropy)                  /* strength */                                              \
    X(vec2, anisotropy_turn)              /* of highlights from axesAcross(normal): cosine, sine */
#define SHEEN_VALUES(X)                                                                               \
    X(vec3, sheen_color)                  /* linear Rec.709 */                                        \
    X(float, sheen_roughness)             /* perceptual */
#define IRIDESCENCE_VALUES(X)                                                                         \
    X(float, iridescence)                 /* weight of the film */                                    \
    X(float, iridescence_ior)                                                                         \
    X(float, iridescence_thickness)       /* nm */
#define DIFFUSE_TRANSMISSION_VALUES(X)                                                                \
    X(vec3, diffuse_transmission_color)   /* linear Rec.709 */                                        \
    X(float, diffuse_transmission)        /* weight */

// Layers in the order of their words, that of LAYER_*: words in packed encodings; values. A float32 G-buffer
// stores the values' components.
#define STORED_LAYERS(X)                   \
    X(CLEARCOAT, 2, CLEARCOAT_VALUES)      \
    X(ANISOTROPY, 1, ANISOTROPY_VALUES)    \
    X(SHEEN, 1, SHEEN_VALUES)              \
    X(IRIDESCENCE, 1, IRIDESCENCE_VALUES)  \
    X(DIFFUSE_TRANSMISSION, 1, DIFFUSE_TRANSMISSION_VALUES)
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
DEPTH_BINDING(CONTRACT_BINDING)

// FIELD_BITS, and FIELD_SHIFT, the lowest bit of fields after the first.
#define DIPTYCH_ONE(word, n, a, a_bits)     \
    CONTRACT_CONST(uint, a##_BITS, a_bits); \
    CONTRACT_WORD(word, (n)*a##_BITS);
#define DIPTYCH_NEXT(word, shift, field, bits)  \
    CONTRACT_CONST(uint, field##_BITS, bits);   \
    CONTRACT_CONST(uint, field##_SHIFT, shift); \
    CONTRACT_WORD(word, field##_SHIFT + field##_BITS);
#define DIPTYCH_TWO(word, n, a, a_bits, b, b_bits) \
    DIPTYCH_ONE(word, n, a, a_bits)                \
    DIPTYCH_NEXT(word, (n)*a##_BITS, b, b_bits)
#define DIPTYCH_THREE(word, n, a, a_bits, b, b_bits, c, c_bits) \
    DIPTYCH_TWO(word, n, a, a_bits, b, b_bits)                  \
    DIPTYCH_NEXT(word, b##_SHIFT + b##_BITS, c, c_bits)
GBUFFER_WORDS(DIPTYCH_ONE, DIPTYCH_TWO, DIPTYCH_THREE)
#undef DIPTYCH_ONE
#undef DIPTYCH_TWO
#undef DIPTYCH_THREE
#undef DIPTYCH_NEXT

CONTRACT_CONST(uint, WORDS_float, 1);
CONTRACT_CONST(uint, WORDS_vec2, 2);
CONTRACT_CONST(uint, WORDS_vec3, 3);
#define DIPTYCH_WORDS(type, name) +WORDS_##type
#define DIPTYCH_LAYER(layer, packed, values)     \
    CONTRACT_CONST(uint, layer##_WORDS, packed); \
    CONTRACT_CONST(uint, layer##_FULL_WORDS, 0 values(DIPTYCH_WORDS));
STORED_LAYERS(DIPTYCH_LAYER)
#undef DIPTYCH_LAYER
#undef DIPTYCH_WORDS
CONTRACT_CONST(uint, LAYER_WORDS, 4 * (GBUFFER_SHADED - GBUFFER_LAYERS));

// An exponent's code 0 stands for 2^-EMISSION_BIAS.
CONTRACT_CONST(uint, EMISSION_BIAS, (1u << (EMISSION_EXPONENT_BITS - 1u)) - 1u);
// Largest component: (511 / 512) * 2^16 with 9 bits of mantissa and 5 of exponent.
CONTRACT_CONST(float, EMISSION_MAX,
               float((1u << EMISSION_MANTISSA_BITS) - 1u) / float(1u << EMISSION_MANTISSA_BITS) * 2.0f *
                   float(1u << EMISSION_BIAS));
// Smallest value of the largest component that keeps every bit of its mantissa, 2^-15.
CONTRACT_CONST(float, EMISSION_MIN, 1.0f / float(1u << EMISSION_BIAS));
// Bits of a thickness's exponent, as a half has.
CONTRACT_CONST(uint, HALF_EXPONENT_BITS, 5);

CONTRACT_END

#endif
