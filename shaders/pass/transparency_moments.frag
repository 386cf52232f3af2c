// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Sums of optical depth, and of optical depth times powers of depth.
#include "shaders/lib/blending/opacity.glsl"
#include "shaders/lib/blending/transparency_moments.glsl"

layout(location = 0) out float out_optical_depth;
layout(location = 1) out vec4 out_moments;

void main() {
    vec4 base_color = baseColor();
    cutOut(base_color);
    float opacity = opacityOf(base_color);
    float optical_depth = opticalDepth(opacity, MAX_OPTICAL_DEPTH_OF_MOMENTS);
    out_optical_depth = optical_depth;
    out_moments = powersOf(momentDepth(middleDepth())) * optical_depth;
}
