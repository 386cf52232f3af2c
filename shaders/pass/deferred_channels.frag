// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Shades float32 channels of any renderer as deferred_shade.frag shades a G-buffer.
#define FLAT_VIEW
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/geometry/stored_depth.glsl"
#include "shaders/lib/surface/surface_channels.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    Surface s = surfaceFromChannels(ivec2(gl_FragCoord.xy));
    out_lit = vec4(lit(shade(s, lightsAt(gl_FragCoord.xy, depthAt(ivec2(gl_FragCoord.xy))))), 1.0);
}
