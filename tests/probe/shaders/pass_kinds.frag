// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(push_constant, scalar) uniform Constants { vec4 color; float depth, corner; };
layout(location = 0) out vec4 result;

void main() { result = color; }
