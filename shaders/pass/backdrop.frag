// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// One level of the mip chain behind surfaces with transmission, from the level before, or its first level
// from an image of the same size. Each texel is the mean over its area: a side of n texels becomes
// max(n / 2, 1), so that a texel covers one, two or, of an odd side, parts of three.
#include "shaders/lib/geometry/draw.glsl"

layout(set = SET_GBUFFER, binding = BINDING_BACKDROP) uniform texture2D backdrop;

layout(location = 0) out vec4 out_mean;

void main() {
    ivec2 from = textureSize(backdrop, 0), to = ivec2(constants.blended.width, constants.blended.rows);
    ivec2 p = ivec2(gl_FragCoord.xy), begin = p * from, end = begin + from;
    vec3 sum = vec3(0.0);
    for (int y = begin.y / to.y; y * to.y < end.y; ++y)
        for (int x = begin.x / to.x; x * to.x < end.x; ++x) {
            ivec2 covered = min(ivec2(x + 1, y + 1) * to, end) - max(ivec2(x, y) * to, begin);
            sum += texelFetch(backdrop, ivec2(x, y), 0).rgb * float(covered.x * covered.y);
        }
    out_mean = vec4(sum / float(from.x * from.y), 1.0);
}
