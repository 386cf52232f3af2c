// SPDX-License-Identifier: MIT
// Which draw a vertex or fragment belongs to.
#ifndef DRAW_GLSL
#define DRAW_GLSL

#include "shaders/lib/contract.glsl"

layout(push_constant, scalar) uniform DrawBlock { DrawConstants constants; };

#endif
