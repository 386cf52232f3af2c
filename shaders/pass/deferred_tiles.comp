// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

// Classifies tiles of deferred lighting by the layers that the G-buffer stores there: one workgroup per tile.
#include "shaders/lib/surface/gbuffer_read.glsl"

layout(local_size_x = LIGHTING_GROUP, local_size_y = LIGHTING_GROUP) in;
layout(push_constant, scalar) uniform TileBlock { TileConstants constants; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer TileClasses { uint at[]; };

shared uint layered;

void main() {
    if (gl_LocalInvocationIndex == 0u) layered = 0u;
    barrier();
    ivec2 size = multisampled() ? textureSize(gbuffer_LAYERS_samples) : textureSize(gbuffer_LAYERS, 0);
    uint across = LIGHTING_TILE / LIGHTING_GROUP, i = 0u;
    uint bits = 0u;
    do {
        uvec2 inside = uvec2(i % across, i / across) * LIGHTING_GROUP + gl_LocalInvocationID.xy;
        // Pixels beyond the image's edge repeat the last one, which is in the tile too.
        ivec2 p = min(ivec2(gl_WorkGroupID.xy * LIGHTING_TILE + inside), size - 1);
        bits |= layerBits(p, 0);
        for (int s = 1; s < int(feature_samples); ++s) bits |= layerBits(p, s);
    } while (++i < LIGHTING_TILE_GROUPS);
    if (bits != 0u) atomicOr(layered, 1u);
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        TileClasses(constants.classes).at[gl_WorkGroupID.y * constants.size.x + gl_WorkGroupID.x] =
            layered != 0u ? TILES_LAYERED : TILES_BASE;
}
