// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// Smallest and largest view depth in each tile, over all samples of its pixels; the smallest is the larger
// one in a tile without geometry. With lights_in_front also the range of blended surfaces: from the viewer
// on, and unbounded if a pixel shows the background. One workgroup per tile, one thread per four pixels.
#include "shaders/lib/lights/light_list_buffers.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/geometry/reversed_depth.glsl"
#include "shaders/lib/samples/samples.glsl"

layout(local_size_x = LIGHT_TILE / 2, local_size_y = LIGHT_TILE / 2) in;

layout(set = SET_LISTS, binding = BINDING_LISTS_DEPTH) uniform sampler2D depth;
layout(set = SET_LISTS, binding = BINDING_LISTS_DEPTH) uniform sampler2DMS depth_samples;
ivec2 size() { return multisampled() ? textureSize(depth_samples) : textureSize(depth, 0); }

const float NO_DEPTH = 2.0;
// Reversed depths as the bits of floats, whose order is that of the values for non-negative floats.
shared uint nearest, deepest;
shared uint farthest;  // over all pixels: 0 if one shows the background

void add(const float z, inout float near, inout float deep, inout float far) {
    near = max(near, z);
    deep = z > 0.0 ? min(deep, z) : deep;
    if (on(feature_lights_in_front)) far = min(far, z);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) {
        nearest = 0u;
        deepest = floatBitsToUint(NO_DEPTH);
        if (on(feature_lights_in_front)) farthest = floatBitsToUint(NO_DEPTH);
    }
    barrier();
    float near = 0.0, deep = NO_DEPTH, far = NO_DEPTH;
    uint side = 1u << grid.tile_shift;
    // If a tile has more pixels than the workgroup covers at once, each thread steps by LIGHT_TILE pixels
    // along both axes.
    uint steps = side / LIGHT_TILE, i = 0u;
    // On lavapipe a `for` loop would run its body once more.
    do {
        uvec2 step = uvec2(i % steps, i / steps);
        ivec2 p = ivec2(gl_WorkGroupID.xy * side + step * LIGHT_TILE + 2u * gl_LocalInvocationID.xy);
        if (all(lessThan(p, size()))) {
            // Pixels beyond the image's edge repeat the last pixel.
            if (multisampled()) {
                ivec2 last = size() - 1;
                ivec2 right = min(p + ivec2(1, 0), last), below = min(p + ivec2(0, 1), last);
                int s = 0;
                do {
                    add(reversedDepth(texelFetch(depth_samples, p, s).r), near, deep, far);
                    add(reversedDepth(texelFetch(depth_samples, right, s).r), near, deep, far);
                    add(reversedDepth(texelFetch(depth_samples, below, s).r), near, deep, far);
                    add(reversedDepth(texelFetch(depth_samples, min(p + 1, last), s).r), near, deep, far);
                } while (++s < int(feature_samples));
            } else {
                vec4 z = textureGather(depth, vec2(p + 1) / vec2(size()));
                add(reversedDepth(z.x), near, deep, far);
                add(reversedDepth(z.y), near, deep, far);
                add(reversedDepth(z.z), near, deep, far);
                add(reversedDepth(z.w), near, deep, far);
            }
        }
    } while (++i < steps * steps);
    // One atomic per subgroup, to avoid contention.
    near = subgroupMax(near);
    deep = subgroupMin(deep);
    if (subgroupElect()) {
        atomicMax(nearest, floatBitsToUint(near));
        atomicMin(deepest, floatBitsToUint(deep));
    }
    if (on(feature_lights_in_front)) {
        far = subgroupMin(far);
        if (subgroupElect()) atomicMin(farthest, floatBitsToUint(far));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        bool drawn = nearest > 0u;
        float smallest = drawn ? max(viewDepth(uintBitsToFloat(nearest)), 0.0) : MAX_BOUND_RADIUS;
        float largest = drawn ? max(viewDepth(uintBitsToFloat(deepest)), 0.0) : 0.0;
        uint tile = gl_WorkGroupID.y * grid.tiles.x + gl_WorkGroupID.x;
        tile_depths[tile] = vec2(smallest, largest);
        if (on(feature_lights_in_front))
            tile_depths[listInFront(tile)] = vec2(0.0, farthest > 0u ? largest : MAX_BOUND_RADIUS);
    }
}
