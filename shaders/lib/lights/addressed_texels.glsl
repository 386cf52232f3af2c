// SPDX-License-Identifier: MIT
// Light and list buffers accessed by device address (FEATURE_addressed_lights), for buffers beyond the
// device's texel buffer limit. Vulkan guarantees 65,536 texels.
#ifndef ADDRESSED_TEXELS_GLSL
#define ADDRESSED_TEXELS_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/lib/contract.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer FloatTexels { vec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer WordTexels { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SingleWords { uint at[]; };

#endif
