// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
// INPUTS: 0 to 3

#include "shaders/lib/forward.glsl"
#include "shaders/lib/shade.glsl"

// Premultiplied by the opacity.
layout(location = 0) out vec4 out_lit;

void main() {
    vec4 base_color = baseColor();
    Surface s = surfaceFromMaterial(base_color);
    s.geometric_normal = quantiseGeometricNormal(s.geometric_normal);
    float opacity = clamp(base_color.a, 0.0, 1.0);
    vec3 radiance = lit(shade(s, lightsAt(gl_FragCoord.xy, gl_FragCoord.z)));
    out_lit = vec4(radiance * opacity, opacity);
}
