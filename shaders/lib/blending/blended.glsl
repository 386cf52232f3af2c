// SPDX-License-Identifier: MIT
// Radiance and opacity of a blended surface, the same for every method that combines fragments.
#ifndef BLENDED_GLSL
#define BLENDED_GLSL

#include "shaders/lib/surface/forward.glsl"
#include "shaders/lib/blending/opacity.glsl"
#include "shaders/lib/shading/shade.glsl"

struct BlendedFragment {
    vec3 radiance;  // times coverage, W/(sr m^2)
    float opacity;  // 0 to 1
    bool covers;    // false: the fragment contributes nothing
};

// Coverage scales the surface's light, so highlights on glass stay. Opacity scales the haze in front,
// because surfaces seen through this one have their own haze.
BlendedFragment blendedFragment() {
    vec4 base_color = baseColor();
    cutOut(base_color);
    Surface s = surfaceFromMaterial(base_color);
    s.geometric_normal = quantiseGeometricNormal(s.geometric_normal);
    Radiance radiance = shade(s, lightsAt(gl_FragCoord.xy, middleDepth(), true));
    float covers = coverageOf(base_color), opacity = opacityOf(s, base_color);
    if (!on(feature_transmission)) return BlendedFragment(lit(radiance) * covers, covers, covers > 0.0);
    vec3 haze = radiance.haze;
    radiance.haze = vec3(0.0);
    vec3 sum = lit(radiance) * covers;
    if (on(feature_haze)) sum += haze * opacity;
    return BlendedFragment(sum, opacity, covers > 0.0);
}

#endif
