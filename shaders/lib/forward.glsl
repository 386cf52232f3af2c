// SPDX-License-Identifier: MIT
// The Surface that the forward+ path shades.
#ifndef FORWARD_GLSL
#define FORWARD_GLSL

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/material.glsl"

// With quantise_surface it is what the deferred path would read back, which reproduces its picture bit for
// bit.
Surface forwardSurface() {
    vec4 base_color = baseColor();
    cutOut(base_color);
    Surface s = surfaceFromMaterial(base_color);
    if (on(feature_quantise_surface)) {
        Surface decoded = decodeGBuffer(encodeGBuffer(s), s.position);
        decoded.object_irradiance = s.object_irradiance;
        return decoded;
    }
    s.geometric_normal = quantiseGeometricNormal(s.geometric_normal);
    return s;
}

#endif
