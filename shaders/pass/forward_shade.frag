// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/lib/surface/forward.glsl"
#include "shaders/lib/shading/shade.glsl"
#include "shaders/lib/shading/transmission.glsl"

layout(location = 0) out vec4 out_lit;

void main() {
    Surface s = forwardSurface();
    Radiance radiance = shade(s, lightsAt(gl_FragCoord.xy, shadedDepth(), on(feature_transmission)));
    if (on(feature_transmission)) radiance = withTransmission(s, radiance, gl_FragCoord.xy);
    out_lit = vec4(lit(radiance), 1.0);
}
