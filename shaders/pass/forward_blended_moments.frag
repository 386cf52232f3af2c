// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Sums of radiance and opacity, each layer weighted by the transmittance of the layers in front.
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/blending/blended.glsl"
#include "shaders/lib/blending/transparency_moments.glsl"

layout(location = 0) out vec4 out_sums;

void main() {
    BlendedFragment f = blendedFragment();
    float weight = transmittanceBefore(ivec2(gl_FragCoord.xy), middleDepth());
    out_sums = vec4(f.radiance, f.opacity) * weight;
}
