// SPDX-License-Identifier: MIT
// The Surface that the forward+ path shades.
#ifndef FORWARD_GLSL
#define FORWARD_GLSL

#include "shaders/lib/gbuffer.glsl"
#include "shaders/lib/material.glsl"
#include "shaders/lib/position.glsl"
#include "shaders/lib/stored_depth.glsl"

// The depth that the pixel is shaded with, reversed.
float shadedDepth() {
    return on(feature_stored_depth) ? depthAt(ivec2(gl_FragCoord.xy)) : fragmentDepth();
}

// With encoded_surface it is what the deferred path reads back, which gives that path's picture bit for bit.
// Nothing else may depend on that feature: a test checks it, because a difference between the two variants
// would count as the encoding's.
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
