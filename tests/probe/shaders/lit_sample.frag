// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Reads one sample of each pixel of channel `lit`.
layout(set = 0, binding = 0) uniform sampler2DMS drawn;
layout(push_constant, scalar) uniform Constants { uint which; };
layout(location = 0) out vec4 result;

void main() { result = texelFetch(drawn, ivec2(gl_FragCoord.xy), int(which)); }
