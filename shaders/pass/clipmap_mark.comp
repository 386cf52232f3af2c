// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One thread per pixel: marks the page of the sun's clipmap that the pixel's surface samples. With MSAA it
// marks the pages of all samples, each as if shaded at its location.
#include "shaders/lib/shadows/clipmap.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/geometry/reversed_depth.glsl"
#include "shaders/lib/samples/samples.glsl"

layout(local_size_x = CLIPMAP_MARK_SIDE, local_size_y = CLIPMAP_MARK_SIDE) in;
layout(set = SET_CLIPMAP, binding = BINDING_CLIPMAP_DEPTH) uniform sampler2D depth;
layout(set = SET_CLIPMAP, binding = BINDING_CLIPMAP_DEPTH) uniform sampler2DMS depth_samples;
layout(set = SET_CLIPMAP, binding = BINDING_CLIPMAP_MARKS, scalar) buffer Marks { uint marks[]; };

// `point`: position in the image, pixels. `z`: reversed depth there.
void mark(const vec2 point, const float z) {
    if (z == 0.0) return;  // no geometry
    vec3 position = positionFromDepth(point, z);
    Clipmap map = clipmap();
    uint page = pageAt(map, shadowLight(), levelAt(map, position), position);
    // Most pixels find their page already marked, which avoids contention of atomics.
    if ((marks[page / 32u] & (1u << (page % 32u))) == 0u) atomicOr(marks[page / 32u], 1u << (page % 32u));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = multisampled() ? textureSize(depth_samples) : textureSize(depth, 0);
    if (any(greaterThanEqual(p, size))) return;
    if (!multisampled()) {
        mark(vec2(p) + 0.5, reversedDepth(texelFetch(depth, p, 0).r));
        return;
    }
    uint i = 0u;
    do {
        mark(vec2(p) + sampleLocation(i), reversedDepth(texelFetch(depth_samples, p, int(i)).r));
    } while (++i < feature_samples);
}
