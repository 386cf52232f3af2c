// SPDX-License-Identifier: MIT
// The Surface that forward+ shades.
#ifndef FORWARD_GLSL
#define FORWARD_GLSL

#include "shaders/lib/surface/gbuffer.glsl"
#include "shaders/lib/surface/material.glsl"
#include "shaders/lib/geometry/position.glsl"
#include "shaders/lib/geometry/stored_depth.glsl"

// Reversed depth at which the pixel is shaded.
float shadedDepth() {
    return on(feature_stored_depth) ? depthAt(ivec2(gl_FragCoord.xy)) : fragmentDepth();
}

// With encoded_surface, the Surface that the deferred path decodes, which gives that path's image bit for
// bit. Nothing else may depend on that feature, as a test checks: any other difference would be attributed
// to the encoding.
Surface forwardSurface() {
    vec4 base_color = baseColor();
    cutOut(base_color);
    Surface s = surfaceFromMaterial(base_color);
    if (on(feature_stored_depth)) s.position = positionFromDepth(gl_FragCoord.xy, shadedDepth());
    if (on(feature_encoded_surface)) {
        Surface decoded = decodeGBuffer(encodeGBuffer(s), s.position);
        decoded.object_irradiance = s.object_irradiance;
        return decoded;
    }
    s.geometric_normal = quantiseGeometricNormal(s.geometric_normal);
    return s;
}

#endif
