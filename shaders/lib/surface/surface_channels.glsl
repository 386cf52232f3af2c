// SPDX-License-Identifier: MIT
// Makes a Surface from the channels of SURFACE_CHANNELS, float32 images of the frame's size.
#ifndef SURFACE_CHANNELS_GLSL
#define SURFACE_CHANNELS_GLSL

#include "shaders/lib/contract.glsl"
#include "shaders/lib/surface/octahedral.glsl"
#include "shaders/lib/surface/surface.glsl"
#include "shared/contract/surface_channels.h"

#define CHANNEL_IMAGE(number, name) \
    layout(set = SET_GBUFFER, binding = number) uniform texture2D channel_##name;
SURFACE_CHANNELS(CHANNEL_IMAGE)
// The Surface stores the direction of highlights as a turn about its normal, the channel as a vector.
#define channel_anisotropy_turn channel_anisotropy_direction

Surface surfaceFromChannels(const ivec2 p) {
    Surface s = bareSurface(texelFetch(channel_position, p, 0).xyz);
    s.normal = texelFetch(channel_normals, p, 0).xyz;
    vec4 geometric_normal = texelFetch(channel_geometric_normal, p, 0);
    s.triangle_normal = geometric_normal.xyz;
    uint bits = uint(geometric_normal.w);
    s.geometric_normal = bits == 0u ? s.triangle_normal
                                    : decodeOctahedral(encodeOctahedral(s.triangle_normal, bits), bits);
    vec4 lightmap = texelFetch(channel_lightmap, p, 0);
    s.lightmap = lightmap.rgb;
    s.lightmapped = lightmap.a > 0.0;
#define FETCH_float(channel) texelFetch(channel, p, 0).r
#define FETCH_vec2(channel) turnOf(texelFetch(channel, p, 0).xyz, s.normal)
#define FETCH_vec3(channel) texelFetch(channel, p, 0).rgb
#define FETCH(type, name) s.name = FETCH_##type(channel_##name);
    FETCH(vec3, albedo) FETCH(float, metallic) FETCH(float, roughness) FETCH(float, occlusion)
    FETCH(vec3, emission) FETCH(vec3, dielectric_f0) FETCH(float, dielectric_f90)
#define FETCH_LAYER(layer, packed, values) \
    if (hasLayer(LAYER_##layer)) { values(FETCH) }
    STORED_LAYERS(FETCH_LAYER)
    return s;
}

#endif
