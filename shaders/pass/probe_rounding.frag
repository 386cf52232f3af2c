// SPDX-License-Identifier: MIT
#version 460

layout(location = 0) out vec4 out_value;

// 4096 values spread over (0.03, 1): what the target makes of them is compared with what float32 keeps.
void main() { out_value = vec4(0.03 + 0.97 * fract(gl_FragCoord.x * 0.61803399)); }
