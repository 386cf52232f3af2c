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

Surface surfaceFromChannels(const ivec2 p) {
    Surface s;
    s.position = texelFetch(channel_position, p, 0).xyz;
    s.normal = texelFetch(channel_normals, p, 0).xyz;
    vec4 geometric_normal = texelFetch(channel_geometric_normal, p, 0);
    s.triangle_normal = geometric_normal.xyz;
    uint bits = uint(geometric_normal.w);
    s.geometric_normal = bits == 0u ? s.triangle_normal
                                    : decodeOctahedral(encodeOctahedral(s.triangle_normal, bits), bits);
    s.albedo = texelFetch(channel_albedo, p, 0).rgb;
    s.metallic = texelFetch(channel_metallic, p, 0).r;
    s.roughness = texelFetch(channel_roughness, p, 0).r;
    s.occlusion = texelFetch(channel_occlusion, p, 0).r;
    s.emission = texelFetch(channel_emission, p, 0).rgb;
    vec4 lightmap = texelFetch(channel_lightmap, p, 0);
    s.lightmap = lightmap.rgb;
    s.lightmapped = lightmap.a > 0.0;
    s.dielectric_f0 = texelFetch(channel_dielectric_f0, p, 0).rgb;
    s.dielectric_f90 = texelFetch(channel_dielectric_f90, p, 0).r;
    removeLayers(s);
    if (hasLayer(LAYER_CLEARCOAT)) {
        s.clearcoat = texelFetch(channel_clearcoat, p, 0).r;
        s.clearcoat_roughness = texelFetch(channel_clearcoat_roughness, p, 0).r;
        s.clearcoat_normal = texelFetch(channel_clearcoat_normal, p, 0).xyz;
    }
    if (hasLayer(LAYER_ANISOTROPY)) {
        s.anisotropy = texelFetch(channel_anisotropy, p, 0).r;
        s.anisotropy_turn = turnOf(texelFetch(channel_anisotropy_direction, p, 0).xyz, s.normal);
    }
    if (hasLayer(LAYER_SHEEN)) {
        s.sheen_color = texelFetch(channel_sheen_color, p, 0).rgb;
        s.sheen_roughness = texelFetch(channel_sheen_roughness, p, 0).r;
    }
    if (hasLayer(LAYER_IRIDESCENCE)) {
        s.iridescence = texelFetch(channel_iridescence, p, 0).r;
        s.iridescence_ior = texelFetch(channel_iridescence_ior, p, 0).r;
        s.iridescence_thickness = texelFetch(channel_iridescence_thickness, p, 0).r;
    }
    if (hasLayer(LAYER_DIFFUSE_TRANSMISSION)) {
        s.diffuse_transmission = texelFetch(channel_diffuse_transmission, p, 0).r;
        s.diffuse_transmission_color = texelFetch(channel_diffuse_transmission_color, p, 0).rgb;
    }
    s.material_id = 0u;
    s.texcoord = vec2(0.0);
    s.tangent = vec3(0.0);
    s.handedness = 0.0;
    s.tangent_normal = vec3(0.0);
    s.object_irradiance = vec3(0.0);
    return s;
}

#endif
