// SPDX-License-Identifier: MIT
#version 460

layout(location = 0) out vec4 out_value;

// 4096 values in (0.03, 1); the target's rounded values are compared with float32.
void main() { out_value = vec4(0.03 + 0.97 * fract(gl_FragCoord.x * 0.61803399)); }
