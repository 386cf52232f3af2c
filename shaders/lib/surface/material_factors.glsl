// SPDX-License-Identifier: MIT
// Material factors of a draw.
#ifndef MATERIAL_FACTORS_GLSL
#define MATERIAL_FACTORS_GLSL

#include "shaders/lib/contract.glsl"

layout(set = SET_MATERIAL, binding = BINDING_MATERIAL, scalar) uniform MaterialBlock { Material material; };

#endif
