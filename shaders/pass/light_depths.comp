// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// The least and the largest view depth in each tile, over all samples of all its pixels, and how far transparents may
// be seen in it: without end where a sample shows the background. A workgroup a tile.
// MULTISAMPLED: 0 to 1
#include "shaders/lib/light_kernel.glsl"
#include "shaders/lib/position.glsl"

layout(local_size_x = LIGHT_TILE, local_size_y = LIGHT_TILE) in;

#if MULTISAMPLED
layout(set = SET_LISTS, binding = BINDING_LISTS_DEPTH) uniform sampler2DMS depth;
int samples() { return textureSamples(depth); }
ivec2 size() { return textureSize(depth); }
#else
layout(set = SET_LISTS, binding = BINDING_LISTS_DEPTH) uniform sampler2D depth;
int samples() { return 1; }
ivec2 size() { return textureSize(depth, 0); }
#endif

shared uint least, largest, farthest;  // bits of positive floats, which order as they do

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        least = floatBitsToUint(MAX_BOUND_RADIUS);
        largest = 0u;
        farthest = 0u;
    }
    barrier();
    float low = MAX_BOUND_RADIUS, high = 0.0, end = 0.0;
    uint side = 1u << grid.tile_shift;
    // A tile of more pixels than threads: every LIGHT_TILE-th of them, both ways.
    uint steps = side / LIGHT_TILE, i = 0u;
    // Not `for`, which runs a body more on lavapipe.
    do {
        uvec2 step = uvec2(i % steps, i / steps);
        ivec2 p = ivec2(gl_WorkGroupID.xy * side + step * LIGHT_TILE + gl_LocalInvocationID.xy);
        bool inside = all(lessThan(p, size()));
        int s = 0;
        do {
            float z = inside ? texelFetch(depth, p, s).r : 0.0;
            float d = viewDepth(z);
            low = z > 0.0 ? min(low, d) : low;  // 0: nothing was drawn there
            high = z > 0.0 ? max(high, d) : high;
            end = inside && z <= 0.0 ? MAX_BOUND_RADIUS : end;
        } while (++s < samples());
    } while (++i < steps * steps);
    // One atomic a subgroup: its threads' would wait for each other.
    low = subgroupMin(low);
    high = subgroupMax(high);
    end = subgroupMax(end);
    if (subgroupElect()) {
        atomicMin(least, floatBitsToUint(max(low, 0.0)));
        atomicMax(largest, floatBitsToUint(max(high, 0.0)));
        atomicMax(farthest, floatBitsToUint(max(high, end)));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        tile_depths[gl_WorkGroupID.y * grid.tiles.x + gl_WorkGroupID.x] =
            vec3(uintBitsToFloat(least), uintBitsToFloat(largest), uintBitsToFloat(farthest));
}
