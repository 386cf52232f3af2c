// SPDX-License-Identifier: MIT
// What a blended surface sends to the viewer and lets through, alike however fragments are put together.
#ifndef BLENDED_GLSL
#define BLENDED_GLSL

#include "shaders/lib/forward.glsl"
#include "shaders/lib/opacity.glsl"
#include "shaders/lib/shade.glsl"

struct BlendedFragment {
    vec3 radiance;  // times the share of its place that it covers, W/(sr m^2)
    float opacity;  // 0 to 1
    bool covers;    // false: nothing at all
};

// All that a surface sends counts as much as it covers, so highlights on glass stay; the haze before it as
// much as it hides, since what is seen through it has its own.
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
