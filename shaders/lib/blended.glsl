// SPDX-License-Identifier: MIT
// What a blended surface sends to the viewer and lets through, alike however fragments are put together.
#ifndef BLENDED_GLSL
#define BLENDED_GLSL

#include "shaders/lib/forward.glsl"
#include "shaders/lib/opacity.glsl"
#include "shaders/lib/shade.glsl"

struct BlendedFragment {
    vec3 radiance;  // times the opacity, W/(sr m^2)
    float opacity;  // 0 to 1
};

BlendedFragment blendedFragment() {
    vec4 base_color = baseColor();
    Surface s = surfaceFromMaterial(base_color);
    s.geometric_normal = quantiseGeometricNormal(s.geometric_normal);
    float opacity = opacityOf(base_color);
    vec3 radiance = lit(shade(s, lightsAt(gl_FragCoord.xy, gl_FragCoord.z)));
    return BlendedFragment(radiance * opacity, opacity);
}

#endif
