// SPDX-License-Identifier: MIT
// The channels that make a Surface: what lights meet at a pixel is a function of them alone. Deferred
// lighting of channels (shaders/pass/deferred_channels.frag) reads them as float32 images in the places of a
// G-buffer, so that a channel is swapped for another picture's by binding another image.
#ifndef DIPTYCH_CONTRACT_SURFACE_CHANNELS_H
#define DIPTYCH_CONTRACT_SURFACE_CHANNELS_H

#include "types.h"

// number of the binding of SET_GBUFFER, where another table has an image as well; name of the debug mode.
// Fourth components: of lightmap the channel lightmapped; of geometric_normal the bits per coordinate that
// lighting quantises it to, 0: none.
// clang-format off
#define SURFACE_CHANNELS(X)  \
    X(0,  albedo)            \
    X(1,  normals)           \
    X(2,  metallic)          \
    X(3,  roughness)         \
    X(4,  emission)          \
    X(5,  occlusion)         \
    X(6,  lightmap)          \
    X(7,  geometric_normal)  \
    X(9,  position)          \
    X(10, dielectric_f0)     \
    X(11, dielectric_f90)
// clang-format on

CONTRACT_BEGIN

#define DIPTYCH_SURFACE_CHANNEL_BINDING(number, name) CONTRACT_CONST(uint, SURFACE_CHANNEL_##name, number);
SURFACE_CHANNELS(DIPTYCH_SURFACE_CHANNEL_BINDING)
#undef DIPTYCH_SURFACE_CHANNEL_BINDING

CONTRACT_END

#endif
