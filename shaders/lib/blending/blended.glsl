// SPDX-License-Identifier: MIT
// Radiance and opacity of a blended surface, the same for every method that combines fragments.
#ifndef BLENDED_GLSL
#define BLENDED_GLSL

#include "shaders/lib/surface/forward.glsl"
#include "shaders/lib/blending/opacity.glsl"
#include "shaders/lib/shading/shade.glsl"

struct BlendedFragment {
    vec3 radiance;  // times opacity, W/(sr m^2)
    float opacity;  // 0 to 1
};

BlendedFragment blendedFragment() {
    vec4 base_color = baseColor();
    cutOut(base_color);
    Surface s = surfaceFromMaterial(base_color);
    s.geometric_normal = quantiseGeometricNormal(s.geometric_normal);
    Radiance radiance = shade(s, lightsAt(gl_FragCoord.xy, middleDepth(), true));
    float opacity = opacityOf(base_color);
    return BlendedFragment(lit(radiance) * opacity, opacity);
}

#endif
