// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// Smallest and largest reversed depth of an image's geometry, over all samples of all pixels. One thread
// reads two columns of DEPTH_BOUNDS_ROWS rows.
#include "shaders/lib/geometry/reversed_depth.glsl"
#include "shaders/lib/samples/samples.glsl"

layout(local_size_x = MOMENT_THREADS) in;
layout(set = SET_DEPTH_BOUNDS, binding = BINDING_BOUNDED_DEPTH) uniform sampler2D depth;
layout(set = SET_DEPTH_BOUNDS, binding = BINDING_BOUNDED_DEPTH) uniform sampler2DMS depth_samples;
layout(set = SET_DEPTH_BOUNDS, binding = BINDING_DEPTH_BOUNDS, scalar) buffer DepthBoundsBlock {
    DepthBounds bounds;
};

void add(const float z, inout uint nearest, inout uint deepest) {
    uint bits = floatBitsToUint(z);
    nearest = max(nearest, bits);
    deepest = z > 0.0 ? min(deepest, bits) : deepest;  // 0: no geometry
}

void main() {
    uint nearest = 0u, deepest = DEEPEST_OF_NOTHING;
    ivec2 size = multisampled() ? textureSize(depth_samples) : textureSize(depth, 0);
    ivec2 first = ivec2(gl_GlobalInvocationID.xy) * ivec2(2, DEPTH_BOUNDS_ROWS);
    for (int y = 0; y < int(DEPTH_BOUNDS_ROWS); y += 2) {
        // Pixels beyond the image's edge repeat the last pixels.
        if (multisampled()) {
            int s = 0;
            do {
                for (int i = 0; i < 4; ++i) {
                    ivec2 p = min(first + ivec2(i & 1, y + (i >> 1)), size - 1);
                    add(reversedDepth(texelFetch(depth_samples, p, s).r), nearest, deepest);
                }
            } while (++s < int(feature_samples));
        } else {
            vec4 z = textureGather(depth, vec2(min(first + ivec2(0, y), size - 1) + 1) / vec2(size));
            for (int i = 0; i < 4; ++i) add(reversedDepth(z[i]), nearest, deepest);
        }
    }
    // One atomic per subgroup, to avoid contention.
    nearest = subgroupMax(nearest);
    deepest = subgroupMin(deepest);
    if (subgroupElect()) {
        atomicMax(bounds.nearest, nearest);
        atomicMin(bounds.deepest, deepest);
    }
}
