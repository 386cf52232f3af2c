// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Blended over the attachment in draw order.
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/blending/blended.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    BlendedFragment f = blendedFragment();
    out_lit = vec4(f.radiance, f.opacity);
}
