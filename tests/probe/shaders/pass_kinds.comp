// SPDX-License-Identifier: MIT
#version 460

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, r32f) uniform writeonly image2D image;

// Each workgroup writes one texel: its x index plus 1.
void main() { imageStore(image, ivec2(gl_WorkGroupID.xy), vec4(float(gl_WorkGroupID.x + 1u))); }
