// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One thread a pixel: marks the page of the sun's clipmap that the surface at the pixel is read from.
#include "shaders/lib/clipmap.glsl"
#include "shaders/lib/position.glsl"

layout(local_size_x = CLIPMAP_MARK_SIDE, local_size_y = CLIPMAP_MARK_SIDE) in;
layout(set = SET_CLIPMAP, binding = BINDING_CLIPMAP_DEPTH) uniform sampler2D depth;
layout(set = SET_CLIPMAP, binding = BINDING_CLIPMAP_MARKS, scalar) buffer Marks { uint marks[]; };

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
    float z = texelFetch(depth, p, 0).r;
    if (z == 0.0) return;  // nothing was drawn there
    vec3 position = positionFromDepth(vec2(p) + 0.5, z);
    Clipmap map = clipmap();
    uint page = pageAt(map, shadowLight(), levelAt(map, position), position);
    // Most pixels find their page marked: atomic operations wait for each other.
    if ((marks[page / 32u] & (1u << (page % 32u))) == 0u) atomicOr(marks[page / 32u], 1u << (page % 32u));
}
