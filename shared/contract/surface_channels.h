// SPDX-License-Identifier: MIT
// Channels that define a Surface: the lighting of a pixel depends on them alone. Deferred lighting of
// channels (shaders/pass/deferred_channels.frag) binds them as float32 images in place of a G-buffer. To
// substitute a channel of another image, bind that image.
#ifndef DIPTYCH_CONTRACT_SURFACE_CHANNELS_H
#define DIPTYCH_CONTRACT_SURFACE_CHANNELS_H

// Binding of SET_GBUFFER, which another table may use for its own image; name of the debug mode. Fourth
// components: of lightmap the channel lightmapped; of geometric_normal the bits per coordinate that lighting
// quantizes it to, 0: none.
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
    X(8,  position)          \
    X(9,  dielectric_f0)     \
    X(10, dielectric_f90)    \
    X(11, clearcoat)         \
    X(12, clearcoat_roughness) \
    X(14, clearcoat_normal)  \
    X(15, anisotropy)        \
    X(23, anisotropy_direction) \
    X(24, sheen_color)       \
    X(25, sheen_roughness)   \
    X(26, iridescence)       \
    X(27, iridescence_ior)   \
    X(28, iridescence_thickness) \
    X(29, diffuse_transmission) \
    X(30, diffuse_transmission_color)

// Bindings of SET_GBUFFER after those of samples, for channels alone.
#define CHANNEL_BINDINGS(X)                                      \
    X(23, CHANNEL_1, fetched_image, "a channel of a surface")    \
    X(24, CHANNEL_2, fetched_image, "a channel of a surface")    \
    X(25, CHANNEL_3, fetched_image, "a channel of a surface")    \
    X(26, CHANNEL_4, fetched_image, "a channel of a surface")    \
    X(27, CHANNEL_5, fetched_image, "a channel of a surface")    \
    X(28, CHANNEL_6, fetched_image, "a channel of a surface")    \
    X(29, CHANNEL_7, fetched_image, "a channel of a surface")    \
    X(30, CHANNEL_8, fetched_image, "a channel of a surface")
// clang-format on

#endif
