// SPDX-License-Identifier: MIT
// Descriptor sets and bindings, one table per set. C++ expands a table to descriptor types. A test
// compares the GLSL declarations in the compiled modules with the tables.
#ifndef DIPTYCH_CONTRACT_BINDINGS_H
#define DIPTYCH_CONTRACT_BINDINGS_H

#include "gbuffer.h"
#include "samples.h"
#include "surface_channels.h"
#include "transparency.h"
#include "types.h"

CONTRACT_BEGIN

CONTRACT_CONST(uint, SET_FRAME, 0);         // read by every pass of a frame
CONTRACT_CONST(uint, SET_MATERIAL, 1);      // one material: textures at SLOT_*, then its factors
CONTRACT_CONST(uint, SET_LISTS, 1);         // compute shaders that build light lists: light_list.h
CONTRACT_CONST(uint, SET_GBUFFER, 2);       // deferred lighting: GBUFFER_SET_BINDINGS
CONTRACT_CONST(uint, SET_PARTIAL_SUMS, 3);  // sums of the preceding light batches

CONTRACT_END

// number  name  kind  contents
//   kind  uniform_buffer, storage_buffer, texel_buffer (read as a sampler buffer), image (with its sampler),
//         fetched_image (read by texel, without a sampler)
// clang-format off
#define FRAME_BINDINGS(X)                                                                     \
    X(0,  VIEW,         uniform_buffer, "View")                                               \
    X(1,  LIGHT_GRID,   uniform_buffer, "LightGrid")                                          \
    X(2,  LIGHTS,       texel_buffer,   "Light[], two texels each")                           \
    X(3,  SPOT_CONES,   texel_buffer,   "SpotCone[], two texels each")                        \
    X(4,  AREA_LIGHTS,  texel_buffer,   "AreaLight[], three texels each")                     \
    X(5,  LTC_TABLE,    image,          "ltc.h")                                              \
    X(6,  LIST_HEADS,   texel_buffer,   "LightListHead[lists + 1], a texel each")             \
    X(7,  LIST_INDICES, texel_buffer,   "uint[]: light indices, one list entry per texel")    \
    X(8,  LIST_COUNTS,  storage_buffer, "uint[2 lists + 1]: light_list.h")                    \
    X(9,  ALBEDO,       texel_buffer,   "vec4[]: each sample of albedo.h with the next one")      \
    X(10, OBJECT_LIST,  storage_buffer, "ObjectLight[]")                                      \
    X(11, OBJECTS,      storage_buffer, "ObjectLights[draws]")                                \
    X(12, VIEW_TEXELS,  texel_buffer,   "PACKED_VIEW")                                        \
    X(13, SHADOW_LIGHT, texel_buffer,   "ShadowLight, eight texels, then Cascade[], clipmap.h") \
    X(14, SHADOW_MAP,   image,          "depth or moments of the cascades, a layer each; pages") \
    X(15, LOCAL_SHADOW_LIGHTS, texel_buffer, "LocalCasters, then nine texels a light")        \
    X(16, LOCAL_SHADOW_MAP, image,      "depth in the tiles of local lights, an array of one layer") \
    X(17, ENVIRONMENT,      texel_buffer, "offsets of its maps, and its harmonics: environment.h")   \
    X(18, ENVIRONMENT_MAPS, image,      "octahedral maps, RGBA32F, W/(sr m^2)")                      \
    X(19, SKY,              image,      "the environment, lat-long, RGBA32F, W/(sr m^2)") \
    X(20, HAZE,             texel_buffer, "Haze, five texels, then HazeMarch, three: haze.h")

#define GBUFFER_SET_BINDINGS(X)                                                               \
    GBUFFER_BINDINGS(X) DEPTH_BINDING(X) TRANSPARENCY_BINDINGS(X) SAMPLE_BINDINGS(X)          \
    CHANNEL_BINDINGS(X) BACKDROP_BINDINGS(X)

#define PARTIAL_SUM_BINDINGS(X)                                                               \
    X(0, PARTIAL_DIFFUSE,   fetched_image, "RGBA32F, W/(sr m^2)")                             \
    X(1, PARTIAL_SPECULAR,  fetched_image, "RGBA32F, W/(sr m^2)")                             \
    X(2, PARTIAL_CLEARCOAT, fetched_image, "RGBA32F, W/(sr m^2); the clear coat's part of the specular sum") \
    X(3, PARTIAL_SHEEN,     fetched_image, "RGBA32F, W/(sr m^2); the sheen's part of the specular sum") \
    X(4, PARTIAL_TRANSMISSION, fetched_image, "RGBA32F, W/(sr m^2); the part of the diffuse sum from behind")
// clang-format on

CONTRACT_BEGIN
FRAME_BINDINGS(CONTRACT_BINDING)
PARTIAL_SUM_BINDINGS(CONTRACT_BINDING)
CONTRACT_END

#endif
