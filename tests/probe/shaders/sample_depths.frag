// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Writes the depth of one sample of each pixel, from a buffer of all; the pipeline's sample mask protects
// the others.
layout(set = 0, binding = 0, scalar) readonly buffer Depths { float depths[]; };
layout(push_constant, scalar) uniform Which { uint width, samples, which; };

void main() {
    uvec2 p = uvec2(gl_FragCoord.xy);
    gl_FragDepth = depths[(p.y * width + p.x) * samples + which];
}
