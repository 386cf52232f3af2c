// SPDX-License-Identifier: MIT
// Buffers of lights and lists by their addresses (FEATURE_addressed_lights), where a texel buffer of the
// device does not hold them: Vulkan promises 65,536 texels.
#ifndef ADDRESSED_TEXELS_GLSL
#define ADDRESSED_TEXELS_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/lib/contract.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FloatTexels { vec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer WordTexels { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SingleWords { uint at[]; };

#endif
