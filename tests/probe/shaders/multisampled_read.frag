// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Reads one sample of each pixel, and its depth.
layout(set = 0, binding = 0) uniform usampler2DMS drawn;
layout(set = 0, binding = 1) uniform sampler2DMS depth;
layout(push_constant, scalar) uniform Constants { vec4 corners[3]; vec3 values; uint which; };
layout(location = 0) out uvec4 result;
layout(location = 1) out float result_depth;

void main() {
    result = texelFetch(drawn, ivec2(gl_FragCoord.xy), int(which));
    result_depth = texelFetch(depth, ivec2(gl_FragCoord.xy), int(which)).r;
}
