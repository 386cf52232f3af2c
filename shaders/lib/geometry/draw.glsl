// SPDX-License-Identifier: MIT
// Push constants of a draw.
#ifndef DRAW_GLSL
#define DRAW_GLSL

#include "shaders/lib/contract.glsl"

layout(push_constant, scalar) uniform DrawBlock { DrawConstants constants; };

#endif
